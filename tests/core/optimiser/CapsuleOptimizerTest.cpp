// SPDX-License-Identifier: BSD-3-Clause
#include "optimiser/CapsuleOptimizer.h"
#include "BundleBetweenWalls.h"
#include "ScratchPath.h"

#include "RandomBundle.h"
#include "base/Error.h"
#include "bundle/BundleInitializer.h"
#include "fibres/JoinFibres.h"
#include "fibres/SegmentDistance.h"
#include "fibres/TrimToDomain.h"
#include "optimiser/BundleBox.h"
#include "optimiser/OverlapReport.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <stdexcept>
#include <string>
#include <thread>

namespace
{

using cactus::Fibres;

/// Returns the largest D over all pairs of capsules of different fibres, without the code under test.
double largestPenetration(const Fibres& fibres)
{
  double largest = 0.0;
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    for (std::size_t g = f + 1; g < fibres.size(); ++g)
    {
      for (std::size_t i = fibres.offsets[f]; i + 1 < fibres.offsets[f + 1]; ++i)
      {
        for (std::size_t j = fibres.offsets[g]; j + 1 < fibres.offsets[g + 1]; ++j)
        {
          const auto pair = cactus::closestPoints(fibres.points[i], fibres.points[i + 1], fibres.points[j], fibres.points[j + 1]);
          const double sum = (1.0 - pair.s) * fibres.radii[i] + pair.s * fibres.radii[i + 1] + (1.0 - pair.t) * fibres.radii[j] +
                             pair.t * fibres.radii[j + 1];
          largest = std::max(largest, 1.0 - pair.distance / sum);
        }
      }
    }
  }
  return largest;
}

Fibres crossingPair()
{
  Fibres fibres;
  fibres.domain = cactus::Domain::cube(10.0);
  for (int f = 0; f < 2; ++f)
  {
    fibres.addFibre(f + 1, f + 1, 0.8);
    for (int i = 0; i <= 10; ++i)
    {
      const double along = -5.0 + i;
      fibres.addPoint(f == 0 ? Eigen::Vector3d(along, 0.05, 0.0) : Eigen::Vector3d(0.0, -0.05, along), 0.8);
    }
  }
  return fibres;
}

} // namespace

// Guarantee 1: after the optimiser no two capsules of different fibres penetrate by more than the tolerance.
TEST(CapsuleOptimizer, PartsADisorderedBundle)
{
  Fibres fibres = randomBundle(11, 40, 12, 8.0, 0.0);
  EXPECT_GT(largestPenetration(fibres), 0.5);
  const cactus::OptimisationResult result = cactus::optimise(fibres, {}, {});
  EXPECT_EQ(result.reason, cactus::StopReason::Converged);
  const double largest = largestPenetration(fibres);
  EXPECT_LE(largest, 1e-3);
  EXPECT_NEAR(result.maximumPenetration, largest, 1e-12);
  EXPECT_NEAR(*std::max_element(result.overlap.begin(), result.overlap.end()), largest, 1e-12);
  EXPECT_EQ(result.overlappingPairs, 0u);
}

// Guarantee 1 with the published descent.
TEST(CapsuleOptimizer, AdagradPartsThemToo)
{
  Fibres fibres = randomBundle(12, 20, 12, 8.0, 0.0);
  cactus::CapsuleOptimizerOptions options;
  options.method = cactus::DescentMethod::Adagrad;
  options.stepSize = 0.05;
  options.weights = { 0.01, 0.01, 0.0, 0.0 };
  EXPECT_EQ(cactus::optimise(fibres, options, {}).reason, cactus::StopReason::Converged);
  EXPECT_LE(largestPenetration(fibres), 1e-3);
}

