// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Recollection.h"
#include "surface/FibreSurfacePair.h"

#include <cstddef>
#include <vector>

namespace cactus
{

/// Remembers how far a SurfaceMaker has come, so that it goes on from there after it was stopped or killed: what is known of a
/// fibre, without its meshes, which are in their stores before it is noted here. Several threads may note and recall different
/// fibres. This one remembers nothing.
class SurfaceJournal
{
public:
  virtual ~SurfaceJournal() = default;

  /// Whether a fibre's outer surface has been made, but not yet kept apart from others; then `pair` becomes what is known of it.
  virtual bool recallOuter(std::size_t, FibreSurfacePair&) const { return false; }
  virtual void noteOuter(std::size_t, const FibreSurfacePair&) {}
  /// All outer surfaces are made, and what is put into their store from now on are those that are moved.
  virtual void beginSpacing() {}
  /// The same for all of them, kept apart.
  virtual bool recallSpaced(std::vector<FibreSurfacePair>&) const { return false; }
  virtual void noteSpaced(const std::vector<FibreSurfacePair>&) {}
  /// Whether a fibre's inner surface has been made, for `gRatio` unless that is NaN.
  virtual bool recallInner(std::size_t, double, FibreSurfacePair&) const { return false; }
  virtual void noteInner(std::size_t, const FibreSurfacePair&) {}
  /// What was found while surfaces were kept apart.
  virtual Recollection findings() { return {}; }
};

} // namespace cactus
