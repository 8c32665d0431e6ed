// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMyelinSurface.h"

#include "DataProvenance.h"
#include "FibreData.h"
#include "FilterSupport.h"
#include "InputBlocks.h"
#include "LabelImageData.h"
#include "StageProperties.h"
#include "SubstrateInputs.h"
#include "SurfaceData.h"
#include "SurfaceFacts.h"
#include "SurfaceTable.h"
#include "VtkMeshing.h"
#include "WholeData.h"
#include "base/Error.h"
#include "base/Numbers.h"
#include "judge/SurfaceFaults.h"
#include "mesh/SurfaceStore.h"
#include "stages/Stages.h"
#include "surface/SurfaceMaker.h"
#include "surface/SurfaceRemarks.h"

#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkTable.h>

#include <algorithm>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

vtkStandardNewMacro(vtkMyelinSurface);

namespace
{

/// Empties the image at the input of an algorithm, and those further up that share its arrays, since ParaView puts its own
/// filters between two stages. Each counts as released, so that the next request makes it again.
void releaseImage(vtkAlgorithm* consumer)
{
  vtkSmartPointer<vtkDataArray> shared;
  while (consumer != nullptr && consumer->GetNumberOfInputPorts() > 0 && consumer->GetNumberOfInputConnections(0) == 1)
  {
    auto* image = vtkImageData::SafeDownCast(consumer->GetInputDataObject(0, 0));
    vtkDataArray* fibreId = image != nullptr ? image->GetPointData()->GetArray("FibreId") : nullptr;
    if (fibreId == nullptr || (shared != nullptr && fibreId != shared))
    {
      return;
    }
    shared = fibreId;
    image->ReleaseData();
    consumer = consumer->GetInputAlgorithm(0, 0);
  }
}

/// Returns the properties that outer surfaces depend on besides the image: all but those of g-ratios.
std::string outerDemandOf(const cactus::MyelinSurfaceStage& stage)
{
  static const std::set<std::string> ofInner = { "GRatioModel", "GRatio", "GRatioDeviation", "TargetAxonVolumeFraction", "Seed" };
  cactus::TextStream demand;
  for (const cactus::PropertyState& state : cactus::MyelinSurfaceStage::properties().states(stage))
  {
    if (state.facts->use != cactus::PropertyUse::Run && ofInner.count(state.facts->name) == 0)
    {
      demand << state.facts->name << ' ' << cactus::valueText(*state.facts, state.value) << '\n';
    }
  }
  return demand.str();
}

/// A source of fibres' surfaces from an output.
class OutputSurfaces : public cactus::SurfaceSource
{
public:
  OutputSurfaces(vtkPolyData* output, const std::vector<cactus::FibreSurfacePair>& fibres)
    : Surfaces(cactus::surfacesFrom(output, "Outer", 0))
    , Fibres(fibres)
  {
  }

  std::size_t size() const override { return this->Fibres.size(); }
  std::shared_ptr<const cactus::TriangleMesh> get(std::size_t index) const override
  {
    const auto& ids = this->Surfaces.fibreIds;
    const auto place = std::lower_bound(ids.begin(), ids.end(), this->Fibres[index].fibreId);
    const bool isHeld = place != ids.end() && *place == this->Fibres[index].fibreId;
    return std::make_shared<cactus::TriangleMesh>(
      isHeld ? this->Surfaces.mesh(std::size_t(place - ids.begin())) : cactus::TriangleMesh());
  }

private:
  cactus::FibreSurfaces Surfaces;
  const std::vector<cactus::FibreSurfacePair>& Fibres;
};

/// Moves the surfaces of one kind to an output.
void giveOut(std::vector<cactus::FibreSurfacePair>& fibres, cactus::TriangleMesh cactus::FibreSurfacePair::*mesh, int kind,
  vtkPolyData* output)
{
  std::vector<cactus::NamedSurface> surfaces;
  surfaces.reserve(fibres.size());
  for (auto& fibre : fibres)
  {
    surfaces.push_back({ fibre.fibreId, fibre.bundleId, std::move(fibre.*mesh) });
  }
  cactus::toPolyData(std::move(surfaces), kind, output);
}

/// Fills the table, and adds facts for the certificate and the user.
void addSurfaceFacts(const std::vector<cactus::FibreSurfacePair>& fibres, double minimumGap, const cactus::Domain& domain,
  const cactus::Provenance& provenance, vtkInformationVector* outputs)
{
  cactus::fillSurfaceTable(vtkTable::GetData(outputs, 2), fibres);
  std::vector<int> wanted;
  for (const auto& fibre : fibres)
  {
    if (fibre.isWanted)
    {
      wanted.push_back(fibre.fibreId);
    }
  }
  cactus::setSurfaceFacts(vtkDataObject::GetData(outputs, 0), wanted, minimumGap);
  cactus::setSurfaceFacts(vtkDataObject::GetData(outputs, 1), {}, minimumGap);
  for (int port = 0; port < 3; ++port)
  {
    cactus::setDomain(vtkDataObject::GetData(outputs, port), domain);
    cactus::setProvenance(vtkDataObject::GetData(outputs, port), provenance, port);
  }
}

} // namespace

struct vtkMyelinSurface::KeptOuter
{
  vtkMTimeType inputTime = 0;
  std::string demand;
  std::vector<cactus::FibreSurfacePair> fibres; ///< as SurfaceMaker::makeOuter() left them
  vtkNew<vtkPolyData> surfaces;                 ///< shares the output's arrays
};

