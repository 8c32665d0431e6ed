// SPDX-License-Identifier: BSD-3-Clause
#include "growth/SeedBins.h"

#include "base/Error.h"
#include "base/Memory.h"
#include "base/Parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace cactus
{

namespace
{

/// Larger bins mean fewer bins per search and per piece, but more pieces that are too far.
constexpr double piecesPerBin = 16.0;

/// Threads fill the bins part by part, and each part counts its own pieces per bin: at most this many parts.
constexpr int mostParts = 8;
constexpr std::size_t piecesAtOnce = 65536;

} // namespace

SeedBins::SeedBins(const std::vector<SeedPiece>& pieces, int threads)
{
  this->choose(pieces, threads);
  const std::size_t bins = this->index(0, 0, this->Count[2]);
  const auto parts = std::size_t(std::clamp(threads, 1, mostParts));
  this->requireRoom(pieces, bins, parts, threads);
  const auto eachBin = [&](const SeedPiece& piece, auto&& visit)
  {
    const Eigen::AlignedBox3d box = boundingBox(piece.cone);
    this->forEachBin(box.min(), box.max(), visit);
  };
  const std::size_t partSize = pieces.size() / parts + 1;
  std::vector<std::vector<std::uint32_t>> next(parts, std::vector<std::uint32_t>(bins, 0));
  parallelBlocks(pieces.size(), partSize, threads,
    [&](std::size_t part, std::size_t begin, std::size_t end)
    {
      for (std::size_t p = begin; p < end; ++p)
      {
        eachBin(pieces[p], [&](std::size_t bin) { ++next[part][bin]; });
      }
    });
  // Within each bin, pieces are in the order of their indices, whatever the parts.
  this->Offsets.resize(bins + 1);
  std::uint32_t sum = 0;
  for (std::size_t bin = 0; bin < bins; ++bin)
  {
    this->Offsets[bin] = sum;
    for (std::vector<std::uint32_t>& ofPart : next)
    {
      sum += std::exchange(ofPart[bin], sum);
    }
  }
  this->Offsets[bins] = sum;
  this->Pieces.resize(sum);
  parallelBlocks(pieces.size(), partSize, threads,
    [&](std::size_t part, std::size_t begin, std::size_t end)
    {
      for (std::size_t p = begin; p < end; ++p)
      {
        eachBin(pieces[p], [&](std::size_t bin) { this->Pieces[next[part][bin]++] = std::uint32_t(p); });
      }
    });
}

/// Chooses about one bin for `piecesPerBin` pieces, and no more than a thousand along an axis.
void SeedBins::choose(const std::vector<SeedPiece>& pieces, int threads)
{
  std::vector<Eigen::AlignedBox3d> parts(pieces.size() / piecesAtOnce + 1);
  parallelBlocks(pieces.size(), piecesAtOnce, threads,
    [&](std::size_t part, std::size_t begin, std::size_t end)
    {
      for (std::size_t p = begin; p < end; ++p)
      {
        parts[part].extend(boundingBox(pieces[p].cone));
      }
    });
  Eigen::AlignedBox3d bounds;
  for (const Eigen::AlignedBox3d& part : parts)
  {
    bounds.extend(part);
  }
  if (pieces.empty())
  {
    bounds.extend(Eigen::Vector3d::Zero());
  }
  this->Origin = bounds.min();
  const Eigen::Vector3d size = bounds.sizes().cwiseMax(1e-6);
  this->Size =
    std::max(std::cbrt(size.prod() * piecesPerBin / std::max<double>(double(pieces.size()), 1.0)), size.maxCoeff() / 1000.0);
  this->Count = (size / this->Size).array().floor().cast<int>() + 1;
}

void SeedBins::requireRoom(const std::vector<SeedPiece>& pieces, std::size_t bins, std::size_t parts, int threads) const
{
  std::vector<double> entriesOf(pieces.size() / piecesAtOnce + 1, 0.0); // whole numbers
  parallelBlocks(pieces.size(), piecesAtOnce, threads,
    [&](std::size_t part, std::size_t begin, std::size_t end)
    {
      for (std::size_t p = begin; p < end; ++p)
      {
        const Eigen::AlignedBox3d box = boundingBox(pieces[p].cone);
        entriesOf[part] += (this->binOf(box.max()) - this->binOf(box.min()) + 1).cast<double>().prod();
      }
    });
  const double entries = std::accumulate(entriesOf.begin(), entriesOf.end(), 0.0);
  if (entries > std::numeric_limits<std::uint32_t>::max())
  {
    throw OutOfMemory("seeding fibres of so uneven calibre takes more entries than can be counted: leave out the thickest or the "
                      "thinnest fibres");
  }
  requireMemory(4.0 * static_cast<double>(parts + 1) * static_cast<double>(bins) + 4.0 * entries,
    "seeding fibres of uneven calibre", "leave out the thickest or the thinnest fibres");
}

} // namespace cactus
