// SPDX-License-Identifier: BSD-3-Clause
#include "TractogramData.h"

#include "Columns.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkTypeInt64Array.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <numeric>
#include <utility>

namespace cactus
{

namespace
{

constexpr double micrometres = 1e3; ///< of one mm

/// An array of these values times `factor`; the vector is emptied.
vtkSmartPointer<vtkDoubleArray> arrayOf(
  const std::string& name, std::vector<double>& values, std::size_t components, double factor)
{
  auto array = makeArray<vtkDoubleArray>(name, values.size() / components, int(components));
  std::transform(values.begin(), values.end(), array->GetPointer(0), [factor](double value) { return factor * value; });
  std::vector<double>().swap(values);
  return array;
}

void addValues(vtkFieldData* data, std::vector<TractogramValues>& all, double length)
{
  for (TractogramValues& values : all)
  {
    const double factor = values.name == "Radius" ? length : 1.0;
    data->AddArray(arrayOf(values.name, values.values, values.components, factor));
  }
}

vtkSmartPointer<vtkCellArray> linesOf(const Tractogram& tractogram)
{
  auto offsets = makeArray<vtkTypeInt64Array>("", tractogram.offsets.size());
  std::copy(tractogram.offsets.begin(), tractogram.offsets.end(), offsets->GetPointer(0));
  auto corners = makeArray<vtkTypeInt64Array>("", tractogram.pointCount());
  std::iota(corners->GetPointer(0), corners->GetPointer(0) + tractogram.pointCount(), vtkTypeInt64(0));
  auto lines = vtkSmartPointer<vtkCellArray>::New();
  lines->SetData(offsets, corners);
  return lines;
}

/// How many groups each streamline is in at most.
int mostGroups(const Tractogram& tractogram)
{
  std::vector<int> counts(tractogram.size(), 0);
  for (const TractogramGroup& group : tractogram.groups)
  {
    for (const std::uint32_t streamline : group.streamlines)
    {
      ++counts[streamline];
    }
  }
  return counts.empty() ? 0 : *std::max_element(counts.begin(), counts.end());
}

void addGroups(const Tractogram& tractogram, vtkPolyData* output)
{
  const std::vector<TractogramGroup>& groups = tractogram.groups;
  addColumn<vtkStringArray>(output->GetFieldData(), "BundleName", groups.size(), [&](std::size_t g) { return groups[g].name; });
  vtkCellData* cells = output->GetCellData();
  if (cells->GetArray("BundleId") == nullptr)
  {
    std::vector<int> bundles(tractogram.size(), int(groups.size()) + 1);
    for (std::size_t g = groups.size(); g-- > 0;)
    {
      for (const std::uint32_t streamline : groups[g].streamlines)
      {
        bundles[streamline] = int(g) + 1; // the first one last
      }
    }
    addColumn<vtkIntArray>(cells, "BundleId", bundles.size(), [&](std::size_t s) { return bundles[s]; });
  }
  if (mostGroups(tractogram) < 2)
  {
    return;
  }
  for (const TractogramGroup& group : groups)
  {
    auto members = makeArray<vtkUnsignedCharArray>("Group " + group.name, tractogram.size());
    members->Fill(0.0);
    for (const std::uint32_t streamline : group.streamlines)
    {
      members->SetValue(vtkIdType(streamline), 1);
    }
    cells->AddArray(members);
  }
}

} // namespace

void toPolyData(Tractogram tractogram, LengthUnit unit, double radius, vtkPolyData* output)
{
  const double length = unit == LengthUnit::Micrometre ? micrometres : 1.0;
  const std::size_t pointCount = tractogram.pointCount();
  vtkNew<vtkPolyData> fresh;
  fresh->SetLines(linesOf(tractogram));
  vtkNew<vtkPoints> points;
  points->SetData(arrayOf("Points", tractogram.points, 3, length));
  fresh->SetPoints(points);
  addValues(fresh->GetPointData(), tractogram.pointValues, length);
  addValues(fresh->GetCellData(), tractogram.streamlineValues, length);
  if (radius > 0.0 && fresh->GetPointData()->GetArray("Radius") == nullptr)
  {
    addColumn<vtkDoubleArray>(
      fresh->GetPointData(), "Radius", pointCount, [&](std::size_t) { return radius * length / micrometres; });
  }
  if (!tractogram.groups.empty())
  {
    addGroups(tractogram, fresh);
  }
  output->ShallowCopy(fresh);
}

} // namespace cactus
