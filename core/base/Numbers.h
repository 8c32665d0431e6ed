// SPDX-License-Identifier: BSD-3-Clause
// Numbers as text, independent of the locale that a script, ParaView's window or a library has set.
#pragma once

#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace cactus
{

/// A text stream that writes numbers as C does: a decimal point and no thousands separators. A plain std::ostringstream follows
/// the global locale, as do std::to_string for a double, printf and strtod.
class TextStream : public std::ostringstream
{
public:
  TextStream() { this->imbue(std::locale::classic()); }
};

/// Appends a number with `digits` significant digits (at most 17) as printf's %g does in the C locale.
void appendNumber(std::string& text, double value, int digits);

/// Returns the shortest text that reads back as the same number.
std::string exactText(double value);

/// Removes white space (blanks, tabs, carriage returns, line, form and vertical feeds) from the front of `text`.
void skipBlanks(std::string_view& text);

/// Takes a number from the front of `text` as strtod does in the C locale: with a sign or without, "1.", ".5", "1e-3", "0x1p-3";
/// a number too small for a double is 0. Returns false, and changes neither argument, if there is no number or if it is infinite,
/// NaN or too large for a double.
bool takeNumber(std::string_view& text, double& value);

/// Appends the numbers of a text, separated by white space, commas or semicolons, and takes them from it. At a word that is no
/// number it returns false and leaves that word in `text`.
bool takeNumbers(std::string_view& text, std::vector<double>& numbers);

/// Replaces control characters, such as line ends, that would move a terminal's cursor: a message may quote a user's file.
std::string onOneLine(std::string text);

/// Returns the first characters of text found in a file, fit for a message: without control characters, in UTF-8, and short.
std::string excerpt(std::string_view text);

} // namespace cactus
