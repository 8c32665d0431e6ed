// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bundle/BundleInitializerOptions.h"
#include "fibres/Fibres.h"

namespace cactus
{

/// Varies the radii of fibres that are as thick everywhere, as a stage lays them with these options, whose radii are those before
/// growth.
///
/// What growth makes of it is allowed for: dense fibres get a calibre of their own from their neighbours (a deviation of 0.15 at
/// a volume fraction of 0.9, of 0.03 at 0.6), which is more than some ask for, and lose a part of that which they bring. The
/// deviation of a thin fibre is at most such that its axon's necks have a radius of 0.12 µm (0.22 µm in a
/// bundle of 0.9, where neighbours squeeze them), which images of 0.1 µm resolve; without myelin half of that, for images of
/// 0.05 µm. The process depends on seed, fibre id and the length from the fibre's middle, so that a longer fibre has the same
/// calibre where a shorter one is. Radii stay within limits::radius. Fibres get the TargetAxisRatio that is asked for.
void varyCalibre(const BundleInitializerOptions& options, Fibres& fibres);

/// Does the same, and keeps the volume of all fibres in the domain by a common factor: few fibres may be thicker or thinner there
/// than elsewhere by chance.
void varyCalibreInDomain(const BundleInitializerOptions& options, Fibres& fibres);

} // namespace cactus
