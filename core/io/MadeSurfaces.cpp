// SPDX-License-Identifier: BSD-3-Clause
#include "io/MadeSurfaces.h"

#include "fibres/FibreShape.h"

#include <cstddef>
#include <utility>

namespace cactus
{

namespace
{

/// Returns the surfaces of one kind, which stay in their store.
FibreSurfaces surfacesIn(
  const SurfaceSource& store, const std::vector<FibreSurfacePair>& fibres, SurfaceReport FibreSurfacePair::*report, double gap)
{
  FibreSurfaces surfaces;
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < fibres.size(); ++i)
  {
    if ((fibres[i].*report).triangles > 0)
    {
      surfaces.fibreIds.push_back(fibres[i].fibreId);
      surfaces.bundleIds.push_back(fibres[i].bundleId);
      places.push_back(i);
    }
  }
  surfaces.mesh = [&store, places = std::move(places)](std::size_t index) { return *store.get(places[index]); };
  surfaces.isGiven = true;
  surfaces.promisedGap = gap;
  return surfaces;
}

} // namespace

LabelImageFacts grownImageFacts(const Fibres& fibres, const FibreRadialGrowthOptions& growth)
{
  LabelImageFacts facts = labelImageFacts(fibres, growth);
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    facts.lengths.push_back(lengthInDomain(fibres, f));
  }
  return facts;
}

void addMadeSurfaces(const std::vector<FibreSurfacePair>& fibres, const SurfaceSource& outer, const SurfaceSource& inner,
  double gap, SubstrateFolderContents& contents)
{
  contents.outer = surfacesIn(outer, fibres, &FibreSurfacePair::outerReport, gap);
  contents.inner = surfacesIn(inner, fibres, &FibreSurfacePair::innerReport, gap);
  for (const FibreSurfacePair& fibre : fibres)
  {
    if (fibre.isWanted)
    {
      contents.outer.wantedIds.push_back(fibre.fibreId);
    }
  }
}

} // namespace cactus
