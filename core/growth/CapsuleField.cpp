// SPDX-License-Identifier: BSD-3-Clause
#include "growth/CapsuleField.h"

#include "base/Constants.h"
#include "base/Error.h"
#include "base/Memory.h"
#include "base/Random.h"

#include <omp.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <limits>
#include <numeric>

namespace cactus
{

namespace
{

/// Distance (µm) of the knots between which the calibre of a rough fibre's seed varies, and how long the cones are at most that
/// it is made of. Beads follow each other every few µm (Andersson et al. 2020); shorter ones would grow into a grainy surface
/// rather than an uneven calibre, and take many triangles.
constexpr double knotSpacing = 2.0;
constexpr double longestCone = 1.0;
constexpr int blockSize = 16;
constexpr float nowhere = -1e30f;
constexpr double infinity = std::numeric_limits<double>::infinity();

/// The union of the balls whose centre slides from `start` by `length` along `axis` while the radius grows by `slope` per length.
struct Cone
{
  Eigen::Vector3d start;
  Eigen::Vector3d axis;
  double length;
  double radius;
  double slope;
  double lean; ///< how far past the foot point, per distance from the axis, the nearest ball's centre lies: m / sqrt(1 - m²)
};

/// A stretch of one capsule's seed.
struct Piece
{
  Cone cone;
  int rank;
};

Cone cone(const Eigen::Vector3d& p0, const Eigen::Vector3d& p1, double r0, double r1)
{
  Cone c;
  const Eigen::Vector3d d = p1 - p0;
  c.length = d.norm();
  c.axis = d / c.length;
  c.slope = (r1 - r0) / c.length;
  if (std::abs(c.slope) > 1.0 - 1e-6)
  {
    // One end ball holds the other.
    c.start = r0 < r1 ? p1 : p0;
    c.radius = std::max(r0, r1);
    c.length = 0.0;
    c.slope = 0.0;
    c.lean = 0.0;
    return c;
  }
  c.start = p0;
  c.radius = r0;
  c.lean = c.slope / std::sqrt(1.0 - c.slope * c.slope);
  return c;
}

double coneValue(const Cone& c, const Eigen::Vector3d& x)
{
  const Eigen::Vector3d d = x - c.start;
  const double foot = d.dot(c.axis);
  const double distance2 = (d - foot * c.axis).squaredNorm();
  const double along = std::min(std::max(foot + c.lean * std::sqrt(distance2), 0.0), c.length);
  const double rest = along - foot;
  return c.radius + c.slope * along - std::sqrt(distance2 + rest * rest);
}

Eigen::AlignedBox3d boundingBox(const Cone& c)
{
  Eigen::AlignedBox3d box;
  const Eigen::Vector3d end = c.start + c.length * c.axis;
  const double endRadius = c.radius + c.slope * c.length;
  box.extend((c.start.array() - c.radius).matrix()).extend((c.start.array() + c.radius).matrix());
  box.extend((end.array() - endRadius).matrix()).extend((end.array() + endRadius).matrix());
  return box;
}

/// Candidates of one block as a structure of arrays in single precision, relative to the block's centre, grouped by fibre.
struct Candidates
{
  struct Group
  {
    int rank;
    int coneBegin, coneEnd;
    float centre; ///< the fibre's field at the centre of the cell in work
  };
  std::vector<Group> groups;
  std::vector<float> x, y, z, ux, uy, uz, length, radius, slope, lean, coneAtCentre;

