// SPDX-License-Identifier: BSD-3-Clause
#include "surface/FibreMesher.h"

#include "base/Constants.h"
#include "base/Error.h"
#include "mesh/NeedleSplitting.h"
#include "mesh/SurfaceDecimation.h"
#include "mesh/SurfaceDistance.h"
#include "mesh/SurfaceIntersection.h"
#include "mesh/SurfacePieces.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace cactus
{

namespace
{

/// Volume of pieces beside the axon's main one that may be left out, as a part of it.
constexpr double negligiblePart = 1e-3;
/// Relative error of an inner volume that is good enough.
constexpr double volumeTolerance = 1e-3;
/// The same of the axons that another library's filters coarsen, after a few rounds.
constexpr double filteredVolumeTolerance = 5e-3;
/// Distance from where an inner surface has the wanted volume that is good enough before coarsening, as a part of a voxel.
constexpr double nearEnough = 0.003;
/// How far an outer surface mostly moves out to make up for what smoothing takes off it, and what may be left of that before
/// coarsening, as parts of the tolerance.
constexpr double usualPart = 0.5;
constexpr double restPart = 0.02;
/// Least distance between the planes of an inner and an outer surface's caps, in voxels: in one plane they would meet.
constexpr double smallestInset = 0.05;
/// Distance of the points at which coarsening looks at the field on large triangles, in voxels.
constexpr double samplingDistance = 6.0;
/// MC/DC warns of triangles above 1000.
constexpr double largestSquaredEdgeRatio = 800.0;
/// How often a surface is made again with less coarsening where something was wrong with it.
constexpr int repairs = 4;
/// µm that growth has to have left between two fibres, so that contours, which are not quite the zeros of the fields, keep off
/// each other.
constexpr double leastRoom = 0.01;
/// µm that a distance may lose where points are written in single precision.
constexpr double rounding = 5e-5;

Eigen::Vector3d centreOf(const TriangleMesh& mesh, std::size_t triangle)
{
  const auto& t = mesh.triangles[triangle];
  return (mesh.points[std::size_t(t[0])] + mesh.points[std::size_t(t[1])] + mesh.points[std::size_t(t[2])]) / 3.0;
}

/// Gives back the room that a mesh had to grow in: all fibres' meshes are held at the same time.
TriangleMesh packed(TriangleMesh&& mesh)
{
  mesh.points.shrink_to_fit();
  mesh.triangles.shrink_to_fit();
  return std::move(mesh);
}

/// Where a coarsened surface must not stay as it is: it cuts itself or its container.
std::vector<Eigen::Vector3d> faults(const TriangleMesh& mesh, const TriangleTree* container)
{
  std::vector<Eigen::Vector3d> places;
  const TriangleTree tree(mesh);
  for (const auto& pair : selfIntersections(tree))
  {
    places.push_back(centreOf(mesh, pair.first));
    places.push_back(centreOf(mesh, pair.second));
  }
  if (container != nullptr)
  {
    for (const auto& pair : meetingTriangles(tree, *container))
    {
      places.push_back(centreOf(mesh, pair.first));
    }
  }
  return places;
}

} // namespace

FibreMesher::FibreMesher(const LabelImageView& image, const LabelImageFacts& facts, const MyelinSurfaceOptions& options,
  const SurfaceFilters* filters, const Context& context)
  : Facts(facts)
  , Options(options)
  , Filters(filters)
  , Field(image, facts.domain, options.clipToDomain)
  , Spacing(image.grid.spacing)
  , Inset(std::clamp(facts.minimumGap, smallestInset * Spacing, 0.25 * Spacing))
  , OuterLattice(Field.lattice())
  , InnerLattice(Field.lattice(Inset))
  , Withdrawal(0.5 * std::max(0.0, leastRoom - image.gap))
  , Nudge(std::min(0.02 * Spacing, 0.2 * std::max(facts.surfaceTolerance, 1e-3 * Spacing)))
  , ThinnestMyelin(std::max({ facts.minimumGap, 4.0 * facts.surfaceTolerance, 1e-3 * Spacing, leastSeparation }))
  , PromisedMyelin(std::max(facts.minimumGap, leastSeparation) + rounding)
{
  if (options.smoothingIterations > 0)
  {
    this->Field.spareThinFibres(context);
  }
}

SmoothedField FibreMesher::smoothed(const std::vector<std::uint32_t>& blocks, int fibreId) const
{
  return SmoothedField(this->Field, fibreId, blocks, this->Options.smoothingIterations);
}

void FibreMesher::makeOuter(
  const SmoothedField& field, FibreSurfacePair& pair, const std::vector<LocalErrorBound>& bounds, double deeper) const
{
  // Smoothing takes more off the ridges than it fills in; the surface moves out until it holds what the fibre held before.
  const double furthest = this->Options.smoothingIterations > 0 ? this->Facts.surfaceTolerance : 0.0;
  const double highest = this->Withdrawal + deeper;
  double level = highest - usualPart * furthest;
  CappedSurface surface = this->contourAt(0.0, field, level);
  pair.droppedVolume = keepMainPart(surface, this->smallestPiece());
  if (surface.mesh.triangles.empty())
  {
    return;
  }
  SurfaceMeasure now = measure(surface);
  double volume = now.volume;
  if (furthest > 0.0)
  {
    CappedSurface before = contour(this->OuterLattice, field.blocks(),
      [&](const NodeRange& around, float* out) { field.unsmoothedValues(this->Nudge, around, out); });
    keepMainPart(before, this->smallestPiece());
    volume = measure(before).volume;
    const double right = std::clamp(level - (volume - now.volume) / now.freeArea, highest - furthest, highest);
    // The rest is left to the move after coarsening.
    const double rest = restPart * furthest;
    if (std::abs(right - level) > rest)
    {
      level = right;
      surface = this->contourAt(0.0, field, level);
      pair.droppedVolume = keepMainPart(surface, this->smallestPiece());
      now = measure(surface);
    }
    volume = std::clamp(volume, now.volume - rest * now.freeArea, now.volume + rest * now.freeArea);
  }
  const bool isSound = this->finish(field, surface, level, volume, nullptr, bounds, pair.outerReport, pair);
  pair.isFlawed = pair.isFlawed || !isSound;
  pair.outer = packed(std::move(surface.mesh));
  pair.outerLevel = level;
  pair.state = pair.outer.triangles.empty() ? MyelinState::NoFibre : MyelinState::NoAxon;
}

std::vector<Eigen::Vector3d> FibreMesher::checkOuter(FibreSurfacePair& pair) const
{
  pair.outerReport = keepSoundPieces(pair.outer, pair.droppedVolume);
  if (pair.outer.triangles.empty())
  {
    pair.state = MyelinState::NoFibre;
    return {};
  }
  return faults(pair.outer, nullptr);
}

std::vector<LocalErrorBound> FibreMesher::boundsAround(const std::vector<Eigen::Vector3d>& places, int attempt) const
{
  std::vector<LocalErrorBound> bounds;
  bounds.reserve(places.size());
  for (const Eigen::Vector3d& place : places)
  {
    bounds.push_back({ place, 2.0 * this->Spacing * (1 + attempt), std::pow(0.25, 1 + attempt) });
  }
  return bounds;
}

double FibreMesher::equivalentDiameter(const SmoothedField& field, const FibreSurfacePair& pair) const
{
  return 2.0 * std::sqrt(std::max(0.0, pair.outerReport.volume) / (pi * this->length(field)));
}

/// An inner surface before coarsening.
struct FibreMesher::Inner
{
  CappedSurface surface;
  double level = 0.0;
  double volume = 0.0;
  double area = 0.0;
  bool onePiece = false;
};

void FibreMesher::makeInner(const SmoothedField& field, FibreSurfacePair& pair) const
{
  pair.inner = TriangleMesh();
  pair.innerReport = SurfaceReport();
  pair.gRatio = 0.0;
  pair.thickness = 0.0;
  pair.state = MyelinState::NoAxon;
  const double wanted = pair.targetGRatio * pair.targetGRatio * pair.outerReport.volume;
  if (!(wanted > 0.0))
  {
    return; // an outer surface, not made here, that encloses nothing
  }

  std::vector<float> depths = this->depths(field);
  const auto deepest = std::max_element(depths.begin(), depths.end());
  if (deepest == depths.end() || *deepest <= this->ThinnestMyelin)
  {
    return;
  }
  const double upper = *deepest;
  // As many samples as the axon shall have of the volume lie deeper than a first guess.
  const auto rank = static_cast<std::size_t>((1.0 - pair.targetGRatio * pair.targetGRatio) * double(depths.size() - 1));
  std::nth_element(depths.begin(), depths.begin() + std::ptrdiff_t(rank), depths.end());
  const double guess = std::max(double(depths[rank]), this->ThinnestMyelin);
  depths = {};

  const TriangleTree outer(pair.outer);
  const TriangleTree* within = nullptr;
  Inner best;
  MyelinState state = this->solve(field, wanted, upper, guess, within, best);
  if (this->Filters != nullptr && state != MyelinState::NoAxon)
  {
    const bool isRight = this->finishByFilters(field, state == MyelinState::AsAsked ? wanted : best.volume, best, pair);
    if (state == MyelinState::AsAsked && !isRight)
    {
      state = pair.innerReport.volume < wanted ? MyelinState::Thicker : MyelinState::Thinner;
    }
    pair.state = pair.inner.triangles.empty() ? MyelinState::NoAxon : state;
    return;
  }
  const TriangleTree wall(pair.outer, this->wallOf(pair.outer));
  double leastStep = 0.1 * this->ThinnestMyelin;
  while (state != MyelinState::NoAxon)
  {
    const double volume = state == MyelinState::AsAsked ? wanted : best.volume;
    const bool isSound = this->finish(field, best.surface, best.level, volume, &outer, {}, pair.innerReport, pair);
    const TriangleMesh& inner = best.surface.mesh;
    if (isSound && (inner.triangles.empty() || (within != nullptr && !liesInside(inner, pair.innerReport, outer))))
    {
      state = MyelinState::NoAxon;
      break;
    }
    if (isSound && !liesInside(inner, pair.innerReport, outer))
    {
      // The largest part of the axon lies in a part of the fibre that is not the largest, and was left out.
      within = &outer;
      state = this->solve(field, wanted, upper, guess, within, best);
      continue;
    }
    const SurfaceGap gap = isSound ? smallestGap(TriangleTree(inner), wall, this->PromisedMyelin) : SurfaceGap();
    if (isSound && !gap.found())
    {
      break;
    }
    // The outer surface lies further in than the field tells, where voxels do not resolve a crease or a neighbour has pushed it.
    state = MyelinState::Thicker;
    const double step = isSound ? std::max(this->PromisedMyelin - gap.distance, leastStep) : this->ThinnestMyelin;
    leastStep = isSound ? 2.0 * leastStep : leastStep;
    best = this->innerAt(field, best.level + step, within);
    if (best.level > upper || !best.onePiece)
    {
      state = MyelinState::NoAxon;
    }
  }
  if (state == MyelinState::NoAxon)
  {
    pair.innerReport = SurfaceReport();
    return;
  }
  pair.inner = packed(std::move(best.surface.mesh));
  // By how much the volume was off before it was moved to what is wanted, was the level.
  pair.thickness = best.level - pair.outerLevel + (state == MyelinState::AsAsked ? (best.volume - wanted) / best.area : 0.0);
  pair.state = state;
  pair.gRatio = std::sqrt(pair.innerReport.volume / pair.outerReport.volume);
}

/// Coarsens an inner surface by somebody else's filters. These change its volume, so it is made again at other levels until it is
/// the one wanted. Returns whether it is.
bool FibreMesher::finishByFilters(const SmoothedField& field, double wanted, Inner& best, FibreSurfacePair& pair) const
{
  const double outerMove = pair.largestMove;
  double error = 0.0;
  for (int round = 0; round < 4; ++round)
  {
    if (round > 0)
    {
      const Inner next = this->innerAt(field, std::max(best.level + error / best.area, this->ThinnestMyelin), nullptr);
      if (!next.onePiece)
      {
        break;
      }
      best = next;
    }
    CappedSurface surface = best.surface;
    pair.largestMove = outerMove;
    this->finish(field, surface, best.level, wanted, nullptr, {}, pair.innerReport, pair);
    pair.inner = packed(std::move(surface.mesh));
    error = pair.innerReport.volume - wanted;
    if (std::abs(error) <= volumeTolerance * wanted)
    {
      break;
    }
  }
  pair.thickness = best.level - pair.outerLevel;
  pair.gRatio = pair.outerReport.volume > 0.0 ? std::sqrt(std::max(0.0, pair.innerReport.volume) / pair.outerReport.volume) : 0.0;
  return std::abs(error) <= filteredVolumeTolerance * wanted;
}

CappedSurface FibreMesher::contourAt(double inset, const SmoothedField& field, double level) const
{
  if (this->Filters != nullptr)
  {
    if (field.blocks().empty())
    {
      return {};
    }
    const Domain& box = this->Field.box();
    const Eigen::Vector3d margin = Eigen::Vector3d::Constant(inset);
    return this->Filters->contour(fibreImage(this->Field, field.fibre(), field.blocks(), level, inset), level,
      Eigen::AlignedBox3d(box.lower + margin, box.upper - margin));
  }
  return contour(inset > 0.0 ? this->InnerLattice : this->OuterLattice, field.blocks(),
    [&](const NodeRange& around, float* out) { field.values(level, this->Nudge, around, out); });
}

FibreMesher::Inner FibreMesher::innerAt(const SmoothedField& field, double level, const TriangleTree* within) const
{
  Inner inner;
  inner.level = level;
  inner.surface = this->contourAt(this->Inset, field, level);
  if (within != nullptr)
  {
    keepPiecesInside(inner.surface, *within);
  }
  const double dropped = keepMainPart(inner.surface, this->smallestPiece());
  const SurfaceMeasure measured = measure(inner.surface);
  inner.volume = measured.volume;
  inner.area = measured.freeArea;
  inner.onePiece = inner.volume > 0.0 && dropped <= negligiblePart * inner.volume;
  return inner;
}

/// Looks for the level at which the axon, or what of it begins inside `within`, has the wanted volume, from a first guess.
MyelinState FibreMesher::solve(
  const SmoothedField& field, double wanted, double deepest, double guess, const TriangleTree* within, Inner& best) const
{
  double lower = this->ThinnestMyelin; // here the axon is too large, or as large as may be
  double upper = deepest;              // here it is too small, or in pieces
  double level = std::clamp(guess, lower, upper);
  bool broken = false;
  bool found = false;
  MyelinState state = MyelinState::AsAsked;
  // Newton's method: the volume falls by the area of the surface as the level rises; else bisection.
  for (int step = 0; step < 40; ++step)
  {
    Inner inner = this->innerAt(field, level, within);
    const double error = inner.volume - wanted;
    // What is off by little, moveToVolume() makes up for; without coarsening it is not called.
    const double slack = this->Options.decimationError > 0.0 ? nearEnough * this->Spacing * inner.area : 0.0;
    const bool good = std::abs(error) <= std::max(volumeTolerance * wanted, slack);
    if (!inner.onePiece)
    {
      broken = true;
      upper = level;
    }
    else
    {
      // The thickest myelin with an axon in one piece, as long as nothing better is known.
      (error > 0.0 ? lower : upper) = level;
      best = inner;
      found = true;
      if (good)
      {
        return MyelinState::AsAsked;
      }
      if (error < 0.0 && level <= this->ThinnestMyelin)
      {
        return MyelinState::Thicker;
      }
    }
    if (upper - lower < 1e-3 * this->Spacing)
    {
      // Squeezed in between a level that is too thin and one at which the axon breaks.
      if (!found && lower <= this->ThinnestMyelin)
      {
        best = this->innerAt(field, lower, within);
        found = best.onePiece;
      }
      state = broken ? MyelinState::Thinner : MyelinState::AsAsked;
      break;
    }
    const double newton = inner.onePiece && inner.area > 0.0 ? level + error / inner.area : level;
    level = newton > lower && newton < upper ? newton : 0.5 * (lower + upper);
    if (newton <= lower && inner.onePiece && error < 0.0)
    {
      level = lower;
    }
  }
  return found ? state : MyelinState::NoAxon;
}

/// Coarsens a surface, gives it its volume, and checks what comes out. Where something is wrong with it, it is made again with
/// less coarsening around there; what cannot be mended like that stays as contoured, without pieces that enclose nothing, which
/// may leave an empty mesh. Returns whether nothing is wrong with it.
bool FibreMesher::finish(const SmoothedField& field, CappedSurface& surface, double level, double volume,
  const TriangleTree* container, const std::vector<LocalErrorBound>& bounds, SurfaceReport& report, FibreSurfacePair& pair) const
{
  if (this->Filters != nullptr)
  {
    this->Filters->finish(surface);
    report = checkSurface(surface.mesh);
    pair.largestMove = std::max(pair.largestMove, this->largestMove(field, surface, level));
    return true;
  }
  const double error = this->Options.decimationError;
  SurfaceDecimationOptions decimation;
  decimation.localBounds = bounds;
  decimation.level = level;
  decimation.maximumError = error;
  decimation.sampling = samplingDistance * this->Spacing;
  decimation.field = [&field](const Eigen::Vector3d& p) { return field.value(p); };
  for (int attempt = 0; error > 0.0 && attempt <= repairs; ++attempt)
  {
    CappedSurface trial = surface;
    decimate(trial, decimation);
    moveToVolume(trial, volume, error);
    splitNeedles(trial, largestSquaredEdgeRatio);
    report = checkSurface(trial.mesh);
    const std::vector<Eigen::Vector3d> places = faults(trial.mesh, container);
    if (places.empty() && report.degenerateTriangles == 0 && report.sound())
    {
      pair.largestMove = std::max(pair.largestMove, this->largestMove(field, trial, level));
      surface = std::move(trial);
      return true;
    }
    if (places.empty())
    {
      break; // no place to mend
    }
    const std::vector<LocalErrorBound> more = this->boundsAround(places, attempt);
    decimation.localBounds.insert(decimation.localBounds.end(), more.begin(), more.end());
  }
  if (error > 0.0)
  {
    splitNeedles(surface, largestSquaredEdgeRatio);
  }
  report = keepSoundPieces(surface.mesh, pair.droppedVolume);
  surface.faces.clear(); // they count the points of before
  return faults(surface.mesh, container).empty();
}

/// The triangles of an outer surface that are no caps on the faces of the box.
std::vector<std::uint32_t> FibreMesher::wallOf(const TriangleMesh& outer) const
{
  const Domain& box = this->Field.box();
  std::vector<std::uint32_t> wall;
  for (std::size_t i = 0; i < outer.triangles.size(); ++i)
  {
    bool isCap = false;
    for (Eigen::Index axis = 0; axis < 3; ++axis)
    {
      const auto isOn = [&](double face)
      {
        return std::all_of(outer.triangles[i].begin(), outer.triangles[i].end(),
          [&](std::int32_t p) { return outer.points[std::size_t(p)][axis] == face; });
      };
      isCap = isCap || isOn(box.lower[axis]) || isOn(box.upper[axis]);
    }
    if (!isCap)
    {
      wall.push_back(static_cast<std::uint32_t>(i));
    }
  }
  return wall;
}

/// Whether a point is nearer to a face of the box than `distance` (µm): a regular grid bevels the edges of caps, and of the box.
static bool isBeside(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& p, double distance)
{
  return (p - box.min()).minCoeff() < distance || (box.max() - p).minCoeff() < distance;
}

/// The largest difference between the field and `level` at points spread over the surface, at most a voxel apart; on caps
/// only where the field is smaller.
double FibreMesher::largestMove(const SmoothedField& field, const CappedSurface& surface, double level) const
{
  const auto& points = surface.mesh.points;
  double largest = 0.0;
  for (const auto& t : surface.mesh.triangles)
  {
    const Eigen::Vector3d& a = points[std::size_t(t[0])];
    const Eigen::Vector3d ab = points[std::size_t(t[1])] - a;
    const Eigen::Vector3d ac = points[std::size_t(t[2])] - a;
    const bool isCap = surface.isCap(t) || (this->Filters != nullptr && isBeside(surface.box, a, this->Spacing));
    const double longest = std::sqrt(std::max({ ab.squaredNorm(), ac.squaredNorm(), (ac - ab).squaredNorm() }));
    const int n = std::max(1, static_cast<int>(std::ceil(longest / this->Spacing)));
    for (int i = 0; i <= n; ++i)
    {
      for (int j = 0; i + j <= n; ++j)
      {
        const double excess = field.value(a + (double(i) / n) * ab + (double(j) / n) * ac) - level;
        largest = std::max(largest, isCap ? -excess : std::abs(excess));
      }
    }
  }
  return largest;
}

/// Calls visit(i, j, k, depth) for each sample of a fibre in the box, i, j, k counted in nodes of the lattice.
template <typename Visit>
void FibreMesher::forEachSample(const SmoothedField& field, Visit&& visit) const
{
  std::vector<float> values;
  for (const std::uint32_t block : field.blocks())
  {
    NodeRange range = nodesOfBlock(this->OuterLattice, block);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      range.first[axis] -= 1;
      range.count[axis] += 2;
    }
    values.resize(range.size());
    field.values(0.0, 0.0, range, values.data());
    std::size_t index = 0;
    for (int k = 0; k < range.count[2]; ++k)
    {
      for (int j = 0; j < range.count[1]; ++j)
      {
        for (int i = 0; i < range.count[0]; ++i, ++index)
        {
          // Each node belongs to one block, and one on a face is none of the image's samples.
          const std::array<int, 3> at{ { range.first[0] + i, range.first[1] + j, range.first[2] + k } };
          constexpr int size = NodeLattice::blockCells;
          const bool mine = i > 0 && j > 0 && k > 0 && i <= size && j <= size && k <= size;
          if (mine && values[index] > 0.0f && this->isSample(at))
          {
            visit(at, values[index]);
          }
        }
      }
    }
  }
}

