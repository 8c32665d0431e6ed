// SPDX-License-Identifier: BSD-3-Clause
// Guarantee: in a periodic domain no image of a capsule that may touch another is missing, and fibres that do not repeat are
// refused.
#include "fibres/PeriodicImages.h"

#include "base/Error.h"
#include "base/Random.h"
#include "fibres/SegmentDistance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <tuple>

using namespace cactus;

namespace
{

Fibres inPeriods(bool alongZ)
{
  Fibres fibres;
  fibres.domain = Domain::cube(8.0);
  fibres.domain.periodic = { { true, true, alongZ } };
  return fibres;
}

/// Random fibres along z, of which some leave the domain by more than a period.
Fibres randomFibres()
{
  Fibres fibres = inPeriods(false);
  RandomEngine engine = randomStream(7, RandomStage::Packing, 0);
  const auto draw = [&](double low, double high) { return low + (high - low) * uniform(engine); };
  for (int f = 1; f <= 30; ++f)
  {
    fibres.addFibre(f, 1, 0.5);
    const Eigen::Vector3d from(draw(-4.0, 4.0), draw(-4.0, 4.0), -5.0);
    const Eigen::Vector3d to = from + Eigen::Vector3d(draw(-9.0, 9.0), draw(-9.0, 9.0), 10.0);
    for (int k = 0; k <= 12; ++k)
    {
      fibres.addPoint(from + (to - from) * k / 12.0, draw(0.2, 0.6));
    }
  }
  return fibres;
}

using Image = std::tuple<std::uint32_t, double, double>;

/// A fibre that repeats every five control points.
Fibres repeated()
{
  Fibres fibres = inPeriods(true);
  fibres.addFibre(3, 1, 0.5);
  const Eigen::Vector3d places[] = { { 0, 0, -4 }, { 1, 0, -2 }, { 1, 1, 0 }, { 0, 1, 1 }, { 0, 0, 3 } };
  for (int k = -2; k < 8; ++k)
  {
    const int period = k < 0 ? -1 : k / 5;
    fibres.addPoint(places[k - 5 * period] + Eigen::Vector3d(8.0 * period, 0.0, 8.0 * period), 0.5 + 0.01 * (k - 5 * period));
  }
  return fibres;
}

} // namespace

TEST(PeriodicImages, ShiftsOfTheDomainLeadToEachNeighbourOnce)
{
  Domain domain = Domain::cube(4.0);
  domain.upper[2] = 5.0;
  EXPECT_TRUE(domain.shiftsToImages().empty());
  for (const bool alongZ : { false, true })
  {
    domain.periodic = { { true, true, alongZ } };
    std::set<std::tuple<double, double, double>> neighbours;
    for (const Eigen::Vector3d& shift : domain.shiftsToImages())
    {
      for (const double sense : { -1.0, 1.0 })
      {
        EXPECT_TRUE(neighbours.emplace(sense * shift[0] / 4.0, sense * shift[1] / 4.0, sense * shift[2] / 7.0).second);
      }
    }
    EXPECT_EQ(neighbours.size(), alongZ ? 26U : 8U);
    EXPECT_EQ(neighbours.count({ 0.0, 0.0, 0.0 }), 0U);
    for (const auto& [x, y, z] : neighbours)
    {
      EXPECT_TRUE(std::abs(x) <= 1.0 && std::abs(y) <= 1.0 && std::abs(z) <= (alongZ ? 1.0 : 0.0));
    }
  }
}

TEST(PeriodicImages, NoneThatMayTouchIsMissing)
{
  const Fibres fibres = randomFibres();
  const Capsules capsules = capsulesOf(fibres);
  std::vector<float> reach(capsules.size());
  for (std::size_t k = 0; k < reach.size(); ++k)
  {
    reach[k] = 0.05f * static_cast<float>(k % 4);
  }
  std::set<Image> found;
  for (const CapsuleImage& image : imagesWithin(fibres.domain, capsules, reach))
  {
    EXPECT_FALSE(image.shift.isZero());
    EXPECT_EQ(image.shift.z(), 0.0);
    EXPECT_TRUE(found.insert({ image.capsule, image.shift.x(), image.shift.y() }).second) << "twice";
  }
  std::size_t near = 0;
  const auto end = [](const double* p) { return Eigen::Vector3d(p[0], p[1], p[2]); };
  for (std::uint32_t k = 0; k < capsules.size(); ++k)
  {
    const Capsule& one = capsules.bodies[k];
    for (int x = -4; x <= 4; ++x)
    {
      for (int y = -4; y <= 4; ++y)
      {
        const Eigen::Vector3d shift(8.0 * x, 8.0 * y, 0.0);
        const bool isNear = !shift.isZero() && [&]
        {
          for (std::size_t j = 0; j < capsules.size(); ++j)
          {
            const Capsule& other = capsules.bodies[j];
            const double limit = std::max(one.r0, one.r1) + std::max(other.r0, other.r1) + double(reach[k]) + double(reach[j]);
            if (closestPoints(end(one.p0) + shift, end(one.p1) + shift, end(other.p0), end(other.p1)).distance < limit)
            {
              return true;
            }
          }
          return false;
        }();
        near += isNear ? 1 : 0;
        EXPECT_TRUE(!isNear || found.count({ k, shift.x(), shift.y() }) != 0) << k << ' ' << shift.transpose();
      }
    }
  }
  EXPECT_GT(near, 100u);
  EXPECT_LT(found.size(), 6 * near) << "and not many more";
}

TEST(PeriodicImages, ADomainThatIsNotPeriodicHasNone)
{
  Fibres fibres = randomFibres();
  fibres.domain.periodic = { { false, false, false } };
  const Capsules capsules = capsulesOf(fibres);
  EXPECT_TRUE(imagesWithin(fibres.domain, capsules, std::vector<float>(capsules.size(), 1.0f)).empty());
}

TEST(PeriodicImages, APeriodIsFoundByItsControlPoints)
{
  const FibrePeriod period = periodOf(repeated(), 0);
  EXPECT_EQ(period.points, 5u);
  EXPECT_EQ(period.shift, Eigen::Vector3d(8.0, 0.0, 8.0));
}

TEST(PeriodicImages, FibresThatDoNotRepeatAreRefusedByName)
{
  for (const int what : { 0, 1, 2 })
  {
    Fibres fibres = repeated();
    what == 0 ? fibres.points[6].x() += 0.01 : what == 1 ? fibres.radii[6] += 0.01 : fibres.domain.upper.z() += 0.01;
    try
    {
      periodOf(fibres, 0);
      FAIL() << what;
    }
    catch (const InvalidInput& error)
    {
      EXPECT_NE(std::string(error.what()).find("fibre 3 (cell 0) does not repeat"), std::string::npos) << error.what();
    }
  }
}

TEST(PeriodicImages, AxesRepeatTogether)
{
  for (int axes = 0; axes < 8; ++axes)
  {
    Domain domain = Domain::cube(5.0);
    domain.periodic = { { (axes & 1) != 0, (axes & 2) != 0, (axes & 4) != 0 } };
    const bool isPossible = axes == 0 || axes == 3 || axes == 7;
    std::string error;
    try
    {
      validate(domain);
    }
    catch (const InvalidInput& found)
    {
      error = found.what();
    }
    EXPECT_EQ(error.empty(), isPossible) << axes << ' ' << error;
  }
}