  void clear()
  {
    groups.clear();
    for (auto* v : { &x, &y, &z, &ux, &uy, &uz, &length, &radius, &slope, &lean, &coneAtCentre })
    {
      v->clear();
    }
  }
  void add(const Cone& c, const Eigen::Vector3d& origin)
  {
    const Eigen::Vector3d start = c.start - origin;
    x.push_back(float(start.x()));
    y.push_back(float(start.y()));
    z.push_back(float(start.z()));
    ux.push_back(float(c.axis.x()));
    uy.push_back(float(c.axis.y()));
    uz.push_back(float(c.axis.z()));
    length.push_back(float(c.length));
    radius.push_back(float(c.radius));
    slope.push_back(float(c.slope));
    lean.push_back(float(c.lean));
    coneAtCentre.push_back(0.0f);
  }
};

/// One cell's samples (relative to the block's centre) and results.
struct alignas(64) CellWork
{
  float best[FieldCell::size];
  float second[FieldCell::size];
  float current[FieldCell::size];
  int rank[FieldCell::size];
  float x[FieldCell::size];
  float y[FieldCell::size];
  float z[FieldCell::size];
  float centre[3];
  /// Distance from the cell's centre to its farthest sample, with room for rounding.
  float extent;
};

struct CellRelevance
{
  float bestReach, secondReach, sumReach, contrast;
};

#define CACTUS_INLINE inline __attribute__((always_inline))

CACTUS_INLINE float larger(float a, float b)
{
  return a > b ? a : b;
}

CACTUS_INLINE float smaller(float a, float b)
{
  return a < b ? a : b;
}

/// The two largest fields at the samples of one cell, and whose the largest is. Fields are 1-Lipschitz, so their values at the
/// cell's centre tell which fibres, and which of their cones, can make no difference at any of its samples; the rest is
/// evaluated. Written as plain loops over eight samples, for the compiler to turn into vectors.
CACTUS_INLINE void evaluateCellBody(Candidates& all, const CellRelevance& relevance, CellWork& work)
{
  const float cx = work.centre[0];
  const float cy = work.centre[1];
  const float cz = work.centre[2];
  const int cones = static_cast<int>(all.x.size());
  {
    const float *x = all.x.data(), *y = all.y.data(), *z = all.z.data();
    const float *ux = all.ux.data(), *uy = all.uy.data(), *uz = all.uz.data();
    const float *length = all.length.data(), *radius = all.radius.data(), *slope = all.slope.data(), *lean = all.lean.data();
    float* out = all.coneAtCentre.data();
#ifndef __clang__ // which does not know it
#pragma GCC ivdep
#endif
    for (int c = 0; c < cones; ++c)
    {
      const float dx = cx - x[c];
      const float dy = cy - y[c];
      const float dz = cz - z[c];
      const float foot = dx * ux[c] + (dy * uy[c] + dz * uz[c]);
      const float ex = dx - foot * ux[c];
      const float ey = dy - foot * uy[c];
      const float ez = dz - foot * uz[c];
      const float distance2 = ex * ex + (ey * ey + ez * ez);
      const float along = smaller(larger(foot + lean[c] * std::sqrt(distance2), 0.0f), length[c]);
      const float rest = along - foot;
      out[c] = radius[c] + slope[c] * along - std::sqrt(distance2 + rest * rest);
    }
  }
  float best = nowhere;
  float second = nowhere;
  for (auto& group : all.groups)
  {
    float value = nowhere;
    for (int c = group.coneBegin; c < group.coneEnd; ++c)
    {
      value = larger(all.coneAtCentre[c], value);
    }
    group.centre = value;
    second = larger(second, smaller(best, value));
    best = larger(best, value);
  }

  for (int i = 0; i < FieldCell::size; ++i)
  {
    work.best[i] = nowhere;
    work.second[i] = nowhere;
    work.rank[i] = -1;
  }
  const float extent = work.extent;
  const bool secondMatters = best + extent > -relevance.secondReach;
  for (const auto& group : all.groups)
  {
    const float value = group.centre;
    const bool mayBeBest = value + 2.0f * extent >= best && value + extent > -relevance.bestReach;
    const bool mayBeSecond = secondMatters && value + 2.0f * extent >= second &&
                             value + best + 2.0f * extent > -relevance.sumReach &&
                             value + 2.0f * extent >= best - relevance.contrast;
    if (!mayBeBest && !mayBeSecond)
    {
      continue;
    }
    const float enough = value - 2.0f * extent;
    for (int i = 0; i < FieldCell::size; ++i)
    {
      work.current[i] = nowhere;
    }
    for (int c = group.coneBegin; c < group.coneEnd; ++c)
    {
      if (all.coneAtCentre[c] < enough)
      {
        continue;
      }
      const float x = all.x[c], y = all.y[c], z = all.z[c], ux = all.ux[c], uy = all.uy[c], uz = all.uz[c];
      const float length = all.length[c], radius = all.radius[c], slope = all.slope[c], lean = all.lean[c];
      for (int i = 0; i < FieldCell::size; ++i)
      {
        const float dx = work.x[i] - x;
        const float dy = work.y[i] - y;
        const float dz = work.z[i] - z;
        const float foot = dx * ux + (dy * uy + dz * uz);
        const float ex = dx - foot * ux;
        const float ey = dy - foot * uy;
        const float ez = dz - foot * uz;
        const float distance2 = ex * ex + (ey * ey + ez * ez);
        const float along = smaller(larger(foot + lean * std::sqrt(distance2), 0.0f), length);
        const float rest = along - foot;
        work.current[i] = larger(radius + slope * along - std::sqrt(distance2 + rest * rest), work.current[i]);
      }
    }
    const int rank = group.rank;
    for (int i = 0; i < FieldCell::size; ++i)
    {
      const float a = work.best[i];
      const float v = work.current[i];
      work.second[i] = larger(work.second[i], smaller(a, v));
      work.rank[i] = v > a ? rank : work.rank[i];
      work.best[i] = larger(v, a);
    }
  }
}

// Two copies of the same arithmetic, without contraction, so both give the same bits.
void evaluateCellPlain(Candidates& all, const CellRelevance& relevance, CellWork& work)
{
  evaluateCellBody(all, relevance, work);
}

#if defined(__x86_64__)
__attribute__((target("avx2"))) void evaluateCellAvx2(Candidates& all, const CellRelevance& relevance, CellWork& work)
{
  evaluateCellBody(all, relevance, work);
}
#endif

using EvaluateCell = void (*)(Candidates&, const CellRelevance&, CellWork&);

EvaluateCell chooseEvaluateCell()
{
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2"))
  {
    return evaluateCellAvx2;
  }
#endif
  return evaluateCellPlain;
}

int floorDivide(int a, int b)
{
  return a >= 0 ? a / b : -((b - 1 - a) / b);
}

} // namespace

struct CapsuleField::Data
{
  SeedOptions options;
  std::vector<std::size_t> fibreOfRank;
  std::vector<std::size_t> pieceOffsets; ///< per rank
  std::vector<Piece> pieces;

