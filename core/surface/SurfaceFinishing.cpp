// SPDX-License-Identifier: BSD-3-Clause
#include "surface/SurfaceFinishing.h"

#include "mesh/BandCoarsening.h"
#include "mesh/EvenFans.h"
#include "mesh/HeldRims.h"
#include "mesh/NeedleSplitting.h"
#include "mesh/OpenTile.h"
#include "mesh/SurfaceIntersection.h"
#include "mesh/SurfacePieces.h"
#include "mesh/SurfaceRemeshing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace cactus
{

namespace
{

/// Distance of the points at which coarsening evaluates the field on large triangles, in voxels.
constexpr double samplingDistance = 6.0;
/// Largest error of the rims in periodic faces, as a part of the decimation error: only the wall beside them is coarsened
/// further.
constexpr double rimPart = 0.5;
/// Longest edge of remeshed triangles, in voxels.
constexpr double longestEdge = 6.0;
/// MC/DC warns about triangles above 1000.
constexpr double largestSquaredEdgeRatio = 800.0;
/// Degrees, least angle of what is cut so that vertex normals stand for all sides, where no MinimumAngle is asked for.
constexpr double leastAngle = 0.6;
/// How often a surface is made again with less coarsening where something was wrong with it.
constexpr int repairs = 4;

Eigen::Vector3d centreOf(const TriangleMesh& mesh, std::size_t triangle)
{
  const auto& t = mesh.triangles[triangle];
  return (mesh.points[std::size_t(t[0])] + mesh.points[std::size_t(t[1])] + mesh.points[std::size_t(t[2])]) / 3.0;
}

void addPlacesThatMeet(const TriangleMesh& mesh, const TriangleTree& tree, std::vector<Eigen::Vector3d>& places)
{
  for (const auto& pair : selfIntersections(tree))
  {
    places.push_back(centreOf(mesh, pair.first));
    places.push_back(centreOf(mesh, pair.second));
  }
}

/// Returns places that meet in memory or in a file: faces of the box need not be numbers in single precision.
std::vector<Eigen::Vector3d> placesThatMeet(const TriangleMesh& mesh, const TriangleTree& tree)
{
  std::vector<Eigen::Vector3d> places;
  addPlacesThatMeet(mesh, tree, places);
  if (!isInSinglePrecision(mesh))
  {
    const TriangleMesh written = inSinglePrecision(mesh);
    addPlacesThatMeet(written, TriangleTree(written), places);
  }
  return places;
}

/// Tells whether a point is nearer to a face of the box than `distance` (µm): a regular grid bevels the edges of caps, and of the
/// box.
bool isBeside(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& p, double distance)
{
  return (p - box.min()).minCoeff() < distance || (box.max() - p).minCoeff() < distance;
}

/// Moves a contour to its target level. For large triangles only: the small ones of a fresh contour might come to meet.
void toLevel(CappedSurface& surface, const SurfaceTarget& target)
{
  const double way = std::abs(target.level - target.contoured);
  if (way > 0.0)
  {
    moveToVolume(surface, target.volume, 2.0 * way); // more than necessary
  }
}

} // namespace

std::vector<Eigen::Vector3d> placesThatMeet(const TriangleMesh& mesh)
{
  return placesThatMeet(mesh, TriangleTree(mesh));
}

std::vector<LocalErrorBound> boundsAround(const std::vector<Eigen::Vector3d>& places, double spacing, int attempt)
{
  std::vector<LocalErrorBound> bounds;
  bounds.reserve(places.size());
  for (const Eigen::Vector3d& place : places)
  {
    bounds.push_back({ place, 2.0 * spacing * (1 + attempt), std::pow(0.25, 1 + attempt) });
  }
  return bounds;
}

SurfaceFinishing::SurfaceFinishing(
  double decimationError, double minimumAngle, double spacing, double rimDepth, const Domain& box, const SurfaceFilters* filters)
  : DecimationError(decimationError)
  , MinimumAngle(minimumAngle)
  , Spacing(spacing)
  , RimDepth(rimDepth)
  , Box(box)
  , Filters(filters)
{
}

bool SurfaceFinishing::finish(const SmoothedField& field, const SurfaceTarget& target, CappedSurface& surface,
  SurfaceReport& report, SurfaceChange& change) const
{
  if (this->Filters != nullptr)
  {
    this->Filters->finish(surface);
    roundPoints(surface.mesh, surface.box);
    report = checkSurface(surface.mesh);
    this->even(surface, report);
    change.largestMove = this->largestMove(field, surface, target.level);
    return true;
  }
  if (this->DecimationError > 0.0)
  {
    if (this->coarsen(field, target, surface, report, change))
    {
      change.largestMove = this->largestMove(field, surface, target.level);
      return true;
    }
    splitNeedles(surface, largestSquaredEdgeRatio);
  }
  roundPoints(surface.mesh, surface.box);
  report = keepSoundPieces(surface.mesh, change.droppedVolume);
  if (target.hasEvenFans)
  {
    this->even(surface, report);
  }
  surface.faces.clear(); // they count the points of before
  return this->faultsOf(surface, target, change).empty();
}

void SurfaceFinishing::finishMoved(CappedSurface& surface) const
{
  if (this->DecimationError > 0.0)
  {
    splitNeedles(surface, largestSquaredEdgeRatio);
  }
  roundPoints(surface.mesh, surface.box);
}

void SurfaceFinishing::even(CappedSurface& surface) const
{
  evenFans(surface, largestSquaredEdgeRatio, std::max(this->MinimumAngle, leastAngle), this->RimDepth);
  roundPoints(surface.mesh, surface.box);
}

/// The same for one whose points may be others than `faces` tells of, if it is a closed manifold.
void SurfaceFinishing::even(CappedSurface& surface, SurfaceReport& report) const
{
  surface.faces = facesOf(surface.mesh, surface.box);
  if (report.closedManifold())
  {
    this->even(surface);
    report = checkSurface(surface.mesh);
  }
}

/// Returns places that meet, where the surface is to end in periodic faces too (see openAtPeriodicFaces), and where it cuts or
/// touches the container of its target, which is recorded.
std::vector<Eigen::Vector3d> SurfaceFinishing::faultsOf(
  const CappedSurface& surface, const SurfaceTarget& target, SurfaceChange& change) const
{
  const TriangleTree tree(surface.mesh);
  std::vector<Eigen::Vector3d> places = placesThatMeet(surface.mesh, tree);
  if (target.container == nullptr)
  {
    return places;
  }
  for (const auto& pair : meetingTriangles(tree, *target.container))
  {
    places.push_back(centreOf(surface.mesh, pair.first));
    change.isHemmedIn = true;
  }
  if (surface.held != 0)
  {
    const std::vector<Eigen::Vector3d> more = placesThatMeet(withoutPeriodicCaps(surface.mesh, this->Box));
    places.insert(places.end(), more.begin(), more.end());
  }
  return places;
}

/// Leaves the surface as it is, and returns false, if it cannot be coarsened.
bool SurfaceFinishing::coarsen(const SmoothedField& field, const SurfaceTarget& target, CappedSurface& surface,
  SurfaceReport& report, SurfaceChange& change) const
{
  SurfaceDecimationOptions decimation;
  decimation.localBounds = target.bounds;
  decimation.level = target.level;
  decimation.maximumError = this->DecimationError;
  decimation.sampling = samplingDistance * this->Spacing;
  decimation.field = [&field](const Eigen::Vector3d& p) { return field.value(p); };
  const HeldRims rims(surface, rimPart * this->DecimationError, samplingDistance * this->Spacing);
  for (int attempt = 0; attempt <= repairs; ++attempt)
  {
    CappedSurface trial = surface;
    trial.stays = rims.stays();
    const bool isBanded = attempt == 0 && decimation.localBounds.empty() && this->MinimumAngle <= 0.0;
    if (isBanded)
    {
      decimation.level = target.contoured;
      coarsenBands(trial, field.lattice(), decimation);
      decimation.level = target.level;
      toLevel(trial, target);
    }
    this->reshape(trial, decimation);
    moveToVolume(trial, target.volume, this->DecimationError);
    rims.join(trial);
    splitNeedles(trial, largestSquaredEdgeRatio);
    target.hasEvenFans ? this->even(trial) : roundPoints(trial.mesh, trial.box);
    report = checkSurface(trial.mesh);
    const std::vector<Eigen::Vector3d> places = this->faultsOf(trial, target, change);
    if (places.empty() && report.degenerateTriangles == 0 && report.sound())
    {
      surface = std::move(trial);
      return true;
    }
    if (places.empty() && !isBanded)
    {
      break; // the fault has no particular place
    }
    const std::vector<LocalErrorBound> more = boundsAround(places, this->Spacing, attempt);
    decimation.localBounds.insert(decimation.localBounds.end(), more.begin(), more.end());
  }
  return false;
}

/// Coarsens or remeshes the triangles of a contour, as the options say.
void SurfaceFinishing::reshape(CappedSurface& surface, const SurfaceDecimationOptions& decimation) const
{
  if (this->MinimumAngle > 0.0)
  {
    remesh(surface, { decimation, longestEdge * this->Spacing, this->MinimumAngle });
    return;
  }
  decimate(surface, decimation);
}

/// Returns the largest difference between the field and `level` at points spread over the surface, at most a voxel apart; on caps
/// only where the field is smaller.
double SurfaceFinishing::largestMove(const SmoothedField& field, const CappedSurface& surface, double level) const
{
  const auto& points = surface.mesh.points;
  double largest = 0.0;
  for (const auto& t : surface.mesh.triangles)
  {
    // In rows along the longest edge, a to b, up to the corner c.
    std::array<double, 3> lengths;
    for (std::size_t i = 0; i < 3; ++i)
    {
      lengths[i] = (points[std::size_t(t[(i + 1) % 3])] - points[std::size_t(t[i])]).norm();
    }
    const auto first = std::size_t(std::max_element(lengths.begin(), lengths.end()) - lengths.begin());
    const Eigen::Vector3d& a = points[std::size_t(t[first])];
    const Eigen::Vector3d ab = points[std::size_t(t[(first + 1) % 3])] - a;
    const Eigen::Vector3d ac = points[std::size_t(t[(first + 2) % 3])] - a;
    const bool isCap = surface.isCap(t) || (this->Filters != nullptr && isBeside(surface.box, a, this->Spacing));
    const double height = lengths[first] > 0.0 ? ab.cross(ac).norm() / lengths[first] : 0.0;
    const int rows = std::max(1, static_cast<int>(std::ceil(height / this->Spacing)));
    for (int j = 0; j <= rows; ++j)
    {
      const double up = double(j) / rows;
      const int n = static_cast<int>(std::ceil((1.0 - up) * lengths[first] / this->Spacing));
      for (int i = 0; i <= n; ++i)
      {
        const double along = (1.0 - up) * (n > 0 ? double(i) / n : 0.0);
        const double excess = field.value(a + along * ab + up * ac) - level;
        largest = std::max(largest, isCap ? -excess : std::abs(excess));
      }
    }
  }
  return largest;
}

} // namespace cactus
