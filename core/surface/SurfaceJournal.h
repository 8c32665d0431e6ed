// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Recollection.h"
#include "surface/FibreSurfacePair.h"

#include <cstddef>
#include <vector>

namespace cactus
{

/// Records the progress of a SurfaceMaker, so that it continues from there after it was stopped or killed: the record of a fibre
/// without its meshes, which are stored before the record. Thread-safe for different fibres. This base class records nothing.
class SurfaceJournal
{
public:
  virtual ~SurfaceJournal() = default;

  /// Tells whether a fibre's outer surface has been made, but not yet kept apart from others; then sets `pair` to its record.
  virtual bool recallOuter(std::size_t, FibreSurfacePair&) const { return false; }
  virtual void noteOuter(std::size_t, const FibreSurfacePair&) {}
  /// Marks that all outer surfaces are made; those stored from now on are moved ones.
  virtual void beginSpacing() {}
  /// Tells the same for all fibres, kept apart.
  virtual bool recallSpaced(std::vector<FibreSurfacePair>&) const { return false; }
  virtual void noteSpaced(const std::vector<FibreSurfacePair>&) {}
  /// Tells whether a fibre's inner surface has been made, for `gRatio` unless that is NaN.
  virtual bool recallInner(std::size_t, double, FibreSurfacePair&) const { return false; }
  virtual void noteInner(std::size_t, const FibreSurfacePair&) {}
  /// Returns the cache of keeping surfaces apart.
  virtual Recollection findings() { return {}; }
};

} // namespace cactus
