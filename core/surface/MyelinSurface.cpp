// SPDX-License-Identifier: BSD-3-Clause
#include "surface/MyelinSurface.h"

#include "growth/LabelSource.h"
#include "mesh/SurfaceStore.h"
#include "surface/SurfaceMaker.h"

#include <memory>

namespace cactus
{

std::vector<FibreSurfacePair> myelinSurfaces(const LabelImageView& image, const LabelImageFacts& facts,
  const MyelinSurfaceOptions& options, const Context& context, const SurfaceFilters* filters)
{
  SurfaceMaker maker(std::make_shared<LabelImageInMemory>(image), facts, options, context, filters);
  SurfacesInMemory outer(maker.fibres().size());
  SurfacesInMemory inner(maker.fibres().size());
  maker.makeOuter(outer, inner);
  maker.makeInner(outer, inner);
  std::vector<FibreSurfacePair> fibres = maker.fibres();
  for (std::size_t i = 0; i < fibres.size(); ++i)
  {
    fibres[i].outer = outer.take(i);
    fibres[i].inner = inner.take(i);
  }
  return fibres;
}

} // namespace cactus
