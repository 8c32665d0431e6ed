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

/// The samples that a row of nodes along x takes its values from: each has one node, the first and the last one some more.
struct SampleRow
{
  int first = 0;  ///< index in the image
  int count = 0;  ///< of samples, at least one
  int before = 0; ///< nodes that have the value of the first sample's node, which follows them
  int behind = 0; ///< nodes that have that of the last one's, and follow it

  /// Copies values where the rim of a row has them; those of the samples are in their places.
  template <typename Value>
  void fillRim(Value* nodes) const
  {
    std::fill(nodes, nodes + this->before, nodes[this->before]);
    Value* last = nodes + this->before + this->count - 1;
    std::fill(last + 1, last + 1 + this->behind, *last);
  }
  int nodes() const { return this->before + this->count + this->behind; }
};

/// The samples of a label image that lie in a box, and which of them the nodes of a lattice take their values from: node 1 from
/// the first one and so on, and those beyond the first and the last one from these.
struct SampleBox
{
  std::array<int, 3> first{ { 0, 0, 0 } }; ///< index in the image, per axis
  std::array<int, 3> count{ { 0, 0, 0 } };

  int sampleOf(std::size_t axis, int node) const { return this->first[axis] + std::clamp(node - 1, 0, this->count[axis] - 1); }
  /// Of the rows of nodes of a range.
  SampleRow rowOf(const NodeRange& range) const;
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
  FibreField(std::shared_ptr<const LabelSource> image, const Domain& domain, bool clipToDomain);
  /// Of an image in memory.
  FibreField(const LabelImageView& image, const Domain& domain, bool clipToDomain);

  /// The samples of the whole image.
  const VoxelGrid& grid() const { return this->Image->grid(); }
  /// Null where only samples tell of fibres.
  const KnownFibres* knownFibres() const { return this->Image->knownFibres(); }
  /// What the lattice fills.
  const Domain& box() const { return this->Box; }
  const SampleBox& samples() const { return this->Samples; }
  /// Planes through the samples; the outermost ones are moved into the box by `inset` (µm, less than a quarter of a voxel), to
  /// where single precision has a number.
  NodeLattice lattice(double inset = 0.0) const;

  /// The image at the samples that a range of nodes takes its values from, and at those up to `more` beyond.
  LabelImageView samplesAt(const NodeRange& range, int more, LabelBuffer& buffer) const;
  /// The same for a range of samples.
  LabelImageView samplesAround(const SampleRange& range, int more, LabelBuffer& buffer) const;

  /// The field of a fibre at a sample of the image.
  double atSample(std::int32_t fibre, int i, int j, int k) const;
  /// The image as far around a range of nodes as atNodes() looks.
  LabelImageView samplesFor(const NodeRange& range, LabelBuffer& buffer) const;
  /// The field of a fibre at nodes of the lattice, where those beyond its faces are as the nearest one inside. held: samplesFor()
  /// the range.
  void atNodes(std::int32_t fibre, const NodeRange& range, const LabelImageView& held, float* out) const;
  /// Where node 0 would be if it were as far from the first sample as that from the next, µm.
  Eigen::Vector3d firstNode() const;

private:
  /// Of a sample outside all fibres that is nearer than gap/2 to one: to which, as its neighbours tell.
  std::int32_t nearest(const LabelImageView& held, int i, int j, int k) const;
  bool isNearest(const LabelImageView& held, std::int32_t fibre, int i, int j, int k) const;
  bool holds(int i, int j, int k) const;
  float field(const LabelImageView& held, std::int32_t fibre, std::size_t index, int i, int j, int k) const;

  std::shared_ptr<const LabelSource> Image;
  Domain Box;
  SampleRange All; ///< samples of the image
  SampleBox Samples;
};

} // namespace cactus
