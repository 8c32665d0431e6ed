// SPDX-License-Identifier: BSD-3-Clause
#include "base/Numbers.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>

namespace cactus
{

namespace
{

constexpr std::size_t longestNumber = 32;
constexpr std::string_view blanks = " \t\r\n\v\f";

bool isDigit(char c)
{
  return c >= '0' && c <= '9';
}

bool isHexadecimalDigit(char c)
{
  return isDigit(c) || (c >= 'a' && c <= 'f') || (c >= 'A' && c <= 'F');
}

/// Tells whether a number beyond the range of a double, given without sign and 0x, is too small (rather than too large). A digit
/// changes the exponent by `perDigit`: 1 for powers of ten, 4 for the powers of two of a hexadecimal number.
template <typename IsDigit>
bool isTiny(std::string_view number, IsDigit&& isADigit, long perDigit)
{
  long power = 0; // power of the base, of the first digit that is not zero
  bool decimals = false;
  bool found = false;
  std::size_t i = 0;
  for (; i < number.size() && (isADigit(number[i]) || number[i] == '.'); ++i)
  {
    decimals = decimals || number[i] == '.';
    found = found || (isADigit(number[i]) && number[i] != '0');
    power += found && !decimals ? 1 : 0;
    power -= !found && decimals ? 1 : 0;
  }
  long exponent = 0;
  if (i < number.size())
  {
    const std::size_t sign = i + 1 < number.size() && number[i + 1] == '+' ? 1 : 0;
    const char* begin = number.data() + i + 1 + sign;
    if (std::from_chars(begin, number.data() + number.size(), exponent).ec == std::errc::result_out_of_range)
    {
      return *begin == '-';
    }
  }
  return exponent < -perDigit * power;
}

/// Returns a hexadecimal number without sign and 0x, cut before its exponent if that has two signs: from_chars of GCC 12 accepts
/// both.
std::string_view withOneSign(std::string_view number)
{
  const std::size_t exponent = number.find_first_of("pP");
  const auto isSign = [&](std::size_t i) { return i < number.size() && (number[i] == '+' || number[i] == '-'); };
  const bool hasTwo = exponent != std::string_view::npos && isSign(exponent + 1) && isSign(exponent + 2);
  return hasTwo ? number.substr(0, exponent) : number;
}

/// Takes a number without a sign, in the standard library's `format`, from the front of `text`.
template <typename IsDigit>
bool takeUnsigned(std::string_view& text, double& value, std::chars_format format, IsDigit&& isADigit, long perDigit)
{
  double found = 0.0;
  const std::string_view number = format == std::chars_format::hex ? withOneSign(text) : text;
  const std::from_chars_result read = std::from_chars(number.data(), number.data() + number.size(), found, format);
  const auto length = static_cast<std::size_t>(read.ptr - text.data());
  if (read.ec == std::errc::result_out_of_range && isTiny(text.substr(0, length), isADigit, perDigit))
  {
    found = 0.0;
  }
  else if (read.ec != std::errc() || !std::isfinite(found))
  {
    return false;
  }
  value = found;
  text.remove_prefix(length);
  return true;
}

} // namespace

void appendNumber(std::string& text, double value, int digits)
{
  char number[longestNumber];
  text.append(number, std::to_chars(number, number + longestNumber, value, std::chars_format::general, digits).ptr);
}

std::string exactText(double value)
{
  char number[longestNumber];
  return std::string(number, std::to_chars(number, number + longestNumber, value).ptr);
}

void skipBlanks(std::string_view& text)
{
  text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
}

bool takeNumber(std::string_view& text, double& value)
{
  std::string_view rest = text;
  // from_chars accepts a minus sign, but no plus sign.
  bool negative = false;
  if (!rest.empty() && (rest.front() == '+' || rest.front() == '-'))
  {
    negative = rest.front() == '-';
    rest.remove_prefix(1);
  }
  if (rest.empty() || rest.front() == '-')
  {
    return false;
  }
  const bool isHexadecimal = rest.size() > 2 && rest[0] == '0' && (rest[1] == 'x' || rest[1] == 'X') &&
                             (isHexadecimalDigit(rest[2]) || (rest.size() > 3 && rest[2] == '.' && isHexadecimalDigit(rest[3])));
  rest.remove_prefix(isHexadecimal ? 2 : 0);
  double found = 0.0;
  if (!(isHexadecimal ? takeUnsigned(rest, found, std::chars_format::hex, isHexadecimalDigit, 4)
                      : takeUnsigned(rest, found, std::chars_format::general, isDigit, 1)))
  {
    return false;
  }
  value = negative ? -found : found;
  text = rest;
  return true;
}

namespace
{

/// Returns the bytes of the UTF-8 character at the front of `text`; 0 if there is none (Unicode, table 3-7).
std::size_t characterLength(std::string_view text)
{
  const auto byte = [text](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U; };
  const unsigned first = byte(0);
  if (first < 0x80)
  {
    return 1;
  }
  const std::size_t length = first >= 0xc2 && first <= 0xdf   ? 2
                             : (first & 0xf0U) == 0xe0        ? 3
                             : first >= 0xf0 && first <= 0xf4 ? 4
                                                              : 0;
  const unsigned lowest = first == 0xe0 ? 0xa0 : first == 0xf0 ? 0x90 : 0x80;
  const unsigned highest = first == 0xed ? 0x9f : first == 0xf4 ? 0x8f : 0xbf;
  bool whole = byte(1) >= lowest && byte(1) <= highest;
  for (std::size_t i = 2; i < length; ++i)
  {
    whole = whole && (byte(i) & 0xc0U) == 0x80;
  }
  return whole ? length : 0;
}

/// Tells whether an ASCII byte is a control character.
bool isControl(unsigned char letter)
{
  return letter < 0x20 || letter == 0x7f;
}

} // namespace

bool takeNumbers(std::string_view& text, std::vector<double>& numbers)
{
  constexpr std::string_view separators = " \t\r\n\v\f,;";
  for (;;)
  {
    text.remove_prefix(std::min(text.find_first_not_of(separators), text.size()));
    if (text.empty())
    {
      return true;
    }
    const std::string_view word = text;
    double value = 0.0;
    if (!takeNumber(text, value) || (!text.empty() && separators.find(text.front()) == std::string_view::npos))
    {
      text = word.substr(0, word.find_first_of(separators));
      return false;
    }
    numbers.push_back(value);
  }
}

std::string onOneLine(std::string text)
{
  std::replace_if(text.begin(), text.end(), isControl, ' ');
  return text;
}

std::string excerpt(std::string_view text)
{
  constexpr std::size_t longest = 60;
  std::string found;
  while (!text.empty() && found.size() < longest)
  {
    const std::size_t length = characterLength(text);
    const auto first = static_cast<unsigned char>(text.front());
    found += isControl(first) ? std::string(" ") : length == 0 ? std::string("?") : std::string(text.substr(0, length));
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return text.empty() ? found : found + "...";
}

} // namespace cactus
