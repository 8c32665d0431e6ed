// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPlacement.h"

#include "DataProvenance.h"
#include "FilterSupport.h"
#include "InputBlocks.h"
#include "PlacementData.h"
#include "StageProperties.h"
#include "SubstrateInputs.h"
#include "WholeData.h"
#include "base/Error.h"
#include "base/Limits.h"
#include "base/Numbers.h"
#include "stages/Stages.h"
#include "stages/TractRecords.h"

#include <vtkCompositeDataIterator.h>
#include <vtkCompositeDataSet.h>
#include <vtkDataObjectTree.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkMatrix3x3.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkPlacement);

namespace
{

/// Tells whether data of this type, or their blocks, can be placed.
bool canBePlaced(vtkDataObject* data)
{
  return vtkDataObjectTree::SafeDownCast(data) != nullptr || cactus::isPlaceable(data);
}

/// Tells whether there is nothing to place, in the data set or in its blocks.
bool isEmpty(vtkDataObject* data)
{
  const std::vector<vtkDataObject*> leaves = cactus::leavesOf(data);
  return std::all_of(leaves.begin(), leaves.end(),
    [](vtkDataObject* leaf)
    { return leaf->GetNumberOfElements(vtkDataObject::POINT) == 0 && leaf->GetNumberOfElements(vtkDataObject::ROW) == 0; });
}

void requireFinite(vtkImageData* image)
{
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

/// Throws InvalidInput for types that cannot be placed, such as refined blocks, and for grids without a position.
void requireValid(vtkDataObject* data)
{
  if (vtkCompositeDataSet::SafeDownCast(data) != nullptr)
  {
    throw cactus::InvalidInput(std::string("the input is a ") + data->GetClassName() +
                               ", whose blocks have to lie along the axes: apply Merge Blocks first");
  }
  cactus::requirePlaceable(data);
  if (auto* image = vtkImageData::SafeDownCast(data))
  {
    requireFinite(image);
  }
}

/// Makes `output`, which is of the same type, a shallow copy of `input`, and calls `visit` with each data set of the copy.
template <typename Visit>
void copyEach(vtkDataObject* input, vtkDataObject* output, Visit&& visit)
{
  auto* tree = vtkDataObjectTree::SafeDownCast(output);
  if (tree == nullptr)
  {
    requireValid(input);
    output->ShallowCopy(input);
    visit(output);
    return;
  }
  auto* composite = vtkCompositeDataSet::SafeDownCast(input);
  tree->CopyStructure(composite);
  tree->GetFieldData()->ShallowCopy(input->GetFieldData());
  auto blocks = vtk::TakeSmartPointer(composite->NewIterator());
  for (blocks->InitTraversal(); !blocks->IsDoneWithTraversal(); blocks->GoToNextItem())
  {
    vtkDataObject* block = blocks->GetCurrentDataObject();
    requireValid(block);
    auto copy = vtk::TakeSmartPointer(block->NewInstance());
    copy->ShallowCopy(block);
    visit(copy.GetPointer());
    tree->SetDataSet(blocks, copy);
  }
}

/// Returns the placement that the options ask for, of data with these origins.
cactus::Placement placementFor(const cactus::PlacementOptions& options, const cactus::InputOrigins& origins)
{
  cactus::validateProperties(options);
  return options.by == cactus::PlacementBy::Tract ? cactus::placementOnTract(origins) : options.placement();
}

} // namespace

vtkPlacement::vtkPlacement()
  : Properties(cactus::makeProperties<cactus::PlacementStage>())
{
  this->SetNumberOfOutputPorts(2);
}

int vtkPlacement::FillInputPortInformation(int, vtkInformation* info)
{
  cactus::acceptAnyData(info);
  return 1;
}

int vtkPlacement::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 0 ? "vtkDataObject" : "vtkPolyData");
  return 1;
}

int vtkPlacement::RequestDataObject(vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkDataObject* input = vtkDataObject::GetData(inputs[0]);
  if ((input == nullptr || canBePlaced(input)) && this->Superclass::RequestDataObject(request, inputs, outputs) == 0)
  {
    return 0;
  }
  // Inner surfaces; and an output for the error: ParaView cannot show all types of data when empty.
  for (int port = input == nullptr || canBePlaced(input) ? 1 : 0; port < this->GetNumberOfOutputPorts(); ++port)
  {
    vtkInformation* info = outputs->GetInformationObject(port);
    if (vtkPolyData::GetData(info) == nullptr)
    {
      vtkNew<vtkPolyData> nothing;
      info->Set(vtkDataObject::DATA_OBJECT(), nothing);
    }
  }
  return 1;
}

int vtkPlacement::RequestInformation(vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkInformation* info = inputs[0]->GetInformationObject(0);
  if (info == nullptr || info->Has(vtkDataObject::ORIGIN()) == 0 || info->Has(vtkDataObject::SPACING()) == 0)
  {
    return 1;
  }
  // For an image: its grid is needed before its data.
  cactus::quietly(
    [&]
    {
      const auto& options = cactus::stageOf<cactus::PlacementStage>(this->Properties).options;
      cactus::InputOrigins origins;
      if (options.by == cactus::PlacementBy::Tract)
      {
        cactus::updateWholeInputs(this, inputs); // which say on which tract they lie
        origins = cactus::originsOf(this, { "Input" });
      }
      vtkNew<vtkImageData> grid;
      grid->SetOrigin(info->Get(vtkDataObject::ORIGIN()));
      grid->SetSpacing(info->Get(vtkDataObject::SPACING()));
      if (info->Has(vtkDataObject::DIRECTION()) != 0)
      {
        grid->SetDirectionMatrix(info->Get(vtkDataObject::DIRECTION()));
      }
      cactus::place(grid, placementFor(options, origins));
      vtkInformation* placed = outputs->GetInformationObject(0);
      placed->Set(vtkDataObject::ORIGIN(), grid->GetOrigin(), 3);
      placed->Set(vtkDataObject::SPACING(), grid->GetSpacing(), 3);
      placed->Set(vtkDataObject::DIRECTION(), grid->GetDirectionMatrix()->GetData(), 9);
    });
  return 1;
}

int vtkPlacement::RequestData(vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  return cactus::guarded(this,
    [&]
    {
      const auto& stage = cactus::stageOf<cactus::PlacementStage>(this->Properties);
      vtkDataObject* input = vtkDataObject::GetData(inputs[0]);
      if (canBePlaced(input) && isEmpty(input))
      {
        if (!cactus::ownsWholeOutput(request, outputs))
        {
          return; // another rank has it
        }
        throw cactus::InvalidInput("the input is empty: there is nothing to place");
      }
      const cactus::InputOrigins origins = cactus::originsOf(this, { "Input" });
      const cactus::Placement placement = placementFor(stage.options, origins);
      const auto record =
        cactus::provenanceOf({ "Placement", cactus::PlacementStage::properties().states(stage), {}, {}, origins });
      const auto giveOut = [&](vtkDataObject* data, int port)
      {
        copyEach(data, vtkDataObject::GetData(outputs, port),
          [&](vtkDataObject* copy)
          {
            cactus::place(copy, placement);
            if (cactus::placementOf(copy))
            {
              cactus::setProvenance(copy, record, port);
            }
          });
      };
      giveOut(input, 0);
      if (vtkDataObject* inner = cactus::substrateDataOf(this, 0, -1, -1).inner)
      {
        giveOut(inner, 1);
      }
    });
}
