// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMyelinSurface.h"

#include "DataProvenance.h"
#include "FibreData.h"
#include "FilterSupport.h"
#include "InputBlocks.h"
#include "LabelImageData.h"
#include "RankTeam.h"
#include "StageProperties.h"
#include "SubstrateInputs.h"
#include "SurfaceData.h"
#include "SurfaceFacts.h"
#include "SurfaceTable.h"
#include "VtkMeshing.h"
#include "WholeData.h"
#include "base/Bytes.h"
#include "base/Error.h"
#include "base/EvenParts.h"
#include "base/Numbers.h"
#include "base/Parallel.h"
#include "base/Sharing.h"
#include "judge/SurfaceFaults.h"
#include "mesh/SurfaceStore.h"
#include "stages/Stages.h"
#include "surface/SurfaceMaker.h"
#include "surface/SurfaceRemarks.h"

#include <vtkCellData.h>
#include <vtkExecutive.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkTable.h>

#include <algorithm>
#include <initializer_list>
#include <limits>
#include <map>
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

/// The properties that outer surfaces without nodes of Ranvier do not depend on.
const std::set<std::string> ofInner = { "GRatioModel", "GRatio", "GRatioDeviation", "TargetAxonVolumeFraction",
  "MyelinFollowsAxon", "SwellingAmplitude", "SwellingSpacing", "SwellingLength", "Seed" };

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

/// Tells whether each rank of several was asked for a piece of its own, as by a view.
bool isAskedForOwnPiece(vtkInformation* request, vtkInformationVector* outputs, const cactus::Sharing& sharing)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  const int from = request->Has(vtkExecutive::FROM_OUTPUT_PORT()) ? request->Get(vtkExecutive::FROM_OUTPUT_PORT()) : 0;
  vtkInformation* info = outputs->GetInformationObject(std::max(from, 0));
  return sharing.size() > 1 && info->Get(Pipeline::UPDATE_NUMBER_OF_PIECES()) == sharing.size() &&
         info->Get(Pipeline::UPDATE_PIECE_NUMBER()) == sharing.place();
}

using ValuesOfFibres = std::map<int, cactus::FibreValues>;

/// Returns what cell data say of each fibre, by its id. `outer` are all outer surfaces.
ValuesOfFibres valuesOf(const std::vector<cactus::FibreSurfacePair>& fibres, const OutputSurfaces& outer,
  const cactus::LabelImageFacts& facts, const cactus::Domain& domain, const cactus::Context& context)
{
  std::map<int, double> lengths;
  for (std::size_t f = 0; f < facts.lengths.size(); ++f)
  {
    lengths[facts.fibreIds[f]] = facts.lengths[f];
  }
  std::vector<cactus::FibreValues> each(fibres.size());
  const auto measure = [&](std::size_t i)
  {
    const cactus::FibreSurfacePair& fibre = fibres[i];
    const auto length = lengths.find(fibre.fibreId);
    each[i] = cactus::fibreValues(*outer.get(i), fibre.outerReport.volume,
      length != lengths.end() ? length->second : std::numeric_limits<double>::quiet_NaN(), fibre.gRatio, domain);
  };
  cactus::parallelFor(fibres.size(), context, measure);
  ValuesOfFibres values;
  for (std::size_t i = 0; i < fibres.size(); ++i)
  {
    values[fibres[i].fibreId] = each[i];
  }
  return values;
}

/// Copies the surfaces of the fibres with ids from `first` to `last`.
void copyPart(vtkPolyData* whole, int kind, int first, int last, const ValuesOfFibres& values, vtkPolyData* part)
{
  const cactus::FibreSurfaces surfaces = cactus::surfacesFrom(whole, kind == 0 ? "Outer" : "Inner", kind);
  std::vector<cactus::NamedSurface> named;
  for (std::size_t i = 0; i < surfaces.size(); ++i)
  {
    if (surfaces.fibreIds[i] >= first && surfaces.fibreIds[i] <= last)
    {
      named.push_back({ surfaces.fibreIds[i], surfaces.bundleIds[i], surfaces.mesh(i) });
    }
  }
  cactus::toPolyData(std::move(named), kind, part);
  cactus::addFibreValues(part, values);
  part->GetFieldData()->ShallowCopy(whole->GetFieldData());
}

