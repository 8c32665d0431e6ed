// SPDX-License-Identifier: BSD-3-Clause
#include "vtkFibreField.h"

#include "Columns.h"
#include "DataProvenance.h"
#include "FibreData.h"
#include "FilterSupport.h"
#include "LabelImageData.h"
#include "StageProperties.h"
#include "WholeData.h"
#include "base/Error.h"
#include "base/Limits.h"
#include "base/Parallel.h"
#include "stages/Stages.h"
#include "surface/FibreImage.h"
#include "surface/FibreSurvey.h"
#include "surface/NearBlocks.h"

#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>

#include <algorithm>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkFibreField);

namespace
{

/// Voxels around a fibre in which blocks are included, so that its surface lies inside them.
constexpr int reach = 2;

/// A fibre of the label image's table.
struct Chosen
{
  int fibreId = 0;
  int bundleId = 0;
};

std::vector<Chosen> choose(const cactus::LabelImageFacts& facts, const cactus::FibreFieldStage& stage)
{
  using Selection = cactus::FibreSelection;
  const int first = facts.fibreIds.empty() ? 0 : *std::min_element(facts.fibreIds.begin(), facts.fibreIds.end());
  const int fibreId = stage.fibreId == 0 ? first : stage.fibreId;
  std::vector<Chosen> chosen;
  for (std::size_t i = 0; i < facts.fibreIds.size(); ++i)
  {
    const bool isChosen = stage.select == Selection::AllFibres ||
                          (stage.select == Selection::OneFibre && facts.fibreIds[i] == fibreId) ||
                          (stage.select == Selection::OneBundle && facts.bundleIds[i] == stage.bundleId);
    if (isChosen)
    {
      chosen.push_back({ facts.fibreIds[i], facts.bundleIds[i] });
    }
  }
  if (chosen.empty())
  {
    const bool oneFibre = stage.select == Selection::OneFibre;
    const auto& ids = oneFibre ? facts.fibreIds : facts.bundleIds;
    throw cactus::InvalidInput(
      std::string(oneFibre ? "FibreId " : "BundleId ") + std::to_string(oneFibre ? fibreId : stage.bundleId) +
      " is not in the label image, whose ids go from " + std::to_string(*std::min_element(ids.begin(), ids.end())) + " to " +
      std::to_string(*std::max_element(ids.begin(), ids.end())));
  }
  std::sort(chosen.begin(), chosen.end(), [](const Chosen& a, const Chosen& b) { return a.fibreId < b.fibreId; });
  return chosen;
}

vtkSmartPointer<vtkImageData> imageFrom(const cactus::FibreImage& image)
{
  const cactus::VoxelGrid& grid = image.grid;
  const auto field = cactus::makeArray<vtkFloatArray>("Field", image.values.size());
  std::copy(image.values.begin(), image.values.end(), field->GetPointer(0));
  auto data = vtkSmartPointer<vtkImageData>::New();
  const Eigen::Vector3d origin = grid.position(grid.lower[0], grid.lower[1], grid.lower[2]);
  data->SetDimensions(grid.count[0], grid.count[1], grid.count[2]);
  data->SetOrigin(origin[0], origin[1], origin[2]);
  data->SetSpacing(grid.spacing, grid.spacing, grid.spacing);
  data->GetPointData()->SetScalars(field);
  return data;
}

} // namespace

vtkFibreField::vtkFibreField()
  : Properties(cactus::makeProperties<cactus::FibreFieldStage>())
{
}

int vtkFibreField::FillInputPortInformation(int, vtkInformation* info)
{
  cactus::acceptAnyData(info);
  return 1;
}

int vtkFibreField::RequestUpdateExtent(vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  cactus::requestWholeInputs(inputs, 1);
  return 1;
}

int vtkFibreField::RequestData(vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  return cactus::guarded(this,
    [&]
    {
      const auto& stage = cactus::stageOf<cactus::FibreFieldStage>(this->Properties);
      cactus::validateProperties(stage);
      const cactus::Context context = cactus::contextFor(this, stage.threads);
      if (!cactus::ownsWholeOutput(request, outputs))
      {
        return;
      }
      const cactus::LabelImageInput labels = cactus::labelImageFrom(vtkDataObject::GetData(inputs[0]));
      cactus::requireWithin("MinimumGap of the label image", labels.facts.minimumGap, cactus::limits::gap);
      cactus::requireWithin(
        "SurfaceTolerance of the label image", labels.facts.surfaceTolerance, cactus::limits::surfaceTolerance);
      const cactus::FibreField field(labels.view, labels.facts.domain, stage.clipToDomain);
      const cactus::FoundFibres found = cactus::findFibres(field, context);
      const std::vector<Chosen> chosen = choose(labels.facts, stage);

      auto* output = vtkMultiBlockDataSet::GetData(outputs);
      output->SetNumberOfBlocks(static_cast<unsigned>(chosen.size()));
      std::vector<vtkSmartPointer<vtkImageData>> images(chosen.size());
      cactus::parallelFor(
        chosen.size(), context,
        [&](std::size_t i)
        {
          const auto fibre = found.find(chosen[i].fibreId);
          if (fibre != found.end())
          {
            images[i] = imageFrom(
              cactus::fibreImage(field, chosen[i].fibreId, cactus::blocksNear(field, fibre->second, reach).numbers, stage.level));
          }
        },
        "sampling fibres");
      const cactus::Provenance provenance = cactus::recordOf(this, "FibreField", stage, { "Input" });
      std::size_t missing = 0;
      for (std::size_t i = 0; i < chosen.size(); ++i)
      {
        const auto block = static_cast<unsigned>(i);
        output->GetMetaData(block)->Set(vtkCompositeDataSet::NAME(), ("fibre " + std::to_string(chosen[i].fibreId)).c_str());
        if (images[i] == nullptr)
        {
          ++missing;
          continue;
        }
        cactus::addCount(images[i]->GetFieldData(), "FibreId", chosen[i].fibreId);
        cactus::addCount(images[i]->GetFieldData(), "BundleId", chosen[i].bundleId);
        cactus::setDomain(images[i], labels.facts.domain);
        cactus::setProvenance(images[i], provenance, 0);
        output->SetBlock(block, images[i]);
      }
      cactus::setDomain(output, labels.facts.domain);
      if (missing > 0)
      {
        vtkWarningMacro(<< missing << " of " << chosen.size()
                        << " fibres have no voxel in the label image: their blocks are empty");
      }
    });
}
