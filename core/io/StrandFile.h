// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fibres/Fibres.h"

#include <istream>
#include <string>

namespace cactus
{

/// Reads the CACTUS strand text format (µm): side of the cube, or, which the reference program does not know, the size of the
/// domain along x, y and z; number of strands; per strand the number of its control points, then one `x y z r` per line. The
/// domain is centred on the origin. Fibre ids count from 1, all fibres are of bundle 1, and a fibre's target radius is the mean
/// of its radii.
///
/// Each of these has its own line; blank lines, blanks around numbers, the kind of line end, a byte order mark and the locale
/// make no difference. Numbers are read by takeNumber(); counts are whole ("23", also "23.0"). Memory is allocated for lines that
/// exist, not for counts.
///
/// Throws FileError (path, line, what was expected and what was found), also for text after the last strand, and InvalidInput as
/// `validate` does.
Fibres readStrandFile(const std::string& path);

/// Does the same with a stream; `name` is its name in messages.
Fibres readStrandFile(std::istream& stream, const std::string& name);

/// Whether the first lines have as many numbers as those of a strand file up to its first control point.
bool beginsAsStrandFile(std::istream& stream);

/// Throws InvalidInput as `validate` does, with the name of the file that the fibres are of.
void validateFile(const Fibres& fibres, const std::string& name);

/// Whether the format can say what domain it is: one centred on the origin.
bool fitsStrandFile(const Domain& domain);

/// Whether all sides are equally long, as the reference program wants them.
bool isCube(const Domain& domain);

/// Writes the same format with 9 significant digits, whatever the locale. The file appears whole or not at all. Throws FileError,
/// and InvalidInput if the domain does not fit.
void writeStrandFile(const Fibres& fibres, const std::string& path);

} // namespace cactus
