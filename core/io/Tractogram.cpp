// SPDX-License-Identifier: BSD-3-Clause
#include "io/Tractogram.h"

#include <limits>

namespace cactus
{

namespace
{

constexpr std::uint32_t gone = std::numeric_limits<std::uint32_t>::max();

/// Moves what belongs to thing `from` to the place of thing `to`, before it.
void move(std::vector<double>& values, std::size_t components, std::size_t from, std::size_t to)
{
  for (std::size_t c = 0; c < components; ++c)
  {
    values[to * components + c] = values[from * components + c];
  }
}

/// Moves all that is kept to the front, and gives each streamline's new number.
std::vector<std::uint32_t> compact(Tractogram& tractogram)
{
  std::vector<std::uint32_t> numbers(tractogram.size(), gone);
  std::uint32_t kept = 0;
  std::size_t point = 0;
  std::size_t begin = 0;
  for (std::size_t s = 0; s < numbers.size(); ++s)
  {
    const std::size_t first = begin; // the former offsets[s], in whose place a new one may stand
    const std::size_t last = tractogram.offsets[s + 1];
    begin = last;
    if (last - first < 2)
    {
      continue;
    }
    for (std::size_t p = first; p < last; ++p, ++point)
    {
      move(tractogram.points, 3, p, point);
      for (TractogramValues& values : tractogram.pointValues)
      {
        move(values.values, values.components, p, point);
      }
    }
    for (TractogramValues& values : tractogram.streamlineValues)
    {
      move(values.values, values.components, s, kept);
    }
    numbers[s] = kept++;
    tractogram.offsets[kept] = point;
  }
  tractogram.offsets.resize(kept + std::size_t(1));
  tractogram.points.resize(3 * point);
  for (TractogramValues& values : tractogram.pointValues)
  {
    values.values.resize(values.components * point);
  }
  for (TractogramValues& values : tractogram.streamlineValues)
  {
    values.values.resize(values.components * kept);
  }
  return numbers;
}

} // namespace

void dropShortStreamlines(Tractogram& tractogram)
{
  std::size_t dropped = 0;
  for (std::size_t s = 0; s < tractogram.size(); ++s)
  {
    dropped += tractogram.offsets[s + 1] - tractogram.offsets[s] < 2 ? 1 : 0;
  }
  if (dropped == 0)
  {
    return;
  }
  tractogram.remarks.push_back(std::to_string(dropped) + " of " + std::to_string(tractogram.size()) +
                               " streamlines have fewer than two points, and are left out");
  const std::vector<std::uint32_t> numbers = compact(tractogram);
  for (TractogramGroup& group : tractogram.groups)
  {
    std::size_t members = 0;
    for (const std::uint32_t streamline : group.streamlines)
    {
      if (numbers[streamline] != gone)
      {
        group.streamlines[members++] = numbers[streamline];
      }
    }
    group.streamlines.resize(members);
  }
}

} // namespace cactus
