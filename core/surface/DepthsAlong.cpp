// SPDX-License-Identifier: BSD-3-Clause
#include "surface/DepthsAlong.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

namespace cactus
{

namespace
{

/// Thickness of slices, in voxels, and how often each is averaged with its neighbours.
constexpr double sliceThickness = 2.0;
constexpr int smoothingPasses = 2;
/// Number of slices beyond the last whole one for which their depth goes on changing.
constexpr std::size_t farthestMirrored = 3;
/// Nodes so far outside the fibre (voxels) have no place along it: no surface depends on them.
constexpr double farthestOutside = 4.0;
/// Error (µm) to which a slice's depth is found.
constexpr double depthTolerance = 1e-5;
/// Relative error to which a volume is kept.
constexpr double redistributionTolerance = 1e-6;

constexpr float nowhere = std::numeric_limits<float>::quiet_NaN();

/// Returns on which side of the lattice, along each axis, a node lies whose sample is beyond a periodic face.
std::array<int, 3> sideOfNode(const SmoothedField& field, const std::array<int, 3>& node)
{
  std::array<int, 3> side{ { 0, 0, 0 } };
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const bool isBefore = field.repeats(axis) && node[axis] < 1;
    const bool isBehind = field.repeats(axis) && node[axis] >= field.lattice().cells(int(axis));
    side[axis] = isBefore ? -1 : isBehind ? 1 : 0;
  }
  return side;
}

/// Calls visit(node, n) for each node of a range, the n-th.
template <typename Visit>
void forEachNodeOf(const NodeRange& range, Visit&& visit)
{
  std::size_t n = 0;
  for (int k = range.first[2]; k < range.first[2] + range.count[2]; ++k)
  {
    for (int j = range.first[1]; j < range.first[1] + range.count[1]; ++j)
    {
      for (int i = range.first[0]; i < range.first[0] + range.count[0]; ++i)
      {
        visit(std::array<int, 3>{ { i, j, k } }, n++);
      }
    }
  }
}

/// Tells whether a node of a range, which is a block's with one node more on every side, has a sample and belongs to no other
/// block.
bool isSampleOf(const NodeLattice& lattice, const NodeRange& range, const std::array<int, 3>& node)
{
  bool result = true;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const int place = node[axis] - range.first[axis];
    result = result && place > 0 && place <= NodeLattice::blockCells && node[axis] > 0 && node[axis] < lattice.cells(int(axis));
  }
  return result;
}

} // namespace

DepthsAlong::DepthsAlong(const SmoothedField& field, const FibreLine& line)
  : Field(field)
  , Line(line)
  , Spacing(field.lattice().planes[0].size() > 3 ? field.lattice().planes[0][2] - field.lattice().planes[0][1] : 1.0)
{
  const double period = line.period();
  const double length = period > 0.0 ? period : line.length();
  const double count = std::max(1.0, std::ceil(length / (sliceThickness * this->Spacing)));
  this->Thickness = length / count;
  this->Slices.resize(std::size_t(count));
  bool hasSamples = false;
  std::vector<float> values;
  for (const std::uint32_t block : field.blocks())
  {
    const NodeRange range = nodesOfBlock(field.lattice(), block).widened(1);
    values.resize(range.size());
    field.values(0.0, 0.0, range, values.data());
    const auto isNear = [&](std::size_t n) { return double(values[n]) > -farthestOutside * this->Spacing; };
    std::map<std::array<int, 3>, Eigen::AlignedBox3d> boxes;
    forEachNodeOf(range,
      [&](const std::array<int, 3>& node, std::size_t n)
      {
        if (isNear(n))
        {
          boxes[sideOfNode(field, node)].extend(field.sampleAt(node));
        }
      });
    std::map<std::array<int, 3>, FibreLine::Near> near;
    for (const auto& [side, box] : boxes)
    {
      near.emplace(side, line.near(box));
    }
    std::vector<float>& places = this->Places.emplace_back(range.size(), nowhere);
    forEachNodeOf(range,
      [&](const std::array<int, 3>& node, std::size_t n)
      {
        if (!isNear(n))
        {
          return;
        }
        const LinePlace place = near.at(sideOfNode(field, node)).at(field.sampleAt(node));
        places[n] = float(place.along);
        if (isSampleOf(field.lattice(), range, node))
        {
          this->addSample(place, values[n]);
          if (values[n] > 0.0f)
          {
            this->From = hasSamples ? std::min(this->From, place.along) : place.along;
            this->To = hasSamples ? std::max(this->To, place.along) : place.along;
            hasSamples = true;
          }
        }
      });
  }
  this->findWholeSlices();
}

