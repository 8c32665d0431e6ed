// SPDX-License-Identifier: BSD-3-Clause
// The promises of every reader of tractograms.
#pragma once

#include "Fuzzing.h"
#include "base/Error.h"
#include "io/Tractogram.h"

#include <algorithm>
#include <cmath>

inline void fitsTogether(const cactus::Tractogram& tracks, std::size_t bytes)
{
  const auto& offsets = tracks.offsets;
  promise(offsets.front() == 0 && offsets.back() == tracks.pointCount(), "offsets hold all points");
  promise(std::is_sorted(offsets.begin(), offsets.end()), "offsets do not decrease");
  promise(
    std::all_of(tracks.points.begin(), tracks.points.end(), [](double x) { return std::isfinite(x); }), "points are finite");
  promise(6 * tracks.pointCount() <= bytes, "each point stands in the file");
  for (const auto& values : tracks.pointValues)
  {
    promise(values.values.size() == values.components * tracks.pointCount(), "each point has its values");
  }
  for (const auto& values : tracks.streamlineValues)
  {
    promise(values.values.size() == values.components * tracks.size(), "each streamline has its values");
  }
  for (const auto& group : tracks.groups)
  {
    for (const std::uint32_t streamline : group.streamlines)
    {
      promise(streamline < tracks.size(), "groups are of streamlines");
    }
  }
}

/// Reads, and drops short streamlines; the result is consistent, and exceptions are ours and name the file.
template <typename Read>
void keepsPromises(const std::string& name, std::size_t bytes, Read&& read)
{
  try
  {
    cactus::Tractogram tracks = read();
    fitsTogether(tracks, bytes);
    cactus::dropShortStreamlines(tracks);
    fitsTogether(tracks, bytes);
    for (std::size_t s = 0; s < tracks.size(); ++s)
    {
      promise(tracks.offsets[s + 1] - tracks.offsets[s] >= 2, "short streamlines are gone");
    }
  }
  catch (const cactus::Error& error)
  {
    promise(std::string(error.what()).find(name) != std::string::npos, "a message names the file");
  }
}
