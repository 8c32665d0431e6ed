// SPDX-License-Identifier: BSD-3-Clause
#include "growth/CapsuleSeeds.h"

#include "base/Error.h"
#include "base/Memory.h"
#include "base/Parallel.h"
#include "fibres/FibreShape.h"
#include "fibres/PeriodicImages.h"
#include "fibres/SelectFibres.h"
#include "growth/SeedPoints.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string>

namespace cactus
{

namespace
{

/// Number of fibres that a thread takes at a time.
constexpr std::size_t fibresAtOnce = 16;

/// How a fibre's capsules are cut into pieces.
struct SegmentCut
{
  SegmentCut(const Calibre& calibre, const SectionShape& shape)
    : chains(chainsOf(shape))
    , longest(shape.isRound() ? calibre.longestPiece() : std::min(calibre.longestPiece(), SectionTurn::longestPiece))
  {
  }

  /// Returns the number of parts of the segment from control point p to the next, of which each chain has a piece.
  int parts(const Fibres& fibres, std::size_t p) const
  {
    const double length = (fibres.points[p + 1] - fibres.points[p]).norm();
    const double radius = std::max(fibres.radii[p], fibres.radii[p + 1]);
    const double most = std::isfinite(this->longest) ? 1e6 : 256.0;
    return int(std::min(std::max(1.0, std::ceil(length / std::min(4.0 * radius, this->longest))), most));
  }

  static int chainsOf(const SectionShape& shape) { return shape.isRound() ? 1 : 3; }

  int chains;
  double longest; ///< µm
};

/// Calls use(shift) for the images of a segment in reach of the region, see forEachImage(). seedReach: the largest distance of a
/// seed's surface from the centre line, as a fraction of the radius.
template <typename Use>
void forEachInReach(
  const Fibres& fibres, std::size_t p, const Eigen::AlignedBox3d& region, double reach, double seedReach, Use&& use)
{
  Eigen::AlignedBox3d box(fibres.points[p]);
  box.extend(fibres.points[p + 1]);
  const double grown = reach + seedReach * std::max(fibres.radii[p], fibres.radii[p + 1]);
  const Eigen::Vector3d around = Eigen::Vector3d::Constant(std::max(grown, 0.0));
  forEachImage(fibres.domain, Eigen::AlignedBox3d(box.min() - around, box.max() + around), region,
    [&](const Eigen::Vector3d& shift)
    {
      if (Eigen::AlignedBox3d(box).translate(shift).squaredExteriorDistance(region) <= grown * grown)
      {
        use(shift);
      }
    });
}

/// A segment of a fibre.
struct Segment
{
  const Fibres& fibres;
  std::size_t first; ///< control point
  double start;      ///< µm along the fibre
  int rank;          ///< of the fibre

