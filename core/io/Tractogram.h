// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/LengthUnit.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace cactus
{

/// Numbers that a tractogram has for each of its points, or for each of its streamlines, one after the other.
struct TractogramValues
{
  std::string name;
  std::size_t components = 1;
  std::vector<double> values;
};

/// A named set of streamlines.
struct TractogramGroup
{
  std::string name;
  std::vector<std::uint32_t> streamlines; ///< by number, from 0
};

/// Streamlines as the formats of the field have them: streamline s owns the points [offsets[s], offsets[s + 1]), in millimetres
/// of the scanner, x to the right, y to the front, z up (RAS).
struct Tractogram
{
  std::vector<double> points;            ///< x y z, x y z, …
  std::vector<std::size_t> offsets{ 0 }; ///< size() + 1 entries, never decreasing
  std::vector<TractogramValues> pointValues;
  std::vector<TractogramValues> streamlineValues;
  std::vector<TractogramGroup> groups;
  std::vector<std::string> remarks; ///< what a user should know of the file, a sentence each

  std::size_t size() const { return offsets.size() - 1; }
  std::size_t pointCount() const { return points.size() / 3; }
};

/// What a reader has to count with for each point, or end of a streamline: coordinates, offset, and the number that the point has
/// in a polyline.
constexpr double bytesPerPoint = 5.0 * 8.0;

/// The values of this name, the last ones where a file has several; null where there are none.
const TractogramValues* valuesNamed(const std::vector<TractogramValues>& all, const std::string& name);

/// Gives points, and values of points and streamlines that are called Radius, in this unit instead of mm; and each point a Radius
/// of `radius` µm where that is not 0 and the file has none.
void setLengths(Tractogram& tractogram, LengthUnit unit, double radius);

/// The number, from 1, of the first group that each streamline is in, and one more than there are groups where it is in none.
/// Empty where there are no groups.
std::vector<int> bundlesByGroup(const Tractogram& tractogram);

/// Takes out streamlines of fewer than two points, which have no direction and no length, with all that belongs to them; a remark
/// counts them. The others keep their order.
void dropShortStreamlines(Tractogram& tractogram);

} // namespace cactus
