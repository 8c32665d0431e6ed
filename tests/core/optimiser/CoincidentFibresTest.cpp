// SPDX-License-Identifier: BSD-3-Clause
// Fibres whose axes meet exactly, where the overlap cost is at its peak and has no gradient.
#include "base/Constants.h"
#include "fibres/Capsules.h"
#include "optimiser/CapsuleOptimizer.h"
#include "optimiser/NeighbourSearch.h"
#include "optimiser/OverlapCost.h"
#include "optimiser/OverlapReport.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace
{

using cactus::Fibres;
using Eigen::Vector3d;

Fibres none()
{
  Fibres fibres;
  fibres.domain = cactus::Domain::cube(10.0);
  return fibres;
}

void addStraight(Fibres& fibres, int id, int bundle, const Vector3d& from, const Vector3d& to, int segments = 10)
{
  fibres.addFibre(id, bundle, 0.5);
  for (int i = 0; i <= segments; ++i)
  {
    fibres.addPoint(from + (double(i) / segments) * (to - from), 0.5);
  }
}

/// Fibres along the first `axes` axes, all through the same point.
Fibres crossing(const Vector3d& at, int axes, int segments)
{
  Fibres fibres = none();
  for (int axis = 0; axis < axes; ++axis)
  {
    addStraight(fibres, axis + 1, axis + 1, at - 5.0 * Vector3d::Unit(axis), at + 5.0 * Vector3d::Unit(axis), segments);
  }
  return fibres;
}

Fibres identical(int count)
{
  Fibres fibres = none();
  for (int f = 0; f < count; ++f)
  {
    addStraight(fibres, 7 * f + 3, 1, { 0, 0, -5 }, { 0, 0, 5 });
  }
  return fibres;
}

Fibres identicalWavy()
{
  Fibres fibres = none();
  for (int f = 0; f < 3; ++f)
  {
    fibres.addFibre(f + 1, 1, 0.5);
    for (int i = 0; i <= 20; ++i)
    {
      fibres.addPoint({ std::sin(0.5 * i), 0.0, -5.0 + 0.5 * i }, 0.4 + 0.1 * std::sin(i));
    }
  }
  return fibres;
}

Fibres collinear(double end, double begin)
{
  Fibres fibres = none();
  addStraight(fibres, 1, 1, { 0, 0, -5 }, { 0, 0, end }, 7);
  addStraight(fibres, 2, 1, { 0, 0, begin }, { 0, 0, 5 }, 7);
  return fibres;
}

/// Fibres on an exact square lattice, each of them `copies` times.
Fibres lattice(int side, int copies, double spacing)
{
  Fibres fibres = none();
  for (int n = 0; n < side * side * copies; ++n)
  {
    const int place = n / copies;
    const Vector3d at(spacing * (place % side - 1.5), spacing * (place / side - 1.5), 0.0);
    addStraight(fibres, n + 1, 1, at - 5.0 * Vector3d::UnitZ(), at + 5.0 * Vector3d::UnitZ());
  }
  return fibres;
}

/// Two families of fibres that cross each other in one plane.
Fibres weave()
{
  Fibres fibres = none();
  for (int i = 0; i < 5; ++i)
  {
    const double at = 2.0 * i - 4.0;
    addStraight(fibres, 2 * i + 1, 1, { -5, at, 0 }, { 5, at, 0 });
    addStraight(fibres, 2 * i + 2, 2, { at, -5, 0 }, { at, 5, 0 });
  }
  return fibres;
}

/// Two rings, one a little above the other: they have no direction from end to end.
Fibres rings()
{
  Fibres fibres = none();
  for (int f = 0; f < 2; ++f)
  {
    fibres.addFibre(f + 1, 1, 0.5);
    for (int i = 0; i <= 32; ++i)
    {
      const double angle = (i % 32) * cactus::pi / 16.0;
      fibres.addPoint({ 3.0 * std::cos(angle), 3.0 * std::sin(angle), 0.3 * f }, 0.5);
    }
  }
  return fibres;
}

struct Case
{
  const char* name;
  Fibres fibres;
};

std::vector<Case> cases()
{
  Fibres reversed = identical(2);
  std::reverse(reversed.points.begin(), reversed.points.begin() + 11);
  return { { "crossing at control points", crossing(Vector3d::Zero(), 2, 10) },
    { "crossing between control points", crossing(Vector3d::Zero(), 2, 9) }, { "three axes", crossing(Vector3d::Zero(), 3, 10) },
    { "crossing far from the origin", crossing({ -6e4, 3e4, 9e4 }, 2, 10) }, { "two identical", identical(2) },
    { "three identical", identical(3) }, { "twelve identical", identical(12) }, { "identical and wavy", identicalWavy() },
    { "identical but for their sense", reversed }, { "one runs into the other", collinear(2.0, -2.0) },
    { "one ends where the other begins", collinear(0.0, 0.0) }, { "a lattice", lattice(4, 1, 0.8) },
    { "a lattice of pairs", lattice(4, 2, 0.9) }, { "a weave in one plane", weave() } };
}

Fibres optimised(const Fibres& fibres, int threads)
{
  Fibres result = fibres;
  cactus::Context context;
  context.threads = threads;
  EXPECT_EQ(cactus::optimise(result, {}, context).reason, cactus::StopReason::Converged);
  return result;
}

/// The gradient at every control point, and the largest of its lengths.
std::vector<Vector3d> gradientOf(const Fibres& fibres)
{
  const cactus::Capsules capsules = cactus::capsulesOf(fibres);
  cactus::NeighbourList list;
  cactus::findNeighbours(capsules, 0.1, 1, list);
  std::vector<cactus::CapsuleOverlap> overlaps;
  cactus::evaluateOverlap(capsules, list, 1.01, 1e-3, 1, overlaps);
  std::vector<Vector3d> gradient(fibres.points.size(), Vector3d::Zero());
  for (std::size_t k = 0; k < capsules.size(); ++k)
  {
    gradient[capsules.first[k]] += Vector3d::Map(overlaps[k].gradient0);
    gradient[capsules.first[k] + 1] += Vector3d::Map(overlaps[k].gradient1);
  }
  return gradient;
}

} // namespace

