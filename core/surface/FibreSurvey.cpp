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

constexpr std::size_t piecesAtOnce = std::size_t(1) << 16;

/// What a piece holds of a fibre.
struct PartOfFibre
{
  double depths = 0.0;
  double samples = 0.0;
  std::array<std::uint8_t, 3> first{ { FoundBox::pieceEdge, FoundBox::pieceEdge, FoundBox::pieceEdge } }; ///< sample in the piece
  std::array<std::uint8_t, 3> last{ { 0, 0, 0 } };

  /// Adds samples in a row along x. at: of the first one in the piece.
  void addRun(const std::array<int, 3>& at, int count, double sum)
  {
    this->depths += sum;
    this->samples += count;
    const std::array<int, 3> end{ { at[0] + count - 1, at[1], at[2] } };
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      this->first[axis] = std::min(this->first[axis], std::uint8_t(at[axis]));
      this->last[axis] = std::max(this->last[axis], std::uint8_t(end[axis]));
    }
  }
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

/// The pieces that hold a field's samples.
class Pieces
{
public:
  explicit Pieces(const SampleBox& samples)
    : Samples(samples)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      this->First[axis] = pieceOf(samples.first[axis]);
      this->Count[axis] = pieceOf(samples.first[axis] + samples.count[axis] - 1) - this->First[axis] + 1;
    }
  }

  std::size_t count() const { return std::size_t(this->Count[0]) * std::size_t(this->Count[1]) * std::size_t(this->Count[2]); }

  /// The place in the image at which a piece begins; its first samples may not be the field's.
  std::array<int, 3> begin(std::size_t piece) const
  {
    std::array<int, 3> at{};
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      at[axis] = FoundBox::pieceEdge * (this->First[axis] + int(piece % std::size_t(this->Count[axis])));
      piece /= std::size_t(this->Count[axis]);
    }
    return at;
  }

  /// Those of the field.
  SampleRange samplesOf(std::size_t piece) const
  {
    const std::array<int, 3> at = this->begin(piece);
    SampleRange range;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      range.first[axis] = std::max(at[axis], this->Samples.first[axis]);
      range.count[axis] =
        std::min(at[axis] + FoundBox::pieceEdge, this->Samples.first[axis] + this->Samples.count[axis]) - range.first[axis];
    }
    return range;
  }

  /// The numbers of those that hold a box of the field's samples.
  std::vector<std::uint32_t> holding(const std::array<int, 3>& firstSample, const std::array<int, 3>& lastSample) const
  {
    std::array<std::size_t, 3> first{};
    std::array<std::size_t, 3> last{};
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      first[axis] = std::size_t(pieceOf(firstSample[axis]) - this->First[axis]);
      last[axis] = std::size_t(pieceOf(lastSample[axis]) - this->First[axis]);
    }
    std::vector<std::uint32_t> numbers;
    for (std::size_t z = first[2]; z <= last[2]; ++z)
    {
      for (std::size_t y = first[1]; y <= last[1]; ++y)
      {
        for (std::size_t x = first[0]; x <= last[0]; ++x)
        {
          numbers.push_back(std::uint32_t(x + std::size_t(this->Count[0]) * (y + std::size_t(this->Count[1]) * z)));
        }
      }
    }
    return numbers;
  }

private:
  /// Of a sample along an axis, which may be negative.
  static int pieceOf(int sample)
  {
    constexpr int edge = FoundBox::pieceEdge;
    return sample >= 0 ? sample / edge : -((edge - 1 - sample) / edge);
  }

  SampleBox Samples;
  std::array<int, 3> First{}; ///< piece along each axis
  std::array<int, 3> Count{};
};

/// Run by run. at: of the row's first sample in the piece.
void addRow(const std::int32_t* ids, const float* depths, int count, const std::array<int, 3>& at, PartsOfPiece& parts)
{
  checkRow(ids, depths, count);
  for (int i = 0; i < count;)
  {
    const std::int32_t id = ids[i];
    const int begin = i;
    double sum = 0.0;
    for (; i < count && ids[i] == id; ++i)
    {
      sum += double(depths[i]);
    }
    if (id != 0)
    {
      parts[id].addRun({ { at[0] + begin, at[1], at[2] } }, i - begin, sum);
    }
  }
}

PartsOfPiece partsOf(const FibreField& field, const Pieces& pieces, std::size_t piece)
{
  const SampleRange range = pieces.samplesOf(piece);
  thread_local LabelBuffer buffer;
  const LabelImageView held = field.samplesAround(range, 0, buffer);
  const std::array<int, 3> begin = pieces.begin(piece);
  PartsOfPiece parts;
  for (int k = range.first[2]; k < range.first[2] + range.count[2]; ++k)
  {
    for (int j = range.first[1]; j < range.first[1] + range.count[1]; ++j)
    {
      const std::size_t row = held.grid.index(range.first[0], j, k);
      addRow(held.fibreId + row, held.depth + row, range.count[0], { { range.first[0] - begin[0], j - begin[1], k - begin[2] } },
        parts);
    }
  }
  return parts;
}

