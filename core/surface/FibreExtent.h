// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "surface/SmoothedField.h"

namespace cactus
{

/// Returns the length (µm) of the line through the centroids of the fibre's slices across its principal axis. `spacing` is that
/// of the samples, and the result for a fibre without any.
double lengthOf(const SmoothedField& field, double spacing);

} // namespace cactus
