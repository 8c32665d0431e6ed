// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <istream>
#include <string>
#include <vector>

namespace cactus
{

/// The numbers (not NaN or infinite; at least one) of one column of a table as text (.csv): cells separated by commas, semicolons
/// or tabs, whichever its first line has; that names the columns, in quotation marks or not. Empty lines count for nothing.
/// Throws FileError, which names the file, the line or the columns that there are, for anything else.
std::vector<double> readRadiusColumn(const std::string& path, const std::string& column);

/// The same from a stream; `name` is what messages call it.
std::vector<double> readRadiusColumn(std::istream& stream, const std::string& name, const std::string& column);

} // namespace cactus