bool FibreMesher::isSample(const std::array<int, 3>& node) const
{
  return node[0] > 0 && node[1] > 0 && node[2] > 0 && node[0] < this->OuterLattice.cells(0) &&
         node[1] < this->OuterLattice.cells(1) && node[2] < this->OuterLattice.cells(2);
}

std::vector<float> FibreMesher::depths(const SmoothedField& field) const
{
  std::vector<float> result;
  this->forEachSample(field, [&](const std::array<int, 3>&, float depth) { result.push_back(depth); });
  return result;
}

/// Length (µm) of the line through the centroids of the fibre's slices across its principal axis.
double FibreMesher::length(const SmoothedField& field) const
{
  double count = 0.0;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Matrix3d square = Eigen::Matrix3d::Zero();
  this->forEachSample(field,
    [&](const std::array<int, 3>& at, float)
    {
      const Eigen::Vector3d p(at[0], at[1], at[2]);
      count += 1.0;
      mean += p;
      square += p * p.transpose();
    });
  if (!(count > 0.0))
  {
    return this->Spacing; // less than a sample
  }
  mean /= count;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(square / count - mean * mean.transpose());
  const Eigen::Vector3d axis = solver.eigenvectors().col(2);
  // Slices as thick as the fibre is wide, so that centroids follow the fibre and not the voxels.
  const double thickness = std::max(4.0, 4.0 * std::sqrt(std::max(0.0, solver.eigenvalues()[1])));
  double lowest = std::numeric_limits<double>::infinity();
  double highest = -lowest;
  std::map<int, std::pair<double, Eigen::Vector3d>> slices;
  this->forEachSample(field,
    [&](const std::array<int, 3>& at, float)
    {
      const Eigen::Vector3d p = Eigen::Vector3d(at[0], at[1], at[2]) - mean;
      const double along = axis.dot(p);
      lowest = std::min(lowest, along);
      highest = std::max(highest, along);
      auto& slice = slices.emplace(static_cast<int>(std::floor(along / thickness)), std::make_pair(0.0, Eigen::Vector3d::Zero()))
                      .first->second;
      slice.first += 1.0;
      slice.second += p;
    });
  // The ends beyond the first and the last centroid go on along the axis.
  double length = 1.0 + highest - lowest;
  const Eigen::Vector3d* before = nullptr;
  Eigen::Vector3d centroid[2];
  int which = 0;
  for (const auto& slice : slices)
  {
    centroid[which] = slice.second.second / slice.second.first;
    if (before != nullptr)
    {
      const Eigen::Vector3d step = centroid[which] - *before;
      length += step.norm() - std::abs(axis.dot(step));
    }
    before = &centroid[which];
    which = 1 - which;
  }
  return length * this->Spacing;
}

} // namespace cactus