/// Returns the number of a slice, as a fraction between the middles of two of them.
double DepthsAlong::sliceAt(double along) const
{
  const double slice = along / this->Thickness - 0.5;
  const auto count = double(this->Slices.size());
  if (this->Line.period() > 0.0)
  {
    const double around = slice - count * std::floor(slice / count);
    return around < count ? around : 0.0; // by rounding
  }
  return std::clamp(slice, 0.0, count - 1.0);
}

void DepthsAlong::addSample(const LinePlace& place, float depth)
{
  if (double(depth) <= -this->Spacing)
  {
    return;
  }
  const double at = this->sliceAt(place.along);
  const auto lower = std::size_t(at);
  const std::size_t upper = (lower + 1) % this->Slices.size();
  const auto part = float(at - double(lower));
  const std::array<std::pair<std::size_t, float>, 2> shares{ { { lower, 1.0f - part }, { upper, part } } };
  for (const auto& [slice, weight] : shares)
  {
    if (weight > 0.0f)
    {
      this->Slices[slice].shares.push_back({ depth, weight });
      this->Slices[slice].widest =
        depth > 0.0f ? std::max(this->Slices[slice].widest, place.distance) : this->Slices[slice].widest;
    }
  }
}

/// Finds the slices that no face of the box cuts; all that have samples, if each is cut.
void DepthsAlong::findWholeSlices()
{
  bool isAnyWhole = false;
  for (std::size_t i = 0; i < this->Slices.size(); ++i)
  {
    Slice& slice = this->Slices[i];
    const Eigen::Vector3d middle = this->Line.point(this->placeOf(i));
    const Eigen::Vector3d direction = this->Line.direction(this->placeOf(i));
    slice.isWhole = slice.widest > 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const auto a = Eigen::Index(axis);
      const std::vector<double>& planes = this->Field.lattice().planes[axis];
      const double reach = slice.widest * std::sqrt(std::max(0.0, 1.0 - direction[a] * direction[a])) +
                           0.5 * this->Thickness * std::abs(direction[a]);
      const bool isInside = middle[a] - reach >= planes.front() && middle[a] + reach <= planes.back();
      slice.isWhole = slice.isWhole && (this->Field.repeats(axis) || isInside);
    }
    isAnyWhole = isAnyWhole || slice.isWhole;
  }
  for (Slice& slice : this->Slices)
  {
    slice.isWhole = isAnyWhole ? slice.isWhole : slice.widest > 0.0;
  }
}

/// Returns the area of what lies below a depth, as a number of samples: one counts in part if it is within half a voxel.
double DepthsAlong::areaBelow(const Slice& slice, double depth) const
{
  double area = 0.0;
  for (const Share& share : slice.shares)
  {
    area += double(share.weight) * std::clamp((double(share.depth) - depth) / this->Spacing + 0.5, 0.0, 1.0);
  }
  return area;
}

/// Returns the depth, from `from` on, below which there is an area.
double DepthsAlong::depthFor(const Slice& slice, double area, double from) const
{
  double lower = from;
  double upper = from;
  for (const Share& share : slice.shares)
  {
    upper = std::max(upper, double(share.depth) + 0.5 * this->Spacing);
  }
  while (upper - lower > depthTolerance)
  {
    const double middle = 0.5 * (lower + upper);
    (this->areaBelow(slice, middle) > area ? lower : upper) = middle;
  }
  return 0.5 * (lower + upper);
}

/// Returns the whole slice that is nearest to each; none, if there is no sample.
std::vector<std::size_t> DepthsAlong::nearestWhole() const
{
  std::vector<std::size_t> whole;
  for (std::size_t i = 0; i < this->Slices.size(); ++i)
  {
    if (this->Slices[i].isWhole)
    {
      whole.push_back(i);
    }
  }
  std::vector<std::size_t> nearest;
  for (std::size_t i = 0; i < this->Slices.size() && !whole.empty(); ++i)
  {
    const auto behind = std::lower_bound(whole.begin(), whole.end(), i);
    const auto before = behind == whole.begin() ? behind : behind - 1;
    const bool isBehindNearer = behind != whole.end() && (*before > i || *behind - i < i - *before);
    nearest.push_back(isBehindNearer ? *behind : *before);
  }
  return nearest;
}

