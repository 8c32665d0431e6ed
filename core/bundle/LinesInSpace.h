// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Context.h"
#include "bundle/BundleInitializerOptions.h"
#include "fibres/Fibres.h"

namespace cactus
{

/// Lays straight fibres of bundles with any distribution of directions (see orientedBundles()) evenly in space, so that their
/// lengths in the domain have that distribution by volume. Directions and places together follow a low-discrepancy
/// sequence (Halton 1960, Numer Math 2:84) with a random shift, thick fibres first. There are as many as fill the fraction asked
/// for, and they end a little outside the domain.
///
/// Fibres overlap as chance has it, more than those of a packed bundle. Throws as initialiseBundles() does.
Fibres layLinesInSpace(const BundleInitializerOptions& options, const Context& context);

} // namespace cactus
