// SPDX-License-Identifier: BSD-3-Clause
#include "MyelinSurface.h"

#include "Error.h"
#include "Parallel.h"
#include "SurfaceDecimation.h"
#include "SurfaceIntersection.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <sstream>
#include <string>

namespace cactus
{

namespace
{

using Blocks = std::vector<std::uint32_t>;

template <typename... Parts>
std::string text(const Parts&... parts)
{
  std::ostringstream out;
  out.precision(4);
  (out << ... << parts);
  return out.str();
}

void require(bool good, const char* message)
{
  if (!good)
  {
    throw InvalidInput(message);
  }
}

/// Volume of pieces beside the axon's main one that may be left out, as a part of it.
constexpr double negligiblePart = 1e-3;
/// Relative error of an inner volume that is good enough.
constexpr double volumeTolerance = 1e-3;
/// MC/DC warns of triangles above this.
constexpr double worstSquaredEdgeRatio = 1000.0;

/// Signed volume and area of a closed surface.
struct Measure
{
  double volume = 0.0;
  double area = 0.0; ///< without caps
};

Measure measure(const CappedSurface& surface)
{
  Measure result;
  const auto& points = surface.mesh.points;
  for (const auto& t : surface.mesh.triangles)
  {
    const Eigen::Vector3d& origin = points[std::size_t(surface.mesh.triangles.front()[0])];
    const Eigen::Vector3d a = points[std::size_t(t[0])] - origin;
    const Eigen::Vector3d b = points[std::size_t(t[1])] - origin;
    const Eigen::Vector3d c = points[std::size_t(t[2])] - origin;
    result.volume += a.dot(b.cross(c)) / 6.0;
    if ((surface.faces[std::size_t(t[0])] & surface.faces[std::size_t(t[1])] & surface.faces[std::size_t(t[2])]) == 0)
    {
      result.area += 0.5 * (b - a).cross(c - a).norm();
    }
  }
  return result;
}

/// Leaves the piece of the largest volume; the sum of the others' volumes, each taken as positive.
double keepLargestPiece(CappedSurface& surface)
{
  auto& points = surface.mesh.points;
  auto& triangles = surface.mesh.triangles;
  std::vector<std::int32_t> root(points.size());
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&root](std::int32_t p)
  {
    while (root[std::size_t(p)] != p)
    {
      root[std::size_t(p)] = root[std::size_t(root[std::size_t(p)])];
      p = root[std::size_t(p)];
    }
    return p;
  };
  for (const auto& t : triangles)
  {
    for (std::size_t i = 1; i < 3; ++i)
    {
      const std::int32_t a = find(t[0]);
      const std::int32_t b = find(t[i]);
      root[std::size_t(std::max(a, b))] = std::min(a, b);
    }
  }
  std::vector<double> volume(points.size(), 0.0);
  for (const auto& t : triangles)
  {
    const std::int32_t piece = find(t[0]);
    const Eigen::Vector3d& origin = points[std::size_t(piece)];
    volume[std::size_t(piece)] +=
      (points[std::size_t(t[0])] - origin).dot((points[std::size_t(t[1])] - origin).cross(points[std::size_t(t[2])] - origin)) /
      6.0;
  }
  const auto largest = std::max_element(volume.begin(), volume.end());
  if (largest == volume.end())
  {
    return 0.0;
  }
  const auto kept = static_cast<std::int32_t>(largest - volume.begin());
  double dropped = 0.0;
  bool whole = true;
  for (std::size_t p = 0; p < points.size(); ++p)
  {
    const bool isRoot = root[p] == static_cast<std::int32_t>(p);
    if (isRoot && static_cast<std::int32_t>(p) != kept)
    {
      dropped += std::abs(volume[p]);
      whole = false;
    }
  }
  if (whole)
  {
    return 0.0;
  }
  std::vector<std::int32_t> number(points.size(), -1);
  std::int32_t used = 0;
  for (std::size_t p = 0; p < points.size(); ++p)
  {
    if (find(static_cast<std::int32_t>(p)) == kept)
    {
      points[std::size_t(used)] = points[p];
      surface.faces[std::size_t(used)] = surface.faces[p];
      number[p] = used++;
    }
  }
  points.resize(std::size_t(used));
  surface.faces.resize(std::size_t(used));
  std::size_t count = 0;
  for (const auto& t : triangles)
  {
    if (number[std::size_t(t[0])] >= 0)
    {
      triangles[count++] = { { number[std::size_t(t[0])], number[std::size_t(t[1])], number[std::size_t(t[2])] } };
    }
  }
  triangles.resize(count);
  return dropped;
}

/// Makes the surfaces of one fibre after the other; may be used from several threads.
class SurfaceMaker
{
public:
  SurfaceMaker(const LabelImageView& image, const LabelImageFacts& facts, const MyelinSurfaceOptions& options)
    : Facts(facts)
    , Options(options)
    , Field(image, facts.domain, options.clipToDomain)
    , Spacing(image.grid.spacing)
    , Inset(std::min(facts.minimumGap, 0.25 * Spacing))
    , OuterLattice(Field.lattice())
    , InnerLattice(Field.lattice(Inset))
    , Nudge(std::min(0.02 * Spacing, 0.2 * std::max(facts.surfaceTolerance, 1e-3 * Spacing)))
    , ThinnestMyelin(std::max({ facts.minimumGap, 4.0 * facts.surfaceTolerance, 1e-3 * Spacing }))
  {
  }