/// Returns the depths of all slices, smoothed, with straight lines between them. Where a slice is not whole, the depths of whole
/// ones go on; or it has the depth that the nearest whole one would have at its place (`isLocal`).
AlongLine DepthsAlong::smooth(const std::function<double(const Slice&, double along)>& depth, bool isLocal) const
{
  const std::size_t count = this->Slices.size();
  const bool isRing = this->Line.period() > 0.0;
  std::vector<double> depths(count, 0.0);
  const std::vector<std::size_t> nearest = this->nearestWhole();
  for (std::size_t i = 0; i < nearest.size(); ++i)
  {
    if (isLocal || this->Slices[i].isWhole)
    {
      depths[i] = depth(this->Slices[nearest[i]], this->placeOf(i));
    }
  }
  for (std::size_t i = 0; i < nearest.size() && !isLocal; ++i)
  {
    if (nearest[i] != i)
    {
      // The depths go on as they end, for a few slices: otherwise smoothing would bend them at the last whole one.
      const bool isBehind = nearest[i] > i;
      const auto steps = std::min(farthestMirrored, isBehind ? nearest[i] - i : i - nearest[i]);
      const std::size_t mirrored = isBehind ? nearest[i] + steps : nearest[i] - steps;
      const bool isKnown = mirrored < count && this->Slices[mirrored].isWhole;
      const double end = depths[nearest[i]];
      depths[i] = isKnown ? std::clamp(2.0 * end - depths[mirrored], 0.5 * end, 1.5 * end) : end;
    }
  }
  for (int pass = 0; pass < smoothingPasses; ++pass)
  {
    const std::vector<double> old = depths;
    for (std::size_t i = 0; i < count; ++i)
    {
      const std::size_t before = i > 0 ? i - 1 : isRing ? count - 1 : 0;
      const std::size_t behind = i + 1 < count ? i + 1 : isRing ? 0 : count - 1;
      depths[i] = 0.25 * (old[before] + old[behind]) + 0.5 * old[i];
    }
  }
  return [this, depths = std::move(depths)](double along)
  {
    const double at = this->sliceAt(along);
    const auto lower = std::size_t(at);
    const std::size_t upper = (lower + 1) % depths.size();
    return depths[lower] + (at - double(lower)) * (depths[upper] - depths[lower]);
  };
}

AlongLine DepthsAlong::depthOfPart(double part, double outer) const
{
  return this->smooth(
    [&](const Slice& slice, double) { return this->depthFor(slice, part * this->areaBelow(slice, outer), outer); });
}

double DepthsAlong::levelOfPart(double part, double outer) const
{
  Slice all;
  for (const Slice& slice : this->Slices)
  {
    if (slice.isWhole)
    {
      all.shares.insert(all.shares.end(), slice.shares.begin(), slice.shares.end());
    }
  }
  return this->depthFor(all, part * this->areaBelow(all, outer), outer);
}

AlongLine DepthsAlong::depthOfPartBelow(double part, const AlongLine& depth) const
{
  return this->smooth([&](const Slice& slice, double along)
    { return this->depthFor(slice, part * this->areaBelow(slice, depth(along)), depth(along)); });
}

AlongLine DepthsAlong::redistributed(const AlongLine& depth, const AlongLine& weight, double shallowest) const
{
  double volume = 0.0;        // in samples
  std::vector<double> wanted; // areas for a factor of 1
  std::vector<double> most;
  for (std::size_t i = 0; i < this->Slices.size(); ++i)
  {
    const double area = this->areaBelow(this->Slices[i], depth(this->placeOf(i)));
    volume += area;
    wanted.push_back(area * weight(this->placeOf(i)));
    most.push_back(std::max(area, this->areaBelow(this->Slices[i], shallowest)));
  }
  const auto held = [&](double factor)
  {
    double sum = 0.0;
    for (std::size_t i = 0; i < wanted.size(); ++i)
    {
      sum += std::min(factor * wanted[i], most[i]);
    }
    return sum;
  };
  double lower = 0.0;
  double upper = 1.0;
  while (upper - lower > redistributionTolerance * upper)
  {
    const double middle = 0.5 * (lower + upper);
    (held(middle) < volume ? lower : upper) = middle;
  }
  return this->smooth(
    [&](const Slice& slice, double along)
    {
      const double own = depth(along);
      const double area = upper * weight(along) * this->areaBelow(slice, own);
      return this->depthFor(slice, area, std::min(own, shallowest));
    },
    true);
}

double DepthsAlong::mean(const AlongLine& of) const
{
  double sum = 0.0;
  double weight = 0.0;
  for (std::size_t i = 0; i < this->Slices.size(); ++i)
  {
    if (this->Slices[i].isWhole)
    {
      sum += of(this->placeOf(i));
      weight += 1.0;
    }
  }
  return weight > 0.0 ? sum / weight : of(0.0);
}

double DepthsAlong::least(const AlongLine& of) const
{
  double result = of(this->placeOf(0));
  for (std::size_t i = 0; i < this->Slices.size(); ++i)
  {
    result = this->Slices[i].shares.empty() ? result : std::min(result, of(this->placeOf(i)));
  }
  return result;
}

SmoothedField DepthsAlong::lowered(const AlongLine& by) const
{
  SmoothedField::NodeNumbers numbers = this->Places;
  for (std::vector<float>& block : numbers)
  {
    for (float& number : block)
    {
      number = std::isnan(number) ? 0.0f : float(by(double(number)));
    }
  }
  return this->Field.lowered(numbers);
}

} // namespace cactus
