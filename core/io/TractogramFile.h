// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Context.h"
#include "base/Placement.h"
#include "fibres/Fibres.h"
#include "io/Tractogram.h"

#include <string>

namespace cactus
{

/// Reads a tractogram by its extension: .tck, .trk, these packed by gzip (.tck.gz, .trk.gz), or .trx (a zip archive or a folder).
/// Streamlines of fewer than two points are
/// left out. Throws FileError, which names the file, OutOfMemory and Cancelled.
Tractogram readTractogram(const std::string& path, const Context& context = {});

/// Throws FileError if readTractogram() could not begin: for a name of another kind, and a file that cannot be opened.
void requireTractogram(const std::string& path);

/// Whether readTractogram() is for this file: its name ends as above, and its content begins as the format does. A damaged file
/// counts, too, if its name has no other dots: then no other format can be meant, and the reader says what is wrong.
bool isTractogram(const std::string& path);

/// Writes fibres by the extension: .tck (centre lines alone) or .trx (with radii, ids and bundles); where they are placed, in mm,
/// which these formats have, or in another unit. Radii that are all NaN are not written. The file appears whole or not at all.
/// Throws FileError, and InvalidInput for other extensions and as `validate` does.
void writeTractogram(
  const Fibres& fibres, const Placement& placement, const std::string& path, LengthUnit unit = LengthUnit::Millimetre);

} // namespace cactus
