// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/NodeLattice.h"
#include "surface/FibreField.h"
#include "surface/NearBlocks.h"
#include "surface/ThinFibres.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace cactus
{

typedef float FourFloats __attribute__((vector_size(16)));

/// The smoothed field of one fibre, stored for all blocks near the fibre.
///
/// Smoothing averages each node with its neighbours, (1 2 1)/4 along each axis in turn, or does so in part (see ThinFibres). This
/// is a linear operation with positive weights that sum to 1 and are the same for all fibres, so properties of all fields are
/// preserved: two of them sum to at most -gap, and none changes by more than the distance between two samples. So surfaces of
/// smoothed fields keep their gap, whatever the shape of the fibres; on average over a convex part of radius r they move inwards
/// by passes · spacing² / (4 r).
class SmoothedField
{
public:
  /// Smooths in `passes` passes, which spare `thin` fibres, if given. blocks: those near the fibre, with a reach of `passes`
  /// nodes; a block is dropped if a box is near it but none of the box's samples.
  SmoothedField(const FibreField& field, std::int32_t fibre, NearBlocks blocks, int passes, const ThinFibres* thin = nullptr);

  std::int32_t fibre() const { return this->Fibre; }
  const NodeLattice& lattice() const { return this->Lattice; }
  const std::vector<std::uint32_t>& blocks() const { return this->Blocks; }

  /// Tells whether samples repeat beyond the box along an axis.
  bool repeats(std::size_t axis) const { return this->Repeats[axis]; }

  /// Writes the field minus `level` at the nodes of a block and one node beyond on every side, for contour(). Values nearer to 0
  /// than `smallest` become ±smallest, so that the contour keeps off the nodes and gets no needles. Three nodes or more away from
  /// the fibre, they may be far lower than the field.
  void values(double level, double smallest, const NodeRange& around, float* out) const;
  /// Does the same for the unsmoothed field, at level 0.
  void unsmoothedValues(double smallest, const NodeRange& around, float* out) const;

  /// Returns the position (µm) of the sample from which a node has its value; samples beyond a periodic face are those inside the
  /// opposite one.
  Eigen::Vector3d sampleAt(const std::array<int, 3>& node) const;

  /// Numbers for the nodes of each of blocks() and one node beyond on every side, x fastest.
  using NodeNumbers = std::vector<std::vector<float>>;
  /// Returns the field, smoothed and unsmoothed, minus a number for each node.
  SmoothedField lowered(const NodeNumbers& by) const;

  /// Returns the field at a point of the blocks: trilinear, and along each axis corrected for the curvature that the samples on
  /// either side agree on, as in contour(). A point beyond the outermost samples has the value of the nearest point among them;
  /// far from the fibre it is very low, or minus infinity.
  double value(const Eigen::Vector3d& at) const;

private:
  using Index = std::array<int, 3>; ///< a block by its place along each axis, or a cell

  /// Where the values of a block and one node beyond on every side are stored.
  struct BlockPlace
  {
    float* values = nullptr;              ///< null: not stored
    float* unsmoothed = nullptr;          ///< the same before smoothing
    std::array<std::int32_t, 2> stride{}; ///< from a node to the next along y and z
  };
  /// The nodes of a block and those around it that are stored.
  struct Piece
  {
    NodeRange range;
    NodeRange inside; ///< box that holds the fibre's samples in them and around them
    BlockPlace* place;
  };
  /// Groups the blocks that are smoothed together.
  std::vector<std::vector<Piece>> layOut(const std::vector<NodeRange>& inside, bool inCubes);
  /// Computes the values of those of some blocks that are near the fibre.
  void smooth(const FibreField& field, const std::vector<Piece>& pieces, int passes, const ThinFibres* thin);
  std::vector<Piece> place(const std::vector<Piece>& pieces, int reach, const std::vector<float>& values, const NodeRange& range);
  /// Fills some blocks with the values of a range where they are `known`; elsewhere with a value far outside.
  static void copyPieces(const std::vector<float>& from, const NodeRange& range, const NodeRange& known,
    const std::vector<Piece>& pieces, float* BlockPlace::*to);

  /// A point by the cell between samples that contains it, or the nearest one.
  struct CellPlace
  {
    Index cell;
    FourFloats t;        ///< position in the cell along each axis, from 0 to 1
    const float* corner; ///< value at the cell's lower corner; null far from the fibre
    std::array<std::int32_t, 2> stride;
  };
  CellPlace placeAt(const Eigen::Vector3d& at) const;
  FourFloats bends(const std::array<FourFloats, 4>& along, int cell, std::size_t axis) const;

  /// Returns the place of a block; null if it lies outside the box of stored blocks.
  const BlockPlace* placeOf(const Index& block) const;
  /// Copies the stored values of a block, minus `level` and kept off 0.
  void copyBlock(float* BlockPlace::*held, double level, double smallest, const NodeRange& around, float* out) const;
  void meanOnFaces(const NodeRange& around, float* values) const;

  std::int32_t Fibre;
  NodeLattice Lattice;
  std::array<bool, 3> Repeats;
  std::vector<std::uint32_t> Blocks;
  Eigen::Vector3d FirstNode;                    ///< µm
  double NodesPerLength;                        ///< per µm
  std::vector<std::shared_ptr<float[]>> Values; ///< of blocks that were smoothed together
  Index First{ { 0, 0, 0 } };                   ///< first one of the box of stored blocks
  Index Count{ { 0, 0, 0 } };                   ///< and their number
  Index Cells{ { 0, 0, 0 } };                   ///< of the lattice
  std::array<double, 3> LastSample{};           ///< last node that is a sample, or the face where samples repeat
  Index LastCell{ { 1, 1, 1 } };                ///< last cell that begins at a sample, and ends at another if there are two
  std::vector<BlockPlace> Places;               ///< per block of the box
};

} // namespace cactus
