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

/// Whether a decimal number without a sign that is beyond the range of a double is too small for it.
bool isTiny(std::string_view number)
{
  long power = 0; // of ten, of the first digit that is not zero
  bool decimals = false;
  bool found = false;
  std::size_t i = 0;
  for (; i < number.size() && (isDigit(number[i]) || number[i] == '.'); ++i)
  {
    decimals = decimals || number[i] == '.';
    found = found || (isDigit(number[i]) && number[i] != '0');
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
  return exponent < -power;
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
  // from_chars knows a minus sign, but no plus sign and no 0x.
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
  const char* const last = rest.data() + rest.size();
  double found = 0.0;
  std::from_chars_result read = { rest.data(), std::errc::invalid_argument };
  if (rest.size() > 2 && rest[0] == '0' && (rest[1] == 'x' || rest[1] == 'X') && rest[2] != '-')
  {
    read = std::from_chars(rest.data() + 2, last, found, std::chars_format::hex);
    if (read.ec == std::errc::result_out_of_range)
    {
      return false;
    }
  }
  if (read.ec != std::errc())
  {
    read = std::from_chars(rest.data(), last, found);
  }
  const auto length = static_cast<std::size_t>(read.ptr - rest.data());
  if (read.ec == std::errc::result_out_of_range && isTiny(rest.substr(0, length)))
  {
    found = 0.0;
  }
  else if (read.ec != std::errc() || !std::isfinite(found))
  {
    return false;
  }
  value = negative ? -found : found;
  text = rest.substr(length);
  return true;
}

std::string excerpt(std::string_view text)
{
  constexpr std::size_t longest = 60;
  std::string found(text.substr(0, longest));
  std::replace_if(
    found.begin(), found.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }, ' ');
  return text.size() > longest ? found + "..." : found;
}

} // namespace cactus
