// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fibres/Capsules.h"
#include "optimiser/SearchKernels.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace cactus
{

/// A bounding box in single precision. Four numbers make a vector: the fourth of each corner is unused.
struct RunBox
{
  Eigen::Array4f lower;
  Eigen::Array4f upper;
};

/// Extends `box` to hold `other`.
void extend(RunBox& box, const RunBox& other);

/// The number of consecutive runs that one thread processes at a time.
constexpr std::size_t runsTogether = 1024;

/// Short runs of consecutive capsules of a fibre, which have most neighbours in common, and the boxes that hold everything within
/// their reach.
class CapsuleRuns
{
public:
  /// The largest number of capsules in a run.
  static constexpr std::size_t longest = 6;

  /// `reach`: per capsule, beyond its radius (µm). Boxes of capsules within reach of each other overlap.
  CapsuleRuns(const Capsules& capsules, const std::vector<float>& reach, int threads);

  std::size_t size() const { return this->Boxes.size(); }
  /// Returns the first capsule of each run, and one past the last capsule of all.
  const std::vector<std::uint32_t>& first() const { return this->First; }
  const std::vector<RunBox>& boxes() const { return this->Boxes; }
  /// Returns the boxes of each run's capsules.
  const BoxBlock* blocks() const { return this->Blocks.get(); }

private:
  std::vector<std::uint32_t> First;
  std::vector<RunBox> Boxes;
  std::unique_ptr<BoxBlock[]> Blocks;
};

} // namespace cactus
