// SPDX-License-Identifier: BSD-3-Clause
#include "surface/FibreSurvey.h"

#include "base/Bytes.h"
#include "base/Error.h"
#include "base/Limits.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>

namespace cactus
{

namespace
{

/// Edge of a piece, in samples; pieces begin at its multiples in the image, as tiles do that are made at once.
constexpr int pieceEdge = 16;
/// Along an axis, the most blocks that have a sample of one piece in reach.
constexpr int mostBlocks = 8;
constexpr std::size_t piecesAtOnce = std::size_t(1) << 16;

static_assert(
  (pieceEdge + NodeLattice::blockCells + 2 * int(limits::smoothingIterations.highest)) / NodeLattice::blockCells < mostBlocks,
  "what has a sample in reach fits into a byte");

/// The blocks along an axis that have a sample in reach: a bit for each, from the first block on.
struct BlocksAlong
{
  int first = 0;
  std::array<std::uint8_t, pieceEdge> ofSample{};
};

/// Of the samples of a piece, the first of which is the one of `node`.
BlocksAlong blocksAlong(int node, int samples, int reach, int blocks)
{
  constexpr int size = NodeLattice::blockCells;
  const auto firstOf = [&](int n) { return std::max(0, (n - reach - 1) / size); };
  BlocksAlong along;
  along.first = firstOf(node);
  for (int i = 0; i < samples; ++i)
  {
    // Of `size` cells, it has a node more than that.
    const int last = std::min(blocks - 1, (node + i + reach) / size);
    for (int block = firstOf(node + i); block <= last; ++block)
    {
      along.ofSample[std::size_t(i)] |= std::uint8_t(1U << unsigned(block - along.first));
    }
  }
  return along;
}

/// What a piece holds of a fibre.
struct PartOfFibre
{
  double depths = 0.0;
  double samples = 0.0;
  std::array<std::uint64_t, mostBlocks>
    blocks{}; ///< per block along z, a byte for each along y, and in it a bit for each along x
};

using PartsOfPiece = std::map<std::int32_t, PartOfFibre>;

/// Sees to it that a row is of a label image.
void checkRow(const std::int32_t* ids, const float* depths, int count)
{
  constexpr auto deepest = float(limits::coordinate.highest); // more than any fibre's radius
  int isWithin = 1;
  int fits = 1;
  std::int32_t least = 0;
  for (int i = 0; i < count; ++i)
  {
    isWithin &= int(std::abs(depths[i]) <= deepest); // which NaN is not
    fits &= int((depths[i] > 0.0f) == (ids[i] > 0));
    least = std::min(least, ids[i]);
  }
  require(isWithin != 0, "the label image has a Depth that is not finite (NaN or infinite), or beyond 100000 µm");
  if (least < 0)
  {
    throw InvalidInput("the label image has a FibreId of " + std::to_string(least) + ": ids count from 1");
  }
  require(fits != 0, "the label image has a Depth that does not fit its FibreId: Depth must be positive just where FibreId is");
}

/// A field's samples, piece by piece.
class Survey
{
public:
  Survey(const FibreField& field, int reach)
    : Field(field)
    , Reach(reach)
  {
    const NodeLattice lattice = field.lattice();
    require(lattice.blockCount() <= std::numeric_limits<std::uint32_t>::max(),
      "the label image has more blocks of 16³ voxels than 32 bits count: choose a larger VoxelSize");
    const SampleBox& samples = field.samples();
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      this->Blocks[axis] = lattice.blocks(int(axis));
      this->First[axis] = samples.first[axis] / pieceEdge;
      this->Count[axis] = (samples.first[axis] + samples.count[axis] - 1) / pieceEdge - this->First[axis] + 1;
    }
  }

  std::size_t pieces() const { return std::size_t(this->Count[0]) * std::size_t(this->Count[1]) * std::size_t(this->Count[2]); }

  PartsOfPiece partsOf(std::size_t piece) const
  {
    const SampleRange range = this->samplesOf(piece);
    thread_local LabelBuffer buffer;
    const LabelImageView held = this->Field.samplesAround(range, 0, buffer);
    const std::array<BlocksAlong, 3> near = this->blocksNear(range);
    PartsOfPiece parts;
    for (int k = 0; k < range.count[2]; ++k)
    {
      for (int j = 0; j < range.count[1]; ++j)
      {
        const std::size_t row = held.grid.index(range.first[0], range.first[1] + j, range.first[2] + k);
        addRow(held.fibreId + row, held.depth + row, range.count[0], near, { { j, k } }, parts);
      }
    }
    return parts;
  }

  /// Adds what a piece holds; blocks may then stand there several times.
  void add(std::size_t piece, const PartsOfPiece& parts, FoundFibres& found) const
  {
    const std::array<BlocksAlong, 3> near = this->blocksNear(this->samplesOf(piece));
    for (const auto& [id, part] : parts)
    {
      FoundFibre& fibre = found[id];
      fibre.depths += part.depths;
      fibre.samples += part.samples;
      for (int z = 0; z < mostBlocks; ++z)
      {
        for (std::uint64_t left = part.blocks[std::size_t(z)]; left != 0; left &= left - 1)
        {
          const int bit = __builtin_ctzll(left);
          const int y = near[1].first + bit / mostBlocks;
          const std::size_t row = std::size_t(y) + std::size_t(this->Blocks[1]) * std::size_t(near[2].first + z);
          fibre.blocks.push_back(
            std::uint32_t(std::size_t(near[0].first + bit % mostBlocks) + std::size_t(this->Blocks[0]) * row));
        }
      }
    }
  }

private:
  SampleRange samplesOf(std::size_t piece) const
  {
    const SampleBox& samples = this->Field.samples();
    SampleRange range;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const int begin = pieceEdge * (this->First[axis] + int(piece % std::size_t(this->Count[axis])));
      piece /= std::size_t(this->Count[axis]);
      range.first[axis] = std::max(begin, samples.first[axis]);
      range.count[axis] = std::min(begin + pieceEdge, samples.first[axis] + samples.count[axis]) - range.first[axis];
    }
    return range;
  }

