// SPDX-License-Identifier: BSD-3-Clause
#include "growth/FieldKernels.h"

#include "growth/CandidateSearch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <random>
#include <vector>

namespace
{

using cactus::CellSamples;
using cactus::FieldCell;

constexpr double spacing = 0.1;

/// Cones of `fibres` fibres in and around a cell about the origin, three each; some are balls, and some
/// everywhere as thick.
std::vector<cactus::Cone> randomCones(int fibres)
{
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto point = [&] { return Eigen::Vector3d(uniform(engine), uniform(engine), uniform(engine)); };
  std::vector<cactus::Cone> cones;
  for (int n = 0; n < 3 * fibres; ++n)
  {
    const Eigen::Vector3d start = point();
    const Eigen::Vector3d end = start + (n % 5 == 0 ? 0.05 : 1.0) * point();
    const double radius = 0.3 + 0.2 * uniform(engine);
    cones.push_back(cactus::coneBetween(start, end, radius, n % 4 == 1 ? radius : 0.3 + 0.2 * uniform(engine)));
  }
  return cones;
}

cactus::Candidates candidatesOf(const std::vector<cactus::Cone>& cones)
{
  cactus::Candidates candidates;
  for (std::size_t n = 0; n < cones.size(); ++n)
  {
    if (n % 3 == 0)
    {
      candidates.beginGroup(int(n / 3));
    }
    candidates.add(cones[n], Eigen::Vector3d::Zero());
  }
  candidates.finish();
  return candidates;
}

Eigen::Vector3d position(int n)
{
  const int plane = FieldCell::sizeX * FieldCell::sizeY;
  return spacing * Eigen::Vector3d(n % FieldCell::sizeX - 3.5, n % plane / FieldCell::sizeX - 1.5, n / plane - 1.5);
}

CellSamples cellAboutOrigin()
{
  CellSamples samples = {};
  for (int n = 0; n < FieldCell::size; ++n)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      samples.position[axis][n] = float(position(n)[axis]);
    }
    samples.extent = std::max(samples.extent, float(position(n).norm() * 1.001));
  }
  return samples;
}

CellSamples evaluate(const cactus::FieldKernels& kernels, const std::vector<cactus::Cone>& cones)
{
  cactus::Candidates candidates = candidatesOf(cones);
  CellSamples samples = cellAboutOrigin();
  constexpr float infinity = 1e20f;
  kernels.evaluateCell(candidates.columns(), candidates.groups().data(), candidates.groups().size(),
    { infinity, infinity, infinity, infinity }, samples);
  return samples;
}

} // namespace

// Guarantee: growth has the same bits on every vector unit, also where cones do not fill a vector.
TEST(FieldKernels, SameBitsOnEveryVectorUnit)
{
  for (const int fibres : { 1, 2, 3, 7, 20 })
  {
    const std::vector<cactus::Cone> cones = randomCones(fibres);
    const CellSamples first = evaluate(cactus::portableFieldKernels, cones);
    for (const cactus::FieldKernels* kernels : cactus::runnableKernels<cactus::FieldKernels>())
    {
      const CellSamples result = evaluate(*kernels, cones);
      for (int n = 0; n < FieldCell::size; ++n)
      {
        ASSERT_EQ(result.best[n], first.best[n]);
        ASSERT_EQ(result.second[n], first.second[n]);
        ASSERT_EQ(result.rank[n], first.rank[n]);
      }
    }
  }
}

// Guarantee: what leaves out cones far from a cell finds the two largest fields at each of its samples all the same.
TEST(FieldKernels, FindsTheTwoLargestFields)
{
  const std::vector<cactus::Cone> cones = randomCones(20);
  const CellSamples result = evaluate(cactus::bestKernels<cactus::FieldKernels>(), cones);
  for (int n = 0; n < FieldCell::size; ++n)
  {
    std::vector<double> fields;
    for (std::size_t c = 0; c < cones.size(); c += 3)
    {
      double field = -std::numeric_limits<double>::infinity();
      for (std::size_t k = c; k < c + 3; ++k)
      {
        field = std::max(field, cactus::coneValue(cones[k], position(n)));
      }
      fields.push_back(field);
    }
    EXPECT_NEAR(fields[std::size_t(result.rank[n])], result.best[n], 1e-5);
    std::sort(fields.begin(), fields.end(), std::greater<double>());
    EXPECT_NEAR(result.best[n], fields[0], 1e-5);
    EXPECT_NEAR(result.second[n], fields[1], 1e-5);
  }
}
