// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Sha256.h"

#include <string>
#include <type_traits>
#include <vector>

/// The SHA-256 of numbers, by their bytes in little-endian order.
class NumbersChecksum
{
public:
  /// Adds numbers by value: −0 counts as 0, since the sign may depend on the vector unit.
  template <typename Number>
  void add(Number value)
  {
    static_assert(std::is_arithmetic_v<Number>);
    if (value == Number(0))
    {
      value = Number(0);
    }
    this->Hash.add(&value, sizeof(value));
  }

  template <typename Number>
  void add(const std::vector<Number>& values)
  {
    for (const Number value : values)
    {
      this->add(value);
    }
  }

  /// 64 hexadecimal digits. Nothing can be added afterwards.
  std::string digest() { return this->Hash.digest(); }

private:
  cactus::Sha256 Hash;
};
