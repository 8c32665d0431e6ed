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
/// altogether, and less and less of the others up to four voxels. The radius is three times the mean depth of a fibre's samples,
/// as in a round one. A fibre that is to have six voxels or more (TargetRadius) is not among them, whatever became of it.
class ThinFibres
{
public:
  /// Voxels; target radius from which on a fibre is not looked at.
  static constexpr double thickTarget = 6.0;

  /// `field` has to outlive the object; `fibres` are those that may be thin.
  ThinFibres(const FibreField& field, const FoundFibres& fibres);

  /// How much of each pass of smoothing the nodes get that have a node before and behind in the range, from 0 to 1, which is the
  /// same for the fields of all fibres. False if that is 1 everywhere; then `out` is not written. held: the image there.
  bool smoothingAt(const NodeRange& range, const LabelImageView& held, float* out) const;

private:
  /// Whether thin fibres may have samples in a range.
  bool areNear(const NodeRange& range) const;
  /// Of each node by itself, whatever is beside it; 2 outside all fibres. False if there is no thin fibre.
  bool smoothingInside(const NodeRange& range, const LabelImageView& held, float* out) const;

  const FibreField& Field;
  std::unordered_map<std::int32_t, float> Smoothing; ///< of thin fibres, below 1
  std::vector<bool> HoldsSome;                       ///< per piece (see FoundBox), up to the last one that holds thin fibres
};

} // namespace cactus
