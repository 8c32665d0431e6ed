// SPDX-License-Identifier: BSD-3-Clause
// Any bytes as a number: takeNumber() agrees with strtod in the C locale, and a written number reads back as the same bits. For
// subnormal hexadecimal numbers strtod may be off by one (glibc 2.36).
#include "base/Numbers.h"

#include "Fuzzing.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <string>

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv)
{
  writeSeeds(*argc, *argv,
    { "1.5", "+1e-3", "-.5E+10", "1.", "0x1.8p-3", "0x8p+-3", "0x", "1e400", "-1e-400", "4.9e-324", "nan(1)", "infinity",
      "0.000001e-400", "179769313486231580793728971405301e277", "2.2250738585072011e-308" });
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  const std::string text(reinterpret_cast<const char*>(data), size);
  if (text.empty() || std::strchr(" \t\r\n\v\f", text[0]) != nullptr)
  {
    return 0;
  }
  char* end = nullptr;
  const double expected = std::strtod(text.c_str(), &end);
  std::string_view rest = text;
  double found = 0.0;
  const bool isNumber = cactus::takeNumber(rest, found);
  promise(isNumber == (end != text.c_str() && std::isfinite(expected)), "what strtod takes for a finite number is one");
  if (isNumber)
  {
    const bool isHexadecimal = text.substr(0, 3).find_first_of("xX") != std::string::npos;
    const double slack =
      isHexadecimal && std::abs(expected) <= std::numeric_limits<double>::min() ? std::numeric_limits<double>::denorm_min() : 0.0;
    promise(std::signbit(found) == std::signbit(expected) && std::abs(found - expected) <= slack,
      "a number has the bits that strtod gives it");
    promise(rest.size() == text.size() - static_cast<std::size_t>(end - text.c_str()), "a number ends where strtod says");
    const std::string exact = cactus::exactText(found);
    std::string_view again = exact;
    double back = 0.0;
    promise(cactus::takeNumber(again, back) && again.empty() && std::memcmp(&back, &found, sizeof(back)) == 0,
      "what is written reads back as the same number");
  }
  return 0;
}