// Guarantee: no bend ends sharper than its fibre is thick, and no segment collapses, however dense and disordered the bundle.
TEST(CapsuleOptimizer, BendsNoFibreSharperThanItsRadius)
{
  Fibres fibres = randomBundle(11, 60, 12, 8.0, 0.0);
  const Fibres before = fibres;
  cactus::optimise(fibres, {}, {});
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    for (std::size_t i = fibres.offsets[f]; i + 1 < fibres.offsets[f + 1]; ++i)
    {
      const Eigen::Vector3d w = fibres.points[i + 1] - fibres.points[i];
      EXPECT_GT(w.norm(), 0.5 * (before.points[i + 1] - before.points[i]).norm());
      if (i > fibres.offsets[f])
      {
        const Eigen::Vector3d u = fibres.points[i] - fibres.points[i - 1];
        EXPECT_GT(0.5 * u.norm() * w.norm() * (u + w).norm() / u.cross(w).norm(), fibres.radii[i]);
      }
    }
  }
}

// Two crossing cylinders: both bend out of each other's way by the same amount, and the ends stay in their planes.
TEST(CapsuleOptimizer, TwoCrossingCylinders)
{
  Fibres fibres = crossingPair();
  const Fibres before = fibres;
  EXPECT_EQ(cactus::optimise(fibres, {}, {}).reason, cactus::StopReason::Converged);
  EXPECT_LE(largestPenetration(fibres), 1e-3);
  EXPECT_NEAR(fibres.points[5][1], -fibres.points[16][1], 1e-6);
  EXPECT_GT(fibres.points[5][1], 0.7);
  for (const std::size_t end : { 0, 10, 11, 21 })
  {
    const int axis = end < 11 ? 0 : 2;
    EXPECT_DOUBLE_EQ(fibres.points[end][axis], before.points[end][axis]);
  }
}

// Guarantee 4: same input and parameters, same bits, on any number of threads.
TEST(CapsuleOptimizer, SameBitsOnAnyNumberOfThreads)
{
  cactus::CapsuleOptimizerOptions options;
  options.maximumIterations = 40;
  options.radiusTolerance = 0.02;
  for (const auto method : { cactus::DescentMethod::Momentum, cactus::DescentMethod::Adagrad })
  {
    options.method = method;
    options.stepSize = method == cactus::DescentMethod::Momentum ? 1.0 : 0.02;
    cactus::Context context;
    context.threads = 1;
    Fibres one = randomBundle(13, 300, 30, 14.0, 0.0);
    const auto first = cactus::optimise(one, options, context);
    for (const int threads : { 2, 4 })
    {
      context.threads = threads;
      Fibres many = randomBundle(13, 300, 30, 14.0, 0.0);
      const auto second = cactus::optimise(many, options, context);
      ASSERT_EQ(one.radii, many.radii);
      for (std::size_t i = 0; i < one.points.size(); ++i)
      {
        ASSERT_EQ(one.points[i], many.points[i]);
      }
      ASSERT_EQ(first.convergence.back().overlapCost, second.convergence.back().overlapCost);
      ASSERT_EQ(first.overlap, second.overlap);
    }
  }
}

// Guarantee 4 over a whole run, from the product's initial state to zero overlap: 1, 2 and 4 threads end with the same fibres
// after the same iterations.
TEST(CapsuleOptimizer, WholeRunHasTheSameBitsOnOneTwoAndFourThreads)
{
  cactus::BundleBetweenWalls bundle;
  bundle.side = 12.0;
  bundle.meanDispersion = 10.0;
  const Fibres start = cactus::initialiseBundles(bundle);
  Fibres one = start;
  cactus::Context context;
  context.threads = 1;
  const auto first = cactus::optimise(one, {}, context);
  EXPECT_EQ(first.reason, cactus::StopReason::Converged);
  for (const int threads : { 2, 4 })
  {
    context.threads = threads;
    Fibres many = start;
    const auto second = cactus::optimise(many, {}, context);
    ASSERT_EQ(one.points, many.points);
    ASSERT_EQ(first.overlap, second.overlap);
    ASSERT_EQ(first.convergence.size(), second.convergence.size());
    for (std::size_t i = 0; i < first.convergence.size(); ++i)
    {
      ASSERT_EQ(first.convergence[i].overlapCost, second.convergence[i].overlapCost);
      ASSERT_EQ(first.convergence[i].curvatureCost, second.convergence[i].curvatureCost);
    }
  }
}