  const FibreField& field() const { return this->Field; }

  SmoothedField smoothed(const Blocks& blocks, const FibreSurfacePair& pair) const
  {
    return SmoothedField(this->Field, pair.fibreId, blocks, this->Options.smoothingIterations);
  }

  void makeOuter(const SmoothedField& field, FibreSurfacePair& pair) const
  {
    CappedSurface raw = this->contourAt(this->OuterLattice, field, 0.0);
    pair.droppedVolume = keepLargestPiece(raw);
    if (raw.mesh.triangles.empty())
    {
      return;
    }
    pair.outerReport = this->finish(field, raw, 0.0, "outer", pair);
    pair.outer = std::move(raw.mesh);
    pair.state = MyelinState::NoAxon;
  }

  /// Outer diameter of the circle whose area is the mean cross-section.
  double equivalentDiameter(const SmoothedField& field, const FibreSurfacePair& pair) const
  {
    const double length = this->length(field);
    return 2.0 * std::sqrt(pair.outerReport.volume / (3.14159265358979323846 * length));
  }

  void makeInner(const SmoothedField& field, FibreSurfacePair& pair) const
  {
    pair.inner = TriangleMesh();
    pair.innerReport = SurfaceReport();
    pair.gRatio = 0.0;
    pair.thickness = 0.0;
    pair.state = MyelinState::NoAxon;
    const double wanted = pair.targetGRatio * pair.targetGRatio * pair.outerReport.volume;

    std::vector<float> depths = this->depths(field);
    if (depths.empty())
    {
      return;
    }
    const double deepest = *std::max_element(depths.begin(), depths.end());
    if (deepest <= this->ThinnestMyelin)
    {
      return;
    }
    // As many samples as the axon shall have of the volume lie deeper than a first guess.
    const auto rank = static_cast<std::size_t>((1.0 - pair.targetGRatio * pair.targetGRatio) * double(depths.size() - 1));
    std::nth_element(depths.begin(), depths.begin() + std::ptrdiff_t(rank), depths.end());
    double level = std::max(double(depths[rank]), this->ThinnestMyelin);
    depths = {};

    Inner best;
    double correction = 0.0; // of the volume, for what smoothing and coarsening change
    MyelinState state = MyelinState::AsAsked;
    for (int round = 0; round < 2; ++round)
    {
      state = this->solve(field, wanted + correction, deepest, level, best);
      if (state == MyelinState::NoAxon)
      {
        return;
      }
      const double before = best.volume;
      FibreSurfacePair finished = pair;
      finished.innerReport = this->finish(field, best.surface, best.level, "inner", finished);
      pair.innerReport = finished.innerReport;
      pair.largestMove = finished.largestMove;
      if (state != MyelinState::AsAsked || std::abs(pair.innerReport.volume - wanted) <= 2.0 * volumeTolerance * wanted)
      {
        break;
      }
      correction = before - pair.innerReport.volume;
      level = best.level;
    }
    pair.inner = std::move(best.surface.mesh);
    pair.thickness = best.level;
    pair.state = state;
    pair.gRatio = std::sqrt(pair.innerReport.volume / pair.outerReport.volume);
  }

private:
  struct Inner
  {
    CappedSurface surface;
    double level = 0.0;
    double volume = 0.0;
    double area = 0.0;
    bool onePiece = false;
  };

  CappedSurface contourAt(const NodeLattice& lattice, const SmoothedField& field, double level) const
  {
    return contour(
      lattice, field.blocks(), [&](const NodeRange& around, float* out) { field.values(level, this->Nudge, around, out); });
  }

