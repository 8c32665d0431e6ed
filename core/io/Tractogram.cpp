// SPDX-License-Identifier: BSD-3-Clause
#include "io/Tractogram.h"

#include <algorithm>
#include <limits>

namespace cactus
{

namespace
{

constexpr std::uint32_t gone = std::numeric_limits<std::uint32_t>::max();

/// Moves the values of element `from` to element `to`, before it.
void move(std::vector<double>& values, std::size_t components, std::size_t from, std::size_t to)
{
  for (std::size_t c = 0; c < components; ++c)
  {
    values[to * components + c] = values[from * components + c];
  }
}

/// Moves all kept streamlines to the front, and returns each one's new number.
std::vector<std::uint32_t> compact(Tractogram& tractogram)
{
  std::vector<std::uint32_t> numbers(tractogram.size(), gone);
  std::uint32_t kept = 0;
  std::size_t point = 0;
  std::size_t begin = 0;
  for (std::size_t s = 0; s < numbers.size(); ++s)
  {
    const std::size_t first = begin; // the former offsets[s], which may be overwritten
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

const TractogramValues* valuesNamed(const std::vector<TractogramValues>& all, const std::string& name)
{
  const auto found = std::find_if(all.rbegin(), all.rend(), [&](const TractogramValues& values) { return values.name == name; });
  return found != all.rend() ? &*found : nullptr;
}

void setLengths(Tractogram& tractogram, LengthUnit unit, double radius)
{
  constexpr char name[] = "Radius";
  constexpr double micrometresInMillimetre = 1e3;
  const double length = unit == LengthUnit::Micrometre ? micrometresInMillimetre : 1.0;
  const auto scale = [length](std::vector<double>& values)
  {
    for (double& value : values)
    {
      value *= length;
    }
  };
  scale(tractogram.points);
  for (std::vector<TractogramValues>* all : { &tractogram.pointValues, &tractogram.streamlineValues })
  {
    for (TractogramValues& values : *all)
    {
      if (values.name == name)
      {
        scale(values.values);
      }
    }
  }
  if (radius > 0.0 && valuesNamed(tractogram.pointValues, name) == nullptr)
  {
    tractogram.pointValues.push_back(
      { name, 1, std::vector<double>(tractogram.pointCount(), radius * length / micrometresInMillimetre) });
  }
}

std::vector<int> bundlesByGroup(const Tractogram& tractogram)
{
  const std::vector<TractogramGroup>& groups = tractogram.groups;
  if (groups.empty())
  {
    return {};
  }
  std::vector<int> bundles(tractogram.size(), static_cast<int>(groups.size()) + 1);
  for (std::size_t g = groups.size(); g-- > 0;)
  {
    for (const std::uint32_t streamline : groups[g].streamlines)
    {
      bundles[streamline] = static_cast<int>(g) + 1; // in reverse, so that the first group wins
    }
  }
  return bundles;
}

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