// Guarantee 6: a run that is stopped, or out of iterations, keeps its best result and says so.
TEST(CapsuleOptimizer, KeepsTheBestStateWhenStopped)
{
  Fibres fibres = randomBundle(14, 40, 12, 6.0, 0.0);
  int calls = 0;
  cactus::Context context;
  context.cancelled = [&] { return ++calls > 5; };
  const auto stopped = cactus::optimise(fibres, {}, context);
  EXPECT_EQ(stopped.reason, cactus::StopReason::Stopped);
  EXPECT_EQ(stopped.convergence.size(), 6u);
  EXPECT_NEAR(stopped.maximumPenetration, largestPenetration(fibres), 1e-12);

  cactus::CapsuleOptimizerOptions options;
  options.maximumIterations = 3;
  const auto limited = cactus::optimise(fibres, options, {});
  EXPECT_EQ(limited.reason, cactus::StopReason::MaximumIterations);
  EXPECT_GT(limited.overlappingPairs, 0u);
  options.maximumIterations = 100000;
  options.timeBudget = 1e-6;
  EXPECT_EQ(cactus::optimise(fibres, options, {}).reason, cactus::StopReason::TimeBudget);
}

// Guarantee: progress never falls, and reflects the overlap: a run that ends well reports high progress, whatever its limit.
TEST(CapsuleOptimizer, ReportsHowFarItHasCome)
{
  Fibres fibres = randomBundle(14, 40, 12, 6.0, 0.0);
  double last = 0.0;
  std::size_t reports = 0;
  cactus::Context context;
  context.progress = [&](double fraction, const std::string& message)
  {
    EXPECT_GE(fraction, last);
    EXPECT_LT(fraction, 1.0);
    EXPECT_NE(message.find("largest penetration"), std::string::npos) << message;
    last = fraction;
    ++reports;
  };
  cactus::CapsuleOptimizerOptions options;
  options.maximumIterations = 100000;
  const auto result = cactus::optimise(fibres, options, context);
  EXPECT_EQ(result.overlappingPairs, 0u);
  EXPECT_GT(last, 0.5);
  EXPECT_EQ(reports, (result.convergence.size() + 9) / 10);
}

// Guarantee: a state without overlap stays unchanged.
TEST(CapsuleOptimizer, LeavesAGoodStateAlone)
{
  Fibres fibres = crossingPair();
  for (std::size_t i = 0; i < 11; ++i)
  {
    fibres.points[i][1] += 1.7;
  }
  const Fibres before = fibres;
  const auto result = cactus::optimise(fibres, {}, {});
  EXPECT_EQ(result.convergence.size(), 1u);
  EXPECT_EQ(fibres.points[5], before.points[5]);
}

// Guarantee: a run without progress ends early, and says so: here because of its tiny steps.
TEST(CapsuleOptimizer, StopsWhereNothingMoreIsGained)
{
  Fibres fibres = crossingPair();
  cactus::CapsuleOptimizerOptions options;
  options.stepSize = 1e-6;
  const auto result = cactus::optimise(fibres, options, {});
  EXPECT_EQ(result.reason, cactus::StopReason::Stagnated);
  EXPECT_LT(result.convergence.size(), 500u);
  EXPECT_GT(result.maximumPenetration, 0.1);
}

