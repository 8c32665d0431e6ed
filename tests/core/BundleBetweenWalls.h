// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bundle/BundleInitializerOptions.h"

namespace cactus
{

/// Options of a small bundle of whole fibres, which lie within the domain.
struct BundleBetweenWalls : BundleInitializerOptions
{
  BundleBetweenWalls()
  {
    this->border = Border::Walls;
    this->correlationLength = 0.0;
  }
};

} // namespace cactus
