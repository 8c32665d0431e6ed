// SPDX-License-Identifier: BSD-3-Clause
#include "optimiser/CapsuleRuns.h"

#include "base/Parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cactus
{

namespace
{

/// Returns a capsule's bounding box, larger by its reach and by a millionth of its coordinates, so that rounding to single
/// precision loses no pair.
RunBox boxOf(const Capsule& capsule, float reach)
{
  const double radius = std::max(capsule.r0, capsule.r1) + static_cast<double>(reach);
  RunBox box = { Eigen::Array4f::Zero(), Eigen::Array4f::Zero() };
  for (int axis = 0; axis < 3; ++axis)
  {
    const double lower = std::min(capsule.p0[axis], capsule.p1[axis]) - radius;
    const double upper = std::max(capsule.p0[axis], capsule.p1[axis]) + radius;
    box.lower[axis] = static_cast<float>(lower - 1e-6 * std::abs(lower));
    box.upper[axis] = static_cast<float>(upper + 1e-6 * std::abs(upper));
  }
  return box;
}

/// Returns a box that overlaps no other.
RunBox emptyBox()
{
  constexpr float infinity = std::numeric_limits<float>::infinity();
  const Eigen::Array4f corner(infinity, infinity, infinity, 0.0f);
  return { corner, -corner };
}

} // namespace

void extend(RunBox& box, const RunBox& other)
{
  box.lower = box.lower.min(other.lower);
  box.upper = box.upper.max(other.upper);
}

CapsuleRuns::CapsuleRuns(const Capsules& capsules, const std::vector<float>& reach, int threads)
{
  for (std::size_t k = 0; k < capsules.size();)
  {
    this->First.push_back(static_cast<std::uint32_t>(k));
    const std::size_t begin = k;
    const auto follows = [&](std::size_t next)
    { return capsules.fibre[next] == capsules.fibre[next - 1] && capsules.first[next] == capsules.first[next - 1] + 1; };
    for (++k; k < capsules.size() && k < begin + longest && follows(k);)
    {
      ++k;
    }
  }
  const std::size_t count = this->First.size();
  this->First.push_back(static_cast<std::uint32_t>(capsules.size()));
  this->Boxes.resize(count);
  this->Blocks.reset(new BoxBlock[count]);
  parallelForInBlocks(count, runsTogether, threads,
    [&](std::size_t run)
    {
      RunBox all = emptyBox();
      BoxBlock& block = this->Blocks[run];
      for (std::uint32_t l = 0; l < 8; ++l)
      {
        const std::uint32_t k = this->First[run] + l;
        const RunBox box = k < this->First[run + 1] ? boxOf(capsules.bodies[k], reach[k]) : emptyBox();
        extend(all, box);
        for (int axis = 0; axis < 3; ++axis)
        {
          block.bounds[axis][l] = box.lower[axis];
          block.bounds[axis][8 + l] = -box.upper[axis];
        }
      }
      this->Boxes[run] = all;
    });
}

} // namespace cactus