// Guarantee: a bundle denser than PackingLimit is widened to it at once, each fibre as a whole, and others stay unchanged.
TEST(BundleBox, SpreadsWhatIsTooDense)
{
  const Fibres before = randomBundle(17, 50, 12, 6.0, 0.0);
  const auto density = [](const Fibres& bundle)
  {
    const cactus::BundleBox box = cactus::bundleBoxes(bundle, 1e9).front();
    double volume = 0.0;
    for (std::size_t f = 0; f < bundle.size(); ++f)
    {
      volume += cactus::chainVolume(bundle, f);
    }
    return volume / ((box.upperU - box.lowerU) * (box.upperV - box.lowerV) * 6.0);
  };
  const double limit = 0.8 * density(before);
  ASSERT_LT(limit, 1.0);
  Fibres fibres = before;
  cactus::spreadBundles(fibres, limit);
  EXPECT_LT(density(fibres), 0.9 * density(before)); // fibres keep thickness and slant, so the cuboid grows a little less
  EXPECT_GT(density(fibres), 0.99 * limit);
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    const Eigen::Vector3d shift = fibres.points[fibres.offsets[f]] - before.points[before.offsets[f]];
    EXPECT_NEAR(shift[2], 0.0, 0.2);
    for (std::size_t i = fibres.offsets[f]; i < fibres.offsets[f + 1]; ++i)
    {
      EXPECT_NEAR((fibres.points[i] - before.points[i] - shift).norm(), 0.0, 1e-12);
    }
  }
  Fibres dense = before;
  for (double& radius : dense.radii)
  {
    radius *= std::sqrt(1.5 / density(before));
  }
  ASSERT_GT(density(dense), 1.2);
  cactus::spreadBundles(dense, 0.7);
  EXPECT_LT(density(dense), 0.9);
  Fibres loose = before;
  cactus::spreadBundles(loose, std::min(1.0, 1.01 * density(before)));
  EXPECT_EQ(loose.points, before.points);
}

namespace
{

/// Bundles along z and x of straight fibres on a lattice 1 µm apart, which reaches as far as `half` sideways; and fibres of the
/// first bundle that run from there, in its middle, to 1.5 times that at its ends.
Fibres bundlesThatFray(double half)
{
  Fibres fibres;
  fibres.domain = cactus::Domain::cube(10.0);
  const auto add = [&](int bundle, double u, double v)
  {
    fibres.addFibre(static_cast<int>(fibres.size()) + 1, bundle, 0.2);
    for (int k = -2; k <= 2; ++k)
    {
      const double w = 0.5 * half * k;
      fibres.addPoint(bundle == 1 ? Eigen::Vector3d(u, v, w) : Eigen::Vector3d(w, v, u), 0.2);
    }
  };
  for (double u = -half; u <= half; u += 1.0)
  {
    for (double v = -half; v <= half; v += 1.0)
    {
      add(1, u, v);
      add(2, u, v);
    }
  }
  for (double v = -half; v <= half; v += 1.0)
  {
    add(1, half, v);
    for (std::size_t k = 0; k < 5; ++k)
    {
      fibres.points[fibres.points.size() - 5 + k].x() *= 1.0 + 0.25 * std::abs(static_cast<double>(k) - 2.0);
    }
  }
  return fibres;
}

} // namespace

// Guarantee: a bundle that frays is held at its bulk if it is larger than the domain and not the only one.
TEST(BundleBox, CutsABundleThatFraysToItsBulk)
{
  Fibres fibres = bundlesThatFray(10.0);
  const std::vector<cactus::BundleBox> boxes = cactus::bundleBoxes(fibres, 0.7);
  EXPECT_GT(boxes[0].upperV, 10.2); // along x
  EXPECT_LT(boxes[0].upperV, 13.0);
  EXPECT_NEAR(boxes[0].lowerV, -10.2, 1e-9);
  EXPECT_NEAR(boxes[0].upperU - boxes[0].lowerU, 20.4, 1e-9);
  EXPECT_TRUE(boxes[0].holds);
  EXPECT_FALSE(boxes[1].holds);
  EXPECT_NEAR(boxes[1].upperU, 10.2, 1e-9); // a bundle that does not fray has its own limits
  // Alone it does not have to make room for another.
  fibres.bundleIds.assign(fibres.size(), 1);
  EXPECT_FALSE(cactus::bundleBoxes(fibres, 0.7)[0].holds);
  // Nor is it cut where the domain reaches farther.
  Fibres inside = bundlesThatFray(10.0);
  inside.domain = cactus::Domain::cube(22.0);
  EXPECT_FALSE(cactus::bundleBoxes(inside, 0.7)[0].holds);
}

