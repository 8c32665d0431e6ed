// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMyelinSurface.h"

#include "Columns.h"
#include "DataProvenance.h"
#include "FibreData.h"
#include "FilterSupport.h"
#include "LabelImageData.h"
#include "StageProperties.h"
#include "SurfaceData.h"
#include "SurfaceFacts.h"
#include "VtkMeshing.h"
#include "WholeData.h"
#include "base/Error.h"
#include "base/Numbers.h"
#include "judge/SurfaceFaults.h"
#include "stages/Stages.h"
#include "surface/MyelinSurface.h"
#include "surface/SurfaceRemarks.h"

#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkIntArray.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkTable.h>

#include <cmath>
#include <string>

vtkStandardNewMacro(vtkMyelinSurface);

namespace
{

void fillTable(vtkTable* table, const std::vector<cactus::FibreSurfacePair>& fibres)
{
  using Fibre = cactus::FibreSurfacePair;
  const auto number = [&](const char* name, double (*value)(const Fibre&))
  { cactus::addColumn<vtkDoubleArray>(table, name, fibres.size(), [&](std::size_t row) { return value(fibres[row]); }); };
  const auto integer = [&](const char* name, long (*value)(const Fibre&))
  { cactus::addColumn<vtkIntArray>(table, name, fibres.size(), [&](std::size_t row) { return value(fibres[row]); }); };
  integer("FibreId", [](const Fibre& f) { return long(f.fibreId); });
  integer("BundleId", [](const Fibre& f) { return long(f.bundleId); });
  number("TargetRadius_um", [](const Fibre& f) { return f.targetRadius; });
  number("OuterVolume_um3", [](const Fibre& f) { return f.outerReport.volume; });
  number("InnerVolume_um3", [](const Fibre& f) { return f.innerReport.volume; });
  number("OuterArea_um2", [](const Fibre& f) { return f.outerReport.area; });
  number("InnerArea_um2", [](const Fibre& f) { return f.innerReport.area; });
  number("Thickness_um", [](const Fibre& f) { return f.thickness; });
  number("TargetGRatio", [](const Fibre& f) { return f.targetGRatio; });
  number("GRatio", [](const Fibre& f) { return f.gRatio; });
  integer("Myelin", [](const Fibre& f) { return long(f.state); });
  integer("OuterTriangles", [](const Fibre& f) { return long(f.outerReport.triangles); });
  integer("InnerTriangles", [](const Fibre& f) { return long(f.innerReport.triangles); });
  integer("OuterClosed", [](const Fibre& f) { return long(f.outerReport.closedManifold() && f.outerReport.outward()); });
  integer("InnerClosed", [](const Fibre& f) { return long(f.innerReport.closedManifold() && f.innerReport.outward()); });
  number("OuterSquaredEdgeRatio", [](const Fibre& f) { return f.outerReport.largestSquaredEdgeRatio; });
  number("InnerSquaredEdgeRatio", [](const Fibre& f) { return f.innerReport.largestSquaredEdgeRatio; });
  integer("Flawed", [](const Fibre& f) { return long(f.isFlawed); });
  number("LargestMove_um", [](const Fibre& f) { return f.largestMove; });
  number("DroppedVolume_um3", [](const Fibre& f) { return f.droppedVolume; });
}

/// Empties the image that comes in at the port of an algorithm, and those further up that share its arrays, as ParaView puts
/// filters of its own between two stages. Each counts as released, so that it is made again for whoever asks for it.
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

} // namespace

vtkMyelinSurface::vtkMyelinSurface()
  : Properties(cactus::makeProperties<cactus::MyelinSurfaceStage>())
{
  this->SetNumberOfOutputPorts(3);
}

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
      }
      cactus::validate(options);
      auto* image = cactus::requireImage(vtkDataObject::GetData(inputs[0]));
      if (!cactus::ownsWholeOutput(request, outputs))
      {
        if (stage.releaseInput)
        {
          releaseImage(this); // which this rank has grown, too
        }
        return;
      }
      const cactus::LabelImageInput labels = cactus::labelImageFrom(image);
      const cactus::LabelImageView& view = labels.view;
      const cactus::LabelImageFacts& facts = labels.facts;

      cactus::SurfaceFilters filters;
      if (byVtk)
      {
        filters = cactus::surfaceFiltersOfVtk(stage.vtkMeshing, view.grid.spacing);
      }
      auto fibres = cactus::myelinSurfaces(view, facts, options, context, byVtk ? &filters : nullptr);
      if (byVtk)
      {
        cactus::markFaults(fibres, facts.domain, facts.minimumGap, context);
      }
      for (int port = 0; port < 3; ++port)
      {
        vtkDataObject* output = outputs->GetInformationObject(port)->Get(vtkDataObject::DATA_OBJECT());
        cactus::setDomain(output, facts.domain);
      }
      const cactus::Provenance provenance = cactus::recordOf(this, "MyelinSurface", stage, { "Input" }); // before it is released
      const std::string remarks = cactus::notAsAsked(fibres, view, facts, byVtk);
      if (stage.releaseInput)
      {
        releaseImage(this);
      }

      fillTable(vtkTable::GetData(outputs, 2), fibres);
      std::vector<cactus::NamedSurface> outer;
      std::vector<cactus::NamedSurface> inner;
      std::vector<int> wanted;
      for (auto& fibre : fibres)
      {
        outer.push_back({ fibre.fibreId, fibre.bundleId, std::move(fibre.outer) });
        inner.push_back({ fibre.fibreId, fibre.bundleId, std::move(fibre.inner) });
        if (fibre.isWanted)
        {
          wanted.push_back(fibre.fibreId);
        }
      }
      cactus::toPolyData(std::move(outer), 0, vtkPolyData::GetData(outputs, 0));
      cactus::toPolyData(std::move(inner), 1, vtkPolyData::GetData(outputs, 1));
      cactus::setSurfaceFacts(outputs->GetInformationObject(0)->Get(vtkDataObject::DATA_OBJECT()), wanted, facts.minimumGap);
      cactus::setSurfaceFacts(outputs->GetInformationObject(1)->Get(vtkDataObject::DATA_OBJECT()), {}, facts.minimumGap);
      for (int port = 0; port < 3; ++port)
      {
        vtkDataObject* output = outputs->GetInformationObject(port)->Get(vtkDataObject::DATA_OBJECT());
        cactus::setProvenance(output, provenance, port);
      }
      if (!remarks.empty())
      {
        vtkWarningMacro(<< remarks);
      }
    });
}

void vtkMyelinSurface::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  this->Properties->print(os, indent);
}