  /// The inner surface at a level, before smoothing.
  Inner innerAt(const SmoothedField& field, double level) const
  {
    Inner inner;
    inner.level = level;
    inner.surface = this->contourAt(this->InnerLattice, field, level);
    const double dropped = keepLargestPiece(inner.surface);
    const Measure measured = measure(inner.surface);
    inner.volume = measured.volume;
    inner.area = measured.area;
    inner.onePiece = inner.volume > 0.0 && dropped <= negligiblePart * inner.volume;
    return inner;
  }

  /// Looks for the level at which the axon has the wanted volume, from a first guess.
  MyelinState solve(const SmoothedField& field, double wanted, double deepest, double guess, Inner& best) const
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
      Inner inner = this->innerAt(field, level);
      const double error = inner.volume - wanted;
      const bool good = std::abs(error) <= volumeTolerance * wanted;
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
          best = this->innerAt(field, lower);
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

  /// Smooths and coarsens a surface and checks what comes out. Names the fibre where even the surface as contoured is no good.
  SurfaceReport finish(
    const SmoothedField& field, CappedSurface& surface, double level, const char* which, FibreSurfacePair& pair) const
  {
    const double error = this->Options.decimationError;
    for (double part = 1.0; error > 0.0 && part > 0.2; part *= 0.5)
    {
      CappedSurface trial = surface;
      SurfaceDecimationOptions decimation;
      decimation.maximumError = 1.5 * part * error;
      decimation.smallestField = level - 0.9 * error;
      decimation.largestField = level + 0.9 * error;
      decimation.field = [&field](const Eigen::Vector3d& p) { return field.value(p); };
      decimate(trial, decimation);
      const SurfaceReport report = checkSurface(trial.mesh);
      if (!sound(report) || report.degenerateTriangles > 0 || report.largestSquaredEdgeRatio >= worstSquaredEdgeRatio ||
          meetsItself(trial.mesh))
      {
        continue;
      }
      const Deviation deviation = this->deviation(field, trial, level);
      if (std::max(-deviation.lowest, 0.2 * deviation.highest) > error)
      {
        // Where the surface as contoured is off by as much (at creases that the samples do not resolve) it is none of
        // coarsening's.
        const Deviation before = this->deviation(field, surface, level);
        if (deviation.lowest < 1.2 * std::min(before.lowest, -1.2 * error) ||
            deviation.highest > 1.5 * std::max(before.highest, 4.0 * error))
        {
          continue;
        }
      }
      pair.largestMove = std::max({ pair.largestMove, -deviation.lowest, deviation.highest });
      surface = std::move(trial);
      return report;
    }
    const SurfaceReport report = checkSurface(surface.mesh);
    if (!sound(report))
    {
      throw Error(text("the ", which, " surface of fibre ", pair.fibreId, " is not a closed 2-manifold in one piece (",
        report.openEdges, " open, ", report.crowdedEdges, " crowded edges, ", report.pinchedPoints, " pinched points, ",
        report.components, " pieces): choose another VoxelSize in FibreRadialGrowth, and report this as a fault"));
    }
    return report;
  }

  static bool sound(const SurfaceReport& report) { return report.closedManifold() && report.outward() && report.components == 1; }

  struct Deviation
  {
    double lowest = 0.0;
    double highest = 0.0;
  };

  /// The field less `level` at points spread over the surface, at most half a voxel apart; on caps only where it is too small.
  Deviation deviation(const SmoothedField& field, const CappedSurface& surface, double level) const
  {
    const auto& points = surface.mesh.points;
    Deviation result;
    for (const auto& t : surface.mesh.triangles)
    {
      const Eigen::Vector3d& a = points[std::size_t(t[0])];
      const Eigen::Vector3d ab = points[std::size_t(t[1])] - a;
      const Eigen::Vector3d ac = points[std::size_t(t[2])] - a;
      const bool isCap =
        (surface.faces[std::size_t(t[0])] & surface.faces[std::size_t(t[1])] & surface.faces[std::size_t(t[2])]) != 0;
      const double longest = std::sqrt(std::max({ ab.squaredNorm(), ac.squaredNorm(), (ac - ab).squaredNorm() }));
      const int n = std::max(1, static_cast<int>(std::ceil(2.0 * longest / this->Spacing)));
      for (int i = 0; i <= n; ++i)
      {
        for (int j = 0; i + j <= n; ++j)
        {
          const double excess = field.value(a + (double(i) / n) * ab + (double(j) / n) * ac) - level;
          result.lowest = std::min(result.lowest, excess);
          result.highest = isCap ? result.highest : std::max(result.highest, excess);
        }
      }
    }
    return result;
  }