// Guarantee: bundles that part in one place keep their density in the domain, so that growth to a fraction gives their radii.
TEST(CapsuleOptimizer, InterpenetratingBundlesKeepTheirDensity)
{
  std::vector<Fibres> bundles;
  for (const Eigen::Vector3d& direction : { Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(0, 0, 1) })
  {
    cactus::BundleInitializerOptions options;
    options.side = 12.0;
    options.direction = direction;
    options.fibreVolumeFraction = 0.2;
    options.grownFibreVolumeFraction = 0.3;
    bundles.push_back(cactus::initialiseBundles(options));
  }
  Fibres fibres = cactus::joinFibres(bundles);
  const auto density = [](const Fibres& of) { return cactus::capsuleVolumeInDomain(of) / of.domain.volume(); };
  const double before = density(fibres);
  EXPECT_NEAR(before, 0.6, 0.03);
  const cactus::OptimisationResult result = cactus::optimise(fibres, {}, {});
  EXPECT_EQ(result.overlappingPairs, 0u);
  EXPECT_LE(largestPenetration(fibres), 1e-3);
  EXPECT_NEAR(density(fibres) / before, 1.0, 0.04); // without a hold it is 0.93
}

namespace
{

/// A file in the test's temporary folder, gone when the test is.
struct TemporaryFile
{
  explicit TemporaryFile(const std::string& name)
    : path(cactus_testing::scratchPath(name))
  {
    std::remove(this->path.c_str());
  }
  ~TemporaryFile() { std::remove(this->path.c_str()); }
  std::string path;
};

} // namespace

// Guarantee: an interrupted run that continues from its checkpoint ends with the same bits and the same table (except for the
// seconds) as an uninterrupted one, wherever it was interrupted, with both methods, and with other threads.
TEST(CapsuleOptimizer, GoesOnFromACheckpointWithTheSameBits)
{
  const Fibres start = randomBundle(18, 120, 20, 9.0, 0.0);
  for (const auto method : { cactus::DescentMethod::Momentum, cactus::DescentMethod::Adagrad })
  {
    cactus::CapsuleOptimizerOptions options;
    options.method = method;
    options.stepSize = method == cactus::DescentMethod::Momentum ? 1.0 : 0.02;
    options.radiusTolerance = 0.02;
    options.maximumIterations = 60;
    cactus::Context context;
    context.threads = 2;
    Fibres whole = start;
    const auto expected = cactus::optimise(whole, options, context);
    // Interrupted like a run out of iterations, and like one that is killed after its last regular checkpoint.
    for (const bool killed : { false, true })
    {
      const TemporaryFile file("cactus-checkpoint");
      options.checkpointFile = file.path;
      options.checkpointInterval = 0.0;
      options.resume = true;
      int calls = 0;
      for (const int until : { 7, 23, 60 })
      {
        options.maximumIterations = until;
        context.threads = context.threads % 3 + 1;
        Fibres part = start;
        if (killed && until < 60)
        {
          EXPECT_THROW(cactus::optimise(part, options, context,
                         [&](const cactus::ConvergenceRow& row, const Fibres&)
                         {
                           std::this_thread::sleep_for(std::chrono::milliseconds(row.iteration == until - 1 ? 100 : 0));
                           if (row.iteration == until)
                           {
                             throw std::runtime_error("killed");
                           }
                         }),
            std::runtime_error);
          continue;
        }
        const auto result =
          cactus::optimise(part, options, context, [&](const cactus::ConvergenceRow&, const Fibres&) { ++calls; });
        if (until == 60)
        {
          EXPECT_LT(calls, killed ? 60 : 64);
          ASSERT_EQ(part.points, whole.points);
          ASSERT_EQ(part.radii, whole.radii);
          ASSERT_EQ(result.overlap, expected.overlap);
          ASSERT_EQ(result.convergence.size(), expected.convergence.size());
          for (std::size_t i = 0; i < result.convergence.size(); ++i)
          {
            ASSERT_EQ(result.convergence[i].iteration, expected.convergence[i].iteration);
            ASSERT_GE(result.convergence[i].seconds, i > 0 ? result.convergence[i - 1].seconds : 0.0) << i;
            ASSERT_EQ(result.convergence[i].overlapCost, expected.convergence[i].overlapCost);
            ASSERT_EQ(result.convergence[i].maximumPenetration, expected.convergence[i].maximumPenetration);
          }
        }
      }
      options.checkpointFile.clear();
      options.resume = false;
    }
  }
}

