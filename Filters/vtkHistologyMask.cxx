// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHistologyMask.h"

#include "Columns.h"
#include "DataProvenance.h"
#include "FibreData.h"
#include "FilterSupport.h"
#include "ImageGrid.h"
#include "PlacementData.h"
#include "StageProperties.h"
#include "SubstrateInputs.h"
#include "WholeData.h"
#include "judge/HistologyMask.h"
#include "stages/Stages.h"

#include <vtkDataObject.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkIntArray.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkUnsignedCharArray.h>

#include <array>

vtkStandardNewMacro(vtkHistologyMask);

namespace
{

cactus::ImageGrid gridOf(const cactus::HistologyMask& mask)
{
  return { { { mask.count[0], mask.count[1], 1 } }, { { mask.origin[mask.axes[0]], mask.origin[mask.axes[1]], 0.0 } },
    mask.pixelSize };
}

} // namespace

vtkHistologyMask::vtkHistologyMask()
  : Properties(cactus::makeProperties<cactus::HistologyMaskStage>())
{
  this->SetNumberOfInputPorts(2);
}

int vtkHistologyMask::FillInputPortInformation(int port, vtkInformation* info)
{
  cactus::acceptAnyData(info);
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), port > 0 ? 1 : 0);
  return 1;
}

int vtkHistologyMask::RequestInformation(vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  cactus::announceGrid(this, inputs, outputs, VTK_UNSIGNED_CHAR,
    [this](vtkDataObject* surfaces)
    {
      return gridOf(
        cactus::maskGrid(cactus::domainFrom(surfaces), cactus::stageOf<cactus::HistologyMaskStage>(this->Properties).options));
    });
  return 1;
}

int vtkHistologyMask::RequestUpdateExtent(vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  cactus::requestWholeInputs(inputs, 2);
  return 1;
}

int vtkHistologyMask::RequestData(vtkInformation* request, vtkInformationVector**, vtkInformationVector* outputs)
{
  return cactus::guarded(this,
    [&]
    {
      const auto& stage = cactus::stageOf<cactus::HistologyMaskStage>(this->Properties);
      cactus::validateProperties(stage);
      if (!cactus::ownsWholeOutput(request, outputs))
      {
        vtkImageData::GetData(outputs)->Initialize();
        return; // one rank cuts; otherwise the pixels of all ranks would be joined into an image that repeats
      }
      cactus::SubstrateData data = cactus::substrateDataOf(this, 0, 1, -1);
      data.fibres = nullptr; // centre lines are not part of a cut
      const cactus::Substrate substrate = cactus::wholeSubstrateFrom(data);
      const cactus::HistologyMask mask = cactus::cutMask(
        substrate.domain, substrate.outer, substrate.inner, stage.options, cactus::contextFor(this, stage.threads));
      if (mask.openSurfaces > 0)
      {
        vtkWarningMacro(<< mask.openSurfaces << " surfaces are not closed; what the mask shows of them is not to be relied on");
      }
      auto* output = vtkImageData::GetData(outputs);
      cactus::setGrid(output, gridOf(mask));
      cactus::forgetPlacement(output);
      vtkPointData* pixels = output->GetPointData();
      cactus::addColumn<vtkUnsignedCharArray>(
        pixels, "Mask", mask.size(), [&](std::size_t i) { return cactus::greyOfTissue[std::size_t(mask.pixels[i])]; });
      cactus::addColumn<vtkIntArray>(pixels, "FibreId", mask.size(), [&](std::size_t i) { return mask.fibreIds[i]; });
      pixels->SetActiveScalars("Mask");
      cactus::addNumber(output->GetFieldData(), "PixelSize_um", mask.pixelSize);
      cactus::setProvenance(output, cactus::recordOf(this, "HistologyMask", stage, { "Outer", "Inner" }), 0);
    });
}
