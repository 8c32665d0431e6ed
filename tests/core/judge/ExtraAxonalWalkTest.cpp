// SPDX-License-Identifier: BSD-3-Clause
// Guarantee: walkers outside fibres diffuse as fast as theory has it, on any number of threads, and do not leak unseen;
// as many leave the domain as theory has it.
#include "judge/ExtraAxonalWalk.h"

#include "ExampleSurfaces.h"
#include "base/Error.h"
#include "judge/SubstrateStatistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

using namespace cactus;

namespace
{

constexpr double side = 2.0;
constexpr int corners = 96;

/// Makes a straight tube in the middle of a cube, which the cube's faces mirror into a square array of tubes of this area
/// fraction.
FibreSurfaces array(double fraction)
{
  const double area = fraction * side * side;
  const double radius = std::sqrt(area / (0.5 * corners * std::sin(2.0 * pi / corners)));
  return example::surfacesOf({ 1 }, { example::tube(0.0, 0.0, radius, -0.5 * side, 0.5 * side, corners, 1) });
}

ExtraAxonalWalkOptions walks(int walkers, double distance, double step)
{
  ExtraAxonalWalkOptions options;
  options.walkers = walkers;
  options.distance = distance;
  options.step = step;
  return options;
}

/// Returns the diffusivity between the tubes of a square array, across them, relative to free diffusion: the conductivity of the
/// whole (Perrins, McKenzie and McPhedran 1979, Proc R Soc A 369:207) over the conducting fraction.
double perrins(double f)
{
  const double f4 = std::pow(f, 4);
  const double f8 = f4 * f4;
  const double conductivity = 1.0 - 2.0 * f / (1.0 + f - 0.305827 * f4 / (1.0 - 1.402958 * f8) - 0.013362 * f8);
  return conductivity / (1.0 - f);
}

} // namespace

TEST(ExtraAxonalWalk, IsAsFastAsTheoryHasItBetweenTubes)
{
  for (const double fraction : { 0.4, 0.7 })
  {
    const ExtraAxonalDiffusion found = walkOutside(Domain::cube(side), array(fraction), walks(1000, 3.0, 0.05));
    const double across = 0.5 * (found.ratio[0] + found.ratio[1]);
    const double error = std::hypot(found.standardError[0], found.standardError[1]) / 2.0;
    EXPECT_NEAR(across, perrins(fraction), 3.0 * error) << fraction;
    EXPECT_NEAR(found.ratio[2], 1.0, 3.0 * found.standardError[2]) << fraction;
    EXPECT_LT(error, 0.06 * across);
    EXPECT_EQ(found.leaked, 0u);
  }
  EXPECT_GT(perrins(0.4) - perrins(0.7), 0.2) << "or the test would not see a difference";
}

/// Walkers are as fast along a gap narrower than a step as along a wide one: two boxes with 0.02 µm between them.
TEST(ExtraAxonalWalk, GapsMayBeThinnerThanAStepIsLong)
{
  const Eigen::Vector3d low(-1.0, -1.0, -1.0);
  const Eigen::Vector3d high(1.0, 1.0, 1.0);
  const FibreSurfaces walls =
    example::surfacesOf({ 1, 2 }, { example::box(low, { 1.0, -0.01, 1.0 }), example::box({ -1.0, 0.01, -1.0 }, high) });
  const ExtraAxonalDiffusion found = walkOutside(Domain::cube(side), walls, walks(2000, 2.0, 0.1));
  EXPECT_NEAR(found.ratio[0], 1.0, 3.0 * found.standardError[0]);
  EXPECT_NEAR(found.ratio[2], 1.0, 3.0 * found.standardError[2]);
  EXPECT_LT(std::abs(found.ratio[1]), 0.001);
  EXPECT_EQ(found.leaked, 0u);
}

TEST(ExtraAxonalWalk, HasTheErrorOfItsNumberOfWalkers)
{
  const ExtraAxonalDiffusion found = walkOutside(Domain::cube(side), array(0.1), walks(4000, 1.0, 0.1));
  // For x² − m² with m half way: √6 of its mean.
  for (const int axis : { 0, 1, 2 })
  {
    EXPECT_NEAR(found.standardError[axis], std::sqrt(6.0 / 4000.0) * found.ratio[axis], 0.1 * found.standardError[axis]);
  }
}

TEST(ExtraAxonalWalk, IsTheSameOnAnyNumberOfThreadsAndForTheSameSeed)
{
  ExtraAxonalWalkOptions options = walks(50, 2.0, 0.1);
  const auto on = [&](int threads)
  {
    Context context;
    context.threads = threads;
    return walkOutside(Domain::cube(side), array(0.5), options, context).ratio;
  };
  EXPECT_EQ(on(1), on(3));
  const Eigen::Vector3d first = on(1);
  options.seed = 2;
  EXPECT_NE(on(1), first);
}

