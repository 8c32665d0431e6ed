// SPDX-License-Identifier: BSD-3-Clause
// Guarantee 5: if memory runs out, at any allocation and in any thread, a stage ends with an exception in the calling thread, and
// the next run gives the right bits. Replaces operator new for the whole test program.
#include "BundleBetweenWalls.h"
#include "Sanitized.h"
#include "base/Error.h"
#include "bundle/BundleInitializer.h"
#include "growth/FibreRadialGrowth.h"
#include "growth/GrowthTarget.h"
#include "growth/TargetRadii.h"
#include "judge/CertificateTables.h"
#include "judge/SubstrateCertificate.h"
#include "judge/SubstrateStatistics.h"
#include "optimiser/CapsuleOptimizer.h"
#include "surface/MyelinSurface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <limits>
#include <new>
#include <utility>
#include <vector>

namespace
{

constexpr std::int64_t never = std::numeric_limits<std::int64_t>::max();

std::atomic<std::int64_t> allocations{ 0 };
std::atomic<std::int64_t> failing{ never }; ///< number of the first allocation that fails
std::atomic<bool> fromThereOn{ false };     ///< whether all later allocations fail, too

void* allocate(std::size_t size, std::size_t alignment)
{
  const std::int64_t number = allocations++;
  if (number == failing || (fromThereOn && number > failing))
  {
    throw std::bad_alloc();
  }
  const std::size_t whole = (std::max<std::size_t>(size, 1) + alignment - 1) / alignment * alignment;
  void* memory = alignment <= alignof(std::max_align_t) ? std::malloc(whole) : std::aligned_alloc(alignment, whole);
  if (memory == nullptr)
  {
    throw std::bad_alloc();
  }
  return memory;
}

} // namespace

void* operator new(std::size_t size)
{
  return allocate(size, 1);
}

void* operator new(std::size_t size, std::align_val_t alignment)
{
  return allocate(size, static_cast<std::size_t>(alignment));
}

// Sanitizers have their own version of this one, too, whose memory only they can free.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept
{
  try
  {
    return allocate(size, 1);
  }
  catch (const std::bad_alloc&)
  {
    return nullptr;
  }
}

void operator delete(void* memory) noexcept
{
  std::free(memory);
}

void operator delete(void* memory, std::size_t) noexcept
{
  std::free(memory);
}

void operator delete(void* memory, std::align_val_t) noexcept
{
  std::free(memory);
}

void operator delete(void* memory, std::size_t, std::align_val_t) noexcept
{
  std::free(memory);
}

namespace
{

using namespace cactus;

/// The numbers of a result.
using Result = std::vector<double>;

Context twoThreads()
{
  Context context;
  context.threads = 2;
  return context;
}

void append(Result& result, const std::vector<Eigen::Vector3d>& points)
{
  for (const Eigen::Vector3d& point : points)
  {
    result.insert(result.end(), point.data(), point.data() + 3);
  }
}

Fibres bundle(const Context& context)
{
  BundleBetweenWalls options;
  options.side = 4.0;
  options.fibreVolumeFraction = 0.5;
  options.radius.maximum = 0.7;
  return initialiseBundles(options, context);
}

FibreRadialGrowthOptions growthOptions()
{
  FibreRadialGrowthOptions options;
  options.voxelSize = 0.2;
  return options;
}

std::vector<FibreSurfacePair> surfacesOf(const Fibres& fibres, const LabelImage& image)
{
  MyelinSurfaceOptions options;
  return myelinSurfaces({ image.grid, image.fibreId.data(), image.depth.data(), growthOptions().gap() },
    labelImageFacts(fibres, growthOptions()), options, twoThreads());
}

#ifdef CACTUS_SANITIZED
constexpr std::int64_t tries = 12; // each takes about as long as one run
#else
constexpr std::int64_t tries = 48;
#endif

/// Makes some allocations of `work` fail, one at a time or with all that follow, and compares its result where it succeeds.
void expectCleanEnds(const std::function<Result()>& work)
{
  const Result expected = work();
  const std::int64_t before = allocations;
  ASSERT_EQ(work(), expected);
  const std::int64_t count = allocations - before;
  std::int64_t thrown = 0;
  for (std::int64_t n = 0; n < tries; ++n)
  {
    // The first ones, then evenly spread.
    const std::int64_t at = n < tries / 4 ? n : n * count / tries;
    fromThereOn = n % 2 == 1;
    failing = allocations + at;
    Result result;
    bool failed = false;
    try
    {
      result = work();
    }
    catch (const std::bad_alloc&)
    {
      failed = true;
    }
    catch (const OutOfMemory&)
    {
      failed = true;
    }
    failing = never;
    fromThereOn = false;
    thrown += failed;
    if (!failed)
    {
      EXPECT_EQ(result, expected) << "allocation " << at << " of " << count << " was done without";
    }
  }
  EXPECT_GT(thrown, tries / 2);
  EXPECT_EQ(work(), expected) << "the next run";
}

} // namespace

