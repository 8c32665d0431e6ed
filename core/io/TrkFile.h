// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Context.h"
#include "io/Tractogram.h"

#include <istream>
#include <string>

namespace cactus
{

/// Reads TrackVis tracks (.trk), version 1 and 2, of either byte order, with scalars of points and properties of streamlines.
///
/// The file has points in mm from the corner of the first voxel. They come out in the scanner's mm, as nibabel gives them: by
/// `vox_to_ras`, half a voxel off, and with the axes turned where `voxel_order` is not that of `vox_to_ras`. Without `vox_to_ras`
/// (version 1, or its last number 0) that is the identity, and without `voxel_order` that is LPS; each gives a remark. A count of
/// 0 means as many as there are.
///
/// Throws FileError (no such file, truncated, by streamline; a header that cannot be), OutOfMemory and Cancelled.
Tractogram readTrk(std::istream& stream, const std::string& name, const Context& context = {});

} // namespace cactus