  std::array<BlocksAlong, 3> blocksNear(const SampleRange& range) const
  {
    std::array<BlocksAlong, 3> near;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      // Node 1 is the first sample.
      const int node = range.first[axis] - this->Field.samples().first[axis] + 1;
      near[axis] = blocksAlong(node, range.count[axis], this->Reach, this->Blocks[axis]);
    }
    return near;
  }

  /// Run by run; at: the row along y and z.
  static void addRow(const std::int32_t* ids, const float* depths, int count, const std::array<BlocksAlong, 3>& near,
    const std::array<int, 2>& at, PartsOfPiece& parts)
  {
    checkRow(ids, depths, count);
    for (int i = 0; i < count;)
    {
      const std::int32_t id = ids[i];
      const int begin = i;
      double sum = 0.0;
      std::uint64_t alongX = 0;
      for (; i < count && ids[i] == id; ++i)
      {
        sum += double(depths[i]);
        alongX |= near[0].ofSample[std::size_t(i)];
      }
      if (id != 0)
      {
        PartOfFibre& part = parts[id];
        part.depths += sum;
        part.samples += i - begin;
        addBlocks(alongX, near[1].ofSample[std::size_t(at[0])], near[2].ofSample[std::size_t(at[1])], part);
      }
    }
  }

  static void addBlocks(std::uint64_t alongX, unsigned alongY, unsigned alongZ, PartOfFibre& part)
  {
    std::uint64_t across = 0;
    for (unsigned y = 0; y < mostBlocks; ++y)
    {
      across |= ((alongY >> y) & 1U) != 0 ? alongX << (mostBlocks * y) : 0;
    }
    for (unsigned z = 0; z < mostBlocks; ++z)
    {
      part.blocks[z] |= ((alongZ >> z) & 1U) != 0 ? across : 0;
    }
  }

  const FibreField& Field;
  int Reach;
  std::array<int, 3> Blocks{};
  std::array<int, 3> First{}; ///< piece
  std::array<int, 3> Count{}; ///< of pieces
};

std::string bytesOfParts(const PartsOfPiece& parts)
{
  ByteWriter put;
  for (const auto& [id, part] : parts)
  {
    put(id);
    put(part.depths);
    put(part.samples);
    put.addAll(part.blocks.data(), part.blocks.size());
  }
  return put.bytes();
}

PartsOfPiece partsFrom(const std::string& bytes)
{
  PartsOfPiece parts;
  for (ByteReader get(bytes); !get.isAtEnd();)
  {
    PartOfFibre& part = parts[get.get<std::int32_t>()];
    get(part.depths);
    get(part.samples);
    for (std::uint64_t& word : part.blocks)
    {
      get(word);
    }
  }
  return parts;
}

/// Brings those in order that came after the first `known`.
void order(std::vector<std::uint32_t>& blocks, std::size_t known)
{
  if (known == blocks.size())
  {
    return;
  }
  const auto fresh = blocks.begin() + std::ptrdiff_t(known);
  std::sort(fresh, blocks.end());
  const auto from = std::lower_bound(blocks.begin(), fresh, *fresh);
  std::inplace_merge(from, fresh, blocks.end());
  blocks.erase(std::unique(from, blocks.end()), blocks.end());
}

} // namespace

FoundFibres findFibres(const FibreField& field, int reach, const Context& context, const Sharing& sharing)
{
  requireWithin("the reach of blocks", reach, limits::smoothingIterations);
  const Survey survey(field, reach);
  const std::size_t pieces = survey.pieces();
  FoundFibres found;
  std::map<std::int32_t, std::size_t> known; // blocks that are in order
  for (std::size_t first = 0; first < pieces; first += piecesAtOnce)
  {
    std::vector<PartsOfPiece> parts(std::min(piecesAtOnce, pieces - first));
    const auto done = [&](std::size_t end) { return 0.05 * static_cast<double>(end) / static_cast<double>(pieces); };
    sharing.loop(
      parts.size(), context, [&](std::size_t i) { parts[i] = survey.partsOf(first + i); },
      [&](std::size_t i) { return bytesOfParts(parts[i]); },
      [&](std::size_t i, const std::string& bytes) { parts[i] = partsFrom(bytes); }, "looking for fibres", done(first),
      done(first + parts.size()));
    for (std::size_t i = 0; i < parts.size(); ++i)
    {
      survey.add(first + i, parts[i], found);
    }
    for (auto& [id, fibre] : found)
    {
      std::size_t& ordered = known[id];
      order(fibre.blocks, ordered);
      ordered = fibre.blocks.size();
    }
  }
  return found;
}

} // namespace cactus
