// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Context.h"
#include "base/Placement.h"
#include "fibres/Fibres.h"
#include "io/Tractogram.h"

#include <string>

namespace cactus
{

/// Reads a tractogram by its extension: .tck, .trk, or .trx (a zip archive or a folder). Streamlines of fewer than two points are
/// left out. Throws FileError, which names the file, OutOfMemory and Cancelled.
Tractogram readTractogram(const std::string& path, const Context& context = {});

/// Throws FileError if readTractogram() could not begin: for a name of another kind, and a file that cannot be opened.
void requireTractogram(const std::string& path);

/// Writes fibres by the extension: .tck (centre lines alone) or .trx (with radii, ids and bundles); in mm, where they are placed.
/// Of a .trx the domain becomes the image, whatever its size is. The file appears whole or not at all. Throws FileError, and
/// InvalidInput for other extensions, where there are no fibres, and for points further away than a scanner reaches.
void writeTractogram(const Fibres& fibres, const Placement& placement, const std::string& path);

} // namespace cactus