  /// Calls visit(i, j, k, depth) for each sample of a fibre in the box, i, j, k counted in nodes of the lattice.
  template <typename Visit>
  void forEachSample(const SmoothedField& field, Visit&& visit) const
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

  bool isSample(const std::array<int, 3>& node) const
  {
    return node[0] > 0 && node[1] > 0 && node[2] > 0 && node[0] < this->OuterLattice.cells(0) &&
           node[1] < this->OuterLattice.cells(1) && node[2] < this->OuterLattice.cells(2);
  }

  std::vector<float> depths(const SmoothedField& field) const
  {
    std::vector<float> result;
    this->forEachSample(field, [&](const std::array<int, 3>&, float depth) { result.push_back(depth); });
    return result;
  }

  /// Length (µm) of the line through the centroids of the fibre's slices across its principal axis.
  double length(const SmoothedField& field) const
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
        auto& slice =
          slices.emplace(static_cast<int>(std::floor(along / thickness)), std::make_pair(0.0, Eigen::Vector3d::Zero()))
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

  const LabelImageFacts& Facts;
  const MyelinSurfaceOptions& Options;
  FibreField Field;
  double Spacing;
  double Inset; ///< of the inner surfaces' caps
  NodeLattice OuterLattice;
  NodeLattice InnerLattice;
  double Nudge;          ///< least distance of the field from its level at a sample
  double ThinnestMyelin; ///< µm; inner and outer surfaces keep apart even where both move
};

std::vector<FibreSurfacePair> fibresOf(const LabelImageFacts& facts, const std::map<std::int32_t, Blocks>& blocksOf)
{
  require(facts.bundleIds.size() == facts.fibreIds.size() && facts.targetRadii.size() == facts.fibreIds.size(),
    "the columns of the label image's FibreTable differ in length");
  std::vector<FibreSurfacePair> pairs(facts.fibreIds.size());
  for (std::size_t i = 0; i < pairs.size(); ++i)
  {
    pairs[i].fibreId = facts.fibreIds[i];
    pairs[i].bundleId = facts.bundleIds[i];
    pairs[i].targetRadius = facts.targetRadii[i];
  }
  std::sort(pairs.begin(), pairs.end(), [](const auto& a, const auto& b) { return a.fibreId < b.fibreId; });
  for (std::size_t i = 0; i < pairs.size(); ++i)
  {
    if (pairs[i].fibreId < 1 || (i > 0 && pairs[i].fibreId == pairs[i - 1].fibreId))
    {
      throw InvalidInput(
        text("the label image's FibreTable names fibre ", pairs[i].fibreId, ": ids must count from 1 and be unique"));
    }
  }
  for (const auto& entry : blocksOf)
  {
    const bool known = std::binary_search(facts.fibreIds.begin(), facts.fibreIds.end(), entry.first) ||
                       std::find(facts.fibreIds.begin(), facts.fibreIds.end(), entry.first) != facts.fibreIds.end();
    if (!known)
    {
      throw InvalidInput(text("fibre ", entry.first, " of the label image is not in its FibreTable"));
    }
  }
  return pairs;
}

} // namespace

void validate(const MyelinSurfaceOptions& options)
{
  const int model = static_cast<int>(options.model);
  require(model >= 0 && model <= 3, "GRatioModel must be Constant, LogLinear, Distributed or TargetAxonVolumeFraction");
  if (options.model == GRatioModel::Constant)
  {
    require(options.gRatio > 0.0 && options.gRatio < 1.0, "GRatio must be between 0 and 1");
  }
  if (options.model == GRatioModel::Distributed)
  {
    distributedGRatio(options.gRatio, options.gRatioDeviation, 0, 1);
  }
  if (options.model == GRatioModel::TargetAxonVolumeFraction)
  {
    require(options.targetAxonVolumeFraction > 0.0 && options.targetAxonVolumeFraction < 1.0,
      "TargetAxonVolumeFraction must be between 0 and 1 where GRatioModel is TargetAxonVolumeFraction");
  }
  require(
    options.smoothingIterations >= 0 && options.smoothingIterations <= 1000, "SmoothingIterations must be between 0 and 1000");
  require(std::isfinite(options.decimationError) && options.decimationError >= 0.0,
    "DecimationError must be a number of µm, 0 or more");
}

