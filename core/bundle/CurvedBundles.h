// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Context.h"
#include "bundle/CurvedBundlesOptions.h"
#include "fibres/Fibres.h"

namespace cactus
{

/// Lays fibres along guide curves (see guideCurve()): in a bundle that bends, in one that fans out, or in two that kiss.
///
/// Circles of the sampled radii are packed without overlap to the requested density, like those on a bundle's face (see
/// initialiseBundles()), in the plane in which all guide curves have the direction z. Each circle follows the curve through its
/// centre, at its y. Neighbours keep their distance or part, so that no fibres overlap. A fibre reaches beyond the domain with
/// its margin by its own (target) radius; fibres that do not come so near are left out. No side of the domain is a wall.
///
/// grownFraction is that of the options in proportion to what the fibres fill of the domain.
///
/// Throws InvalidInput (see CurvedBundlesOptions::validate()), Infeasible if the density cannot be met, OutOfMemory, Cancelled.
/// Gives the same bits on any number of threads. `fibreVolumeFraction`, if given, receives the volume of the capsules in the
/// domain over the domain's volume.
Fibres layCurvedBundles(const CurvedBundlesOptions& options, const Context& context = {}, double* fibreVolumeFraction = nullptr);

} // namespace cactus