void add(std::size_t piece, const PartsOfPiece& parts, FoundFibres& found)
{
  for (const auto& [id, part] : parts)
  {
    FoundFibre& fibre = found[id];
    fibre.depths += part.depths;
    fibre.samples += part.samples;
    FoundBox& box = fibre.boxes.emplace_back();
    box.piece = std::uint32_t(piece);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      box.ends[axis] = std::uint8_t(part.first[axis] + FoundBox::pieceEdge * part.last[axis]);
    }
  }
}

std::string bytesOfParts(const PartsOfPiece& parts)
{
  ByteWriter put;
  for (const auto& [id, part] : parts)
  {
    put(id);
    put(part.depths);
    put(part.samples);
    put.addAll(part.first.data(), part.first.size());
    put.addAll(part.last.data(), part.last.size());
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
    get.getAll(part.first.data(), part.first.size());
    get.getAll(part.last.data(), part.last.size());
  }
  return parts;
}

/// The node of the sample at which a piece begins: node 1 is the field's first sample.
std::array<int, 3> firstNodeOf(const FibreField& field, std::size_t piece)
{
  std::array<int, 3> node = Pieces(field.samples()).begin(piece);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    node[axis] += 1 - field.samples().first[axis];
  }
  return node;
}

} // namespace

FoundFibres findFibres(const FibreField& field, const Context& context, const Sharing& sharing)
{
  require(field.lattice().blockCount() <= std::numeric_limits<std::uint32_t>::max(),
    "the label image has more blocks of 16³ voxels than 32 bits count: choose a larger VoxelSize");
  const Pieces pieces(field.samples());
  require(pieces.count() <= std::numeric_limits<std::uint32_t>::max(),
    "the label image has more pieces of 16³ voxels than 32 bits count: choose a larger VoxelSize");
  FoundFibres found;
  for (std::size_t first = 0; first < pieces.count(); first += piecesAtOnce)
  {
    std::vector<PartsOfPiece> parts(std::min(piecesAtOnce, pieces.count() - first));
    const auto done = [&](std::size_t end) { return 0.05 * static_cast<double>(end) / static_cast<double>(pieces.count()); };
    sharing.loop(
      parts.size(), context, [&](std::size_t i) { parts[i] = partsOf(field, pieces, first + i); },
      [&](std::size_t i) { return bytesOfParts(parts[i]); },
      [&](std::size_t i, const std::string& bytes) { parts[i] = partsFrom(bytes); }, "looking for fibres", done(first),
      done(first + parts.size()));
    for (std::size_t i = 0; i < parts.size(); ++i)
    {
      add(first + i, parts[i], found);
    }
  }
  return found;
}

NodeRange nodesOf(const FibreField& field, const FoundBox& box)
{
  const std::array<int, 3> begin = firstNodeOf(field, box.piece);
  NodeRange nodes;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const int first = box.ends[axis] % FoundBox::pieceEdge;
    nodes.first[axis] = begin[axis] + first;
    nodes.count[axis] = box.ends[axis] / FoundBox::pieceEdge - first + 1;
  }
  return nodes;
}

std::vector<std::uint32_t> piecesAt(const FibreField& field, const NodeRange& nodes)
{
  const SampleBox& samples = field.samples();
  std::array<int, 3> first{};
  std::array<int, 3> last{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    first[axis] = samples.sampleOf(axis, nodes.first[axis]);
    last[axis] = samples.sampleOf(axis, nodes.first[axis] + nodes.count[axis] - 1);
  }
  return Pieces(samples).holding(first, last);
}

NearBlocks blocksNear(const FibreField& field, const FoundFibre& fibre, int reach)
{
  const NodeLattice lattice = field.lattice();
  constexpr int size = NodeLattice::blockCells;
  const int farthest = std::max(reach, NearBlocks::around);
  struct Known
  {
    NodeRange inside;
    bool isNear = false;
  };
  std::map<std::uint32_t, Known> known;
  for (const FoundBox& box : fibre.boxes)
  {
    const NodeRange nodes = nodesOf(field, box);
    std::array<int, 3> first{};
    std::array<int, 3> last{};
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      // Of `size` cells, a block has a node more than that.
      first[axis] = std::max(0, (nodes.first[axis] - farthest - 1) / size);
      last[axis] = std::min(lattice.blocks(int(axis)) - 1, (nodes.first[axis] + nodes.count[axis] - 1 + farthest) / size);
    }
    for (int z = first[2]; z <= last[2]; ++z)
    {
      for (int y = first[1]; y <= last[1]; ++y)
      {
        for (int x = first[0]; x <= last[0]; ++x)
        {
          const std::size_t row = std::size_t(y) + std::size_t(lattice.blocks(1)) * std::size_t(z);
          const auto block = std::uint32_t(std::size_t(x) + std::size_t(lattice.blocks(0)) * row);
          const NodeRange own = nodesOfBlock(lattice, block);
          Known& here = known[block];
          here.inside = here.inside.joined(nodes.within(own.widened(NearBlocks::around)));
          here.isNear = here.isNear || nodes.within(own.widened(reach)).size() > 0;
        }
      }
    }
  }
  NearBlocks blocks;
  for (const auto& [block, here] : known)
  {
    if (here.isNear)
    {
      blocks.numbers.push_back(block);
      blocks.inside.push_back(here.inside);
    }
  }
  return blocks;
}

} // namespace cactus
