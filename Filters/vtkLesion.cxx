// SPDX-License-Identifier: BSD-3-Clause
#include "vtkLesion.h"

#include "DataProvenance.h"
#include "FibreData.h"
#include "FilterSupport.h"
#include "StageProperties.h"
#include "SubstrateInputs.h"
#include "SurfaceData.h"
#include "SurfaceFacts.h"
#include "WholeData.h"
#include "base/Constants.h"
#include "base/Error.h"
#include "base/Parallel.h"
#include "fibres/FibreShape.h"
#include "fibres/SelectFibres.h"
#include "judge/Lesion.h"
#include "judge/SubstrateStatistics.h"
#include "mesh/SurfaceCheck.h"
#include "stages/Stages.h"

#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>

#include <map>
#include <set>
#include <utility>
#include <vector>

vtkStandardNewMacro(vtkLesion);

namespace
{

/// Returns what cell data say of each fibre that is left.
std::map<int, cactus::FibreValues> valuesOf(const cactus::FibreSurfaces& outer, const cactus::FibreSurfaces& inner,
  const cactus::Substrate& substrate, const cactus::Context& context)
{
  std::map<int, double> lengths;
  for (std::size_t f = 0; substrate.fibres && f < substrate.fibres->size(); ++f)
  {
    lengths[substrate.fibres->fibreIds[f]] = cactus::lengthInDomain(*substrate.fibres, f);
  }
  std::vector<cactus::FibreValues> each(outer.size());
  const auto measure = [&](std::size_t i)
  {
    const cactus::TriangleMesh mesh = outer.mesh(i);
    const double volume = cactus::checkSurface(mesh).volume;
    const auto axon = inner.placeOf(outer.fibreIds[i]);
    const double gRatio = axon ? cactus::gRatioOf(cactus::checkSurface(inner.mesh(*axon)).volume, volume) : cactus::notANumber;
    const auto length = lengths.find(outer.fibreIds[i]);
    each[i] =
      cactus::fibreValues(mesh, volume, length != lengths.end() ? length->second : cactus::notANumber, gRatio, substrate.domain);
  };
  cactus::parallelFor(outer.size(), context, measure);
  std::map<int, cactus::FibreValues> values;
  for (std::size_t i = 0; i < outer.size(); ++i)
  {
    values[outer.fibreIds[i]] = each[i];
  }
  for (std::size_t i = 0; i < inner.size(); ++i)
  {
    if (values.count(inner.fibreIds[i]) == 0) // a lone inner surface
    {
      values[inner.fibreIds[i]] =
        cactus::fibreValues(inner.mesh(i), cactus::notANumber, cactus::notANumber, cactus::notANumber, substrate.domain);
    }
  }
  return values;
}

void giveSurfaces(const cactus::FibreSurfaces& surfaces, int kind, const std::map<int, cactus::FibreValues>& values,
  const cactus::Domain& domain, vtkPolyData* output)
{
  std::vector<cactus::NamedSurface> named;
  named.reserve(surfaces.size());
  for (std::size_t i = 0; i < surfaces.size(); ++i)
  {
    named.push_back({ surfaces.fibreIds[i], surfaces.bundleIds[i], surfaces.mesh(i) });
  }
  cactus::toPolyData(std::move(named), kind, output);
  cactus::addFibreValues(output, values);
  cactus::setSurfaceFacts(output, surfaces.wantedIds, surfaces.promisedGap);
  cactus::setDomain(output, domain);
}

/// Returns the fibres that are not gone.
cactus::Fibres fibresLeft(const cactus::Fibres& fibres, const cactus::FibreSurfaces& outer, const cactus::Lesion& lesion)
{
  std::set<int> gone;
  for (std::size_t i = 0; i < outer.size(); ++i)
  {
    if (lesion.fibres[i] == cactus::FibreInLesion::Gone)
    {
      gone.insert(outer.fibreIds[i]);
    }
  }
  std::vector<std::size_t> left;
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    if (gone.count(fibres.fibreIds[f]) == 0)
    {
      left.push_back(f);
    }
  }
  return cactus::selectFibres(fibres, left);
}

} // namespace

vtkLesion::vtkLesion()
  : Properties(cactus::makeProperties<cactus::LesionStage>())
{
  this->SetNumberOfInputPorts(3);
  this->SetNumberOfOutputPorts(3);
}

int vtkLesion::FillInputPortInformation(int port, vtkInformation* info)
{
  cactus::acceptAnyData(info);
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), port > 0 ? 1 : 0);
  return 1;
}

int vtkLesion::RequestUpdateExtent(vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  cactus::requestWholeInputs(inputs, 3);
  return 1;
}

int vtkLesion::RequestData(vtkInformation* request, vtkInformationVector**, vtkInformationVector* outputs)
{
  return cactus::guarded(this,
    [&]
    {
      const auto& stage = cactus::stageOf<cactus::LesionStage>(this->Properties);
      cactus::validateProperties(stage);
      if (!cactus::ownsWholeOutput(request, outputs))
      {
        return; // the first rank gives everything
      }
      const cactus::SubstrateData data = cactus::substrateDataOf(this, 0, 1, 2);
      const cactus::Substrate substrate = cactus::wholeSubstrateFrom(data);
      if (substrate.inner.size() == 0)
      {
        throw cactus::InvalidInput(
          "there are no inner surfaces, and without them no myelin to lose: connect MyelinSurface's Inner");
      }
      const cactus::Context context = cactus::contextFor(this, stage.threads);
      const cactus::Lesion lesion =
        cactus::fibresInLesion(substrate.domain, substrate.outer, substrate.inner, stage.options, context);
      auto* outer = vtkPolyData::GetData(outputs, 0);
      auto* inner = vtkPolyData::GetData(outputs, 1);
      auto* fibres = vtkPolyData::GetData(outputs, 2);
      const cactus::FibreSurfaces outerLeft = cactus::outerInLesion(lesion, substrate.outer, substrate.inner);
      const cactus::FibreSurfaces innerLeft = cactus::innerInLesion(lesion, substrate.outer, substrate.inner);
      const std::map<int, cactus::FibreValues> values = valuesOf(outerLeft, innerLeft, substrate, context);
      giveSurfaces(outerLeft, 0, values, substrate.domain, outer);
      giveSurfaces(innerLeft, 1, values, substrate.domain, inner);
      if (substrate.fibres)
      {
        cactus::toPolyData(fibresLeft(*substrate.fibres, substrate.outer, lesion), fibres);
        cactus::addDirectionColours(fibres);
      }
      const cactus::Provenance provenance = cactus::recordOf(this, "Lesion", stage, { "Outer", "Inner", "Fibres" },
        { { "AxonLossReached", lesion.axonLoss }, { "MyelinLossReached", lesion.myelinLoss } });
      int port = 0;
      for (vtkPolyData* output : { outer, inner, fibres })
      {
        cactus::setProvenance(output, provenance, port++);
      }
    });
}
