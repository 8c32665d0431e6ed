// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Random123/conventional/Engine.hpp>
#include <Random123/philox.h>

#include <cstdint>

namespace cactus
{

/// The purpose of a stream of random numbers. Values are part of the reproducibility promise: never renumber.
enum class RandomStage : std::uint32_t
{
  Radii = 1,
  Packing = 2,
  Directions = 3,
  Seeds = 4,
  GRatio = 5,
  Optimiser = 6,
  StartPositions = 7,
  ExtraAxonalWalk = 8,
  Sample = 9,
  Calibre = 10,
  Lesion = 11,
  Nodes = 12,
  Sections = 13,
  Internodes = 14,
  SeedPoints = 15,
  Swellings = 16,
  SwellingCount = 17
};

/// A counter-based C++11 random engine (Random123, Philox4x32-10). Its numbers are the same everywhere. The distributions of
/// <random> are not, so RandomVariates.h replaces them.
using RandomEngine = r123::Engine<r123::Philox4x32>;

/// Returns the stream of one seed, stage and item (a fibre, a bundle, a circle): the same numbers in every thread and rank, in
/// whatever order the items are visited.
inline RandomEngine randomStream(std::uint64_t seed, RandomStage stage, std::uint64_t item = 0)
{
  const RandomEngine::key_type key = { { static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32) } };
  RandomEngine engine(key);
  const RandomEngine::ctr_type counter = { { 0, static_cast<std::uint32_t>(stage), static_cast<std::uint32_t>(item),
    static_cast<std::uint32_t>(item >> 32) } };
  engine.setcounter(counter, 0);
  return engine;
}

/// Returns a uniform number in (0, 1), never 0 or 1, with 53 bits; the same on every platform.
inline double uniform(RandomEngine& engine)
{
  const std::uint64_t high = engine();
  const std::uint64_t bits = ((high << 32) | engine()) >> 12;
  return (static_cast<double>(bits) + 0.5) * 0x1p-52;
}

} // namespace cactus
