// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Context.h"
#include "base/Domain.h"
#include "growth/LabelImage.h"
#include "mesh/Isosurface.h"

#include <cstdint>
#include <map>
#include <unordered_map>
#include <vector>

namespace cactus
{

/// A label image held by somebody else; see LabelImage for what its numbers mean.
struct LabelImageView
{
  VoxelGrid grid;
  const std::int32_t* fibreId = nullptr;
  const float* depth = nullptr;
  double gap = 0.0; ///< µm, the room that growth kept between two fibres; see FibreRadialGrowthOptions::gap
};

/// The fields of all fibres of a label image, in a box whose faces cut them off.
///
/// At the samples a field is what LabelImage says, and the sum of two fields is at most -gap. The lattice's inner planes run
/// through the samples, and its outermost ones are the faces of the box, where a field has the value of the sample beside it.
class FibreField
{
public:
  /// The box is `domain` or, with `clipToDomain` off, what the image's voxels fill. A domain that reaches beyond the image is cut
  /// off where the image ends. Throws InvalidInput where nothing is left, or the image is not a proper one.
  FibreField(const LabelImageView& image, const Domain& domain, bool clipToDomain);

  const LabelImageView& image() const { return this->Image; }
  /// What the lattice fills.
  const Domain& box() const { return this->Box; }
  /// Planes through the samples; the outermost ones are moved into the box by `inset` (µm, less than a quarter of a voxel).
  NodeLattice lattice(double inset = 0.0) const;

  /// Of each fibre, in increasing order of fibres, the blocks of the lattice with a node that belongs to it or has one at most
  /// `reach` nodes away. Throws InvalidInput for a negative FibreId, a Depth that is not finite or does not fit its FibreId, and
  /// Cancelled.
  std::map<std::int32_t, std::vector<std::uint32_t>> findFibres(int reach, const Context& context = {}) const;

  /// From now on smoothing spares thin fibres, which it would shrink and break: it does nothing in and beside those of a radius
  /// below two voxels, and all from four on. The radius is three times the mean depth of a fibre's samples, as in a round one.
  void spareThinFibres(const Context& context = {});
  /// How much of each pass of smoothing the nodes get that have a node before and behind in the range, from 0 to 1: the same for
  /// all fibres. False where that is 1 everywhere, and nothing has been written.
  bool smoothingAt(const NodeRange& range, float* out) const;

  /// The field of a fibre at a sample of the image.
  double atSample(std::int32_t fibre, int i, int j, int k) const;
  /// The field of a fibre at nodes of the lattice, where those beyond its faces are as the nearest one inside.
  void atNodes(std::int32_t fibre, const NodeRange& range, float* out) const;
  /// Where node 0 would be if it were as far from the first sample as that from the next, µm.
  Eigen::Vector3d firstNode() const;

private:
  /// Index in the image of the sample that a node takes its value from.
  int sampleOf(std::size_t axis, int node) const;
  /// Of a row of nodes, the samples that they take their values from, from the first one on.
  std::vector<int> columnsOf(const NodeRange& range) const;
  /// Of a sample outside all fibres that is nearer than gap/2 to one: to which, as its neighbours tell.
  std::int32_t nearest(int i, int j, int k) const;
  bool holds(int i, int j, int k) const;
  float field(std::int32_t fibre, std::size_t index, int i, int j, int k) const;

  LabelImageView Image;
  Domain Box;
  std::unordered_map<std::int32_t, float> Smoothing; ///< of thin fibres, below 1
  std::array<int, 3> First{ { 0, 0, 0 } };           ///< first sample used, per axis
  std::array<int, 3> Count{ { 0, 0, 0 } };           ///< number of samples used, per axis
};

/// The field of one fibre, smoothed, held for all blocks near the fibre.
///
/// Smoothing averages each node with its neighbours, (1 2 1)/4 along each axis in turn, or does so in part (see
/// FibreField::spareThinFibres()). That is a linear operation with weights that are positive, sum to 1 and are the same for all
/// fibres, so what holds for all fields goes on to hold: two of them sum to at most -gap, and none
/// changes by more than the distance between two samples. So surfaces of smoothed fields keep their gap, whatever the shape of
/// the fibres; on average over a convex part of radius r they move inwards by passes · spacing² / (4 r).
class SmoothedField
{
public:
  SmoothedField(const FibreField& field, std::int32_t fibre, std::vector<std::uint32_t> blocks, int passes);

  std::int32_t fibre() const { return this->Fibre; }
  const NodeLattice& lattice() const { return this->Lattice; }
  const std::vector<std::uint32_t>& blocks() const { return this->Blocks; }

  /// The field less `level` at the nodes of a block and one node beyond on every side, for contour(). Values nearer to 0 than
  /// `smallest` become ±smallest, so that the contour keeps off the nodes and gets no needles.
  void values(double level, double smallest, const NodeRange& around, float* out) const;
  /// The same of the field before it was smoothed, at level 0.
  void unsmoothedValues(double smallest, const NodeRange& around, float* out) const;

  /// The field at a point of the blocks: trilinear, and along each axis corrected for the curvature that the samples on either
  /// side agree on, as contour() does. A point beyond the outermost samples has the value of the nearest point among them; far
  /// from the fibre it is minus infinity.
  double value(const Eigen::Vector3d& at) const;

private:
  using Index = std::array<int, 3>; ///< a block by its place along each axis, or a cell

  /// The nodes held of a block, and where in Values they begin.
  struct Piece
  {
    NodeRange range;
    std::ptrdiff_t place;
  };
  /// Fills Values and Unsmoothed for some blocks.
  void smooth(const FibreField& field, std::int32_t fibre, const std::vector<Piece>& pieces, int passes);

  /// Number of a block in Places; none where it lies outside the box of the blocks held.
  std::ptrdiff_t placeOf(const Index& block) const;
  /// Copies what is held of a block, less `level` and kept off 0.
  void copyBlock(const std::vector<float>& held, double level, double smallest, const NodeRange& around, float* out) const;

  std::int32_t Fibre;
  NodeLattice Lattice;
  std::vector<std::uint32_t> Blocks;
  Eigen::Vector3d FirstNode;          ///< µm
  double NodesPerLength;              ///< per µm
  std::vector<float> Values;          ///< of each block held, and one node beyond on every side
  std::vector<float> Unsmoothed;      ///< the same before smoothing
  Index First{ { 0, 0, 0 } };         ///< the box of the blocks held: first one
  Index Count{ { 0, 0, 0 } };         ///< and how many
  Index Cells{ { 0, 0, 0 } };         ///< of the lattice
  std::vector<std::ptrdiff_t> Places; ///< per block of the box, where its values begin; -1: not held
};

} // namespace cactus
