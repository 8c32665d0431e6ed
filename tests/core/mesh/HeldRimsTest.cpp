// SPDX-License-Identifier: BSD-3-Clause
// Guarantees: of the rim of a cap that is thinner than the error enough points stay for the cap not to vanish, in either face.
#include "mesh/HeldRims.h"

#include "mesh/ExampleContours.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <set>

namespace
{

using namespace cactus;

constexpr double rimError = 0.0025;

/// Faces across all axes.
constexpr std::uint8_t allFaces = 0x3f;

std::size_t countIf(const std::set<std::array<double, 3>>& places, bool (*isWanted)(const std::array<double, 3>&))
{
  return std::size_t(std::count_if(places.begin(), places.end(), isWanted));
}

// A ball outside the box reaches over an edge of it: its cap in the face z = 1 is 2 nm wide, between two points on the edge.
TEST(HeldRims, ASliverAtAnEdgeOfTheBoxStays)
{
  const double across = std::sqrt(0.8 * 0.8 - 0.3 * 0.3);
  CappedSurface surface = example::ballInBox({ 0.0, 1.0 + across - 0.002, 0.7 });
  surface.held = allFaces;
  const auto places = HeldRims(surface, rimError, 1.0).stays();
  ASSERT_NE(places, nullptr);
  EXPECT_EQ(countIf(*places, [](const auto& p) { return p[2] == 1.0 && p[1] == 1.0; }), 2u);
  EXPECT_EQ(
    countIf(*places, [](const auto& p) { return p[2] == 1.0 && p[1] < 1.0 && p[1] > 0.997 && std::abs(p[0]) < 0.01; }), 1u);
}

// A sheet 2 nm thick.
TEST(HeldRims, ASliverAmidAFaceStays)
{
  const NodeLattice lattice = example::cubeLattice(21, 0.1);
  CappedSurface surface = contour(lattice, example::allBlocks(lattice),
    example::sampled([](int i, int j, int) { return std::min(0.001 - 0.1 * std::abs(j - 10), 0.32 - 0.1 * std::abs(i - 10)); }));
  surface.held = allFaces;
  const auto places = HeldRims(surface, rimError, 1.0).stays();
  ASSERT_NE(places, nullptr);
  EXPECT_EQ(countIf(*places, [](const auto& p) { return p[2] == -1.0; }), 3u);
  EXPECT_EQ(countIf(*places, [](const auto& p) { return p[2] == 1.0; }), 3u);
}

} // namespace
