// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Placement.h"
#include "fibres/Fibres.h"
#include "io/FileCollection.h"
#include "io/Tractogram.h"

#include <string>

namespace cactus
{

/// Reads a .trx tractogram (tee-ar-ex, version 1): `header.json`, `positions.3.float16|32|64`, `offsets.uint32|64` (with or
/// without the number of points at its end), `dpv/`, `dps/` and `groups/`. Positions are in the scanner's mm. Values of groups
/// (`dpg/`) are left out, with a remark. Backslashes in names count as slashes, and a header of 0 streamlines and 0 points is
/// enough, each with a remark.
///
/// Throws FileError, which begins with `name` or names the file in it, if something is missing, has a length that differs from
/// the header, or has impossible values; and OutOfMemory.
Tractogram readTrx(const FileCollection& files, const std::string& name);

/// Tells whether fibres have radii: those of a tractogram without any are all NaN.
bool hasRadii(const Fibres& fibres);

/// Writes fibres (µm) as a .trx archive where they are placed, in the placement's unit (mm): positions in single precision, in
/// double precision where their origin was moved (100 mm from the scanner's, single precision has steps of 0.008 µm);
/// `dpv/Radius` (mm, if they have radii), `dps/FibreId`, `dps/BundleId`, and a group `bundle_00001` for each bundle. The header's
/// image is the domain in voxels of 1 µm, or larger ones where it would have more than 65535 along a side. The file appears whole
/// or not at all; throws FileError, and InvalidInput as `validate` does.
void writeTrx(const Fibres& fibres, const Placement& placement, const std::string& path);

} // namespace cactus
