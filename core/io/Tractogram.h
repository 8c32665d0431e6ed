// SPDX-License-Identifier: BSD-3-Clause
#pragma once

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

/// Takes out streamlines of fewer than two points, which have no direction and no length, with all that belongs to them; a remark
/// counts them. The others keep their order.
void dropShortStreamlines(Tractogram& tractogram);

} // namespace cactus
