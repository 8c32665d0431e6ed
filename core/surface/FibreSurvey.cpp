// SPDX-License-Identifier: BSD-3-Clause
#include "surface/FibreSurvey.h"

#include "base/Bytes.h"
#include "base/Error.h"
#include "base/Limits.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace cactus
{

namespace
{

constexpr std::size_t piecesAtOnce = std::size_t(1) << 16;

/// The samples of a fibre in one piece.
struct PartOfFibre
{
  double depths = 0.0;
  double samples = 0.0;
  std::array<std::uint8_t, 3> first{ { ImagePieces::edge, ImagePieces::edge, ImagePieces::edge } }; ///< first sample in the piece
  std::array<std::uint8_t, 3> last{ { 0, 0, 0 } };

  /// Adds samples in a row along x. at: place of the first one in the piece.
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

/// Throws unless a row belongs to a label image.
void checkRow(const std::int32_t* ids, const float* depths, int count)
{
  constexpr auto deepest = float(limits::coordinate.highest); // more than any fibre's radius
  int isWithin = 1;
  int fits = 1;
  std::int32_t least = 0;
  for (int i = 0; i < count; ++i)
  {
    isWithin &= int(std::abs(depths[i]) <= deepest); // false for NaN
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

/// Calls visit(ids, depths, count, at) for each row of a piece's samples; `at` is the place of the first one in the piece.
template <typename Visit>
void forEachRow(const FibreField& field, const ImagePieces& pieces, std::size_t piece, Visit&& visit)
{
  const SampleRange range = pieces.samplesOf(piece);
  LabelBuffer buffer;
  const LabelImageView held = field.samplesAround(range, 0, buffer);
  const std::array<int, 3> begin = pieces.begin(piece);
  for (int k = range.first[2]; k < range.first[2] + range.count[2]; ++k)
  {
    for (int j = range.first[1]; j < range.first[1] + range.count[1]; ++j)
    {
      const std::size_t row = held.grid.index(range.first[0], j, k);
      visit(held.fibreId + row, held.depth + row, range.count[0],
        std::array<int, 3>{ { range.first[0] - begin[0], j - begin[1], k - begin[2] } });
    }
  }
}

/// Adds a row's samples; part(id) returns the sum for a fibre, or null.
template <typename Part>
void addRow(const std::int32_t* ids, const float* depths, int count, const std::array<int, 3>& at, Part&& part)
{
  for (int i = 0; i < count;)
  {
    const std::int32_t id = ids[i];
    const int begin = i;
    double sum = 0.0;
    for (; i < count && ids[i] == id; ++i)
    {
      sum += double(depths[i]);
    }
    if (PartOfFibre* own = part(id))
    {
      own->addRun({ { at[0] + begin, at[1], at[2] } }, i - begin, sum);
    }
  }
}

PartsOfPiece partsOf(const FibreField& field, const ImagePieces& pieces, std::size_t piece)
{
  PartsOfPiece parts;
  forEachRow(field, pieces, piece,
    [&](const std::int32_t* ids, const float* depths, int count, const std::array<int, 3>& at)
    {
      checkRow(ids, depths, count);
      addRow(ids, depths, count, at, [&](std::int32_t id) { return id != 0 ? &parts[id] : nullptr; });
    });
  return parts;
}

/// Returns a part without samples if the piece has none.
PartOfFibre partOf(const FibreField& field, const ImagePieces& pieces, std::size_t piece, std::int32_t fibre)
{
  PartOfFibre part;
  forEachRow(field, pieces, piece,
    [&](const std::int32_t* ids, const float* depths, int count, const std::array<int, 3>& at)
    {
      int isHere = 0; // false for most rows
      for (int i = 0; i < count; ++i)
      {
        isHere |= int(ids[i] == fibre);
      }
      if (isHere != 0)
      {
        addRow(ids, depths, count, at, [&](std::int32_t id) { return id == fibre ? &part : nullptr; });
      }
    });
  return part;
}

void add(std::size_t piece, const PartOfFibre& part, FoundFibre& fibre)
{
  fibre.depths += part.depths;
  fibre.samples += part.samples;
  FoundBox& box = fibre.boxes.emplace_back();
  box.piece = std::uint32_t(piece);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    box.ends[axis] = std::uint8_t(part.first[axis] + ImagePieces::edge * part.last[axis]);
  }
}

auto membersOf(PartOfFibre& part)
{
  return std::tie(part.depths, part.samples, part.first, part.last);
}

/// Returns the node of the first sample of a piece: node 1 is the field's first sample.
std::array<int, 3> firstNodeOf(const FibreField& field, std::size_t piece)
{
  std::array<int, 3> node = ImagePieces(field.samples()).begin(piece);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    node[axis] += 1 - field.samples().first[axis];
  }
  return node;
}

/// Finds fibres in the pieces pieceAt(0), pieceAt(1) …, increasing; isWanted(id) selects the fibres.
template <typename PieceAt, typename IsWanted>
FoundFibres findThem(const FibreField& field, std::size_t count, const PieceAt& pieceAt, const IsWanted& isWanted,
  const Context& context, const Sharing& sharing)
{
  const ImagePieces pieces(field.samples());
  FoundFibres found;
  for (std::size_t first = 0; first < count; first += piecesAtOnce)
  {
    std::vector<PartsOfPiece> parts(std::min(piecesAtOnce, count - first));
    const auto done = [&](std::size_t end) { return shareOfLooking * static_cast<double>(end) / static_cast<double>(count); };
    sharing.loop(
      parts.size(), context, [&](std::size_t i) { parts[i] = partsOf(field, pieces, pieceAt(first + i)); },
      [&](std::size_t i) { return bytesOf(parts[i]); }, [&](std::size_t i, const std::string& bytes) { getAll(bytes, parts[i]); },
      "looking for fibres", done(first), done(first + parts.size()));
    for (std::size_t i = 0; i < parts.size(); ++i)
    {
      for (const auto& [id, part] : parts[i])
      {
        if (isWanted(id))
        {
          add(pieceAt(first + i), part, found[id]);
        }
      }
    }
  }
  return found;
}

} // namespace

FoundFibres findFibres(const FibreField& field, const Context& context, const Sharing& sharing)
{
  return findThem(
    field, ImagePieces(field.samples()).count(), [](std::size_t i) { return i; }, [](std::int32_t) { return true; }, context,
    sharing);
}

FoundFibres findFibres(
  const FibreField& field, const std::set<std::int32_t>& fibres, const Context& context, const Sharing& sharing)
{
  return findThem(
    field, ImagePieces(field.samples()).count(), [](std::size_t i) { return i; },
    [&](std::int32_t id) { return fibres.count(id) != 0; }, context, sharing);
}

FoundFibres findFibres(const FibreField& field, const std::set<std::int32_t>& fibres, const std::vector<std::uint32_t>& pieces,
  const Context& context, const Sharing& sharing)
{
  return findThem(
    field, pieces.size(), [&](std::size_t i) { return std::size_t(pieces[i]); },
    [&](std::int32_t id) { return fibres.count(id) != 0; }, context, sharing);
}

FoundFibre findFibre(const FibreField& field, std::int32_t fibre, const std::vector<std::uint32_t>& pieces)
{
  const ImagePieces all(field.samples());
  FoundFibre found;
  for (const std::uint32_t piece : pieces)
  {
    const PartOfFibre part = partOf(field, all, piece, fibre);
    if (part.samples > 0.0)
    {
      add(piece, part, found);
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
    const int first = box.ends[axis] % ImagePieces::edge;
    nodes.first[axis] = begin[axis] + first;
    nodes.count[axis] = box.ends[axis] / ImagePieces::edge - first + 1;
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
    const int end = samples.first[axis] + samples.count[axis] - 1;
    if (first[axis] < samples.first[axis] || last[axis] > end)
    {
      // What lies beyond a periodic face is elsewhere along the axis.
      first[axis] = samples.first[axis];
      last[axis] = end;
    }
  }
  return ImagePieces(samples).holding(first, last);
}

} // namespace cactus