std::vector<FibreSurfacePair> myelinSurfaces(
  const LabelImageView& image, const LabelImageFacts& facts, const MyelinSurfaceOptions& options, const Context& context)
{
  validate(options);
  require(std::isfinite(facts.minimumGap) && facts.minimumGap >= 0.0 && std::isfinite(facts.surfaceTolerance) &&
            facts.surfaceTolerance >= 0.0,
    "MinimumGap and SurfaceTolerance of the label image must be 0 or more");
  if (options.decimationError > facts.surfaceTolerance * (1.0 + 1e-9))
  {
    throw InvalidInput(text("DecimationError ", options.decimationError, " is more than the room of ", facts.surfaceTolerance,
      " µm that growth left for moving surfaces: choose a smaller one, or raise SurfaceTolerance in FibreRadialGrowth"));
  }
  const SurfaceMaker maker(image, facts, options);
  const auto blocksOf = maker.field().findFibres(options.smoothingIterations, context);
  std::vector<FibreSurfacePair> pairs = fibresOf(facts, blocksOf);
  static const Blocks none;
  const auto blocks = [&](const FibreSurfacePair& pair) -> const Blocks&
  {
    const auto found = blocksOf.find(pair.fibreId);
    return found == blocksOf.end() ? none : found->second;
  };

  parallelFor(
    pairs.size(), context,
    [&](std::size_t i)
    {
      FibreSurfacePair& pair = pairs[i];
      const SmoothedField field = maker.smoothed(blocks(pair), pair);
      maker.makeOuter(field, pair);
      if (pair.state == MyelinState::NoFibre)
      {
        return;
      }
      switch (options.model)
      {
      case GRatioModel::Constant:
        pair.targetGRatio = options.gRatio;
        break;
      case GRatioModel::LogLinear:
        pair.targetGRatio = logLinearGRatio(maker.equivalentDiameter(field, pair));
        break;
      case GRatioModel::Distributed:
        pair.targetGRatio = distributedGRatio(options.gRatio, options.gRatioDeviation, options.seed, pair.fibreId);
        break;
      case GRatioModel::TargetAxonVolumeFraction:
        break; // known once all volumes are
      }
    },
    "making outer surfaces", 0.05, 0.5);

  const auto makeInner = [&]
  {
    parallelFor(
      pairs.size(), context,
      [&](std::size_t i)
      {
        if (pairs[i].state != MyelinState::NoFibre)
        {
          maker.makeInner(maker.smoothed(blocks(pairs[i]), pairs[i]), pairs[i]);
        }
      },
      "making inner surfaces", 0.5, 1.0);
  };
  if (options.model != GRatioModel::TargetAxonVolumeFraction)
  {
    makeInner();
    return pairs;
  }

  // One g-ratio for all; where a fibre cannot have it, the others make up for that.
  const double wanted = options.targetAxonVolumeFraction * maker.field().box().volume();
  double given = 0.0; // by fibres that cannot have the common g-ratio
  double open = 0.0;  // outer volume of the others
  double reached = 0.0;
  for (const FibreSurfacePair& pair : pairs)
  {
    open += pair.outerReport.volume;
  }
  const double fibreFraction = open / maker.field().box().volume();
  for (int round = 0; round < 4; ++round)
  {
    const double square = open > 0.0 ? (wanted - given) / open : 2.0;
    if (!(square > 0.0 && square < 1.0))
    {
      break;
    }
    for (FibreSurfacePair& pair : pairs)
    {
      pair.targetGRatio = std::sqrt(square);
    }
    makeInner();
    given = open = reached = 0.0;
    for (const FibreSurfacePair& pair : pairs)
    {
      const double inner = pair.innerReport.volume;
      reached += inner;
      (pair.state == MyelinState::AsAsked ? open : given) += pair.state == MyelinState::AsAsked ? pair.outerReport.volume : inner;
    }
    if (std::abs(reached - wanted) <= 2.0 * volumeTolerance * wanted)
    {
      return pairs;
    }
  }
  throw Infeasible(text("TargetAxonVolumeFraction ", options.targetAxonVolumeFraction, " cannot be reached: the fibres fill ",
    fibreFraction, " of the box, and with the thinnest myelin allowed their axons fill ", reached / maker.field().box().volume(),
    ". Ask for another fraction, or grow the fibres further"));
}

} // namespace cactus
