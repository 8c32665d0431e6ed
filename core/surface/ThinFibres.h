// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "surface/FibreField.h"
#include "surface/FibreSurvey.h"

#include <cstdint>
#include <unordered_map>
#include <vector>

namespace cactus
{

/// The fibres of a label image that smoothing spares, since it would shrink and break them: those of a radius below two voxels
/// entirely, the others gradually less up to four voxels. The radius is three times the mean depth of a fibre's samples, as in a
/// round one. A fibre with a TargetRadius of six voxels or more is not among them, whatever its radius in the image.
class ThinFibres
{
public:
  /// Target radius, in voxels, from which on a fibre is not measured.
  static constexpr double thickTarget = 6.0;

  /// Measures `fibres`, those that may be thin; `field` has to outlive the object.
  ThinFibres(const FibreField& field, const FoundFibres& fibres);

  /// Writes the fraction of each smoothing pass, from 0 to 1, for the nodes that have a node before and behind in the range; it
  /// is the same for the fields of all fibres. Returns false if it is 1 everywhere; then `out` is not written. held: the image
  /// there.
  bool smoothingAt(const NodeRange& range, const LabelImageView& held, float* out) const;

private:
  /// Tells whether thin fibres may have samples in a range.
  bool areNear(const NodeRange& range) const;
  /// Writes the fraction of each node by itself, without its neighbours; 2 outside all fibres. Returns false if there is no thin
  /// fibre.
  bool smoothingInside(const NodeRange& range, const LabelImageView& held, float* out) const;

  const FibreField& Field;
  std::unordered_map<std::int32_t, float> Smoothing; ///< of thin fibres, below 1
  std::vector<bool> HoldsSome;                       ///< per piece (see FoundBox), up to the last one that holds thin fibres
};

} // namespace cactus
