// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace cactus
{

/// The unit of a length.
enum class LengthUnit
{
  Micrometre = 0,
  Millimetre = 1
};

/// Micrometres in a unit.
constexpr double micrometresIn(LengthUnit unit)
{
  return unit == LengthUnit::Millimetre ? 1e3 : 1.0;
}

} // namespace cactus