vtkMyelinSurface::vtkMyelinSurface()
  : Properties(cactus::makeProperties<cactus::MyelinSurfaceStage>())
{
  this->SetNumberOfOutputPorts(3);
}

vtkMyelinSurface::~vtkMyelinSurface() = default;

int vtkMyelinSurface::FillInputPortInformation(int, vtkInformation* info)
{
  cactus::acceptAnyData(info);
  return 1;
}

int vtkMyelinSurface::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 2 ? "vtkTable" : "vtkPolyData");
  return 1;
}

int vtkMyelinSurface::RequestUpdateExtent(vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  cactus::requestWholeInputs(inputs, 1);
  return 1;
}

int vtkMyelinSurface::ComputePipelineMTime(
  vtkInformation*, vtkInformationVector**, vtkInformationVector*, int, vtkMTimeType* time)
{
  return cactus::pipelineTime(this, time);
}

int vtkMyelinSurface::RequestData(vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  return cactus::guarded(this,
    [&]
    {
      const auto& stage = cactus::stageOf<cactus::MyelinSurfaceStage>(this->Properties);
      cactus::validateProperties(stage);
      const cactus::Context context = cactus::contextFor(this, stage.threads);
      cactus::MyelinSurfaceOptions options = stage.options;
      const bool byVtk = stage.meshing == cactus::Meshing::Vtk;
      if (byVtk)
      {
        options.smoothingIterations = 0;
        options.decimationError = 0.0;
        options.minimumAngle = 0.0;
      }
      cactus::validate(options);
      auto* image = cactus::requireImage(vtkDataObject::GetData(inputs[0]));
      this->Fibres = cactus::fibresOfImage(this, 0);
      if (!cactus::ownsWholeOutput(request, outputs))
      {
        if (stage.releaseInput)
        {
          releaseImage(this); // this rank has also grown it
        }
        return;
      }
      const cactus::LabelImageInput labels = cactus::labelImageFrom(image);
      const cactus::LabelImageFacts& facts = labels.facts;
      cactus::SurfaceFilters filters;
      if (byVtk)
      {
        filters = cactus::surfaceFiltersOfVtk(stage.vtkMeshing, labels.view.grid.spacing);
      }
      cactus::SurfaceMaker maker(
        std::make_shared<cactus::LabelImageInMemory>(labels.view), facts, options, context, byVtk ? &filters : nullptr);
      auto fibres = this->makeSurfaces(maker, cactus::changeTime(image), vtkPolyData::GetData(outputs, 0));
      const cactus::Domain domain = options.clipToDomain ? maker.box() : facts.domain; // of an image that was cut
      if (byVtk)
      {
        cactus::markFaults(fibres, domain, facts.minimumGap, context);
      }
      const cactus::Provenance provenance = cactus::recordOf(this, "MyelinSurface", stage, { "Input" }); // before it is released
      const std::string remarks = cactus::notAsAsked(fibres, labels.view.grid.spacing, facts, byVtk);
      if (stage.releaseInput)
      {
        releaseImage(this);
      }
      giveOut(fibres, &cactus::FibreSurfacePair::inner, 1, vtkPolyData::GetData(outputs, 1));
      addSurfaceFacts(fibres, facts.minimumGap, domain, provenance, outputs);
      if (!remarks.empty())
      {
        vtkWarningMacro(<< remarks);
      }
    });
}

std::vector<cactus::FibreSurfacePair> vtkMyelinSurface::makeSurfaces(
  cactus::SurfaceMaker& maker, vtkMTimeType inputTime, vtkPolyData* output)
{
  const auto& stage = cactus::stageOf<cactus::MyelinSurfaceStage>(this->Properties);
  const std::string demand = outerDemandOf(stage);
  const std::size_t count = maker.fibres().size();
  cactus::SurfacesInMemory inner(count);
  if (this->Kept == nullptr || this->Kept->inputTime != inputTime || this->Kept->demand != demand)
  {
    this->Kept.reset(); // a failing run leaves nothing behind
    cactus::SurfacesInMemory outer(count);
    maker.makeOuter(outer, inner);
    std::vector<cactus::FibreSurfacePair> fibres = maker.fibres();
    for (std::size_t i = 0; i < count; ++i)
    {
      fibres[i].outer = outer.take(i);
    }
    giveOut(fibres, &cactus::FibreSurfacePair::outer, 0, output);
    auto kept = std::make_unique<KeptOuter>();
    kept->inputTime = inputTime;
    kept->demand = demand;
    kept->fibres = std::move(fibres);
    kept->surfaces->ShallowCopy(output);
    this->Kept = std::move(kept);
  }
  else
  {
    maker.takeOuter(this->Kept->fibres);
    output->CopyStructure(this->Kept->surfaces);
    output->GetCellData()->ShallowCopy(this->Kept->surfaces->GetCellData());
  }
  const OutputSurfaces outer(this->Kept->surfaces, this->Kept->fibres);
  maker.makeInner(outer, inner);
  std::vector<cactus::FibreSurfacePair> fibres = maker.fibres();
  for (std::size_t i = 0; i < count; ++i)
  {
    fibres[i].inner = inner.take(i);
    if (stage.meshing == cactus::Meshing::Vtk)
    {
      fibres[i].outer = *outer.get(i); // they are judged together
    }
  }
  return fibres;
}

void vtkMyelinSurface::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  this->Properties->print(os, indent);
}
