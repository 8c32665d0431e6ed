// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMyelinSurface.h"

#include "Columns.h"
#include "Error.h"
#include "FibreData.h"
#include "FilterSupport.h"
#include "MyelinSurface.h"
#include "Numbers.h"
#include "SurfaceData.h"
#include "SurfaceFacts.h"
#include "WholeData.h"

#include <vtkCompositeDataSet.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkIntArray.h>
#include <vtkMatrix3x3.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkTable.h>

#include <cmath>
#include <string>

vtkStandardNewMacro(vtkMyelinSurface);

namespace
{

constexpr const char* advice = ": give the output of FibreRadialGrowth";

vtkDataArray* fieldColumn(vtkImageData* image, const std::string& name)
{
  vtkDataArray* array = image->GetFieldData()->GetArray(name.c_str());
  if (array == nullptr || array->GetNumberOfComponents() != 1 || array->GetNumberOfTuples() < 1)
  {
    throw cactus::InvalidInput("the label image has no field data " + name + advice);
  }
  return array;
}

double fieldNumber(vtkImageData* image, const std::string& name)
{
  return fieldColumn(image, name)->GetComponent(0, 0);
}

std::vector<double> fieldValues(vtkImageData* image, const std::string& name)
{
  vtkDataArray* array = fieldColumn(image, name);
  std::vector<double> values;
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
  {
    values.push_back(array->GetComponent(i, 0));
  }
  return values;
}

std::vector<int> fieldIds(vtkImageData* image, const std::string& name)
{
  vtkDataArray* array = fieldColumn(image, name);
  std::vector<int> ids;
  for (vtkIdType row = 0; row < array->GetNumberOfTuples(); ++row)
  {
    ids.push_back(cactus::idFrom(array, row));
  }
  return ids;
}

/// The input as an image. Throws InvalidInput for anything else.
vtkImageData* imageFrom(vtkDataObject* input)
{
  auto* image = vtkImageData::SafeDownCast(input);
  if (input != nullptr && image == nullptr)
  {
    const bool isComposite = vtkCompositeDataSet::SafeDownCast(input) != nullptr;
    throw cactus::InvalidInput(std::string("the input is a ") + input->GetClassName() + ", and one label image is expected" +
                               (isComposite ? ": group fibres before FibreRadialGrowth, not images after it" : advice));
  }
  if (image == nullptr || image->GetNumberOfPoints() == 0)
  {
    throw cactus::InvalidInput(std::string("the label image is empty") + advice);
  }
  return image;
}

/// The image's numbers where VTK keeps them.
cactus::LabelImageView viewOf(vtkImageData* image)
{
  auto* fibreId = vtkIntArray::SafeDownCast(image->GetPointData()->GetArray("FibreId"));
  auto* depth = vtkFloatArray::SafeDownCast(image->GetPointData()->GetArray("Depth"));
  const vtkIdType points = image->GetNumberOfPoints();
  if (fibreId == nullptr || fibreId->GetNumberOfComponents() != 1 || fibreId->GetNumberOfTuples() != points)
  {
    throw cactus::InvalidInput(std::string("the label image has no point data FibreId of 32-bit integers") + advice);
  }
  if (depth == nullptr || depth->GetNumberOfComponents() != 1 || depth->GetNumberOfTuples() != points)
  {
    throw cactus::InvalidInput(std::string("the label image has no point data Depth of 32-bit floating point numbers") + advice);
  }
  cactus::LabelImageView view;
  const double* spacing = image->GetSpacing();
  if (!std::isfinite(spacing[0]) || spacing[0] <= 0.0 || !Eigen::Vector3d(image->GetOrigin()).allFinite())
  {
    throw cactus::InvalidInput("the label image's Spacing or Origin is no length in µm: give the output of FibreRadialGrowth");
  }
  if (std::abs(spacing[1] - spacing[0]) > 1e-9 * spacing[0] || std::abs(spacing[2] - spacing[0]) > 1e-9 * spacing[0])
  {
    throw cactus::InvalidInput("the label image's voxels are no cubes: resample it, or use the output of FibreRadialGrowth");
  }
  const double* direction = image->GetDirectionMatrix()->GetData();
  for (int i = 0; i < 9; ++i)
  {
    if (direction[i] != (i % 4 == 0 ? 1.0 : 0.0))
    {
      throw cactus::InvalidInput("the label image is turned (Direction): only images along the axes can be contoured");
    }
  }
  view.grid.spacing = spacing[0];
  view.grid.origin = Eigen::Vector3d(image->GetOrigin());
  const int* extent = image->GetExtent();
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    view.grid.lower[axis] = extent[2 * axis];
    view.grid.count[axis] = extent[2 * axis + 1] - extent[2 * axis] + 1;
  }
  view.fibreId = fibreId->GetPointer(0);
  view.depth = depth->GetPointer(0);
  return view;
}

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
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  cactus::requestWholeInputs(inputs, 1);
  vtkInformation* info = inputs[0]->GetInformationObject(0);
  int extent[6];
  if (info->Has(Pipeline::WHOLE_EXTENT()) != 0) // which data other than images have not
  {
    info->Get(Pipeline::WHOLE_EXTENT(), extent);
    info->Set(Pipeline::UPDATE_EXTENT(), extent, 6);
  }
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
      const cactus::Context context = cactus::contextFor(this, this->NumberOfThreads);
      cactus::MyelinSurfaceOptions options;
      options.model = static_cast<cactus::GRatioModel>(this->GRatioModel);
      options.gRatio = this->GRatio;
      options.gRatioDeviation = this->GRatioDeviation;
      options.targetAxonVolumeFraction = this->TargetAxonVolumeFraction;
      options.smoothingIterations = this->SmoothingIterations;
      options.decimationError = this->DecimationError;
      options.clipToDomain = this->ClipToDomain;
      options.seed = cactus::seedFrom(this->Seed);
      cactus::validate(options);
      auto* image = imageFrom(vtkDataObject::GetData(inputs[0]));
      if (!cactus::ownsWholeOutput(request, outputs))
      {
        if (this->ReleaseInput)
        {
          releaseImage(this); // which this rank has grown, too
        }
        return;
      }
      cactus::LabelImageView view = viewOf(image);
      cactus::LabelImageFacts facts;
      facts.domain = cactus::domainFrom(image);
      facts.minimumGap = fieldNumber(image, "MinimumGap");
      facts.surfaceTolerance = fieldNumber(image, "SurfaceTolerance");
      facts.fibreIds = fieldIds(image, "FibreTable.FibreId");
      facts.bundleIds = fieldIds(image, "FibreTable.BundleId");
      facts.targetRadii = fieldValues(image, "FibreTable.TargetRadius");
      if (image->GetFieldData()->HasArray("FibreTable.LengthInDomain"))
      {
        facts.lengths = fieldValues(image, "FibreTable.LengthInDomain");
      }
      view.gap = facts.minimumGap + 2.0 * facts.surfaceTolerance;

      auto fibres = cactus::myelinSurfaces(view, facts, options, context);
      cactus::TextStream parameters;
      parameters.precision(15);
      parameters << "GRatioModel=" << this->GRatioModel << " GRatio=" << this->GRatio
                 << " GRatioDeviation=" << this->GRatioDeviation << " TargetAxonVolumeFraction=" << this->TargetAxonVolumeFraction
                 << " SmoothingIterations=" << this->SmoothingIterations << " DecimationError=" << this->DecimationError
                 << " ClipToDomain=" << this->ClipToDomain << " Seed=" << this->Seed;
      for (int port = 0; port < 3; ++port)
      {
        vtkDataObject* output = outputs->GetInformationObject(port)->Get(vtkDataObject::DATA_OBJECT());
        cactus::setDomain(output, facts.domain);
        cactus::addProvenance(image, output, "MyelinSurface", parameters.str());
      }
      const std::string remarks = cactus::notAsAsked(fibres, view, facts);
      if (this->ReleaseInput)
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
      if (!remarks.empty())
      {
        vtkWarningMacro(<< remarks);
      }
    });
}

void vtkMyelinSurface::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "GRatioModel: " << this->GRatioModel << '\n'
     << indent << "GRatio: " << this->GRatio << '\n'
     << indent << "GRatioDeviation: " << this->GRatioDeviation << '\n'
     << indent << "TargetAxonVolumeFraction: " << this->TargetAxonVolumeFraction << '\n'
     << indent << "SmoothingIterations: " << this->SmoothingIterations << '\n'
     << indent << "DecimationError: " << this->DecimationError << '\n'
     << indent << "ClipToDomain: " << this->ClipToDomain << '\n'
     << indent << "Seed: " << this->Seed << '\n'
     << indent << "ReleaseInput: " << this->ReleaseInput << '\n'
     << indent << "NumberOfThreads: " << this->NumberOfThreads << '\n';
}