/// Fills the table, and adds facts for the certificate and the user.
void addSurfaceFacts(const std::vector<cactus::FibreSurfacePair>& fibres, double minimumGap, const cactus::Domain& domain,
  const cactus::Provenance& provenance, vtkPolyData* outer, vtkPolyData* inner, vtkTable* table)
{
  cactus::fillSurfaceTable(table, fibres);
  std::vector<int> wanted;
  for (const auto& fibre : fibres)
  {
    if (fibre.isWanted)
    {
      wanted.push_back(fibre.fibreId);
    }
  }
  cactus::setSurfaceFacts(outer, wanted, minimumGap);
  cactus::setSurfaceFacts(inner, {}, minimumGap);
  int port = 0;
  for (vtkDataObject* output : std::initializer_list<vtkDataObject*>{ outer, inner, table })
  {
    cactus::setDomain(output, domain);
    cactus::setProvenance(output, provenance, port++);
  }
}

/// Adds the parts of the domain that all fibres and all axons fill.
void addFractions(const std::vector<cactus::FibreSurfacePair>& fibres, const cactus::Domain& domain, vtkTable* table)
{
  double outer = 0.0;
  double inner = 0.0;
  for (const auto& fibre : fibres)
  {
    outer += fibre.outerReport.volume;
    inner += fibre.innerReport.volume;
  }
  cactus::addNumber(table->GetFieldData(), "FVF", outer / domain.volume());
  cactus::addNumber(table->GetFieldData(), "AVF", inner / domain.volume());
}

} // namespace

struct vtkMyelinSurface::KeptOuter
{
  vtkMTimeType inputTime = 0;
  std::string demand;
  std::vector<cactus::FibreSurfacePair> fibres; ///< as SurfaceMaker::makeOuter() left them
  vtkNew<vtkPolyData> surfaces;                 ///< shares the output's arrays
};

struct vtkMyelinSurface::Result
{
  vtkMTimeType parameterTime = 0;
  vtkMTimeType inputTime = 0;
  vtkNew<vtkPolyData> outer;
  vtkNew<vtkPolyData> inner;
  vtkNew<vtkTable> table;
  ValuesOfFibres values;
  // Ids of the fibres in the piece of this rank.
  int first = 1;
  int last = 0;

