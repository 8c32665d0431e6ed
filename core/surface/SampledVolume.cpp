// SPDX-License-Identifier: BSD-3-Clause
#include "surface/SampledVolume.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace cactus
{

namespace
{

constexpr int mostNewtonSteps = 40;
/// µm, far below the moves of coarsening.
constexpr double sampledTolerance = 1e-4;
/// Sums in single precision are over so few samples that they are accurate to a millionth.
constexpr std::size_t samplesAtOnce = 1024;

/// Sums over samples in lanes, by the index modulo `lanes`, which can be vectorised.
struct SampledSums
{
  static constexpr int lanes = 16;

  float volume[lanes] = {};
  float slope[lanes] = {};
  float bend[lanes] = {};

  /// Adds the volume of the samples' boxes above a level, and its derivatives; see SampledVolume::measureAt(). `count` is a
  /// multiple of the lanes.
  void add(const float* depths, const float* volumes, std::size_t count, float level, float perWidth)
  {
    for (std::size_t n = 0; n < count; n += lanes)
    {
      for (int lane = 0; lane < lanes; ++lane)
      {
        const float box = volumes[n + std::size_t(lane)];
        const float t = std::max(std::min((depths[n + std::size_t(lane)] - level) * perWidth, 1.0f), -1.0f);
        const float square = t * t;
        const float rest = 1.0f - square;
        volume[lane] += box * (0.5f + t * (15.0f - square * (10.0f - 3.0f * square)) * 0.0625f);
        slope[lane] += box * rest * rest;
        bend[lane] -= box * t * rest;
      }
    }
  }
};

static_assert(samplesAtOnce % SampledSums::lanes == 0);

/// Returns the lengths (µm) of the boxes of an axis's samples, by node: those beside the faces reach up to them, whose own nodes
/// have none.
std::vector<float> lengthsAlong(const std::vector<double>& planes)
{
  std::vector<float> lengths(planes.size(), 0.0f);
  const std::size_t last = planes.size() - 1;
  for (std::size_t i = 1; i < last; ++i)
  {
    const double below = i == 1 ? planes[0] : 0.5 * (planes[i - 1] + planes[i]);
    const double above = i + 1 == last ? planes[last] : 0.5 * (planes[i] + planes[i + 1]);
    lengths[i] = static_cast<float>(above - below);
  }
  return lengths;
}

/// Returns the distance between samples; if all axes have one sample only, between the faces.
double spacingOf(const NodeLattice& lattice)
{
  double spacing = lattice.planes[0].back() - lattice.planes[0].front();
  for (const std::vector<double>& planes : lattice.planes)
  {
    spacing = planes.size() > 3 ? std::min(spacing, planes[2] - planes[1]) : spacing;
  }
  return spacing;
}

} // namespace

SampledVolume::SampledVolume(const SmoothedField& field, const NodeLattice& lattice, double lowest)
  : Spacing(spacingOf(lattice))
  , Deepest(lowest)
{
  const std::array<std::vector<float>, 3> lengths{ { lengthsAlong(lattice.planes[0]), lengthsAlong(lattice.planes[1]),
    lengthsAlong(lattice.planes[2]) } };
  const auto least = static_cast<float>(lowest - this->Spacing);
  std::vector<float> values;
  for (const std::uint32_t block : field.blocks())
  {
    const NodeRange nodes = nodesOfBlock(lattice, block);
    const NodeRange around = nodes.widened(1);
    values.resize(around.size());
    field.values(0.0, 0.0, around, values.data());
    // Blocks share their outermost nodes: the last ones count for the next block.
    const auto end = [&](std::size_t axis) { return std::min(nodes.count[axis], NodeLattice::blockCells); };
    for (int k = 0; k < end(2); ++k)
    {
      for (int j = 0; j < end(1); ++j)
      {
        const float area = lengths[1][std::size_t(nodes.first[1] + j)] * lengths[2][std::size_t(nodes.first[2] + k)];
        const float* row = values.data() + 1 + around.count[0] * (j + 1 + around.count[1] * (k + 1));
        const float* along = lengths[0].data() + nodes.first[0];
        float deepest = least; // most rows are outside the fibre
        for (int i = 0; i < end(0); ++i)
        {
          deepest = row[i] > deepest ? row[i] : deepest;
        }
        for (int i = 0; deepest > least && i < end(0); ++i)
        {
          if (row[i] > least && area * along[i] > 0.0f)
          {
            this->Depths.push_back(row[i]);
            this->Volumes.push_back(area * along[i]);
            this->Deepest = std::max(this->Deepest, double(row[i]));
            this->Inside += row[i] > 0.0f ? double(area * along[i]) : 0.0;
          }
        }
      }
    }
  }
  const std::size_t whole = (this->Depths.size() + SampledSums::lanes - 1) / SampledSums::lanes * SampledSums::lanes;
  this->Depths.resize(whole, 0.0f);
  this->Volumes.resize(whole, 0.0f);
}

/// A box counts in part if its sample is nearer to the level than a voxel: by a polynomial with zero slope at both ends, so that
/// the position of the surface between the samples hardly matters. Two effects make the sum larger than the volume of a contour:
/// around a convex surface more volume lies outside than inside, by its curvature times the variance of that ramp, a seventh of a
/// square voxel; and a contour cuts the curve short in each cell.
SampledVolume::Measure SampledVolume::measureAt(double level) const
{
  const double perWidth = 1.0 / this->Spacing;
  Measure result;
  double slope = 0.0;
  double bend = 0.0;
  const std::size_t count = this->Depths.size();
  for (std::size_t begin = 0; begin < count; begin += samplesAtOnce)
  {
    SampledSums sums;
    sums.add(this->Depths.data() + begin, this->Volumes.data() + begin, std::min(samplesAtOnce, count - begin), float(level),
      float(perWidth));
    for (int lane = 0; lane < SampledSums::lanes; ++lane)
    {
      result.volume += sums.volume[lane];
      slope += sums.slope[lane];
      bend += sums.bend[lane];
    }
  }
  result.area = 15.0 / 16.0 * perWidth * slope;
  const double curvature = 15.0 / 4.0 * perWidth * perWidth * bend; // integral over the surface, µm
  result.volume -= (1.0 / 14.0 + 1.0 / 12.0) * this->Spacing * this->Spacing * curvature;
  return result;
}

double SampledVolume::levelOf(double volume, double lower, double upper) const
{
  // In a round fibre the level falls from the middle as the root of the volume.
  const double part = this->Inside > 0.0 ? std::clamp(volume / this->Inside, 0.0, 1.0) : 1.0;
  double level = std::clamp(this->Deepest * (1.0 - std::sqrt(part)), lower, std::max(lower, upper));
  for (int step = 0; step < mostNewtonSteps && upper - lower > sampledTolerance; ++step)
  {
    const Measure now = this->measureAt(level);
    const double error = now.volume - volume;
    (error > 0.0 ? lower : upper) = level;
    const double newton = now.area > 0.0 ? level + error / now.area : level;
    if (now.area > 0.0 && std::abs(newton - level) < sampledTolerance)
    {
      break;
    }
    level = newton > lower && newton < upper ? newton : 0.5 * (lower + upper);
  }
  return level;
}

} // namespace cactus