  // Uniform bins over the pieces' bounding boxes.
  Eigen::Vector3d binOrigin = Eigen::Vector3d::Zero();
  double binSize = 1.0;
  Eigen::Array3i binCount = Eigen::Array3i::Ones();
  std::vector<std::uint32_t> binOffsets;
  std::vector<std::uint32_t> binPieces;

  Eigen::Array3i binOf(const Eigen::Vector3d& x) const
  {
    const Eigen::Array3d b = ((x - binOrigin) / binSize).array().floor();
    return b.max(0.0).min((binCount - 1).cast<double>()).cast<int>();
  }
  std::size_t binIndex(int i, int j, int k) const
  {
    return std::size_t(i) + std::size_t(binCount[0]) * (std::size_t(j) + std::size_t(binCount[1]) * std::size_t(k));
  }

  void seed(const Fibres& fibres, const Eigen::AlignedBox3d& region, double reach);
  double narrowing(int fibreId, double length) const;
  void fillBins();

  /// What one thread needs to find a block's candidates.
  struct Search
  {
    struct Found
    {
      int rank;
      std::uint32_t piece;
    };
    std::vector<std::uint32_t> seenPiece;
    std::uint32_t visit = 0;
    std::vector<Found> found;
    std::vector<double> valueOf; ///< per rank: largest value at the block's centre
    std::vector<int> touched;
    Candidates candidates;
  };

