// SPDX-License-Identifier: BSD-3-Clause
#include "growth/CapsuleSeeds.h"

#include "base/Error.h"
#include "base/Memory.h"
#include "base/Parallel.h"
#include "fibres/PeriodicImages.h"
#include "fibres/SelectFibres.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

namespace cactus
{

namespace
{

/// Number of fibres that a thread takes at a time.
constexpr std::size_t fibresAtOnce = 16;

/// Returns the number of pieces of the segment from control point p to the next.
int pieceCount(const Fibres& fibres, const Calibre& calibre, std::size_t p)
{
  const double length = (fibres.points[p + 1] - fibres.points[p]).norm();
  const double radius = std::max(fibres.radii[p], fibres.radii[p + 1]);
  const double longest = std::min(4.0 * radius, calibre.longestPiece());
  return int(std::min(std::max(1.0, std::ceil(length / longest)), calibre.varies() ? 1e6 : 256.0));
}

/// Calls use(shift) for the images of a segment in reach of the region, see forEachImage().
template <typename Use>
void forEachInReach(const Fibres& fibres, std::size_t p, const Eigen::AlignedBox3d& region, double reach, Use&& use)
{
  Eigen::AlignedBox3d box(fibres.points[p]);
  box.extend(fibres.points[p + 1]);
  const double grown = reach + std::max(fibres.radii[p], fibres.radii[p + 1]);
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

/// Cuts the image of the segment from control point p to the next, `start` along the fibre of that rank, into `parts` pieces;
/// returns their end.
SeedPiece* cutSegment(const Fibres& fibres, FibreCalibre& calibre, std::size_t p, const Eigen::Vector3d& shift, double start,
  int parts, int rank, SeedPiece* piece)
{
  const Eigen::Vector3d p0 = fibres.points[p] + shift;
  const Eigen::Vector3d along = fibres.points[p + 1] - fibres.points[p];
  const double length = along.norm();
  const double r0 = fibres.radii[p];
  const double widening = fibres.radii[p + 1] - r0;
  const auto radius = [&](double t) { return (r0 + t * widening) * calibre.fraction(start + t * length); };
  for (int part = 0; part < parts; ++part)
  {
    const double t0 = double(part) / parts;
    const double t1 = part + 1 == parts ? 1.0 : double(part + 1) / parts;
    *piece++ = { coneBetween(p0 + t0 * along, p0 + t1 * along, radius(t0), radius(t1)), rank };
  }
  return piece;
}

} // namespace

CapsuleSeeds::CapsuleSeeds(
  const Fibres& fibres, const Calibre& calibre, const Eigen::AlignedBox3d& region, double reach, int threads)
  : fibreOfRank(orderById(fibres))
  , pieceOffsets(fibreOfRank.size() + 1, 0)
{
  if (calibre.varies() && fibres.domain.periodic[2])
  {
    throw InvalidInput("the Domain is periodic along z, where SurfaceRoughness would not come back to its values: leave it at 0; "
                       "CalibreVariation of BundleInitializer varies fibres and repeats");
  }
  parallelForInBlocks(this->fibreOfRank.size(), fibresAtOnce, threads,
    [&](std::size_t rank)
    {
      const std::size_t f = this->fibreOfRank[rank];
      std::size_t count = 0;
      for (std::size_t p = fibres.offsets[f]; p + 1 < fibres.offsets[f + 1]; ++p)
      {
        forEachInReach(
          fibres, p, region, reach, [&](const Eigen::Vector3d&) { count += std::size_t(pieceCount(fibres, calibre, p)); });
      }
      this->pieceOffsets[rank + 1] = count;
    });
  std::partial_sum(this->pieceOffsets.begin(), this->pieceOffsets.end(), this->pieceOffsets.begin());
  requireMemory(static_cast<double>(this->pieceOffsets.back()) * (sizeof(SeedPiece) + 64.0),
    "seeding " + std::to_string(fibres.size()) + " fibres", "request a smaller extent, or use fewer fibres or control points");
  this->pieces.resize(this->pieceOffsets.back());
  parallelForInBlocks(this->fibreOfRank.size(), fibresAtOnce, threads,
    [&](std::size_t rank)
    {
      const std::size_t f = this->fibreOfRank[rank];
      FibreCalibre ofFibre(calibre, fibres.fibreIds[f]);
      SeedPiece* piece = this->pieces.data() + this->pieceOffsets[rank];
      double start = 0.0; // length of the fibre before the segment
      for (std::size_t p = fibres.offsets[f]; p + 1 < fibres.offsets[f + 1]; ++p)
      {
        forEachInReach(fibres, p, region, reach,
          [&](const Eigen::Vector3d& shift)
          { piece = cutSegment(fibres, ofFibre, p, shift, start, pieceCount(fibres, calibre, p), int(rank), piece); });
        start += (fibres.points[p + 1] - fibres.points[p]).norm();
      }
    });
}

} // namespace cactus