TEST(ExtraAxonalWalk, IsNotTakenUnasked)
{
  const ExtraAxonalDiffusion found = walkOutside(Domain::cube(side), array(0.5), {});
  EXPECT_TRUE(std::isnan(found.ratio[0]));
}

namespace
{

/// A box around the middle of a cube.
Domain middle(double width)
{
  return Domain::cube(width);
}

/// In a corner of a cube of 20 µm, in nobody's way.
FibreSurfaces tinyFibre()
{
  return example::surfacesOf({ 1 }, { example::tetrahedron({ 9.0, 9.0, 9.0 }, 0.1) });
}

/// Free walkers that start in the plane in the middle of a slab have not left it with this chance, by the method of images.
double stayFromMiddle(double side, double distance)
{
  double stay = 0.0;
  for (int image = -50; image <= 50; ++image)
  {
    const double nearer = (image - 0.5) * side / (std::sqrt(2.0) * distance);
    const double farther = (image + 0.5) * side / (std::sqrt(2.0) * distance);
    stay += (image % 2 == 0 ? 0.5 : -0.5) * (std::erf(farther) - std::erf(nearer));
  }
  return stay;
}

} // namespace

// The series is what the images are, another way to solve the same.
TEST(LeavingWalk, FreeShareIsThatOfTheMethodOfImages)
{
  for (const double distance : { 0.5, 3.0, 6.0, 12.0 })
  {
    const double stay = stayFromMiddle(20.0, distance);
    EXPECT_NEAR(freeLeavingShare(Domain::cube(20.0), middle(0.0), distance), 1.0 - std::pow(stay, 3), 1e-9) << distance;
    EXPECT_NEAR(freeLeavingShare(Domain::cube(20.0), middle(1e-3), distance), 1.0 - std::pow(stay, 3), 1e-6) << distance;
  }
  EXPECT_GT(freeLeavingShare(Domain::cube(20.0), middle(20.0), 1.0), freeLeavingShare(Domain::cube(20.0), middle(10.0), 1.0));
}

TEST(LeavingWalk, AsManyLeaveAnEmptyBoxAsTheoryHasIt)
{
  const Domain domain = Domain::cube(20.0);
  const Domain start = middle(8.0);
  const auto tolerance = [](double share, std::size_t walkers)
  { return 3.0 * std::sqrt(share * (1.0 - share) / double(walkers)); };
  for (const double distance : { 2.5, 4.0, 6.0, 8.0 })
  {
    const LeavingWalkers found = walkUntilLeaving(domain, start, tinyFibre(), distance, 1);
    const double theory = freeLeavingShare(domain, start, distance);
    EXPECT_EQ(found.walkers, theory > 0.15 ? 200u : 1000u) << distance;
    EXPECT_NEAR(found.share(), theory, tolerance(theory, found.walkers)) << distance;
    // The distances say when each of the first has left.
    EXPECT_EQ(found.early, 1000u);
    ASSERT_FALSE(found.distances.empty()) << distance;
    const double half = 0.5 * (found.distances.front() + found.until);
    for (const double early : { half, found.until })
    {
      const auto left = std::upper_bound(found.distances.begin(), found.distances.end(), early) - found.distances.begin();
      const double earlyTheory = freeLeavingShare(domain, start, early);
      EXPECT_NEAR(double(left) / 1000.0, earlyTheory, tolerance(earlyTheory, 1000)) << distance << ", " << early;
    }
  }
  EXPECT_LT(freeLeavingShare(domain, start, 2.5), 0.1) << "or all would walk alike";
  EXPECT_GT(freeLeavingShare(domain, start, 8.0) - freeLeavingShare(domain, start, 4.0), 0.5) << "or the test would see nothing";
}

// In a closed room nobody does, and between walls only those do that come to their ends.
TEST(LeavingWalk, WallsHoldWalkers)
{
  const Domain domain = Domain::cube(20.0);
  const FibreSurfaces walls = example::surfacesOf({ 1, 2 },
    { example::box({ -10.0, -10.0, -10.0 }, { 10.0, -2.0, 10.0 }), example::box({ -10.0, 2.0, -10.0 }, { 10.0, 10.0, 10.0 }) });
  const LeavingWalkers between = walkUntilLeaving(domain, middle(4.0), walls, 8.0, 1);
  Domain open = domain;
  open.lower[1] = -1e3;
  open.upper[1] = 1e3;
  EXPECT_NEAR(between.share(), freeLeavingShare(open, middle(4.0), 8.0), 0.08);
  EXPECT_LT(between.share(), freeLeavingShare(domain, middle(4.0), 8.0) - 0.1);
  const FibreSurfaces full = example::surfacesOf({ 1 }, { example::box({ -9.0, -9.0, -9.0 }, { 9.0, 9.0, 9.0 }) });
  const LeavingWalkers none = walkUntilLeaving(domain, middle(4.0), full, 8.0, 1);
  EXPECT_EQ(none.walkers, 0u) << "there is no room to start";
  EXPECT_TRUE(std::isnan(none.share()));
}