  /// Splits the fibres among the ranks.
  void split(const std::vector<cactus::FibreSurfacePair>& fibres, const cactus::Sharing& sharing)
  {
    std::vector<double> triangles;
    triangles.reserve(fibres.size());
    for (const auto& fibre : fibres)
    {
      triangles.push_back(double(fibre.outerReport.triangles + fibre.innerReport.triangles));
    }
    const std::vector<std::size_t> begins = cactus::evenParts(triangles, std::size_t(sharing.size()));
    const auto place = std::size_t(sharing.place());
    if (begins[place] < begins[place + 1])
    {
      this->first = fibres[begins[place]].fibreId;
      this->last = fibres[begins[place + 1] - 1].fibreId;
    }
  }
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

int vtkMyelinSurface::RequestData(vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  cactus::RankTeam ranks;
  const cactus::Sharing sharing(&ranks);
  return cactus::guarded(this, sharing,
    [&]
    {
      auto* input = vtkDataObject::GetData(inputs[0]);
      // On several ranks what is made is kept: some ask for pieces, others for everything.
      if (!sharing.isEverywhere(this->Made != nullptr && this->Made->parameterTime == this->GetMTime() &&
                                this->Made->inputTime == cactus::changeTime(input)))
      {
        this->Made.reset();
        sharing.together([&] { this->make(input, sharing); });
      }
      auto* outer = vtkPolyData::GetData(outputs, 0);
      auto* inner = vtkPolyData::GetData(outputs, 1);
      if (isAskedForOwnPiece(request, outputs, sharing))
      {
        copyPart(this->Made->outer, 0, this->Made->first, this->Made->last, this->Made->values, outer);
        copyPart(this->Made->inner, 1, this->Made->first, this->Made->last, this->Made->values, inner);
      }
      else if (cactus::ownsWholeOutput(request, outputs))
      {
        outer->ShallowCopy(this->Made->outer);
        inner->ShallowCopy(this->Made->inner);
      }
      if (cactus::ownsWholeOutput(request, outputs))
      {
        vtkTable::GetData(outputs, 2)->ShallowCopy(this->Made->table);
      }
      if (sharing.size() == 1)
      {
        this->Made.reset();
      }
    });
}

void vtkMyelinSurface::make(vtkDataObject* input, const cactus::Sharing& sharing)
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
  auto* image = cactus::requireImage(input);
  this->Fibres = cactus::fibresOfImage(this, 0);
  cactus::LabelImageInput labels = cactus::labelImageFrom(image);
  cactus::require(this->Fibres != nullptr || image->GetFieldData()->HasArray(cactus::saysMyelinName) == 0,
    "the fibres say how much of their myelin there is (MyelinFraction), and are not at hand: give the label image directly from "
    "FibreRadialGrowth");
  if (this->Fibres != nullptr && (options.followsLines() || cactus::hasMyelinFractions(this->Fibres)))
  {
    labels.facts.centreLines = std::make_shared<const cactus::Fibres>(cactus::fibresFrom(this->Fibres));
  }
  const cactus::LabelImageFacts& facts = labels.facts;
  if (sharing.size() > 1)
  {
    cactus::require(
      sharing.areAlike(cactus::checksumsOf(image) + cactus::bytesOf(facts.fibreIds) + cactus::valuesForResult(stage)),
      "the ranks were given different label images or properties, and cannot share the work: give all of them the same");
  }
  cactus::SurfaceFilters filters;
  if (byVtk)
  {
    filters = cactus::surfaceFiltersOfVtk(stage.vtkMeshing, labels.view.grid.spacing);
  }
  auto made = std::make_unique<Result>();
  made->inputTime = cactus::changeTime(image);
  cactus::SurfaceMaker maker(
    std::make_shared<cactus::LabelImageInMemory>(labels.view), facts, options, context, byVtk ? &filters : nullptr, sharing);
  const bool outerFollowsInner = options.hasNodes() || facts.hasMyelinFractions();
  auto fibres = this->makeSurfaces(maker, made->inputTime, outerFollowsInner, made->outer, sharing);
  const cactus::Domain domain = options.clipToDomain ? maker.box() : facts.domain; // of an image that was cut
  if (byVtk)
  {
    cactus::markFaults(fibres, domain, facts.minimumGap, context);
  }
  const cactus::Provenance provenance = cactus::recordOf(this, "MyelinSurface", stage, { "Input" }); // before it is released
  const std::vector<std::string> remarks = { cactus::notAsAsked(fibres, labels.view.grid.spacing, facts, byVtk),
    cactus::remarkOnSwellings(fibres, facts, options) };
  if (stage.releaseInput)
  {
    releaseImage(this);
  }
  made->split(fibres, sharing);
  made->values = valuesOf(fibres, OutputSurfaces(this->Kept->surfaces, fibres), facts, domain, context);
  giveOut(fibres, &cactus::FibreSurfacePair::inner, 1, made->inner);
  for (vtkPolyData* surfaces : { made->outer.Get(), made->inner.Get() })
  {
    cactus::addFibreValues(surfaces, made->values);
  }
  addSurfaceFacts(fibres, facts.minimumGap, domain, provenance, made->outer, made->inner, made->table);
  if (options.clipToDomain)
  {
    addFractions(fibres, domain, made->table);
  }
  made->parameterTime = this->GetMTime(); // only now: being stopped modifies the filter
  this->Made = std::move(made);
  for (const std::string& remark : remarks)
  {
    if (!remark.empty() && sharing.isFirst())
    {
      vtkWarningMacro(<< remark);
    }
  }
}

std::vector<cactus::FibreSurfacePair> vtkMyelinSurface::makeSurfaces(cactus::SurfaceMaker& maker, vtkMTimeType inputTime,
  bool outerFollowsInner, vtkPolyData* output, const cactus::Sharing& sharing)
{
  const auto& stage = cactus::stageOf<cactus::MyelinSurfaceStage>(this->Properties);
  const std::string demand = cactus::valuesForResult(stage, outerFollowsInner ? std::set<std::string>() : ofInner);
  const std::size_t count = maker.fibres().size();
  cactus::SurfacesInMemory inner(count);
  if (!sharing.isEverywhere(this->Kept != nullptr && this->Kept->inputTime == inputTime && this->Kept->demand == demand))
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
