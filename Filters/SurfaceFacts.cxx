// SPDX-License-Identifier: BSD-3-Clause
#include "SurfaceFacts.h"

#include "Columns.h"

#include <vtkCompositeDataIterator.h>
#include <vtkCompositeDataSet.h>
#include <vtkDataArray.h>
#include <vtkDataObject.h>
#include <vtkFieldData.h>
#include <vtkSmartPointer.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace cactus
{

namespace
{

constexpr const char* wantedName = "WantedFibres";
constexpr const char* gapName = "MinimumGap";

void readOne(vtkDataObject* data, FibreSurfaces& surfaces)
{
  vtkDataArray* wanted = data->GetFieldData() != nullptr ? data->GetFieldData()->GetArray(wantedName) : nullptr;
  for (vtkIdType i = 0; wanted != nullptr && wanted->GetNumberOfComponents() == 1 && i < wanted->GetNumberOfTuples(); ++i)
  {
    const double id = wanted->GetComponent(i, 0);
    if (id >= 1.0 && id <= double(std::numeric_limits<int>::max()) && id == std::floor(id))
    {
      surfaces.wantedIds.push_back(static_cast<int>(id));
    }
  }
  vtkDataArray* gap = data->GetFieldData() != nullptr ? data->GetFieldData()->GetArray(gapName) : nullptr;
  if (gap != nullptr && gap->GetNumberOfValues() == 1 && std::isfinite(gap->GetComponent(0, 0)))
  {
    surfaces.promisedGap = std::max(surfaces.promisedGap, gap->GetComponent(0, 0));
  }
}

} // namespace

void setSurfaceFacts(vtkDataObject* output, const std::vector<int>& wantedFibres, double minimumGap)
{
  addColumn<vtkIntArray>(output->GetFieldData(), wantedName, wantedFibres.size(), [&](std::size_t i) { return wantedFibres[i]; });
  addNumber(output->GetFieldData(), gapName, minimumGap);
}

void readSurfaceFacts(vtkDataObject* input, FibreSurfaces& surfaces)
{
  surfaces.isGiven = input != nullptr;
  if (input == nullptr)
  {
    return;
  }
  readOne(input, surfaces);
  if (auto* composite = vtkCompositeDataSet::SafeDownCast(input))
  {
    const auto blocks = vtkSmartPointer<vtkCompositeDataIterator>::Take(composite->NewIterator());
    for (blocks->InitTraversal(); !blocks->IsDoneWithTraversal(); blocks->GoToNextItem())
    {
      readOne(blocks->GetCurrentDataObject(), surfaces);
    }
  }
}

} // namespace cactus
