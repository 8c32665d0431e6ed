// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/FibresOfFile.h"

#include <istream>
#include <string>

namespace cactus
{

/// Reads the axons of a JSON file that the White Matter Generator has written (config_output_N.json;
/// github.com/MaP-science/WhiteMatterGenerator; Winther et al. 2024), lengths in µm. An axon is a chain of ellipsoids: their
/// positions are the control points of a fibre, and half their myelinDiameter, that of a circle as large as the cross-section, is
/// the radius there. Ids count from 1 in the order of the file. The domain is the voxel (voxelSize), centred on the origin. Cells
/// are left out.
///
/// Throws FileError, naming the axon and what it lacks, and InvalidInput as `validate` does.
FibresOfFile readEllipsoidFile(std::istream& stream, const std::string& name);

} // namespace cactus
