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

/// Whether the file begins as one of these formats does. A file NAME.strands counts in any case, if NAME has no dots: then no
/// other format can be meant, and readFibreFile() says what is wrong.
bool isFibreFile(const std::string& path);

} // namespace cactus
