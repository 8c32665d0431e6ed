// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Context.h"
#include "io/FolderWriter.h"
#include "io/SubstrateContents.h"

namespace cactus
{

/// Writes `start/intra.txt`, `start/myelin.txt` and `start/extra.txt` for the existing compartments: one point per line, `x y z`,
/// in the unit of the simulator (MC/DC mm, the reference program µm, Camino and Disimpy m). Disimpy's coordinates start at the
/// lower corner of the box around the surfaces that confine the walkers: inner ones for intra, outer ones for the others; points
/// outside that box are left out. Writes nothing if contents.startPositions is 0. Throws as drawStartPositions() does, and
/// FileError.
void writeStartPositions(const SubstrateFolderContents& contents, FolderWriter& writer, const Context& context);

} // namespace cactus
