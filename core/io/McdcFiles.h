// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Context.h"
#include "io/FolderWriter.h"
#include "io/SubstrateContents.h"

namespace cactus
{

/// The simulation inside, and, where there are outer surfaces, the one outside, of a folder for MC/DC: with steps that fit the
/// narrowest of `files`.
std::vector<McdcSimulation> mcdcSimulations(const SubstrateFolderContents& contents, const std::vector<SubstrateFile>& files);

/// Writes `mcdc/`: the configurations of both simulations, their lists of surfaces and the acquisition. Finds out which share of
/// the walkers outside leaves, where surfaces are closed, and notes it, with a remark where it is too large, in `substrate`.
/// Throws FileError and Cancelled.
void writeMcdc(const SubstrateFolderContents& contents, const std::vector<McdcSimulation>& simulations,
  WrittenSubstrate& substrate, FolderWriter& writer, const Context& context);

} // namespace cactus
