// SPDX-License-Identifier: BSD-3-Clause
#include "TractogramData.h"

#include "Columns.h"
#include "FibreData.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
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

void addValues(vtkFieldData* data, std::vector<TractogramValues>& all)
{
  for (TractogramValues& values : all)
  {
    data->AddArray(adoptedArray(values.name, std::move(values.values), int(values.components)));
  }
}

vtkSmartPointer<vtkCellArray> linesOf(std::vector<std::size_t> offsets, std::size_t pointCount)
{
  auto corners = makeArray<vtkTypeInt64Array>("", pointCount);
  std::iota(corners->GetPointer(0), corners->GetPointer(0) + pointCount, vtkTypeInt64(0));
  auto lines = vtkSmartPointer<vtkCellArray>::New();
  lines->SetData(adoptedArray("", std::move(offsets)), corners);
  return lines;
}

/// Returns the largest number of groups of a streamline.
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
    const std::vector<int> bundles = bundlesByGroup(tractogram);
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

void toPolyData(Tractogram tractogram, vtkPolyData* output)
{
  // Large arrays, perhaps gigabytes, are not copied.
  const std::size_t pointCount = tractogram.pointCount();
  vtkNew<vtkPolyData> fresh;
  vtkNew<vtkPoints> points;
  points->SetData(adoptedArray("Points", std::move(tractogram.points), 3));
  fresh->SetPoints(points);
  addValues(fresh->GetPointData(), tractogram.pointValues);
  addValues(fresh->GetCellData(), tractogram.streamlineValues);
  if (!tractogram.groups.empty())
  {
    addGroups(tractogram, fresh);
  }
  fresh->SetLines(linesOf(std::move(tractogram.offsets), pointCount));
  if (fresh->GetPointData()->GetArray("Direction") == nullptr) // a file may have its own
  {
    addDirectionColours(fresh);
  }
  output->ShallowCopy(fresh);
}

} // namespace cactus
