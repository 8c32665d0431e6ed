// SPDX-License-Identifier: BSD-3-Clause
#include "bundle/Beads.h"

#include "base/Constants.h"
#include "base/Error.h"
#include "base/Limits.h"
#include "base/RandomVariates.h"

#include <algorithm>
#include <cmath>

namespace cactus
{

namespace
{

constexpr double reachInWidths = 5.7;

double widthOf(const BeadShape& shape)
{
  return shape.length / (2.0 * std::sqrt(2.0 * std::log(2.0)));
}

/// Returns the number of a bead's random stream.
std::uint64_t itemOfBead(int fibreId, std::int64_t bead)
{
  return (std::uint64_t(std::uint32_t(fibreId)) << 32) | std::uint32_t(static_cast<std::int32_t>(bead));
}

/// Returns the distance (µm) from a bead to the next one, away from the fibre's middle, or of the two about it. A place is in a
/// gap as often as that is long, so that this one's distribution is weighted by length.
double gapAfter(const BeadShape& shape, RandomEngine& engine, bool isMiddle = false)
{
  if (shape.spacingDeviation == 0.0)
  {
    return shape.spacing;
  }
  const double scale = shape.spacingDeviation * shape.spacingDeviation / shape.spacing;
  return gammaVariate(shape.spacing / scale + (isMiddle ? 1.0 : 0.0), scale, engine);
}

} // namespace

const PropertyList<BeadShape>& BeadShape::properties()
{
  static const auto list =
    PropertyList<BeadShape>()
      .add("BeadSpacing", &BeadShape::spacing, limits::beadSpacing,
        "Mean distance in µm of neighbouring beads along a fibre. Axons of the mouse have 5.1.")
      .where("CalibreModel", { 1 })
      .add("BeadSpacingDeviation", &BeadShape::spacingDeviation, limits::beadSpacingDeviation,
        "Standard deviation in µm of the distances of neighbouring beads, which are gamma distributed. 0: all are the same.")
      .where("CalibreModel", { 1 })
      .add("BeadLength", &BeadShape::length, limits::beadLength,
        "Length in µm over which a bead is thicker than half of its height. Control points are at most 0.4 times this length "
        "apart.")
      .where("CalibreModel", { 1 });
  return list;
}

double BeadShape::mean() const
{
  return std::sqrt(2.0 * pi) * widthOf(*this) / this->spacing;
}

double BeadShape::meanSquare() const
{
  constexpr double beads = 1000.0;
  constexpr double stepsInALength = 8.0;
  const double half = 0.5 * beads * this->spacing;
  const Beads chain(*this, 0, 0, half, false);
  const auto steps = static_cast<std::int64_t>(2.0 * half / this->length * stepsInALength);
  double sum = 0.0;
  for (std::int64_t i = 0; i < steps; ++i)
  {
    const double value = chain.at(half * ((2.0 * double(i) + 1.0) / double(steps) - 1.0));
    sum += value * value;
  }
  return sum / double(steps);
}

double BeadShape::leastSpacing(double amplitude) const
{
  constexpr double mostCovered = 0.9;
  return this->spacing * (this->mean() * (1.0 + amplitude) / mostCovered);
}

void BeadShape::requireRoom(double amplitude, const std::string& name) const
{
  const double least = this->leastSpacing(amplitude);
  if (this->spacing < least)
  {
    throw InvalidInput(text(name, "Spacing is ", this->spacing, " µm: with ", name, "Amplitude ", amplitude, " and ", name,
      "Length ", this->length, " µm they run into each other; give ", least, " µm or more, or a smaller ", name, "Length or ",
      name, "Amplitude"));
  }
}

Beads::Beads(const BeadShape& shape, std::uint64_t seed, int fibreId, double half, bool repeats, RandomStage stage)
  : Reach(reachInWidths * widthOf(shape))
  , Width(widthOf(shape))
{
  const auto streamOf = [&](std::int64_t bead) { return randomStream(seed, stage, itemOfBead(fibreId, bead)); };
  RandomEngine middle = streamOf(0);
  const double before = uniformFromZero(middle); // the part of the gap about the middle that lies before it
  const double gap = gapAfter(shape, middle, true);
  if (repeats)
  {
    const auto count = std::max(std::int64_t(1), static_cast<std::int64_t>(std::llround(2.0 * half / shape.spacing)));
    std::vector<double> ends{ 0.0 };
    for (std::int64_t bead = 0; bead < count; ++bead)
    {
      RandomEngine engine = streamOf(bead + 1);
      ends.push_back(ends.back() + gapAfter(shape, engine));
    }
    const double scale = 2.0 * half / ends.back();
    for (const double period : { -2.0, -1.0, 0.0, 1.0, 2.0 })
    {
      for (std::int64_t bead = 0; bead < count; ++bead)
      {
        this->Places.push_back(2.0 * half * (period + before) + scale * ends[static_cast<std::size_t>(bead)]);
      }
    }
  }
  else
  {
    double place = -before * gap;
    for (std::int64_t bead = -1; place > -half - this->Reach; --bead)
    {
      this->Places.push_back(place);
      RandomEngine engine = streamOf(bead);
      place -= gapAfter(shape, engine);
    }
    place = (1.0 - before) * gap;
    for (std::int64_t bead = 1; place < half + this->Reach; ++bead)
    {
      this->Places.push_back(place);
      RandomEngine engine = streamOf(bead);
      place += gapAfter(shape, engine);
    }
  }
  std::sort(this->Places.begin(), this->Places.end());
}

double Beads::at(double length) const
{
  double sum = 0.0;
  for (auto place = std::lower_bound(this->Places.begin(), this->Places.end(), length - this->Reach);
       place != this->Places.end() && *place <= length + this->Reach; ++place)
  {
    const double distance = (length - *place) / this->Width;
    sum += std::exp(-0.5 * distance * distance);
  }
  return sum;
}

} // namespace cactus
