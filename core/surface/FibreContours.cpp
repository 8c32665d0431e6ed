// SPDX-License-Identifier: BSD-3-Clause
#include "surface/FibreContours.h"

#include "mesh/Isosurface.h"
#include "mesh/SurfacePieces.h"
#include "surface/FibreImage.h"

namespace cactus
{

FibreContours::FibreContours(const FibreField& field, double inset, double nudge, const SurfaceFilters* filters)
  : Field(field)
  , Filters(filters)
  , Inset(inset)
  , Nudge(nudge)
  , SmallestPiece(field.grid().spacing * field.grid().spacing * field.grid().spacing)
  , OuterLattice(field.lattice())
  , InnerLattice(field.lattice(inset))
{
}

CappedSurface FibreContours::contourAt(double inset, const SmoothedField& field, double level) const
{
  const NodeLattice& lattice = inset > 0.0 ? this->InnerLattice : this->OuterLattice;
  if (this->Filters != nullptr)
  {
    if (field.blocks().empty())
    {
      return {};
    }
    const auto& [x, y, z] = lattice.planes;
    return this->Filters->contour(fibreImage(this->Field, field.fibre(), field.blocks(), level, inset), level,
      Eigen::AlignedBox3d(Eigen::Vector3d(x.front(), y.front(), z.front()), Eigen::Vector3d(x.back(), y.back(), z.back())));
  }
  CappedSurface surface =
    contour(lattice, field.blocks(), [&](const NodeRange& around, float* out) { field.values(level, this->Nudge, around, out); });
  surface.held = this->Field.heldFaces();
  return surface;
}

CappedSurface FibreContours::outerAt(const SmoothedField& field, double level, double& dropped) const
{
  CappedSurface surface = this->contourAt(0.0, field, level);
  dropped = keepMainPart(surface, this->SmallestPiece);
  return surface;
}

CappedSurface FibreContours::innerAt(const SmoothedField& field, double level, const TriangleTree* within, double& dropped) const
{
  CappedSurface surface = this->contourAt(this->Inset, field, level);
  if (within != nullptr)
  {
    keepPiecesInside(surface, *within);
  }
  dropped = keepMainPart(surface, this->SmallestPiece);
  return surface;
}

CappedSurface FibreContours::unsmoothed(const SmoothedField& field) const
{
  CappedSurface surface = contour(this->OuterLattice, field.blocks(),
    [&](const NodeRange& around, float* out) { field.unsmoothedValues(this->Nudge, around, out); });
  surface.held = this->Field.heldFaces();
  keepMainPart(surface, this->SmallestPiece);
  return surface;
}

SampledVolume FibreContours::innerVolumes(const SmoothedField& field, double lowest) const
{
  return SampledVolume(field, this->InnerLattice, lowest);
}

} // namespace cactus
