// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Context.h"
#include "base/Domain.h"
#include "base/Properties.h"
#include "mesh/FibreSurfaces.h"

#include <cstdint>
#include <vector>

namespace cactus
{

/// The fibres that a lesion takes first.
enum class LesionOrder
{
  Thinnest,
  Random
};

/// Options of fibresInLesion().
struct LesionOptions
{
  double axonLoss = 0.0;   ///< fraction of the fibres' length, of fibres that are gone
  double myelinLoss = 0.0; ///< fraction of the myelinated length that is left, of axons that have lost their myelin
  LesionOrder order = LesionOrder::Thinnest;
  std::uint64_t seed = 1; ///< for LesionOrder::Random

  static const PropertyList<LesionOptions>& properties();
  /// Throws InvalidInput, naming the property, unless every value is within its range.
  void validate() const;
};

/// What a lesion leaves of a fibre.
enum class FibreInLesion
{
  Whole,
  WithoutMyelin, ///< its inner surface alone, which is the outer one then
  Gone
};

/// The fibres of a substrate with a lesion.
struct Lesion
{
  std::vector<FibreInLesion> fibres; ///< one for each outer surface
  double axonLoss = 0.0;             ///< as reached with whole fibres
  double myelinLoss = 0.0;
};

/// Chooses fibres for a lesion: in their order, as many as come nearest to the asked fraction of length. Fibres without an inner
/// surface, and axons without myelin, have none to lose. Radius and length are those of the cylinder with the volume of the outer
/// surface and the area of its wall. The same seed takes the same fibres, and more of them for a larger fraction. Throws
/// InvalidInput (options, a surface) and Cancelled.
Lesion fibresInLesion(const Domain& domain, const FibreSurfaces& outer, const FibreSurfaces& inner, const LesionOptions& options,
  const Context& context = {});

/// Returns the outer surfaces that are left; those without myelin are inner ones. `outer` and `inner` have to outlive the result.
FibreSurfaces outerInLesion(const Lesion& lesion, const FibreSurfaces& outer, const FibreSurfaces& inner);

/// Returns the inner surfaces that are left. `outer` and `inner` have to outlive the result.
FibreSurfaces innerInLesion(const Lesion& lesion, const FibreSurfaces& outer, const FibreSurfaces& inner);

} // namespace cactus