TEST(AllocationFailure, InABundle)
{
  expectCleanEnds(
    []
    {
      Result result;
      append(result, bundle(twoThreads()).points);
      return result;
    });
}

TEST(AllocationFailure, InAnOptimisation)
{
  const Fibres fibres = bundle(twoThreads());
  expectCleanEnds(
    [&]
    {
      Fibres optimised = fibres;
      CapsuleOptimizerOptions options;
      options.maximumIterations = 12;
      optimise(optimised, options, twoThreads());
      Result result;
      append(result, optimised.points);
      return result;
    });
}

TEST(AllocationFailure, InGrowth)
{
  const Fibres fibres = bundle(twoThreads());
  expectCleanEnds(
    [&]
    {
      const LabelImage image = growFibres(fibres, growthOptions(), 0.1, growthGrid(fibres.domain, growthOptions()), twoThreads());
      Result result(image.depth.begin(), image.depth.end());
      result.insert(result.end(), image.fibreId.begin(), image.fibreId.end());
      return result;
    });
}

TEST(AllocationFailure, InTheSearchForATarget)
{
  const Fibres fibres = bundle(twoThreads());
  FibreRadialGrowthOptions options = growthOptions();
  options.targetFibreVolumeFraction = 0.6;
  const Fibres aimed = aimAtTargetRadii(fibres, options, twoThreads());
  expectCleanEnds([&] { return aimAtTargetRadii(fibres, options, twoThreads()).radii; });
}

TEST(AllocationFailure, InSurfaces)
{
  const Fibres fibres = bundle(twoThreads());
  const LabelImage image = growFibres(fibres, growthOptions(), 0.0, growthGrid(fibres.domain, growthOptions()), twoThreads());
  expectCleanEnds(
    [&]
    {
      Result result;
      for (const FibreSurfacePair& pair : surfacesOf(fibres, image))
      {
        append(result, pair.outer.points);
        append(result, pair.inner.points);
      }
      return result;
    });
}

TEST(AllocationFailure, InTheCertificateAndTheStatistics)
{
  const Fibres fibres = bundle(twoThreads());
  const LabelImage image = growFibres(fibres, growthOptions(), 0.0, growthGrid(fibres.domain, growthOptions()), twoThreads());
  const std::vector<FibreSurfacePair> pairs = surfacesOf(fibres, image);
  FibreSurfaces outer;
  FibreSurfaces inner;
  std::vector<std::size_t> withAxon;
  for (std::size_t i = 0; i < pairs.size(); ++i)
  {
    outer.fibreIds.push_back(pairs[i].fibreId);
    outer.bundleIds.push_back(pairs[i].bundleId);
    if (!pairs[i].inner.triangles.empty())
    {
      inner.fibreIds.push_back(pairs[i].fibreId);
      inner.bundleIds.push_back(pairs[i].bundleId);
      withAxon.push_back(i);
    }
  }
  outer.mesh = [&](std::size_t i) { return pairs[i].outer; };
  inner.mesh = [&](std::size_t i) { return pairs[withAxon[i]].inner; };
  expectCleanEnds(
    [&]
    {
      const SubstrateCertificate certificate = certify(fibres.domain, outer, inner, &fibres, {}, twoThreads());
      Result result{ certificate.certified() ? 1.0 : 0.0 };
      for (const CertificateColumn& column : fibreColumns(certificate))
      {
        for (const double value : column.values)
        {
          result.push_back(std::isfinite(value) ? value : -1.0);
        }
      }
      return result;
    });
  expectCleanEnds(
    [&]
    {
      const SubstrateStatistics statistics = measureSubstrate(fibres, outer, inner, {}, twoThreads());
      return Result{ statistics.fibreVolumeFraction, statistics.largestPenetration, statistics.smallestAngle };
    });
}
