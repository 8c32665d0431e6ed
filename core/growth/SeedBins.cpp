// SPDX-License-Identifier: BSD-3-Clause
#include "growth/SeedBins.h"

#include "base/Error.h"
#include "base/Memory.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace cactus
{

namespace
{

/// A search comes to fewer bins if these are larger, and to fewer of them for the same piece, but to more pieces that are too
/// far.
constexpr double piecesPerBin = 16.0;

} // namespace

SeedBins::SeedBins(const std::vector<SeedPiece>& pieces)
{
  this->choose(pieces);
  const std::size_t bins = this->index(0, 0, this->Count[2]);
  this->Offsets.assign(bins + 1, 0);
  this->requireRoom(pieces, bins);
  const auto eachBin = [&](const SeedPiece& piece, auto&& visit)
  {
    const Eigen::AlignedBox3d box = boundingBox(piece.cone);
    this->forEachBin(box.min(), box.max(), visit);
  };
  for (const SeedPiece& piece : pieces)
  {
    eachBin(piece, [&](std::size_t bin) { ++this->Offsets[bin + 1]; });
  }
  std::partial_sum(this->Offsets.begin(), this->Offsets.end(), this->Offsets.begin());
  this->Pieces.resize(this->Offsets.back());
  std::vector<std::uint32_t> cursor(this->Offsets.begin(), this->Offsets.end() - 1);
  for (std::size_t p = 0; p < pieces.size(); ++p)
  {
    eachBin(pieces[p], [&](std::size_t bin) { this->Pieces[cursor[bin]++] = std::uint32_t(p); });
  }
}

/// About one bin for `piecesPerBin` pieces, and no more than a thousand along an axis.
void SeedBins::choose(const std::vector<SeedPiece>& pieces)
{
  Eigen::AlignedBox3d bounds;
  for (const SeedPiece& piece : pieces)
  {
    bounds.extend(boundingBox(piece.cone));
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

void SeedBins::requireRoom(const std::vector<SeedPiece>& pieces, std::size_t bins) const
{
  double entries = 0.0;
  for (const SeedPiece& piece : pieces)
  {
    const Eigen::AlignedBox3d box = boundingBox(piece.cone);
    entries += (this->binOf(box.max()) - this->binOf(box.min()) + 1).cast<double>().prod();
  }
  if (entries > std::numeric_limits<std::uint32_t>::max())
  {
    throw OutOfMemory("seeding fibres of so uneven calibre takes more entries than can be counted: leave out the thickest or the "
                      "thinnest fibres");
  }
  requireMemory(8.0 * static_cast<double>(bins) + 4.0 * entries, "seeding fibres of uneven calibre",
    "leave out the thickest or the thinnest fibres");
}

} // namespace cactus
