// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "NumbersChecksum.h"
#include "base/Random.h"

#include <cmath>
#include <string>

/// An elementary function of the C library over arguments as the method uses them, and the first digits of the SHA-256 of 50,000
/// values with glibc 2.36 and 2.41, on processors with fused multiply-add and without it.
struct ElementaryFunction
{
  const char* name;
  double from;
  double to;
  double (*value)(double);
  const char* fused;
  const char* separate;

  std::string digest() const
  {
    cactus::RandomEngine engine = cactus::randomStream(1, cactus::RandomStage::Radii);
    NumbersChecksum hash;
    for (int i = 0; i < 50000; ++i)
    {
      hash.add(this->value(this->from + (this->to - this->from) * cactus::uniform(engine)));
    }
    return hash.digest().substr(0, 16);
  }
};

inline constexpr ElementaryFunction elementaryFunctions[] = {
  { "log", 0.0, 1.0, [](double x) { return std::log(x); }, "8667cedb291e4999", "86639fe085f285b0" },
  { "exp", -20.0, 5.0, [](double x) { return std::exp(x); }, "87b7f428eda5db5f", "f36a1d75e54b77d5" },
  { "pow", 0.0, 1.0, [](double x) { return std::pow(x, 1.7); }, "1efd3c7fb2f720f6", "053a74e60220164e" },
  { "sin", -50.0, 50.0, [](double x) { return std::sin(x); }, "7dd33ba28c0e85e9", "64b51c347e41a6e8" },
  { "cos", -50.0, 50.0, [](double x) { return std::cos(x); }, "9d0bb20070fcd304", "6f4694cf9a3a9e36" },
  { "tan", 0.0, 1.5, [](double x) { return std::tan(x); }, "2c57c894a5738fe4", "2c57c894a5738fe4" },
  { "atan2", -1.0, 1.0, [](double x) { return std::atan2(x, 0.7); }, "d14614007ebe54d1", "98ed40437f4c86f7" },
  { "hypot", 0.0, 30.0, [](double x) { return std::hypot(x, 1.7); }, "f9114111057cd426", "f9114111057cd426" },
};

/// Returns the names of those whose last digits differ from where known answers were stored; empty if none does.
inline std::string unknownElementaryFunctions()
{
  std::string names;
  for (const ElementaryFunction& function : elementaryFunctions)
  {
    const std::string digest = function.digest();
    if (digest != function.fused && digest != function.separate)
    {
      names += std::string(names.empty() ? "" : ", ") + function.name + " (" + digest + ")";
    }
  }
  return names;
}