  void gather(const Eigen::Vector3d& centre, double extent, const FieldRelevance& relevance, Search& search) const;
};

void CapsuleField::Data::seed(const Fibres& fibres, const Eigen::AlignedBox3d& region, double reach)
{
  fibreOfRank.resize(fibres.size());
  std::iota(fibreOfRank.begin(), fibreOfRank.end(), std::size_t(0));
  std::sort(fibreOfRank.begin(), fibreOfRank.end(),
    [&](std::size_t a, std::size_t b) { return fibres.fibreIds[a] < fibres.fibreIds[b]; });

  const bool rough = options.surfaceRoughness > 0.0;
  // A segment's stretches are short, so that boxes are tight and single precision is enough within a block.
  const auto stretches = [&](std::size_t p)
  {
    const double length = (fibres.points[p + 1] - fibres.points[p]).norm();
    const double radius = std::max(fibres.radii[p], fibres.radii[p + 1]);
    const double longest = rough ? std::min(4.0 * radius, longestCone) : 4.0 * radius;
    return int(std::min(std::max(1.0, std::ceil(length / longest)), rough ? 1e6 : 256.0));
  };
  const auto inReach = [&](std::size_t p)
  {
    Eigen::AlignedBox3d box(fibres.points[p]);
    box.extend(fibres.points[p + 1]);
    const double grown = reach + std::max(fibres.radii[p], fibres.radii[p + 1]);
    return box.squaredExteriorDistance(region) <= grown * grown;
  };
  double pieceTotal = 0.0;
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    for (std::size_t p = fibres.offsets[f]; p + 1 < fibres.offsets[f + 1]; ++p)
    {
      pieceTotal += inReach(p) ? stretches(p) : 0.0;
    }
  }
  requireMemory(pieceTotal * (sizeof(Piece) + 64.0), "seeding " + std::to_string(fibres.size()) + " fibres",
    "request a smaller extent, or use fewer fibres or control points");

  pieces.reserve(std::size_t(pieceTotal));
  pieceOffsets.assign(1, 0);
  for (const std::size_t f : fibreOfRank)
  {
    const int rank = int(pieceOffsets.size()) - 1;
    double before = 0.0; // length of the fibre up to the segment
    for (std::size_t p = fibres.offsets[f]; p + 1 < fibres.offsets[f + 1]; ++p)
    {
      const Eigen::Vector3d& p0 = fibres.points[p];
      const Eigen::Vector3d along = fibres.points[p + 1] - p0;
      const double length = along.norm();
      const double start = before;
      before += length;
      if (!inReach(p))
      {
        continue;
      }
      const double r0 = fibres.radii[p];
      const double widening = fibres.radii[p + 1] - r0;
      const auto radius = [&](double t)
      {
        const double full = r0 + t * widening;
        return rough ? full * (1.0 - this->options.surfaceRoughness * this->narrowing(fibres.fibreIds[f], start + t * length))
                     : full;
      };
      const int parts = stretches(p);
      for (int part = 0; part < parts; ++part)
      {
        const double t0 = double(part) / parts;
        const double t1 = part + 1 == parts ? 1.0 : double(part + 1) / parts;
        pieces.push_back({ cone(p0 + t0 * along, p0 + t1 * along, radius(t0), radius(t1)), rank });
      }
    }
    pieceOffsets.push_back(pieces.size());
  }
}

/// A smooth random function of the length along a fibre, from 0 to 1: a cubic B-spline whose coefficients follow the arcsine
/// distribution, so that most are near 0 or 1.
double CapsuleField::Data::narrowing(int fibreId, double length) const
{
  const double knots = length / knotSpacing;
  const double whole = std::floor(knots);
  const double t = knots - whole;
  const auto first = static_cast<std::uint32_t>(std::fmod(whole, 4294967296.0));
  const double weights[4] = { (1.0 - t) * (1.0 - t) * (1.0 - t) / 6.0, (4.0 + t * t * (3.0 * t - 6.0)) / 6.0,
    (1.0 + 3.0 * t * (1.0 + t * (1.0 - t))) / 6.0, t * t * t / 6.0 };
  double sum = 0.0;
  for (std::uint32_t k = 0; k < 4; ++k)
  {
    RandomEngine engine =
      randomStream(options.seed, RandomStage::Seeds, (std::uint64_t(std::uint32_t(fibreId)) << 32) | (first + k));
    const double sine = std::sin(pi * uniform(engine));
    sum += weights[k] * sine * sine;
  }
  return sum;
}

