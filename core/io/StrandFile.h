// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fibres/Fibres.h"

#include <istream>
#include <string>

namespace cactus
{

/// Reads the CACTUS strand text format (µm): cube side; number of strands; per strand the number of its control points, then one
/// `x y z r` per line. The domain becomes the centred cube. Fibre ids count from 1, all fibres are of bundle 1, and a fibre's
/// target radius is the mean of its radii.
///
/// Each of these has a line of its own; blank lines, blanks around numbers, any line ends and a byte order mark make no
/// difference, nor does the locale. Numbers are as takeNumber() has them; counts are whole ("23", also "23.0"). Nothing is set
/// aside for a count before its lines are there.
///
/// Throws FileError (path, line, what was expected there and what was found), also where text is left after the last strand,
/// and InvalidInput as `validate` does.
Fibres readStrandFile(const std::string& path);

/// The same from a stream; `name` is what messages call it.
Fibres readStrandFile(std::istream& stream, const std::string& name);

/// Throws InvalidInput as `validate` does, with the name of the file that the fibres are of.
void validateFile(const Fibres& fibres, const std::string& name);

/// Whether the format can say what domain it is: a cube centred on the origin.
bool fitsStrandFile(const Domain& domain);

/// Writes the same format with 9 significant digits, whatever the locale. The file appears whole or not at all. Throws FileError,
/// and InvalidInput where the domain does not fit.
void writeStrandFile(const Fibres& fibres, const std::string& path);

} // namespace cactus
