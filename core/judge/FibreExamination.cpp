// SPDX-License-Identifier: BSD-3-Clause
#include "judge/FibreExamination.h"

#include "base/Constants.h"
#include "base/Error.h"
#include "fibres/FibreShape.h"
#include "mesh/CappedSurface.h"
#include "mesh/SurfaceDistance.h"
#include "mesh/SurfaceIntersection.h"
#include "mesh/SurfacePieces.h"
#include "mesh/SurfaceWall.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace cactus
{

namespace
{

/// Largest number of pairs of triangles that is counted: a badly damaged surface may have half a billion.
constexpr std::size_t mostIntersections = 10000;

/// Returns the triangles of `mesh` that are not in `some`, which is in increasing order.
std::vector<std::uint32_t> othersThan(const std::vector<std::uint32_t>& some, const TriangleMesh& mesh)
{
  std::vector<std::uint32_t> others;
  others.reserve(mesh.triangles.size() - some.size());
  auto next = some.begin();
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
  {
    if (next != some.end() && *next == t)
    {
      ++next;
    }
    else
    {
      others.push_back(t);
    }
  }
  return others;
}

double reachOf(const TriangleMesh& mesh, const Domain& box)
{
  double reach = 0.0;
  for (const Eigen::Vector3d& point : mesh.points)
  {
    reach = std::max(reach, -box.depth(point));
  }
  return reach;
}

} // namespace

FibreExamination::FibreExamination(
  const Domain& domain, const FibreSurfaces& outer, const FibreSurfaces& inner, const Fibres* fibres, double cutSpacing)
  : Box(domain)
  , Outer(outer)
  , Inner(inner)
  , Lines(fibres)
  , CutSpacing(cutSpacing)
  , OuterIndex(indexOf(outer.fibreIds))
  , InnerIndex(indexOf(inner.fibreIds))
  , LineIndex(fibres != nullptr ? indexOf(fibres->fibreIds) : Index())
{
}

FibreExamination::Index FibreExamination::indexOf(const std::vector<int>& ids)
{
  Index index;
  for (std::size_t i = 0; i < ids.size(); ++i)
  {
    index[ids[i]] = i;
  }
  return index;
}

std::unique_ptr<TreedSurface> FibreExamination::examine(FibreCertificate& fibre, double& reach) const
{
  fibre.outerRadius = fibre.innerRadius = { 0, notANumber, notANumber };
  fibre.gap = fibre.myelinThickness = fibre.gRatio = notANumber;
  const auto line = this->LineIndex.find(fibre.fibreId);
  fibre.length = line != this->LineIndex.end() ? lengthInDomain(*this->Lines, line->second) : notANumber;
  std::unique_ptr<TreedSurface> outer;
  const auto outerEntry = this->OuterIndex.find(fibre.fibreId);
  if (outerEntry != this->OuterIndex.end())
  {
    fibre.hasOuter = true;
    outer = this->measure(this->Outer.mesh(outerEntry->second), fibre.fibreId, "outer",
      { fibre.outer, fibre.outerSelfIntersections, fibre.outerSelfNested, fibre.outerRadius });
    reach = std::max(reach, reachOf(outer->mesh, this->Box));
  }
  const auto innerEntry = this->InnerIndex.find(fibre.fibreId);
  if (innerEntry != this->InnerIndex.end())
  {
    fibre.hasInner = true;
    const auto inner = this->measure(this->Inner.mesh(innerEntry->second), fibre.fibreId, "inner",
      { fibre.inner, fibre.innerSelfIntersections, fibre.innerSelfNested, fibre.innerRadius });
    reach = std::max(reach, reachOf(inner->mesh, this->Box));
    fibre.innerLeaves = !fibre.hasOuter;
    if (fibre.hasOuter)
    {
      fibre.isBare = areSame(inner->mesh, outer->mesh);
      fibre.gRatio = gRatioOf(fibre.inner.volume, fibre.outer.volume);
    }
    if (fibre.hasOuter && !fibre.isBare)
    {
      // In a file, caps lie at the nearest number in single precision to the face.
      const std::vector<std::uint32_t> wall = wallTriangles(outer->mesh, this->Box, lostInFiles);
      const SurfaceGap gap = smallestGap(inner->tree, TriangleTree(outer->mesh, wall));
      fibre.myelinThickness = gap.found() ? gap.distance : notANumber;
      // Unless every piece can be shown to lie strictly inside. With a gap, the wall is not met.
      fibre.innerLeaves = !fibre.outer.closed() || gap.distance == 0.0 ||
                          surfacesMeet(inner->tree, TriangleTree(outer->mesh, othersThan(wall, outer->mesh))) ||
                          !liesInside(inner->mesh, fibre.inner, outer->tree);
    }
  }
  return outer;
}

std::unique_ptr<TreedSurface> FibreExamination::outerOf(int fibreId) const
{
  return std::make_unique<TreedSurface>(this->Outer.mesh(this->OuterIndex.at(fibreId)));
}

std::unique_ptr<TreedSurface> FibreExamination::measure(
  TriangleMesh mesh, int fibreId, const std::string& name, Findings findings) const
{
  try
  {
    findings.report = checkSurface(mesh);
  }
  catch (const InvalidInput& error)
  {
    throw InvalidInput("the " + name + " surface of fibre " + std::to_string(fibreId) + ": " + error.what());
  }
  auto surface = std::make_unique<TreedSurface>(std::move(mesh));
  findings.selfIntersections = selfIntersections(surface->tree, mostIntersections).size();
  findings.selfNested = findings.report.pieces.size() > 1 && findings.report.closed() && findings.selfIntersections == 0 &&
                        holdsItself(surface->mesh);
  const auto line = this->LineIndex.find(fibreId);
  if (line != this->LineIndex.end())
  {
    const std::vector<FibreCut> cuts = cutsAlongFibre(*this->Lines, line->second, surface->mesh, this->CutSpacing);
    findings.radius = radiusAlongFibre(*this->Lines, line->second, surface->mesh, cuts, findings.report.volume);
  }
  return surface;
}

} // namespace cactus
