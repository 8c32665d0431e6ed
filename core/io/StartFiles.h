// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Context.h"
#include "io/FolderWriter.h"
#include "io/SubstrateContents.h"

namespace cactus
{

/// Writes `start/intra.txt`, `start/myelin.txt` and `start/extra.txt`, as far as there are these compartments: one point a line,
/// `x y z`, in the unit of the simulator (MC/DC mm, the reference program and MCMRSimulator.jl µm, Camino and Disimpy m).
/// Disimpy's count from the lower corner of the box around the surfaces that hold the walkers in: inner ones for intra, outer
/// ones for the others; points out of that box are left out. Nothing where contents.startPositions is 0. Throws as
/// drawStartPositions() does, and FileError.
void writeStartPositions(const SubstrateFolderContents& contents, FolderWriter& writer, const Context& context);

} // namespace cactus
