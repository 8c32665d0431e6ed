// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Context.h"
#include "base/Domain.h"
#include "io/FolderWriter.h"
#include "io/SubstrateContents.h"

namespace cactus
{

/// The box (µm) in which walkers stay: the domain, with faces a little inside of it, so that they do not coincide with the ends
/// of fibres.
Domain mcmrBox(const Domain& domain);

/// Writes `geometry.json`, which MCMRSimulator.jl (Cottaar et al. 2026, Imaging Neuroscience; version 1.1.0) reads as its
/// geometry: a Mesh of all outer surfaces, one of all inner ones, as far as there are any, and Walls at the faces of mcmrBox(),
/// where walkers would leave the substrate. A periodic domain has `repeats` instead (around the origin, as that program's are).
/// Lengths are µm, with the digits of the PLY files; corners are counted from 1, and MCMRSimulator.jl takes the surfaces of a
/// Mesh apart by itself. Throws FileError and Cancelled.
void writeMcmrGeometry(const SubstrateFolderContents& contents, FolderWriter& writer, const Context& context);

} // namespace cactus