TEST(LeavingWalk, IsTheSameOnAnyNumberOfThreads)
{
  const auto on = [&](int threads)
  {
    Context context;
    context.threads = threads;
    return walkUntilLeaving(Domain::cube(20.0), middle(8.0), tinyFibre(), 3.0, 1, context).distances;
  };
  const std::vector<double> first = on(1);
  EXPECT_GT(first.size(), 20u);
  EXPECT_EQ(first, on(3));
}

TEST(ExtraAxonalWalk, SaysWhyItCannotBeTaken)
{
  const auto message = [](const FibreSurfaces& surfaces, const ExtraAxonalWalkOptions& options) -> std::string
  {
    try
    {
      walkOutside(Domain::cube(side), surfaces, options);
    }
    catch (const Error& error)
    {
      return error.what();
    }
    return "no error";
  };
  EXPECT_NE(message(array(0.5), walks(10, 1000.0, 0.01)).find("WalkStep 0.01 µm makes walks of 3e+10 steps"), std::string::npos);
  EXPECT_NE(message(array(0.5), walks(-1, 1.0, 0.1)).find("ExtraAxonalWalkers is -1"), std::string::npos);
  EXPECT_NE(message(array(0.5), walks(10, 1.0, 0.0)).find("WalkStep is 0"), std::string::npos);
  const FibreSurfaces full = example::surfacesOf({ 1 }, { example::box({ -1.5, -1.5, -1.5 }, { 1.5, 1.5, 1.5 }) });
  EXPECT_NE(message(full, walks(10, 1.0, 0.1)).find("none lay outside the fibres"), std::string::npos);
  TriangleMesh open = example::tube(0.0, 0.0, 0.8, -1.0, 1.0, 24, 1);
  open.triangles.erase(open.triangles.begin(), open.triangles.begin() + 20);
  EXPECT_NE(
    message(example::surfacesOf({ 1 }, { open }), walks(200, 2.0, 0.1)).find("came to be inside a fibre"), std::string::npos);
}

/// The same array, moved so that the faces cut each tube in four: what leaves through one comes in again through the other.
TEST(ExtraAxonalWalk, PeriodicFacesLetWalkersInAgain)
{
  const double fraction = 0.6;
  const double radius = std::sqrt(fraction * side * side / (0.5 * corners * std::sin(2.0 * pi / corners)));
  std::vector<TriangleMesh> tubes;
  std::vector<int> ids;
  for (const double x : { -1.5, -0.5, 0.5, 1.5 })
  {
    for (const double y : { -1.5, -0.5, 0.5, 1.5 })
    {
      tubes.push_back(example::tube(x * side + 0.5, y * side + 0.5, radius, -0.5 * side, 0.5 * side, corners, 1));
      ids.push_back(static_cast<int>(tubes.size()));
    }
  }
  Domain domain = Domain::cube(side);
  domain.periodic = { { true, true, true } };
  const FibreSurfaces all = example::surfacesOf(ids, tubes);
  const ExtraAxonalDiffusion found = walkOutside(domain, all, walks(1000, 3.0, 0.05));
  const double across = 0.5 * (found.ratio[0] + found.ratio[1]);
  const double error = std::hypot(found.standardError[0], found.standardError[1]) / 2.0;
  EXPECT_NEAR(across, perrins(fraction), 3.0 * error);
  EXPECT_NEAR(found.ratio[2], 1.0, 3.0 * found.standardError[2]);
  EXPECT_EQ(found.leaked, 0u);
}

TEST(ExtraAxonalWalk, NobodyLeavesThroughPeriodicFaces)
{
  Domain domain = Domain::cube(side);
  domain.periodic = { { true, true, false } };
  const double half = freeLeavingShare(domain, domain, 0.5);
  domain.periodic = { { true, true, true } };
  EXPECT_EQ(freeLeavingShare(domain, domain, 0.5), 0.0);
  EXPECT_GT(half, 0.1);
  const LeavingWalkers leaving = walkUntilLeaving(domain, domain, array(0.5), 1.0, 1, {});
  EXPECT_EQ(leaving.walkers, 1000u);
  EXPECT_TRUE(leaving.distances.empty());
}
