// SPDX-License-Identifier: BSD-3-Clause
#include "SubstrateInputs.h"

#include "DataProvenance.h"
#include "FibreData.h"
#include "SurfaceData.h"
#include "base/Error.h"
#include "vtkFibreRadialGrowth.h"
#include "vtkLesion.h"
#include "vtkMyelinSurface.h"
#include "vtkPlacement.h"
#include "vtkSubstrateReader.h"

#include <vtkAlgorithm.h>
#include <vtkDataObject.h>
#include <vtkPolyData.h>

#include <cstring>

namespace cactus
{

namespace
{

vtkDataObject* connectedTo(vtkAlgorithm* consumer, int port)
{
  return port >= 0 && consumer->GetNumberOfInputConnections(port) == 1 ? consumer->GetInputDataObject(port, 0) : nullptr;
}

/// Returns null if the data's memory was released.
vtkDataObject* unlessReleased(vtkDataObject* data)
{
  return data != nullptr && data->GetDataReleased() == 0 ? data : nullptr;
}

/// Returns null for data without cells, as a reader gives out for what its folder does not have.
vtkDataObject* unlessEmpty(vtkDataObject* data)
{
  auto* cells = vtkPolyData::SafeDownCast(unlessReleased(data));
  return cells != nullptr && cells->GetNumberOfCells() > 0 ? cells : nullptr;
}

/// Returns the filter that made the data at a port, as its output `wantedOutput`; null if it is no `Filter`. It looks through
/// ParaView's own filters, which pass data on, and through placement.
template <typename Filter>
Filter* makerOf(vtkAlgorithm* consumer, int port, int wantedOutput)
{
  int output = 0;
  vtkAlgorithm* maker = consumer->GetNumberOfInputConnections(port) == 1 ? consumer->GetInputAlgorithm(port, 0, output) : nullptr;
  while (maker != nullptr &&
         (std::strcmp(maker->GetClassName(), "vtkPVPostFilter") == 0 || vtkPlacement::SafeDownCast(maker) != nullptr) &&
         maker->GetNumberOfInputConnections(0) == 1)
  {
    maker = maker->GetInputAlgorithm(0, 0, output);
  }
  return output == wantedOutput ? Filter::SafeDownCast(maker) : nullptr;
}

/// Returns the reader or the lesion that gives out a substrate's outer and inner surfaces and its fibres, in this order, if the
/// data at a port are these outer surfaces; otherwise null.
vtkAlgorithm* giverOfAll(vtkAlgorithm* consumer, int port)
{
  vtkAlgorithm* reader = makerOf<vtkSubstrateReader>(consumer, port, 0);
  return reader != nullptr ? reader : makerOf<vtkLesion>(consumer, port, 0);
}

} // namespace

vtkDataObject* fibresOfImage(vtkAlgorithm* consumer, int port)
{
  auto* growth = makerOf<vtkFibreRadialGrowth>(consumer, port, 0);
  return growth != nullptr ? growth->GrownFibres() : nullptr;
}

SubstrateData substrateDataOf(vtkAlgorithm* self, int outerPort, int innerPort, int fibrePort)
{
  SubstrateData data{ connectedTo(self, outerPort), connectedTo(self, innerPort), connectedTo(self, fibrePort) };
  vtkDataObject* inner = nullptr;
  vtkDataObject* fibres = nullptr;
  if (auto* surfaces = makerOf<vtkMyelinSurface>(self, outerPort, 0))
  {
    inner = unlessReleased(surfaces->GetOutputDataObject(1));
    fibres = surfaces->GrownFibres();
  }
  else if (vtkAlgorithm* maker = giverOfAll(self, outerPort))
  {
    inner = unlessEmpty(maker->GetOutputDataObject(1));
    fibres = unlessEmpty(maker->GetOutputDataObject(2));
  }
  data.inner = data.inner == nullptr ? inner : data.inner;
  data.fibres = data.fibres == nullptr ? fibres : data.fibres;
  return data;
}

SubstrateData measuredDataOf(vtkAlgorithm* self, int fibrePort, int outerPort, int innerPort)
{
  const bool isMade = makerOf<vtkMyelinSurface>(self, fibrePort, 0) != nullptr || giverOfAll(self, fibrePort) != nullptr;
  if (connectedTo(self, outerPort) != nullptr || !isMade)
  {
    return { connectedTo(self, outerPort), connectedTo(self, innerPort), connectedTo(self, fibrePort) };
  }
  SubstrateData data = substrateDataOf(self, fibrePort, innerPort, outerPort);
  if (data.fibres == nullptr)
  {
    throw InvalidInput(
      "Fibres holds surfaces, and the fibres that they come from are not at hand: connect these as Fibres, and the "
      "surfaces as Outer and Inner");
  }
  return data;
}

Sharing sharingOf(const SubstrateData& data, const std::string& order, const Sharing& all)
{
  if (all.size() == 1)
  {
    return all;
  }
  std::string given = order;
  for (vtkDataObject* one : { data.outer, data.inner, data.fibres })
  {
    given += (one != nullptr ? checksumsOf(one) : "none") + '\n';
  }
  return all.areAlike(given) ? all : Sharing();
}

void requireInnerOf(const FibreSurfaces& outer, const FibreSurfaces& inner)
{
  for (std::size_t i = 0; i < outer.gRatios.size(); ++i)
  {
    if (outer.gRatios[i] > 0.0 && !inner.placeOf(outer.fibreIds[i]))
    {
      throw InvalidInput(text("Outer has fibre ", outer.fibreIds[i], " with an axon (its GRatio is ", outer.gRatios[i], "), and ",
        inner.given() ? "Inner does not have its surface" : "its inner surface is not at hand",
        ": connect as Inner the inner surfaces of the same fibres, which MyelinSurface and SubstrateReader give out beside "
        "the outer ones"));
    }
  }
}

Substrate substrateFrom(const SubstrateData& data)
{
  Substrate substrate;
  substrate.outer = surfacesFrom(data.outer, "Outer", 0);
  substrate.inner = surfacesFrom(data.inner, "Inner", 1);
  substrate.domain = domainFrom(data.outer);
  requireSameDomain(substrate.domain, data.inner, "Inner");
  requireSameDomain(substrate.domain, data.fibres, "Fibres");
  if (data.fibres != nullptr)
  {
    substrate.fibres = fibresFrom(data.fibres);
  }
  return substrate;
}

Substrate wholeSubstrateFrom(const SubstrateData& data)
{
  Substrate substrate = substrateFrom(data);
  requireInnerOf(substrate.outer, substrate.inner);
  return substrate;
}

} // namespace cactus