// Guarantee: a checkpoint of other fibres or other parameters, or one that cannot be written, is refused with a clear error (a
// damaged one: see CheckpointTest); without a checkpoint, the run starts from the beginning.
TEST(CapsuleOptimizer, RefusesACheckpointOfSomethingElse)
{
  const TemporaryFile file("cactus-checkpoint-other");
  cactus::CapsuleOptimizerOptions options;
  options.checkpointFile = file.path;
  options.resume = true;
  options.maximumIterations = 5;
  const auto message = [](Fibres fibres, const cactus::CapsuleOptimizerOptions& with)
  {
    try
    {
      cactus::optimise(fibres, with, {});
    }
    catch (const cactus::Error& error)
    {
      return std::string(error.what());
    }
    return std::string();
  };
  ASSERT_EQ(message(crossingPair(), options), "");
  ASSERT_EQ(message(crossingPair(), options), "");
  Fibres moved = crossingPair();
  moved.points[3][1] += 1e-9;
  EXPECT_NE(message(moved, options).find("was written for other fibres or other parameters"), std::string::npos);
  auto other = options;
  other.weights.length *= 2.0;
  EXPECT_NE(message(crossingPair(), other).find("was written for other fibres or other parameters"), std::string::npos);

  options.checkpointFile = "/nowhere/checkpoint";
  EXPECT_NE(message(crossingPair(), options).find("cannot write /nowhere/checkpoint"), std::string::npos);
  options.checkpointFile.clear();
  EXPECT_NE(message(crossingPair(), options).find("Resume"), std::string::npos);
}

// Guarantee: an observer sees the state of every iteration, from the first to the returned one.
TEST(CapsuleOptimizer, ShowsEveryStateToAnObserver)
{
  Fibres fibres = randomBundle(19, 20, 12, 8.0, 0.0);
  std::vector<Eigen::Vector3d> last;
  int next = 0;
  const auto result = cactus::optimise(fibres, {}, {},
    [&](const cactus::ConvergenceRow& row, const Fibres& state)
    {
      EXPECT_EQ(row.iteration, next++);
      last = state.points;
    });
  EXPECT_EQ(result.reason, cactus::StopReason::Converged);
  EXPECT_EQ(static_cast<std::size_t>(next), result.convergence.size());
  EXPECT_EQ(last, fibres.points);
}

// Guarantee: radii change only within RadiusTolerance.
TEST(CapsuleOptimizer, RadiiStayWithinTheirTolerance)
{
  Fibres fibres = randomBundle(15, 60, 12, 6.0, 0.0);
  const Fibres before = fibres;
  cactus::CapsuleOptimizerOptions options;
  options.radiusTolerance = 0.03;
  options.maximumIterations = 100;
  cactus::optimise(fibres, options, {});
  double changed = 0.0;
  for (std::size_t i = 0; i < fibres.radii.size(); ++i)
  {
    const double change = fibres.radii[i] / before.radii[i] - 1.0;
    EXPECT_LE(std::abs(change), 0.03 + 1e-12);
    changed = std::max(changed, std::abs(change));
  }
  EXPECT_GT(changed, 1e-3);
}

