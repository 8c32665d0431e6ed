// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Context.h"
#include "io/FolderWriter.h"
#include "io/SubstrateContents.h"

namespace cactus
{

/// Returns the number of points in each compartment that walkers are to start from: as asked for, or as many as there are walkers
/// where the format needs them.
int startPointCount(const SubstrateFolderContents& contents);

/// Writes `start/intra.txt`, `start/myelin.txt` and `start/extra.txt`, as far as there are these compartments: one point a line,
/// `x y z`, in the unit of the simulator (MC/DC mm, the reference program µm, Camino and Disimpy m). Disimpy's count from the
/// lower corner of the box around the surfaces that hold the walkers in: inner ones for intra, outer ones for the others; points
/// out of that box are left out. Those of MC/DC's simulations are in the boxes where walkers are to start. Nothing where
/// startPointCount() is 0. Throws as drawStartPositions() does, and FileError.
void writeStartPositions(const SubstrateFolderContents& contents, const std::vector<McdcSimulation>& simulations,
  FolderWriter& writer, const Context& context);

} // namespace cactus