  Eigen::Vector3d along() const { return this->fibres.points[this->first + 1] - this->fibres.points[this->first]; }
  double radius(double t) const
  {
    return this->fibres.radii[this->first] + t * (this->fibres.radii[this->first + 1] - this->fibres.radii[this->first]);
  }
  /// Where part `part` of `parts` ends.
  static double endOf(int part, int parts) { return part + 1 == parts ? 1.0 : double(part + 1) / parts; }
};

/// Cuts the image of a segment into parts, whose radii are `thickness` times those of the capsule; returns the end of their
/// pieces.
SeedPiece* cutSegment(
  const Segment& segment, FibreCalibre& calibre, double thickness, const Eigen::Vector3d& shift, int parts, SeedPiece* piece)
{
  const Eigen::Vector3d p0 = segment.fibres.points[segment.first] + shift;
  const Eigen::Vector3d along = segment.along();
  const double length = along.norm();
  const auto radius = [&](double t) { return thickness * (segment.radius(t) * calibre.fraction(segment.start + t * length)); };
  for (int part = 0; part < parts; ++part)
  {
    const double t0 = double(part) / parts;
    const double t1 = Segment::endOf(part, parts);
    *piece++ = { coneBetween(p0 + t0 * along, p0 + t1 * along, radius(t0), radius(t1)), segment.rank };
  }
  return piece;
}

/// Returns the number of a fibre's control points after which it repeats.
std::size_t pointsUntilRepeat(const Fibres& fibres, std::size_t f)
{
  return fibres.domain.periodic[2] ? periodOf(fibres, f).points : fibres.offsets[f + 1] - fibres.offsets[f];
}

/// The discs across a fibre where pieces end: one on the centre line, and one on either side.
struct Discs
{
  Eigen::Vector3d centre; ///< on the centre line
  Eigen::Vector3d offset; ///< µm, of one on a side
  double radius;
};

/// The same for a fibre whose sections are not round: three chains of pieces. tangents: at both ends of the segment.
SeedPiece* cutInThree(const Segment& segment, FibreCalibre& calibre, SectionTurn& turn,
  const std::array<Eigen::Vector3d, 2>& tangents, const Eigen::Vector3d& shift, int parts, SeedPiece* piece)
{
  const Eigen::Vector3d p0 = segment.fibres.points[segment.first] + shift;
  const Eigen::Vector3d along = segment.along();
  const double length = along.norm();
  const auto discsAt = [&](double t)
  {
    const double radius = segment.radius(t) * calibre.fraction(segment.start + t * length);
    const Eigen::Vector3d tangent = (tangents[0] + t * (tangents[1] - tangents[0])).stableNormalized();
    const Eigen::Vector3d offset = turn.offset(segment.start + t * length, tangent);
    return Discs{ p0 + t * along, radius * offset, radius * SectionShape::discRadius(offset.norm()) };
  };
  Discs from = discsAt(0.0);
  for (int part = 0; part < parts; ++part)
  {
    const Discs to = discsAt(Segment::endOf(part, parts));
    *piece++ = { coneBetween(from.centre + from.offset, to.centre + to.offset, from.radius, to.radius), segment.rank };
    *piece++ = { coneBetween(from.centre, to.centre, from.radius, to.radius), segment.rank };
    *piece++ = { coneBetween(from.centre - from.offset, to.centre - to.offset, from.radius, to.radius), segment.rank };
    from = to;
  }
  return piece;
}

/// Makes a piece for each seed point in the image of a segment: from the centre line, as thick as the core, to the ball at the
/// point.
SeedPiece* addPoints(
  const Segment& segment, FibreCalibre& calibre, SeedPoints& points, const Eigen::Vector3d& shift, SeedPiece* piece)
{
  const Eigen::Vector3d p0 = segment.fibres.points[segment.first] + shift;
  const Eigen::Vector3d along = segment.along();
  const double length = along.norm();
  for (std::size_t n = points.size(); n > 0; --n)
  {
    const SeedPoints::Place place = points.next(along / length);
    const double radius = segment.radius(place.along) * calibre.fraction(segment.start + place.along * length);
    const Eigen::Vector3d foot = p0 + place.along * along;
    *piece++ = { coneBetween(foot, foot + radius * place.across, SeedPoints::core * radius, SeedPoints::tip * radius),
      segment.rank };
  }
  return piece;
}

} // namespace

CapsuleSeeds::CapsuleSeeds(
  const Fibres& fibres, const SeedOptions& options, const Eigen::AlignedBox3d& region, double reach, int threads)
  : fibreOfRank(orderById(fibres))
  , shapes(sectionShapes(fibres, options))
  , pieceOffsets(fibreOfRank.size() + 1, 0)
  , chainPieces(fibreOfRank.size(), 0)
{
  const Calibre calibre(options);
  if (calibre.varies() && fibres.domain.periodic[2])
  {
    throw InvalidInput("the Domain is periodic along z, where SurfaceRoughness would not come back to its values: leave it at 0; "
                       "CalibreVariation of BundleInitializer varies fibres and repeats");
  }
  parallelForInBlocks(this->fibreOfRank.size(), fibresAtOnce, threads,
    [&](std::size_t rank)
    {
      const std::size_t f = this->fibreOfRank[rank];
      const SegmentCut cut(calibre, this->shapes[f]);
      std::size_t points = 0;
      for (std::size_t p = fibres.offsets[f]; p + 1 < fibres.offsets[f + 1]; ++p)
      {
        const std::size_t ofSegment =
          options.pointDensity > 0.0
            ? SeedPoints(options, fibres, f, (p - fibres.offsets[f]) % pointsUntilRepeat(fibres, f)).size()
            : 0;
        forEachInReach(fibres, p, region, reach, this->shapes[f].reach(),
          [&](const Eigen::Vector3d&)
          {
            this->chainPieces[rank] += std::size_t(cut.chains * cut.parts(fibres, p));
            points += ofSegment;
          });
      }
      this->pieceOffsets[rank + 1] = this->chainPieces[rank] + points;
    });
  std::partial_sum(this->pieceOffsets.begin(), this->pieceOffsets.end(), this->pieceOffsets.begin());
  requireMemory(static_cast<double>(this->pieceOffsets.back()) * (sizeof(SeedPiece) + 64.0),
    "seeding " + std::to_string(fibres.size()) + " fibres",
    options.pointDensity > 0.0 ? "choose a smaller SeedDensity, request a smaller extent, or use fewer fibres"
                               : "request a smaller extent, or use fewer fibres or control points");
  this->pieces.resize(this->pieceOffsets.back());
  parallelForInBlocks(this->fibreOfRank.size(), fibresAtOnce, threads,
    [&](std::size_t rank) { this->makePieces(fibres, calibre, options, region, reach, rank); });
}

void CapsuleSeeds::makePieces(const Fibres& fibres, const Calibre& calibre, const SeedOptions& options,
  const Eigen::AlignedBox3d& region, double reach, std::size_t rank)
{
  const std::size_t f = this->fibreOfRank[rank];
  const SectionShape& shape = this->shapes[f];
  const SegmentCut cut(calibre, shape);
  FibreCalibre ofFibre(calibre, fibres.fibreIds[f]);
  const std::vector<double> lengths = arcLengths(fibres, f);
  const std::size_t repeat = pointsUntilRepeat(fibres, f);
  SectionTurn turn(shape, options.seed, fibres.fibreIds[f], repeat < lengths.size() ? lengths[repeat] : 0.0);
  const std::vector<Eigen::Vector3d> tangents = shape.isRound() ? std::vector<Eigen::Vector3d>() : unitTangents(fibres, f);
  SeedPiece* piece = this->pieces.data() + this->pieceOffsets[rank];
  SeedPiece* point = piece + this->chainPieces[rank];
  for (std::size_t i = 0; i + 1 < lengths.size(); ++i)
  {
    const std::size_t p = fibres.offsets[f] + i;
    const Segment segment{ fibres, p, lengths[i % repeat], int(rank) };
    forEachInReach(fibres, p, region, reach, shape.reach(),
      [&](const Eigen::Vector3d& shift)
      {
        const int parts = cut.parts(fibres, p);
        if (!shape.isRound())
        {
          piece = cutInThree(segment, ofFibre, turn, { { tangents[i], tangents[i + 1] } }, shift, parts, piece);
        }
        else if (options.pointDensity > 0.0)
        {
          SeedPoints points(options, fibres, f, i % repeat);
          piece = cutSegment(segment, ofFibre, SeedPoints::core, shift, parts, piece);
          point = addPoints(segment, ofFibre, points, shift, point);
        }
        else
        {
          piece = cutSegment(segment, ofFibre, 1.0, shift, parts, piece);
        }
      });
  }
}

double CapsuleSeeds::chainsOf(std::size_t rank) const
{
  return SegmentCut::chainsOf(this->shapes[this->fibreOfRank[rank]]);
}

} // namespace cactus
