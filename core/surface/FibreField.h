// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Domain.h"
#include "growth/LabelImage.h"
#include "growth/LabelSource.h"
#include "mesh/NodeLattice.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>

namespace cactus
{

/// The samples that give a row of nodes along x its values: each sample has one node, the first and the last one have more.
struct SampleRow
{
  int first = 0;  ///< index in the image
  int count = 0;  ///< number of samples, at least one
  int before = 0; ///< number of nodes before the first sample's node, with the same value
  int behind = 0; ///< number of nodes behind the last sample's node, with the same value

  /// Copies values to the rim of a row; those of the samples are in place.
  template <typename Value>
  void fillRim(Value* nodes) const
  {
    std::fill(nodes, nodes + this->before, nodes[this->before]);
    Value* last = nodes + this->before + this->count - 1;
    std::fill(last + 1, last + 1 + this->behind, *last);
  }
  int nodes() const { return this->before + this->count + this->behind; }
};

/// The samples of a label image in a box, and their assignment to the nodes of a lattice: node 1 has the first sample and so on;
/// nodes beyond the first and the last sample have the values of these.
struct SampleBox
{
  std::array<int, 3> first{ { 0, 0, 0 } }; ///< index in the image, per axis
  std::array<int, 3> count{ { 0, 0, 0 } };
  /// Whether samples repeat beyond the box, per axis: nodes beyond then have those that follow.
  std::array<bool, 3> repeats{ { false, false, false } };

  int sampleOf(std::size_t axis, int node) const
  {
    return this->first[axis] + (this->repeats[axis] ? node - 1 : std::clamp(node - 1, 0, this->count[axis] - 1));
  }
  /// Returns the row of samples for the rows of nodes of a range.
  SampleRow rowOf(const NodeRange& range) const;
};

/// The fields of all fibres of a label image, in a box whose faces cut them off.
///
/// At the samples, a field is defined as in LabelImage, and the sum of two fields is at most -gap. The lattice's inner planes run
/// through the samples, and its outermost ones are the faces of the box, where a field has the value of the sample beside it.
///
/// Where the domain is periodic, the samples repeat beyond its faces, and a field has the mean of the samples on both sides
/// there: the same on two opposite faces, bit for bit.
class FibreField
{
public:
  /// The box is `domain` or, with `clipToDomain` off, the extent of the image's voxels. A domain that reaches beyond the image is
  /// cut off where the image ends. Throws InvalidInput if nothing is left, if the image is invalid, or if the domain is periodic
  /// and the image is not exactly that.
  FibreField(std::shared_ptr<const LabelSource> image, const Domain& domain, bool clipToDomain);
  /// Uses an image in memory.
  FibreField(const LabelImageView& image, const Domain& domain, bool clipToDomain);

  /// Returns the samples of the whole image.
  const VoxelGrid& grid() const { return this->Image->grid(); }
  /// Returns null if fibres are known only from the samples.
  const KnownFibres* knownFibres() const { return this->Image->knownFibres(); }
  /// Returns the box that the lattice fills.
  const Domain& box() const { return this->Box; }
  const SampleBox& samples() const { return this->Samples; }
  /// Returns the periodic faces of the box, as bits (see CappedSurface::held).
  std::uint8_t heldFaces() const;
  /// Returns the lattice with planes through the samples; the outermost ones are moved into the box by `inset` (µm, less than a
  /// quarter of a voxel), to a number in single precision.
  NodeLattice lattice(double inset = 0.0) const;

  /// Returns the image at the samples that give a range of nodes its values, and at up to `more` samples beyond.
  LabelImageView samplesAt(const NodeRange& range, int more, LabelBuffer& buffer) const;
  /// Does the same for a range of samples.
  LabelImageView samplesAround(const SampleRange& range, int more, LabelBuffer& buffer) const;

  /// Returns the image around a range of nodes, as far as atNodes() reads it.
  LabelImageView samplesFor(const NodeRange& range, LabelBuffer& buffer) const;
  /// Computes the field of a fibre at nodes of the lattice; nodes beyond its faces have the value of the nearest one inside.
  /// held: the result of samplesFor() for the range.
  void atNodes(std::int32_t fibre, const NodeRange& range, const LabelImageView& held, float* out) const;
  /// Returns the position (µm) of node 0 as if it were one spacing before the first sample.
  Eigen::Vector3d firstNode() const;

private:
  /// Returns the fibre nearest to a sample that is outside all fibres but nearer than gap/2 to one, judged by its neighbours.
  std::int32_t nearest(const LabelImageView& held, int i, int j, int k) const;
  bool isNearest(const LabelImageView& held, std::int32_t fibre, int i, int j, int k) const;
  bool holds(int i, int j, int k) const;
  LabelImageView repeated(const SampleRange& range, LabelBuffer& buffer) const;
  float field(const LabelImageView& held, std::int32_t fibre, std::size_t index, int i, int j, int k) const;

  std::shared_ptr<const LabelSource> Image;
  Domain Box;
  SampleRange All; ///< samples of the image
  SampleBox Samples;
};

} // namespace cactus
