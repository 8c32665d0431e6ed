// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Context.h"
#include "base/Sharing.h"
#include "io/SubstrateContents.h"

#include <string>

namespace cactus
{

/// Throws InvalidInput if a format's files do not exist in an encoding.
void requireEncoding(SubstrateFormat format, PlyEncoding encoding);

/// Throws InvalidInput if a format cannot hold a substrate of this domain: the reference program requires a cube centred on the
/// origin, RMS one that voxels of this size (µm) fill.
void requireRoom(SubstrateFormat format, const Domain& domain, double voxelSize);

/// Writes a folder for simulators:
///
///   outer/fibre_00001.ply, inner/…   PLY, µm, one file per fibre and surface; of more than 1,000 fibres
///                                    outer/00000/fibre_00001.ply, where the ids from 0 to 999 are, and so on;
///                                    with an id above 99,999 all have six digits or more, as many as the largest
///   mcdc/intra.conf, mcdc/extra.conf MC/DC configurations that run as written, with lists of the surfaces and a PGSE scheme
///   fibres.strands                   the centre lines, where given, by increasing id, of a domain centred on the
///                                    origin
///   certificate.csv, certificate_fibres.csv   what certify() found on the surfaces as written
///   manifest.json, README.txt
///
/// The folder appears whole or not at all, and its name refers to a whole folder, the former or the new one, at any time (see
/// FolderReplacement). An existing one is replaced if it is a substrate folder in which everything is as written, by the
/// checksums in its manifest; it is refused, by name, if anything was added, changed or write-protected: results of simulations,
/// an edited configuration, notes. Surfaces that meet or come too near are written, and their certificate says so. Throws
/// InvalidInput (no surfaces, an encoding that the simulator cannot read, a surface that is not a closed outward 2-manifold,
/// unless allowed; the message names the fibre), FileError, and Cancelled. Processes that share the work judge and write the
/// surfaces together, and all get the result; the first one writes the other files. Results in the cache `known`, for the same
/// surfaces and centre lines, are not judged again.
WrittenSubstrate writeSubstrateFolder(const SubstrateFolderContents& contents, const std::string& folder,
  const Context& context = {}, const Sharing& sharing = Sharing(), const Recollection& known = {});

} // namespace cactus