// Guarantee 1: after CapsuleOptimizer fibres do not overlap, even if their axes met exactly. Guarantee 4: the bits are the same
// on any number of threads.
TEST(CoincidentFibres, ComeApart)
{
  for (const Case& one : cases())
  {
    SCOPED_TRACE(one.name);
    const Fibres result = optimised(one.fibres, 1);
    EXPECT_LE(cactus::measureOverlap(result).largestPenetration, 1e-3);
    EXPECT_EQ(result.points, optimised(one.fibres, 2).points);
  }
}

// Fibres that end where they begin give their bundle no direction: it is +z then.
TEST(CoincidentFibres, ClosedOnesComeApartToo)
{
  EXPECT_LE(cactus::measureOverlap(optimised(rings(), 2)).largestPenetration, 1e-3);
}

// The forces of two fibres on each other are equal and opposite, and across both.
TEST(CoincidentFibres, PushEachOtherAcrossTheirAxes)
{
  for (const Case& one : cases())
  {
    SCOPED_TRACE(one.name);
    const std::vector<Vector3d> gradient = gradientOf(one.fibres);
    Vector3d sum = Vector3d::Zero();
    double largest = 0.0;
    for (const Vector3d& g : gradient)
    {
      sum += g;
      largest = std::max(largest, g.norm());
    }
    EXPECT_GT(largest, 1e-2);
    EXPECT_LT(sum.norm(), 1e-9 * static_cast<double>(gradient.size()) * largest);
  }
  for (const int segments : { 9, 10 })
  {
    // The direction across both is z.
    const std::vector<Vector3d> gradient = gradientOf(crossing(Vector3d::Zero(), 2, segments));
    double up = 0.0;
    for (std::size_t i = 0; i < gradient.size() / 2; ++i)
    {
      up += gradient[i].z();
    }
    EXPECT_GT(std::abs(up), 0.5);
  }
}

// The direction follows from the fibres' ids, not from their order.
TEST(CoincidentFibres, PartInDirectionsThatDoNotDependOnTheirOrder)
{
  const Fibres forward = identical(5);
  Fibres backward = none();
  for (int f = 4; f >= 0; --f)
  {
    addStraight(backward, 7 * f + 3, 1, { 0, 0, -5 }, { 0, 0, 5 });
  }
  const std::vector<Vector3d> one = gradientOf(forward);
  const std::vector<Vector3d> other = gradientOf(backward);
  for (std::size_t f = 0; f < 5; ++f)
  {
    for (std::size_t i = 0; i < 11; ++i)
    {
      EXPECT_LT((one[11 * f + i] - other[11 * (4 - f) + i]).norm(), 1e-12 * one[11 * f + i].norm());
    }
    EXPECT_GT(one[11 * f + 5].norm(), 1e-2);
  }
}
