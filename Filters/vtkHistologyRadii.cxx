// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHistologyRadii.h"

#include "Columns.h"
#include "DataProvenance.h"
#include "FilterSupport.h"
#include "PlacementData.h"
#include "StageProperties.h"
#include "WholeData.h"
#include "base/Error.h"
#include "judge/HistologyRadii.h"
#include "judge/MaskColours.h"
#include "stages/Stages.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDataObject.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkIntArray.h>
#include <vtkLookupTable.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkTable.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkHistologyRadii);

namespace
{

/// Returns the active scalars, those of points first; else the first array.
vtkDataArray* greysOf(vtkImageData* image)
{
  for (vtkDataSetAttributes* data :
    { static_cast<vtkDataSetAttributes*>(image->GetPointData()), static_cast<vtkDataSetAttributes*>(image->GetCellData()) })
  {
    vtkDataArray* array = data->GetScalars() != nullptr ? data->GetScalars() : data->GetArray(0);
    if (array != nullptr)
    {
      return array;
    }
  }
  throw cactus::InvalidInput("the input has no grey values: give a mask as AxonDeepSeg or HistologyMask makes it");
}

/// Checks the pixel size against that of a mask of HistologyMask, also if the image was rescaled since.
void requirePixelSize(vtkImageData* image, double pixelSize)
{
  const auto placement = cactus::placementOf(image);
  const double width = image->GetSpacing()[0] / (placement ? placement->scale : 1.0);
  if (image->GetFieldData()->HasArray("PixelSize_um") != 0 && std::abs(width - pixelSize) > 1e-3 * width)
  {
    throw cactus::InvalidInput(cactus::text(
      "the mask's pixels have an edge of ", width, " µm, and PixelSize is ", pixelSize, " µm: set PixelSize to ", width));
  }
}

/// Gives the colour or grey value of each pixel. An image with a palette holds indices, from which its table makes colours.
class PixelColours
{
public:
  explicit PixelColours(vtkDataArray* array)
    : Array(array)
    , Components(std::size_t(array->GetNumberOfComponents()))
  {
    vtkLookupTable* palette = array->GetLookupTable();
    if (palette != nullptr && palette->GetIndexedLookup() != 0 && this->Components.size() == 1)
    {
      this->Components.resize(4);
      for (int index = 0; index < mostColours; ++index)
      {
        const unsigned char* colour = palette->MapValue(index);
        this->Palette.push_back({ { double(colour[0]), double(colour[1]), double(colour[2]), double(colour[3]) } });
      }
    }
  }

  const std::vector<double>& at(vtkIdType pixel)
  {
    if (this->Palette.empty())
    {
      this->Array->GetTuple(pixel, this->Components.data());
      return this->Components;
    }
    const double index = this->Array->GetComponent(pixel, 0);
    if (!(index >= 0.0 && index < mostColours))
    {
      throw cactus::InvalidInput(
        cactus::text("the mask has a pixel of colour ", index, " of its palette, which has none beyond 255"));
    }
    const auto& colour = this->Palette[std::size_t(index)];
    this->Components.assign(colour.begin(), colour.end());
    return this->Components;
  }

private:
  static constexpr int mostColours = 256;

