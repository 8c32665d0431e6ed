// SPDX-License-Identifier: BSD-3-Clause
#include "judge/SurfaceFaults.h"

#include "judge/SubstrateCertificate.h"

#include <algorithm>

namespace cactus
{

namespace
{

/// Returns the existing surfaces of the pairs, in increasing order of fibres, like the pairs.
FibreSurfaces surfacesOf(const std::vector<FibreSurfacePair>& pairs, TriangleMesh FibreSurfacePair::*member)
{
  FibreSurfaces surfaces;
  std::vector<const TriangleMesh*> meshes;
  for (const FibreSurfacePair& pair : pairs)
  {
    if (!(pair.*member).triangles.empty())
    {
      surfaces.fibreIds.push_back(pair.fibreId);
      surfaces.bundleIds.push_back(pair.bundleId);
      meshes.push_back(&(pair.*member));
    }
  }
  surfaces.mesh = [meshes](std::size_t index) { return *meshes[index]; };
  return surfaces;
}

bool isAtFault(const FibreCertificate& fibre, double minimumGap)
{
  const bool outer = fibre.hasOuter && (!fibre.outer.sound() || fibre.outerSelfIntersections > 0 || fibre.outerSelfNested);
  const bool inner =
    fibre.hasInner && (!fibre.inner.sound() || fibre.innerSelfIntersections > 0 || fibre.innerSelfNested || fibre.innerLeaves);
  return outer || inner || fibre.meetingFibres > 0 || fibre.gap < minimumGap;
}

} // namespace

void markFaults(std::vector<FibreSurfacePair>& pairs, const Domain& domain, double minimumGap, const Context& context)
{
  SubstrateCertificateOptions options;
  options.minimumGap = minimumGap;
  const FibreSurfaces outer = surfacesOf(pairs, &FibreSurfacePair::outer);
  const FibreSurfaces inner = surfacesOf(pairs, &FibreSurfacePair::inner);
  for (FibreSurfacePair& pair : pairs)
  {
    pair.isFlawed = false;
  }
  if (outer.size() + inner.size() == 0)
  {
    return; // all fibres have vanished, which another remark reports
  }
  const SubstrateCertificate certificate = certify(domain, outer, inner, nullptr, options, context);
  for (const FibreCertificate& fibre : certificate.fibres)
  {
    const auto pair = std::lower_bound(
      pairs.begin(), pairs.end(), fibre.fibreId, [](const FibreSurfacePair& one, int id) { return one.fibreId < id; });
    pair->isFlawed = isAtFault(fibre, minimumGap);
  }
}

} // namespace cactus
