// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPlacement.h"

#include "DataProvenance.h"
#include "FilterSupport.h"
#include "PlacementData.h"
#include "StageProperties.h"
#include "WholeData.h"
#include "base/Error.h"
#include "base/Limits.h"
#include "base/Numbers.h"
#include "stages/Stages.h"

#include <vtkCompositeDataIterator.h>
#include <vtkCompositeDataSet.h>
#include <vtkDataObjectTree.h>
#include <vtkDataSet.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkMatrix3x3.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkSmartPointer.h>
#include <vtkTable.h>

#include <cmath>
#include <string>

vtkStandardNewMacro(vtkPlacement);

namespace
{

/// What cannot be placed is refused by name: data without points, and grids that are nowhere.
void requirePlaceable(vtkDataObject* data)
{
  auto* set = vtkDataSet::SafeDownCast(data);
  if (set == nullptr && vtkTable::SafeDownCast(data) == nullptr)
  {
    throw cactus::InvalidInput(std::string("the input is a ") + data->GetClassName() + ", which cannot be placed");
  }
  auto* image = vtkImageData::SafeDownCast(data);
  if (image == nullptr)
  {
    return;
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    if (!(std::abs(image->GetOrigin()[axis]) <= cactus::limits::coordinate.highest) ||
        !(std::abs(image->GetSpacing()[axis]) <= cactus::limits::coordinate.highest))
    {
      throw cactus::InvalidInput(
        cactus::text("the input's origin and spacing have to be finite, and within ", cactus::limits::coordinate.highest, " µm"));
    }
  }
}

/// Makes `output`, which is of the same type, a shallow copy of `input`, and calls `visit` with each data set of the copy.
template <typename Visit>
void copyEach(vtkDataObject* input, vtkDataObject* output, Visit&& visit)
{
  auto* composite = vtkCompositeDataSet::SafeDownCast(input);
  if (composite == nullptr)
  {
    requirePlaceable(input);
    output->ShallowCopy(input);
    visit(output);
    return;
  }
  auto* tree = vtkDataObjectTree::SafeDownCast(output);
  if (tree == nullptr)
  {
    throw cactus::InvalidInput(std::string("the input is a ") + input->GetClassName() +
                               ", whose blocks have to lie along the axes: apply Merge Blocks first");
  }
  tree->CopyStructure(composite);
  tree->GetFieldData()->ShallowCopy(input->GetFieldData());
  auto blocks = vtk::TakeSmartPointer(composite->NewIterator());
  for (blocks->InitTraversal(); !blocks->IsDoneWithTraversal(); blocks->GoToNextItem())
  {
    vtkDataObject* block = blocks->GetCurrentDataObject();
    requirePlaceable(block);
    auto copy = vtk::TakeSmartPointer(block->NewInstance());
    copy->ShallowCopy(block);
    visit(copy.GetPointer());
    tree->SetDataSet(blocks, copy);
  }
}

} // namespace

vtkPlacement::vtkPlacement()
  : Properties(cactus::makeProperties<cactus::PlacementStage>())
{
}

int vtkPlacement::FillInputPortInformation(int, vtkInformation* info)
{
  cactus::acceptAnyData(info);
  return 1;
}

int vtkPlacement::RequestInformation(vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkInformation* info = inputs[0]->GetInformationObject(0);
  if (info == nullptr || info->Has(vtkDataObject::ORIGIN()) == 0 || info->Has(vtkDataObject::SPACING()) == 0)
  {
    return 1;
  }
  // Of an image: its grid is known before its data.
  cactus::quietly(
    [&]
    {
      vtkNew<vtkImageData> grid;
      grid->SetOrigin(info->Get(vtkDataObject::ORIGIN()));
      grid->SetSpacing(info->Get(vtkDataObject::SPACING()));
      if (info->Has(vtkDataObject::DIRECTION()) != 0)
      {
        grid->SetDirectionMatrix(info->Get(vtkDataObject::DIRECTION()));
      }
      cactus::place(grid, cactus::stageOf<cactus::PlacementStage>(this->Properties).options.placement());
      vtkInformation* placed = outputs->GetInformationObject(0);
      placed->Set(vtkDataObject::ORIGIN(), grid->GetOrigin(), 3);
      placed->Set(vtkDataObject::SPACING(), grid->GetSpacing(), 3);
      placed->Set(vtkDataObject::DIRECTION(), grid->GetDirectionMatrix()->GetData(), 9);
    });
  return 1;
}

int vtkPlacement::RequestData(vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  return cactus::guarded(this,
    [&]
    {
      const auto& stage = cactus::stageOf<cactus::PlacementStage>(this->Properties);
      const cactus::Placement placement = stage.options.placement();
      const auto record = cactus::recordOf(this, "Placement", stage, { "Input" });
      copyEach(vtkDataObject::GetData(inputs[0]), vtkDataObject::GetData(outputs),
        [&](vtkDataObject* copy)
        {
          cactus::place(copy, placement);
          if (cactus::placementOf(copy))
          {
            cactus::setProvenance(copy, record, 0);
          }
        });
    });
}

void vtkPlacement::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  this->Properties->print(os, indent);
}