void CapsuleField::Data::fillBins()
{
  Eigen::AlignedBox3d bounds;
  for (const Piece& piece : pieces)
  {
    bounds.extend(boundingBox(piece.cone));
  }
  if (pieces.empty())
  {
    bounds.extend(Eigen::Vector3d::Zero());
  }
  binOrigin = bounds.min();
  const Eigen::Vector3d size = bounds.sizes().cwiseMax(1e-6);
  binSize = std::max(std::cbrt(size.prod() * 2.0 / std::max<double>(double(pieces.size()), 1.0)), size.maxCoeff() / 1000.0);
  binCount = (size / binSize).array().floor().cast<int>() + 1;
  const std::size_t bins = binIndex(0, 0, binCount[2]);
  binOffsets.assign(bins + 1, 0);
  const auto eachBin = [&](const Piece& piece, auto&& visit)
  {
    const Eigen::AlignedBox3d box = boundingBox(piece.cone);
    const Eigen::Array3i lower = binOf(box.min());
    const Eigen::Array3i upper = binOf(box.max());
    for (int k = lower[2]; k <= upper[2]; ++k)
    {
      for (int j = lower[1]; j <= upper[1]; ++j)
      {
        for (int i = lower[0]; i <= upper[0]; ++i)
        {
          visit(binIndex(i, j, k));
        }
      }
    }
  };
  double entries = 0.0;
  for (const Piece& piece : pieces)
  {
    const Eigen::AlignedBox3d box = boundingBox(piece.cone);
    entries += (binOf(box.max()) - binOf(box.min()) + 1).cast<double>().prod();
  }
  if (entries > std::numeric_limits<std::uint32_t>::max())
  {
    throw OutOfMemory("seeding fibres of so uneven calibre takes more entries than can be counted: leave out the thickest or the "
                      "thinnest fibres");
  }
  requireMemory(8.0 * static_cast<double>(bins) + 4.0 * entries, "seeding fibres of uneven calibre",
    "leave out the thickest or the thinnest fibres");
  for (const Piece& piece : pieces)
  {
    eachBin(piece, [&](std::size_t bin) { ++binOffsets[bin + 1]; });
  }
  std::partial_sum(binOffsets.begin(), binOffsets.end(), binOffsets.begin());
  binPieces.resize(binOffsets.back());
  std::vector<std::uint32_t> cursor(binOffsets.begin(), binOffsets.end() - 1);
  for (std::size_t p = 0; p < pieces.size(); ++p)
  {
    eachBin(pieces[p], [&](std::size_t bin) { binPieces[cursor[bin]++] = std::uint32_t(p); });
  }
}

/// Fills search.candidates with all that can matter within `extent` of `centre`.
void CapsuleField::Data::gather(
  const Eigen::Vector3d& centre, double extent, const FieldRelevance& relevance, Search& search) const
{
  double reach = extent + std::min(relevance.bestReach, extent);
  double best = -infinity;   // the largest field at the centre, of the fibres found
  double second = -infinity; // and the second largest
  for (;;)
  {
    for (const int rank : search.touched)
    {
      search.valueOf[std::size_t(rank)] = -infinity;
    }
    search.touched.clear();
    search.found.clear();
    ++search.visit;
    const Eigen::Array3i lower = binOf(centre.array() - std::max(reach, 0.0));
    const Eigen::Array3i upper = binOf(centre.array() + std::max(reach, 0.0));
    for (int k = lower[2]; k <= upper[2]; ++k)
    {
      for (int j = lower[1]; j <= upper[1]; ++j)
      {
        for (int i = lower[0]; i <= upper[0]; ++i)
        {
          const std::size_t bin = binIndex(i, j, k);
          for (std::uint32_t n = binOffsets[bin]; n < binOffsets[bin + 1]; ++n)
          {
            const std::uint32_t p = binPieces[n];
            if (search.seenPiece[p] == search.visit)
            {
              continue;
            }
            search.seenPiece[p] = search.visit;
            const Piece& piece = pieces[p];
            const double value = coneValue(piece.cone, centre);
            if (value <= -reach)
            {
              continue;
            }
            const auto rank = std::size_t(piece.rank);
            if (search.valueOf[rank] == -infinity)
            {
              search.touched.push_back(piece.rank);
            }
            search.valueOf[rank] = std::max(search.valueOf[rank], value);
            search.found.push_back({ piece.rank, p });
          }
        }
      }
    }
    best = second = -infinity;
    for (const int rank : search.touched)
    {
      const double value = search.valueOf[std::size_t(rank)];
      second = std::max(second, std::min(best, value));
      best = std::max(best, value);
    }
    double needed = std::min(relevance.bestReach + extent, 2.0 * extent - best);
    if (best + extent > -relevance.secondReach)
    {
      needed = std::max(needed, 2.0 * extent + std::min({ best + relevance.sumReach, relevance.contrast - best, -second }));
    }
    if (needed <= reach)
    {
      break;
    }
    reach = needed;
  }

  std::sort(
    search.found.begin(), search.found.end(), [](const Search::Found& a, const Search::Found& b) { return a.piece < b.piece; });
  Candidates& out = search.candidates;
  out.clear();
  for (std::size_t n = 0; n < search.found.size();)
  {
    const int rank = search.found[n].rank;
    std::size_t end = n;
    while (end < search.found.size() && search.found[end].rank == rank)
    {
      ++end;
    }
    const double value = search.valueOf[std::size_t(rank)];
    if (value + 2.0 * extent >= second)
    {
      Candidates::Group group;
      group.rank = rank;
      group.coneBegin = int(out.x.size());
      for (; n < end; ++n)
      {
        const Piece& piece = pieces[search.found[n].piece];
        if (coneValue(piece.cone, centre) >= value - 2.0 * extent)
        {
          out.add(piece.cone, centre);
        }
      }
      group.coneEnd = int(out.x.size());
      group.centre = 0.0f;
      out.groups.push_back(group);
    }
    n = end;
  }
}

