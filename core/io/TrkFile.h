// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Context.h"
#include "io/Tractogram.h"

#include <istream>
#include <string>

namespace cactus
{

/// Reads TrackVis tracks (.trk), version 1 to 3, of either byte order, with scalars of points and properties of streamlines.
///
/// The file has points in mm from the corner of the first voxel. They are converted to the scanner's mm, as in nibabel: by
/// `vox_to_ras`, half a voxel off, and with the axes permuted if `voxel_order` is not that of `vox_to_ras`. A missing
/// `vox_to_ras` (version 1, or its last number 0) is the identity, and a missing `voxel_order` is LPS; version 3 is
/// read as version 2; each gives a remark. A
/// count of 0 means all streamlines in the file.
///
/// Throws FileError (no such file, truncated, with its streamline; an impossible header), OutOfMemory and Cancelled.
Tractogram readTrk(std::istream& stream, const std::string& name, const Context& context = {});

} // namespace cactus
