// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bundle/BundleInitializerOptions.h"

namespace cactus
{

/// Returns options of fibres that are as thick everywhere, and dense before growth, for tests of where they run.
template <typename Options = BundleInitializerOptions>
Options ofPipes(Options options = {})
{
  options.calibre.deviation = 0.0;
  options.fibreVolumeFraction = 0.7;
  return options;
}

/// Options of a small bundle of such fibres, which lie within the domain as wholes.
struct BundleBetweenWalls : BundleInitializerOptions
{
  BundleBetweenWalls()
    : BundleInitializerOptions(ofPipes())
  {
    this->border = Border::Walls;
    this->correlationLength = 0.0;
  }
};

} // namespace cactus
