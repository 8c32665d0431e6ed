// SPDX-License-Identifier: BSD-3-Clause
#include "bundle/Streamlines.h"

#include "base/Error.h"
#include "base/Limits.h"

#include <algorithm>

namespace cactus
{

namespace
{

void requireLength(const Streamlines& streamlines, std::size_t streamline)
{
  const auto begin = streamlines.points.begin() + static_cast<std::ptrdiff_t>(streamlines.offsets[streamline]);
  const auto end = streamlines.points.begin() + static_cast<std::ptrdiff_t>(streamlines.offsets[streamline + 1]);
  if (std::all_of(begin, end, [&](const Eigen::Vector3d& point) { return point == *begin; }))
  {
    throw InvalidInput(text("all points of streamline ", streamline + 1, " are in one place: remove it"));
  }
}

std::vector<std::size_t> selected(const Streamlines& streamlines, const TractFibresOptions& options)
{
  std::vector<std::size_t> found;
  for (std::size_t s = 0; s < streamlines.size(); ++s)
  {
    const std::size_t number = s + 1;
    const bool isTaken = options.select == StreamlineSelection::All ||
                         (options.select == StreamlineSelection::Range && number >= static_cast<std::size_t>(options.first) &&
                           number <= static_cast<std::size_t>(options.last)) ||
                         (options.select == StreamlineSelection::Bundle && !streamlines.bundleIds.empty() &&
                           streamlines.bundleIds[s] == options.bundleId);
    if (isTaken)
    {
      found.push_back(s);
    }
  }
  if (!found.empty())
  {
    return found;
  }
  if (options.select == StreamlineSelection::Bundle)
  {
    throw InvalidInput(streamlines.bundleIds.empty()
                         ? std::string("the streamlines have no cell data BundleId to select a bundle by")
                         : text("no streamline has the BundleId ", options.bundleId));
  }
  throw InvalidInput(text("there is no streamline ", options.first, " (FirstStreamline): the input has ", streamlines.size()));
}

/// Returns the point half way along a streamline.
Eigen::Vector3d halfWay(const Streamlines& streamlines, std::size_t streamline)
{
  const std::size_t begin = streamlines.offsets[streamline];
  const std::size_t last = streamlines.offsets[streamline + 1] - 1;
  const auto lengthOf = [&](std::size_t i) { return (streamlines.points[i + 1] - streamlines.points[i]).norm(); };
  double left = 0.0;
  for (std::size_t i = begin; i < last; ++i)
  {
    left += 0.5 * lengthOf(i);
  }
  for (std::size_t i = begin; i < last; ++i)
  {
    const double length = lengthOf(i);
    if (left <= length && length > 0.0)
    {
      return streamlines.points[i] + left / length * (streamlines.points[i + 1] - streamlines.points[i]);
    }
    left -= length;
  }
  return streamlines.points[last];
}

StreamlinePlace nearestPlace(const Streamlines& streamlines, std::size_t streamline, const Eigen::Vector3d& to)
{
  StreamlinePlace nearest;
  nearest.streamline = streamline;
  nearest.distance = -1.0;
  for (std::size_t i = streamlines.offsets[streamline]; i + 1 < streamlines.offsets[streamline + 1]; ++i)
  {
    const Eigen::Vector3d& from = streamlines.points[i];
    const Eigen::Vector3d along = streamlines.points[i + 1] - from;
    const double squared = along.squaredNorm();
    const double part = squared > 0.0 ? std::clamp((to - from).dot(along) / squared, 0.0, 1.0) : 0.0;
    const Eigen::Vector3d point = from + part * along;
    const double distance = (point - to).norm();
    if (nearest.distance < 0.0 || distance < nearest.distance)
    {
      nearest.segment = i;
      nearest.point = point;
      nearest.distance = distance;
    }
  }
  return nearest;
}

/// Returns the nearest places to `to` on these streamlines, the nearest first, equal ones in their order.
std::vector<StreamlinePlace> placesBy(
  const Streamlines& streamlines, const std::vector<std::size_t>& which, const Eigen::Vector3d& to)
{
  std::vector<StreamlinePlace> places;
  places.reserve(which.size());
  for (const std::size_t s : which)
  {
    places.push_back(nearestPlace(streamlines, s, to));
  }
  std::stable_sort(
    places.begin(), places.end(), [](const StreamlinePlace& a, const StreamlinePlace& b) { return a.distance < b.distance; });
  return places;
}

} // namespace

void validate(const Streamlines& streamlines)
{
  require(streamlines.size() > 0, "the input holds no streamlines: connect a TractogramReader or other polylines");
  for (std::size_t s = 0; s < streamlines.size(); ++s)
  {
    if (streamlines.pointCount(s) < 2)
    {
      throw InvalidInput(text("streamline ", s + 1, " has fewer than two points: remove it"));
    }
    for (std::size_t i = streamlines.offsets[s]; i < streamlines.offsets[s + 1]; ++i)
    {
      for (const double coordinate : streamlines.points[i])
      {
        if (!limits::streamlineCoordinate.holds(coordinate))
        {
          requireWithin(text("streamline ", s + 1, ", point ", i - streamlines.offsets[s] + 1, ": a coordinate").c_str(),
            coordinate, limits::streamlineCoordinate);
        }
      }
    }
    requireLength(streamlines, s);
  }
}

StreamlineChoice chooseStreamlines(const Streamlines& streamlines, const TractFibresOptions& options, double reach)
{
  const std::vector<std::size_t> which = selected(streamlines, options);
  Eigen::Vector3d aim(options.pointX, options.pointY, options.pointZ);
  if (options.middle == TractMiddle::Tract)
  {
    aim.setZero();
    for (const std::size_t s : which)
    {
      aim += halfWay(streamlines, s) / static_cast<double>(which.size());
    }
  }
  StreamlineChoice choice;
  choice.middle = placesBy(streamlines, which, aim).front().point;
  choice.places = placesBy(streamlines, which, choice.middle);
  const auto isBeyond = [&](const StreamlinePlace& place) { return place.distance > reach; };
  choice.places.erase(std::find_if(choice.places.begin(), choice.places.end(), isBeyond), choice.places.end());
  if (options.numberOfStreamlines > 0 && choice.places.size() > static_cast<std::size_t>(options.numberOfStreamlines))
  {
    choice.places.resize(static_cast<std::size_t>(options.numberOfStreamlines));
  }
  return choice;
}

} // namespace cactus
