// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/FibresOfFile.h"

#include <string>

namespace cactus
{

/// Reads fibres (µm) from a file of any of these formats, which its first characters tell, whatever its name is:
///  - CACTUS strands, see readStrandFile();
///  - CATERPillar's table of spheres, see readSphereTable();
///  - what the White Matter Generator writes, see readEllipsoidFile().
/// Throws FileError and InvalidInput as these do.
FibresOfFile readFibreFile(const std::string& path);

} // namespace cactus