CapsuleField::CapsuleField(const Fibres& fibres, const SeedOptions& options, const Eigen::AlignedBox3d& region, double reach)
  : Seeds(std::make_unique<Data>())
{
  if (!(options.surfaceRoughness >= 0.0 && options.surfaceRoughness <= 0.5))
  {
    throw InvalidInput("SurfaceRoughness must be between 0 and 0.5");
  }
  Seeds->options = options;
  Seeds->seed(fibres, region, reach);
  Seeds->fillBins();
}

CapsuleField::~CapsuleField() = default;

std::size_t CapsuleField::size() const
{
  return Seeds->fibreOfRank.size();
}

std::size_t CapsuleField::fibre(int rank) const
{
  return Seeds->fibreOfRank[std::size_t(rank)];
}

double CapsuleField::value(int rank, const Eigen::Vector3d& x) const
{
  double value = -infinity;
  for (std::size_t p = Seeds->pieceOffsets[std::size_t(rank)]; p < Seeds->pieceOffsets[std::size_t(rank) + 1]; ++p)
  {
    value = std::max(value, coneValue(Seeds->pieces[p].cone, x));
  }
  return value;
}

void CapsuleField::sweep(const VoxelGrid& grid, const FieldRelevance& relevance, const Context& context, double progressFrom,
  double progressTo, const std::string& message, const std::function<void(const FieldCell&, int)>& sink) const
{
  if (grid.size() == 0)
  {
    return;
  }
  int firstBlock[3];
  std::int64_t blocks[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    firstBlock[axis] = floorDivide(grid.lower[axis], blockSize);
    blocks[axis] = floorDivide(grid.lower[axis] + grid.count[axis] - 1, blockSize) - firstBlock[axis] + 1;
  }
  const std::int64_t blockTotal = blocks[0] * blocks[1] * blocks[2];
  const double h = grid.spacing;
  // Single precision is good to some 1e-7 of a block's neighbourhood; the slack keeps decisions on the safe side of it.
  const auto slackened = [](double extent) { return extent * (1.0 + 1e-5) + 1e-5; };
  const double blockExtent = slackened(0.5 * h * (blockSize - 1) * std::sqrt(3.0));
  const double cellExtent =
    slackened(0.5 * h * Eigen::Vector3d(FieldCell::sizeX - 1, FieldCell::sizeY - 1, FieldCell::sizeZ - 1).norm());
  const auto bounded = [](double value) { return float(std::min(value, 1e20)); };
  const CellRelevance cellRelevance = { bounded(relevance.bestReach), bounded(relevance.secondReach), bounded(relevance.sumReach),
    bounded(relevance.contrast) };
  const EvaluateCell evaluateCell = chooseEvaluateCell();

  std::atomic<bool> stop{ false };
  std::atomic<std::int64_t> done{ 0 };
  std::exception_ptr failure;
  const int threads = context.threadCount();
#pragma omp parallel num_threads(threads)
  {
    const int thread = omp_get_thread_num();
    std::unique_ptr<Data::Search> search;
    CellWork work;
    double reported = -1.0;
    try
    {
      search = std::make_unique<Data::Search>();
      search->seenPiece.assign(Seeds->pieces.size(), 0);
      search->valueOf.assign(Seeds->fibreOfRank.size(), -infinity);
    }
    catch (...)
    {
#pragma omp critical(CapsuleFieldSweep)
      failure = std::current_exception();
      stop = true;
    }
#pragma omp for schedule(dynamic, 1)
    for (std::int64_t block = 0; block < blockTotal; ++block)
    {
      if (stop)
      {
        continue;
      }
      try
      {
        if (thread == 0)
        {
          // Only the calling thread talks to the caller.
          if (context.stopRequested())
          {
            stop = true;
            continue;
          }
          const double fraction = double(done) / double(blockTotal);
          if (fraction >= reported + 0.01)
          {
            reported = fraction;
            context.report(progressFrom + (progressTo - progressFrom) * fraction, message);
          }
        }
        const int blockLower[3] = { (firstBlock[0] + int(block % blocks[0])) * blockSize,
          (firstBlock[1] + int(block / blocks[0] % blocks[1])) * blockSize,
          (firstBlock[2] + int(block / (blocks[0] * blocks[1]))) * blockSize };
        const double half = 0.5 * (blockSize - 1);
        const Eigen::Vector3d centre =
          grid.origin + h * Eigen::Vector3d(blockLower[0] + half, blockLower[1] + half, blockLower[2] + half);
        Seeds->gather(centre, blockExtent, relevance, *search);
        work.extent = float(cellExtent);
        FieldCell cell;
        cell.best = work.best;
        cell.second = work.second;
        cell.rank = work.rank;
        const int cellSize[3] = { FieldCell::sizeX, FieldCell::sizeY, FieldCell::sizeZ };
        for (int ck = 0; ck < blockSize; ck += FieldCell::sizeZ)
        {
          for (int cj = 0; cj < blockSize; cj += FieldCell::sizeY)
          {
            for (int ci = 0; ci < blockSize; ci += FieldCell::sizeX)
            {
              const int at[3] = { ci, cj, ck };
              bool empty = false;
              for (int axis = 0; axis < 3; ++axis)
              {
                cell.lower[axis] = blockLower[axis] + at[axis];
                cell.begin[axis] = std::max(0, grid.lower[axis] - cell.lower[axis]);
                cell.end[axis] = std::min(cellSize[axis], grid.lower[axis] + grid.count[axis] - cell.lower[axis]);
                empty = empty || cell.begin[axis] >= cell.end[axis];
                work.centre[axis] = float((at[axis] + 0.5 * (cellSize[axis] - 1) - half) * h);
              }
              if (empty)
              {
                continue;
              }
              for (int i = 0; i < FieldCell::size; ++i)
              {
                const int inRow = i % FieldCell::sizeX;
                const int row = i / FieldCell::sizeX % FieldCell::sizeY;
                const int plane = i / (FieldCell::sizeX * FieldCell::sizeY);
                work.x[i] = float((ci + inRow - half) * h);
                work.y[i] = float((cj + row - half) * h);
                work.z[i] = float((ck + plane - half) * h);
              }
              evaluateCell(search->candidates, cellRelevance, work);
              sink(cell, thread);
            }
          }
        }
        ++done;
      }
      catch (...)
      {
#pragma omp critical(CapsuleFieldSweep)
        failure = std::current_exception();
        stop = true;
      }
    }
  }
  if (failure)
  {
    std::rethrow_exception(failure);
  }
  if (stop)
  {
    throw Cancelled("stopped by the user");
  }
  context.checkpoint();
  context.report(progressTo, message);
}

} // namespace cactus
