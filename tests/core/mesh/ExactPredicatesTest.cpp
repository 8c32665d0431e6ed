// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/ExactPredicates.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace
{

using Eigen::Vector3d;
__extension__ using Integer = __int128;

/// A point on a fine lattice, whose determinants fit into 128-bit integers.
constexpr double step = 1.0 / 1099511627776.0; // 2^-40

int sign(Integer value)
{
  return value > 0 ? 1 : value < 0 ? -1 : 0;
}

struct LatticePoint
{
  std::int64_t x = 0;
  std::int64_t y = 0;
  std::int64_t z = 0;
  Vector3d real() const { return step * Vector3d(double(this->x), double(this->y), double(this->z)); }
};

int exactOrientation(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c, const LatticePoint& d)
{
  const Integer ax = a.x - d.x;
  const Integer ay = a.y - d.y;
  const Integer az = a.z - d.z;
  const Integer bx = b.x - d.x;
  const Integer by = b.y - d.y;
  const Integer bz = b.z - d.z;
  const Integer cx = c.x - d.x;
  const Integer cy = c.y - d.y;
  const Integer cz = c.z - d.z;
  return sign(ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx));
}

} // namespace

// The certificate's answers are as right as these signs: compared with integer arithmetic, on points so nearly in one plane that
// doubles alone cannot decide.
TEST(ExactPredicates, OrientationAgreesWithIntegers)
{
  std::mt19937_64 random(7);
  std::uniform_int_distribution<std::int64_t> wide(-(std::int64_t(1) << 39), std::int64_t(1) << 39);
  std::uniform_int_distribution<std::int64_t> few(-3, 3);
  std::size_t roundingFails = 0;
  std::size_t zeros = 0;
  for (int trial = 0; trial < 20000; ++trial)
  {
    LatticePoint a{ wide(random), wide(random), wide(random) };
    LatticePoint b{ wide(random), wide(random), wide(random) };
    LatticePoint c{ wide(random), wide(random), wide(random) };
    // d = a + (b - a) / 2 + (c - a) / 4 or so, a few steps off or not at all.
    for (LatticePoint* p : { &a, &b, &c })
    {
      *p = { p->x / 4 * 4, p->y / 4 * 4, p->z / 4 * 4 };
    }
    LatticePoint d{ a.x + (b.x - a.x) / 2 + (c.x - a.x) / 4, a.y + (b.y - a.y) / 2 + (c.y - a.y) / 4,
      a.z + (b.z - a.z) / 2 + (c.z - a.z) / 4 };
    if (trial % 2 == 0)
    {
      d.x += few(random);
      d.y += few(random);
      d.z += few(random);
    }
    const int wanted = exactOrientation(a, b, c, d);
    ASSERT_EQ(cactus::orientation(a.real(), b.real(), c.real(), d.real()), wanted);
    ASSERT_EQ(cactus::orientation(b.real(), a.real(), c.real(), d.real()), -wanted);
    ASSERT_EQ(cactus::orientation(d.real(), c.real(), b.real(), a.real()), wanted);
    zeros += wanted == 0 ? 1 : 0;
    const double plain = (a.real() - d.real()).dot((b.real() - d.real()).cross(c.real() - d.real()));
    roundingFails += (plain > 0.0 ? 1 : plain < 0.0 ? -1 : 0) != wanted ? 1 : 0;
  }
  EXPECT_GT(zeros, 5000U);
  EXPECT_GT(roundingFails, 100U) << "the points are too easy to tell anything";
}

TEST(ExactPredicates, ProjectedOrientationAgreesWithIntegers)
{
  std::mt19937_64 random(11);
  std::uniform_int_distribution<std::int64_t> wide(-(std::int64_t(1) << 50), std::int64_t(1) << 50);
  std::uniform_int_distribution<std::int64_t> few(-1, 1);
  for (int trial = 0; trial < 20000; ++trial)
  {
    const LatticePoint a{ wide(random) / 2 * 2, wide(random) / 2 * 2, 0 };
    const LatticePoint b{ wide(random) / 2 * 2, wide(random) / 2 * 2, 1 };
    const LatticePoint c{ (a.x + b.x) / 2 + few(random), (a.y + b.y) / 2 + few(random), 2 };
    const int wanted = sign(Integer(a.x - c.x) * Integer(b.y - c.y) - Integer(a.y - c.y) * Integer(b.x - c.x));
    ASSERT_EQ(cactus::orientationAlong(2, a.real(), b.real(), c.real()), wanted);
    const auto turned = [](const LatticePoint& p) { return Vector3d(p.real()[2], p.real()[0], p.real()[1]); };
    ASSERT_EQ(cactus::orientationAlong(0, turned(a), turned(b), turned(c)), wanted);
  }
}

// In doubles 0.1 + 0.2 is not 0.3; the predicate uses the doubles as they are.
TEST(ExactPredicates, SeesOneUnitInTheLastPlace)
{
  const Vector3d a(0.1, 0.1, 0.1);
  const Vector3d b(12.3, 0.7, 0.1);
  const Vector3d c(-0.3, 45.6, 0.1);
  Vector3d d(3.3, 7.7, 0.1);
  EXPECT_EQ(cactus::orientation(a, b, c, d), 0);
  d[2] = std::nextafter(0.1, 1.0);
  EXPECT_EQ(cactus::orientation(a, b, c, d), -1);
  d[2] = std::nextafter(0.1, 0.0);
  EXPECT_EQ(cactus::orientation(a, b, c, d), 1);
}
