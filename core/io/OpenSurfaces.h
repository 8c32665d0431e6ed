// SPDX-License-Identifier: BSD-3-Clause
// The open tile of a periodic substrate: its surfaces without the caps in the faces across which it repeats.
#pragma once

#include "base/Context.h"
#include "base/Sharing.h"
#include "io/SubstrateContents.h"

#include <string>
#include <vector>

namespace cactus
{

/// Returns how surfaces end in periodic faces, Caps or Open. ByFormat is Open for a periodic domain in MC/DC's format, which with
/// caps lets walkers into fibres unnoticed, and Caps otherwise.
PeriodicFaces facesFor(PeriodicFaces asked, SubstrateFormat format, const Domain& domain, bool allowOpenSurfaces);

/// Throws InvalidInput if an open tile is asked for in a format whose reader needs closed surfaces, or with surfaces that need
/// not be closed.
void requireOpenable(PeriodicFaces faces, SubstrateFormat format, bool allowOpenSurfaces);

/// Throws InvalidInput if an open tile is asked for of a domain that is not periodic.
void requirePeriodic(PeriodicFaces faces, const Domain& domain);

/// Returns surfaces (`kind` outer or inner) without their caps in periodic faces, see openAtPeriodicFaces(). Its meshes throw
/// InvalidInput, with the name of the fibre, where copies would not join.
FibreSurfaces openedSurfaces(const FibreSurfaces& surfaces, const std::string& kind, const Domain& domain);

/// Puts triangles and areas of the opened surfaces into the manifest's entries, in the order of `surfaces`. Throws InvalidInput
/// if an axon that is extended to the faces would meet its outer surface or itself. Processes share the work.
void describeOpened(const SubstrateFolderContents& contents, const std::string& kind, std::vector<SubstrateFile>& files,
  const Context& context, const Sharing& sharing, double from, double to);

} // namespace cactus
