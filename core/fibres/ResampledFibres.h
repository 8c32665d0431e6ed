// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fibres/Fibres.h"

#include <cstddef>

namespace cactus
{

/// What resampling has changed.
struct Resampling
{
  std::size_t fibres = 0;        ///< that were resampled
  double largestDeviation = 0.0; ///< µm, of a control point that came in from the polyline that took its place
};

/// Spaces the control points of dense fibres 0.6 of their radius apart, and keeps all other fibres as they are.
///
/// A fibre is dense where the mean distance between its control points is below half its mean radius (of which 2.5 µm count at
/// most). Its ends stay, the new control points lie at equal lengths along the polyline, and the square of each radius is the
/// mean of the squared radius around that point, so that beads keep their volume. Fibres of BundleInitializer and TractFibres are
/// not dense.
///
/// The reason: the costs of a bend and of a stretch are per control point and fade with the distance between them (a bend's with
/// its third power), while an overlap pushes every control point alike. Chains of many short capsules therefore fold up when they
/// are optimised, and chains of few long ones become straighter than they came.
Resampling resampleDenseFibres(Fibres& fibres);

} // namespace cactus