  vtkDataArray* Array;
  std::vector<double> Components;
  std::vector<std::array<double, 4>> Palette;
};

cactus::HistologyMask maskFrom(vtkDataObject* input, const cactus::HistologyRadiiStage& stage)
{
  auto* image = vtkImageData::SafeDownCast(input);
  if (image == nullptr)
  {
    throw cactus::InvalidInput(
      std::string("the input is a ") + input->GetClassName() + ", and one mask is expected: 0 background, 127 myelin, 255 axon");
  }
  requirePixelSize(image, stage.pixelSize);
  vtkDataArray* greys = greysOf(image);
  const int* size = image->GetDimensions();
  const int less = greys->GetNumberOfTuples() == image->GetNumberOfPoints() ? 0 : 1; // cells lie between points
  cactus::HistologyMask mask;
  mask.count = { { size[0] - less, size[1] - less } };
  mask.pixelSize = stage.pixelSize;
  if (size[2] != 1 || mask.count[0] < 1 || mask.count[1] < 1 || greys->GetNumberOfTuples() != vtkIdType(mask.size()))
  {
    throw cactus::InvalidInput(cactus::text("the input has ", size[0], " × ", size[1], " × ", size[2],
      " points: give a flat image, along x and y, with a grey value for each pixel"));
  }
  cactus::MaskReader reader(stage.axonColour, stage.myelinColour);
  PixelColours colours(greys);
  for (vtkIdType i = 0; i < vtkIdType(mask.size()); ++i)
  {
    const std::vector<double>& components = colours.at(i);
    mask.pixels.push_back(reader.tissueOf(components.data(), components.size()));
  }
  reader.finish();
  return mask;
}

void fillTable(const std::vector<cactus::MaskAxon>& axons, double pixelSize, vtkTable* table)
{
  const auto column = [&](const char* name, auto&& value)
  { cactus::addColumn<vtkDoubleArray>(table, name, axons.size(), [&](std::size_t i) { return value(axons[i]); }); };
  using Axon = cactus::MaskAxon;
  column("X_um", [&](const Axon& axon) { return pixelSize * (axon.column + 0.5); });
  column("Y_um", [&](const Axon& axon) { return pixelSize * (axon.row + 0.5); });
  column("AxonRadius_um", [](const Axon& axon) { return axon.axonRadius(); });
  column("FibreRadius_um", [](const Axon& axon) { return axon.fibreRadius(); });
  column("GRatio", [](const Axon& axon) { return axon.axonRadius() / axon.fibreRadius(); });
  column("AxonArea_um2", [](const Axon& axon) { return axon.axonArea; });
  column("MyelinArea_um2", [](const Axon& axon) { return axon.myelinArea; });
  cactus::addColumn<vtkIntArray>(table, "AtBorder", axons.size(), [&](std::size_t i) { return axons[i].touchesBorder ? 1 : 0; });
}

} // namespace

vtkHistologyRadii::vtkHistologyRadii()
  : Properties(cactus::makeProperties<cactus::HistologyRadiiStage>())
{
}

int vtkHistologyRadii::FillInputPortInformation(int, vtkInformation* info)
{
  cactus::acceptAnyData(info);
  return 1;
}

int vtkHistologyRadii::RequestUpdateExtent(vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  cactus::requestWholeInputs(inputs, 1);
  return 1;
}

int vtkHistologyRadii::RequestData(vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  return cactus::guarded(this,
    [&]
    {
      const auto& stage = cactus::stageOf<cactus::HistologyRadiiStage>(this->Properties);
      cactus::validateProperties(stage);
      if (!cactus::ownsWholeOutput(request, outputs))
      {
        return;
      }
      const cactus::HistologyMask mask = maskFrom(vtkDataObject::GetData(inputs[0]), stage);
      const cactus::MaskAxons found = cactus::measureMask(mask, cactus::contextFor(this));
      std::vector<cactus::MaskAxon> axons;
      for (const cactus::MaskAxon& axon : found.axons)
      {
        if (axon.axonRadius() >= stage.smallestRadius && !(stage.leaveOutBorder && axon.touchesBorder))
        {
          axons.push_back(axon);
        }
      }
      if (axons.empty())
      {
        throw cactus::InvalidInput(cactus::text(
          "none of the ", found.axons.size(), " axons is left: choose a smaller SmallestRadius, or do not LeaveOutBorder"));
      }
      auto* table = vtkTable::GetData(outputs);
      fillTable(axons, stage.pixelSize, table);
      table->GetFieldData()->RemoveArray("Domain"); // that of the substrate that was cut
      cactus::addNumber(table->GetFieldData(), "LooseMyelin_um2", found.looseMyelin);
      cactus::setProvenance(table, cactus::recordOf(this, "HistologyRadii", stage, { "Input" }), 0);
    });
}
