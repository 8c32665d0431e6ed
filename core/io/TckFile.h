// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Context.h"
#include "base/Placement.h"
#include "fibres/Fibres.h"
#include "io/Tractogram.h"

#include <istream>
#include <string>

namespace cactus
{

/// Reads MRtrix's tracks (.tck, "mrtrix tracks"): a header in text, then x y z in single or double precision of either byte
/// order, three NaNs after each streamline and three infinities at the end. Keys of the header may be in capitals. A wrong
/// count gives a remark, since MRtrix leaves one when it is stopped, and so does a missing datatype (Float32LE).
///
/// Throws FileError (no such file, truncated, an invalid coordinate, with its streamline), OutOfMemory and Cancelled.
Tractogram readTck(std::istream& stream, const std::string& name, const Context& context = {});

/// Writes the centre lines of fibres (µm) as tracks where they are placed, Float32LE, in mm, as readers take them, or in another
/// unit. Radii and ids do not fit into the format. The file appears whole or not at all; throws FileError, and InvalidInput as
/// `validate` does.
void writeTck(const Fibres& fibres, const Placement& placement, const std::string& path, LengthUnit unit);

} // namespace cactus
