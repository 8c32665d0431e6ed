// SPDX-License-Identifier: BSD-3-Clause
#include "growth/FieldKernels.h"

#include "growth/CandidateSearch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace
{

using cactus::CellSamples;
using cactus::FieldCell;
using Eigen::Vector3d;

constexpr double spacing = 0.1;
constexpr int conesPerFibre = 6;

/// Makes fibres in and around a cell about the origin; some of their cones are balls, and some have constant radius.
std::vector<cactus::Cone> randomCones(int fibres, unsigned seed)
{
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto point = [&] { return Vector3d(uniform(engine), uniform(engine), uniform(engine)); };
  std::vector<cactus::Cone> cones;
  for (int n = 0; n < conesPerFibre * fibres; ++n)
  {
    const Vector3d start = point();
    const Vector3d end = start + (n % 5 == 0 ? 0.05 : 1.0) * point();
    const double radius = 0.3 + 0.2 * uniform(engine);
    cones.push_back(cactus::coneBetween(start, end, radius, n % 4 == 1 ? radius : 0.3 + 0.2 * uniform(engine)));
  }
  return cones;
}

/// Makes chains of short cones side by side, like fibres along z with a rough surface.
std::vector<cactus::Cone> chains(int fibres, unsigned seed)
{
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::vector<cactus::Cone> cones;
  for (int f = 0; f < fibres; ++f)
  {
    const Vector3d middle(1.2 * uniform(engine), 1.2 * uniform(engine), 0.1 * uniform(engine));
    const Vector3d step(0.05 * uniform(engine), 0.05 * uniform(engine), 0.3);
    double radius = 0.4 + 0.1 * uniform(engine);
    for (int n = 0; n < conesPerFibre; ++n)
    {
      const double next = 0.4 + 0.1 * uniform(engine);
      const Vector3d start = middle + (n - 0.5 * conesPerFibre) * step;
      cones.push_back(cactus::coneBetween(start, start + step, radius, next));
      radius = next;
    }
  }
  return cones;
}

cactus::Candidates candidatesOf(const std::vector<cactus::Cone>& cones)
{
  cactus::Candidates candidates;
  for (std::size_t n = 0; n < cones.size(); ++n)
  {
    if (n % conesPerFibre == 0)
    {
      candidates.beginGroup(int(n / conesPerFibre));
    }
    candidates.add(cones[n], Vector3d::Zero());
  }
  candidates.finish();
  return candidates;
}

Vector3d position(int n)
{
  constexpr int edge = FieldCell::edge;
  return spacing * (Vector3d(n % edge, n / edge % edge, n / (edge * edge)) - Vector3d::Constant(0.5 * (edge - 1)));
}

/// Returns a cube about a place, with some room.
cactus::SamplePlace cubeAround(const Vector3d& centre, double half)
{
  return { { float(centre.x()), float(centre.y()), float(centre.z()) }, float(half * 1.001),
    float(half * std::sqrt(3.0) * 1.001) };
}

constexpr double cellHalf = 0.5 * spacing * (FieldCell::edge - 1);

/// isNarrowed: with the cones that matter in a larger cube, of which the cell is a corner.
CellSamples evaluate(const cactus::FieldKernels& kernels, const std::vector<cactus::Cone>& cones, bool isNarrowed)
{
  constexpr float infinity = 1e20f;
  const cactus::CellRelevance relevance = { infinity, infinity, infinity, infinity };
  cactus::Candidates candidates = candidatesOf(cones);
  cactus::Candidates few;
  few.makeRoomFor(candidates);
  cactus::ConeGroups near = candidates.all();
  if (isNarrowed)
  {
    near = few.all();
    kernels.narrow(candidates.all(), relevance, cubeAround(Vector3d::Constant(2.0 * spacing), cellHalf + 2.0 * spacing), near);
  }
  CellSamples samples = {};
  for (int n = 0; n < FieldCell::size; ++n)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      samples.position[axis][n] = float(position(n)[axis]);
    }
  }
  samples.place = cubeAround(Vector3d::Zero(), cellHalf);
  kernels.evaluateCell(near, relevance, samples);
  return samples;
}

