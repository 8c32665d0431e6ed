// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/LengthUnit.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace cactus
{

/// Consecutive numbers of a tractogram for each of its points, or for each of its streamlines.
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
  std::vector<std::uint32_t> streamlines; ///< by index, from 0
};

/// Streamlines as in the formats of the field: streamline s owns the points [offsets[s], offsets[s + 1]), in millimetres of the
/// scanner, x to the right, y to the front, z up (RAS).
struct Tractogram
{
  std::vector<double> points;            ///< x y z, x y z, …
  std::vector<std::size_t> offsets{ 0 }; ///< size() + 1 entries, never decreasing
  std::vector<TractogramValues> pointValues;
  std::vector<TractogramValues> streamlineValues;
  std::vector<TractogramGroup> groups;
  std::vector<std::string> remarks; ///< remarks on the file for the user, a sentence each

  std::size_t size() const { return offsets.size() - 1; }
  std::size_t pointCount() const { return points.size() / 3; }
};

/// Memory of a reader for each point, or end of a streamline: coordinates, offset, and the point's index in a polyline.
constexpr double bytesPerPoint = 5.0 * 8.0;

/// Returns the values of this name, the last ones if a file has several; null if there are none.
const TractogramValues* valuesNamed(const std::vector<TractogramValues>& all, const std::string& name);

/// Converts points, and values of points and streamlines named Radius, from mm to this unit. If the file has no radii and
/// `radius` (µm) is not 0, each point gets it.
void setLengths(Tractogram& tractogram, LengthUnit unit, double radius);

/// Returns, for each streamline, the number, from 1, of its first group, or the number of groups plus one if it is in none. Empty
/// if there are no groups.
std::vector<int> bundlesByGroup(const Tractogram& tractogram);

/// Removes streamlines of fewer than two points, which have no direction and no length, with all their values; a remark counts
/// them. The others keep their order.
void dropShortStreamlines(Tractogram& tractogram);

} // namespace cactus
