// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>

namespace cactus
{

constexpr double pi = 3.14159265358979323846;
/// Radians in a degree, and degrees in a radian.
constexpr double degree = pi / 180.0;
constexpr double radian = 180.0 / pi;
/// Radians (π (3 − √5)) from one point of a sunflower to the next: points so placed never line up.
constexpr double goldenAngle = 2.399963229728653;
/// Millimetres in a micrometre.
constexpr double micrometre = 1e-3;
/// For a measure that is undefined.
constexpr double notANumber = std::numeric_limits<double>::quiet_NaN();

} // namespace cactus