/// Calls visit(cones) with bundles of all kinds.
void forEachBundle(const std::function<void(const std::vector<cactus::Cone>&)>& visit)
{
  for (unsigned seed = 1; seed <= 20; ++seed)
  {
    for (const int fibres : { 1, 2, 3, 7, 20 })
    {
      SCOPED_TRACE(std::to_string(fibres) + " fibres, seed " + std::to_string(seed));
      visit(randomCones(fibres, seed));
      visit(chains(fibres, seed));
    }
  }
}

} // namespace

// Guarantee: growth has the same bits on every vector unit, even if cones do not fill a vector.
TEST(FieldKernels, SameBitsOnEveryVectorUnit)
{
  forEachBundle(
    [](const std::vector<cactus::Cone>& cones)
    {
      for (const bool isNarrowed : { false, true })
      {
        const CellSamples first = evaluate(cactus::portableFieldKernels, cones, isNarrowed);
        for (const cactus::FieldKernels* kernels : cactus::runnableKernels<cactus::FieldKernels>())
        {
          const CellSamples result = evaluate(*kernels, cones, isNarrowed);
          for (int n = 0; n < FieldCell::size; ++n)
          {
            ASSERT_EQ(result.best[n], first.best[n]);
            ASSERT_EQ(result.second[n], first.second[n]);
            ASSERT_EQ(result.rank[n], first.rank[n]);
          }
        }
      }
    });
}

// Guarantee: leaving out cones that do not matter in a cell still finds the two largest fields at each of its samples.
TEST(FieldKernels, FindsTheTwoLargestFields)
{
  forEachBundle(
    [](const std::vector<cactus::Cone>& cones)
    {
      const CellSamples result = evaluate(cactus::bestKernels<cactus::FieldKernels>(), cones, false);
      for (int n = 0; n < FieldCell::size; ++n)
      {
        std::vector<double> fields;
        for (std::size_t c = 0; c < cones.size(); c += conesPerFibre)
        {
          double field = -std::numeric_limits<double>::infinity();
          for (std::size_t k = c; k < c + conesPerFibre; ++k)
          {
            field = std::max(field, cactus::coneValue(cones[k], position(n)));
          }
          fields.push_back(field);
        }
        ASSERT_NEAR(fields[std::size_t(result.rank[n])], result.best[n], 1e-5);
        std::sort(fields.begin(), fields.end(), std::greater<double>());
        ASSERT_NEAR(result.best[n], fields[0], 1e-5);
        if (fields.size() > 1)
        {
          ASSERT_NEAR(result.second[n], fields[1], 1e-5);
        }
      }
    });
}

// Guarantee: leaving out cones beforehand, for a larger cube, changes no bit.
TEST(FieldKernels, NarrowingChangesNothing)
{
  std::size_t kept = 0;
  std::size_t all = 0;
  forEachBundle(
    [&](const std::vector<cactus::Cone>& cones)
    {
      const CellSamples whole = evaluate(cactus::bestKernels<cactus::FieldKernels>(), cones, false);
      const CellSamples narrowed = evaluate(cactus::bestKernels<cactus::FieldKernels>(), cones, true);
      for (int n = 0; n < FieldCell::size; ++n)
      {
        ASSERT_EQ(narrowed.best[n], whole.best[n]);
        ASSERT_EQ(narrowed.second[n], whole.second[n]);
        ASSERT_EQ(narrowed.rank[n], whole.rank[n]);
      }
      cactus::Candidates candidates = candidatesOf(cones);
      cactus::Candidates few;
      few.makeRoomFor(candidates);
      cactus::ConeGroups near = few.all();
      cactus::bestKernels<cactus::FieldKernels>().narrow(
        candidates.all(), { 1e20f, 1e20f, 1e20f, 1e20f }, cubeAround(Vector3d::Zero(), cellHalf), near);
      kept += near.cones.count;
      all += cones.size();
    });
  EXPECT_LT(2 * kept, all); // it does leave out some
}
