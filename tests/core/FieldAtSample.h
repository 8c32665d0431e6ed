// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "surface/FibreField.h"

/// Returns the field of a fibre at a sample of the image.
inline double fieldAtSample(const cactus::FibreField& field, std::int32_t fibre, int i, int j, int k)
{
  const std::array<int, 3>& first = field.samples().first;
  const cactus::NodeRange node{ { { i - first[0] + 1, j - first[1] + 1, k - first[2] + 1 } }, { { 1, 1, 1 } } };
  cactus::LabelBuffer buffer;
  float value = 0.0f;
  field.atNodes(fibre, node, field.samplesFor(node, buffer), &value);
  return double(value);
}
