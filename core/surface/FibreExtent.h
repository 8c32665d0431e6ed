// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "surface/SmoothedField.h"

#include <vector>

namespace cactus
{

// What the samples inside a fibre tell of its size.

/// The field (µm) at each sample of the image at which it is positive.
std::vector<float> depthsOf(const SmoothedField& field);

/// Length (µm) of the line through the centroids of the fibre's slices across its principal axis; `spacing` is that of the
/// samples, and the length of a fibre without any.
double lengthOf(const SmoothedField& field, double spacing);

} // namespace cactus