// Guarantee 5: parameters out of range give an error that names them.
TEST(CapsuleOptimizer, NamesTheParameterThatIsOutOfRange)
{
  const auto message = [](auto&& spoil)
  {
    cactus::CapsuleOptimizerOptions options;
    spoil(options);
    Fibres fibres = crossingPair();
    try
    {
      cactus::optimise(fibres, options, {});
    }
    catch (const cactus::InvalidInput& error)
    {
      return std::string(error.what());
    }
    return std::string();
  };
  using Options = cactus::CapsuleOptimizerOptions;
  const double nan = std::nan("");
  EXPECT_NE(message([](Options& o) { o.maximumIterations = -1; }).find("MaximumIterations"), std::string::npos);
  EXPECT_NE(message([](Options& o) { o.overlapTolerance = 0.0; }).find("OverlapTolerance"), std::string::npos);
  EXPECT_NE(message([&](Options& o) { o.stepSize = nan; }).find("StepSize"), std::string::npos);
  EXPECT_NE(message([](Options& o) { o.weights.curvature = -1.0; }).find("CurvatureWeight"), std::string::npos);
  EXPECT_NE(message([](Options& o) { o.timeBudget = -1.0; }).find("TimeBudget"), std::string::npos);
  for (const double large : { 1e13, 1e300 })
  {
    EXPECT_NE(message([&](Options& o) { o.stepSize = large; }).find("StepSize"), std::string::npos);
    EXPECT_NE(message([&](Options& o) { o.overlapWeight = large; }).find("OverlapWeight"), std::string::npos);
    EXPECT_NE(message([&](Options& o) { o.weights.curvature = large; }).find("CurvatureWeight"), std::string::npos);
    EXPECT_NE(message([&](Options& o) { o.weights.length = large; }).find("LengthWeight"), std::string::npos);
    EXPECT_NE(message([&](Options& o) { o.weights.compactness = large; }).find("CompactnessWeight"), std::string::npos);
    EXPECT_NE(message([&](Options& o) { o.timeBudget = large; }).find("TimeBudget"), std::string::npos);
    EXPECT_NE(message([&](Options& o) { o.checkpointInterval = large; }).find("CheckpointInterval"), std::string::npos);
  }
  EXPECT_NE(message([](Options& o) { o.maximumIterations = 2000000000; }).find("MaximumIterations"), std::string::npos);
  Fibres broken = crossingPair();
  broken.points[3][2] = nan;
  EXPECT_THROW(cactus::optimise(broken, {}, {}), cactus::InvalidInput);
  EXPECT_THROW(
    {
      Fibres none;
      cactus::optimise(none, {}, {});
    },
    cactus::InvalidInput);
}

TEST(CapsuleOptimizer, RefusesBundlesThatTogetherOverfillTheDomain)
{
  Fibres fibres;
  fibres.domain = cactus::Domain::cube(10.0);
  for (const int bundle : { 1, 2 })
  {
    fibres.addFibre(bundle, bundle, 4.5);
    for (int i = 0; i <= 4; ++i)
    {
      fibres.addPoint({ 0.0, 0.0, 2.5 * i - 5.0 }, 4.5);
    }
  }
  try
  {
    cactus::optimise(fibres, {}, {});
    FAIL() << "nothing was said";
  }
  catch (const cactus::InvalidInput& error)
  {
    EXPECT_NE(std::string(error.what()).find("together have 1.27 times the domain's volume"), std::string::npos) << error.what();
  }
  fibres.bundleIds = { 1, 1 };
  cactus::CapsuleOptimizerOptions few;
  few.maximumIterations = 1;
  EXPECT_NO_THROW(cactus::optimise(fibres, few, {})); // one bundle is spread
}

// Such a fibre has so many capsules within reach of each other that the search for neighbours would take hours, and runs back the
// way it came, so that it cannot be resampled.
TEST(CapsuleOptimizer, RefusesFibresOfFarTooManyPoints)
{
  Fibres fibres;
  fibres.domain = cactus::Domain::cube(10.0);
  fibres.addFibre(1, 1, 0.5);
  constexpr int half = 150000;
  for (int i = -half; i <= half; ++i)
  {
    fibres.addPoint({ 0.0, 0.0, 4.0 - 4.0 * std::abs(i) / half }, 0.5);
  }
  try
  {
    cactus::optimise(fibres, {}, {});
    FAIL() << "nothing was said";
  }
  catch (const cactus::InvalidInput& error)
  {
    EXPECT_NE(std::string(error.what()).find("fibre 1 (cell 0) has 300001 control points"), std::string::npos) << error.what();
  }
  // As far as the turn it can.
  fibres.points.resize(half + 1);
  fibres.radii.resize(half + 1);
  fibres.offsets.back() = half + 1;
  EXPECT_EQ(cactus::optimise(fibres, {}, {}).resampling.fibres, 1u);
  EXPECT_EQ(fibres.points.size(), 14u);
}

