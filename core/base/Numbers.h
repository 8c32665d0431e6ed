// SPDX-License-Identifier: BSD-3-Clause
// Numbers as text, the same whatever locale a script, ParaView's window or a library has set.
#pragma once

#include <sstream>
#include <string>
#include <string_view>

namespace cactus
{

/// A text that is put together piece by piece, with numbers as C writes them: a point before the decimals, and no other marks. A
/// plain std::ostringstream follows the global locale, as do std::to_string for a double, printf and strtod.
class TextStream : public std::ostringstream
{
public:
  TextStream() { this->imbue(std::locale::classic()); }
};

/// Appends a number with so many significant digits (at most 17) as printf's %g does in the C locale.
void appendNumber(std::string& text, double value, int digits);

/// The shortest text that reads back as the same number.
std::string exactText(double value);

/// Takes white space (blanks, tabs, carriage returns, line, form and vertical feeds) from the front of `text`.
void skipBlanks(std::string_view& text);

/// Takes a number from the front of `text` as strtod does in the C locale: with a sign or without, "1.", ".5", "1e-3", "0x1p-3";
/// what is too small for a double is 0. Returns false, and leaves both as they are, where there is none, and where it is
/// infinite, not a number, or too large for a double.
bool takeNumber(std::string_view& text, double& value);

/// Without what would move a terminal's cursor, such as the ends of lines: a message may hold what stands in somebody's file.
std::string onOneLine(std::string text);

/// The first characters of what was found in a file, fit for a message: without control characters, in UTF-8, and not long.
std::string excerpt(std::string_view text);

} // namespace cactus
