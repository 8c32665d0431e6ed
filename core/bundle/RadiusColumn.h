// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <istream>
#include <string>
#include <vector>

namespace cactus
{

/// Reads the numbers (finite; at least one) of one column of a text table (.csv): cells separated by commas, semicolons or tabs,
/// whichever its first line has; that line names the columns, in quotation marks or not. A micro sign in a name counts as "u",
/// and decimals may follow a comma where it does not separate cells. Empty lines are skipped. Throws FileError, which names the
/// file, the line or the existing columns, for anything else.
std::vector<double> readRadiusColumn(const std::string& path, const std::string& column);

/// Does the same with a stream; `name` is its name in messages.
std::vector<double> readRadiusColumn(std::istream& stream, const std::string& name, const std::string& column);

} // namespace cactus