// The pieces of a fibre that is outside only briefly would overlap, or meet when they grow.
TEST(TrimToDomain, KeepsAFibreWholeThatComesBackAtOnce)
{
  Fibres fibres;
  fibres.domain = cactus::Domain::cube(10.0);
  fibres.addFibre(1, 1, 0.5);
  for (int i = 0; i <= 20; ++i)
  {
    const double z = -5.0 + 0.5 * i;
    fibres.addPoint({ std::abs(z) < 0.8 ? 6.1 : 5.0, 0.0, z }, 0.5);
  }
  const Fibres trimmed = cactus::trimToDomain(fibres);
  ASSERT_EQ(trimmed.size(), 1u);
  EXPECT_EQ(trimmed.points.size(), fibres.points.size());
  EXPECT_EQ(cactus::measureOverlap(trimmed, 1e-3, 1).overlappingPairs, 0u);
}

TEST(TrimToDomain, RefusesWhereNoIdIsFreeForAPiece)
{
  Fibres fibres;
  fibres.domain = cactus::Domain::cube(10.0);
  fibres.addFibre(std::numeric_limits<int>::max(), 1, 0.5);
  for (int i = 0; i <= 40; ++i)
  {
    const double x = -10.0 + 0.5 * i;
    fibres.addPoint({ x, 0.0, std::abs(x) < 2.0 ? 9.0 : 0.0 }, 0.5);
  }
  EXPECT_THROW(cactus::trimToDomain(fibres), cactus::InvalidInput);
  fibres.fibreIds[0] -= 1;
  EXPECT_EQ(cactus::trimToDomain(fibres).fibreIds.back(), std::numeric_limits<int>::max());
}

// Trimming keeps the domain filled, cuts off the parts outside, and gives a new id to a fibre that comes back.
TEST(TrimToDomain, CutsAndSplits)
{
  Fibres fibres;
  fibres.domain = cactus::Domain::cube(10.0);
  fibres.addFibre(7, 2, 0.5); // leaves upwards in the middle and comes back
  for (int i = 0; i <= 40; ++i)
  {
    const double x = -10.0 + 0.5 * i;
    fibres.addPoint({ x, 0.0, std::abs(x) < 2.0 ? 9.0 : 0.0 }, 0.5);
  }
  fibres.addFibre(9, 1, 0.5); // never comes near
  fibres.addPoint({ 20, 0, 0 }, 0.5);
  fibres.addPoint({ 20, 5, 0 }, 0.5);
  fibres.addFibre(3, 1, 0.5); // outside, but its surface is inside
  fibres.addPoint({ 5.3, -5, 0 }, 0.5);
  fibres.addPoint({ 5.3, 5, 0 }, 0.5);
  std::vector<std::size_t> kept;
  const Fibres trimmed = cactus::trimToDomain(fibres, &kept);
  ASSERT_EQ(trimmed.size(), 3u);
  EXPECT_EQ(trimmed.fibreIds, (std::vector<int>{ 7, 10, 3 }));
  EXPECT_EQ(trimmed.bundleIds, (std::vector<int>{ 2, 2, 1 }));
  ASSERT_EQ(kept.size(), trimmed.points.size());
  for (std::size_t i = 0; i < kept.size(); ++i)
  {
    EXPECT_EQ(trimmed.points[i], fibres.points[kept[i]]);
  }
  // The whole part of the first fibre in the domain is still there, and nothing far outside.
  EXPECT_NEAR(cactus::capsuleVolumeInDomain(trimmed), cactus::capsuleVolumeInDomain(fibres), 1e-12);
  for (const auto& point : trimmed.points)
  {
    EXPECT_GT(trimmed.domain.depth(point), -5.0);
  }
}
