// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Fibres.h"

#include <string>

namespace cactus
{

/// Reads the CACTUS strand text format (µm): cube side; number of strands; per strand the number of its control points, then one
/// `x y z r` per line. The domain becomes the centred cube. Fibre ids count from 1, all fibres are of bundle 1, and a fibre's
/// target radius is the mean of its radii. Throws FileError (path, line and what was expected there) and InvalidInput as
/// `validate` does.
Fibres readStrandFile(const std::string& path);

/// Writes the same format with 9 significant digits. The file appears whole or not at all. Throws FileError, and InvalidInput
/// where the domain is not a centred cube, which the format cannot say.
void writeStrandFile(const Fibres& fibres, const std::string& path);

} // namespace cactus
