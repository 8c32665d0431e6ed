// SPDX-License-Identifier: BSD-3-Clause
// Guarantee: a seed has the same bits in every version that does not say otherwise in its CHANGELOG, with any compiler, vector
// unit and number of threads. What may differ from one C library to the next are the elementary functions (std::log, std::sin,
// …); where they have other last digits than those below, what depends on them is not compared.
#include "ElementaryFunctions.h"
#include "NumbersChecksum.h"
#include "bundle/BundleInitializer.h"
#include "fibres/TrimToDomain.h"
#include "growth/FibreRadialGrowth.h"
#include "growth/GrowthTarget.h"
#include "growth/TargetRadii.h"
#include "optimiser/CapsuleOptimizer.h"
#include "surface/MyelinSurface.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

namespace
{

using namespace cactus;

std::string digest(const Fibres& fibres)
{
  NumbersChecksum hash;
  for (const Eigen::Vector3d& point : fibres.points)
  {
    hash.add(point.x());
    hash.add(point.y());
    hash.add(point.z());
  }
  hash.add(fibres.radii);
  hash.add(std::vector<std::uint64_t>(fibres.offsets.begin(), fibres.offsets.end()));
  hash.add(fibres.fibreIds);
  hash.add(fibres.bundleIds);
  hash.add(fibres.targetRadii);
  return hash.digest();
}

std::string digest(const LabelImage& image)
{
  NumbersChecksum hash;
  hash.add(image.fibreId);
  hash.add(image.depth);
  return hash.digest();
}

std::string digest(const TriangleMesh& mesh)
{
  NumbersChecksum hash;
  for (const Eigen::Vector3d& point : mesh.points)
  {
    hash.add(point.x());
    hash.add(point.y());
    hash.add(point.z());
  }
  for (const auto& triangle : mesh.triangles)
  {
    hash.add(triangle[0]);
    hash.add(triangle[1]);
    hash.add(triangle[2]);
  }
  return hash.digest();
}

} // namespace

TEST(StoredBits, DefaultChain)
{
  if (const std::string names = unknownElementaryFunctions(); !names.empty())
  {
    GTEST_SKIP() << "this C library has other last digits in " << names;
  }
  BundleInitializerOptions wanted;
  wanted.side = 8.0;
  wanted.meanDispersion = 10.0;
  const Fibres initial = initialiseBundles(wanted);
  EXPECT_EQ(digest(initial), "21567c8b37922ddc7272719cc66d0c47d5503747ca5c8774bad875196810fc14");

  Fibres fibres = initial;
  optimise(fibres, CapsuleOptimizerOptions{}, {});
  fibres = trimToDomain(fibres);
  EXPECT_EQ(digest(fibres), "74c3c6e6ad8fdf250229df2e0df06d3cdd057e506dbb89ddc2beae2cf55607ec");

  const FibreRadialGrowthOptions growth;
  const Fibres aimed = aimAtTargetRadii(fibres, growth);
  const LabelImage image = growFibres(aimed, growth, growthFor(aimed, growth), growthGrid(fibres.domain, growth));
  EXPECT_EQ(digest(image), "6f390d0626292db1cfec0fea89c2054d7d4c150fe2bc96d5d3c98e21bf476885");

  const LabelImageFacts facts = labelImageFacts(fibres, growth);
  const auto surfaces = myelinSurfaces({ image.grid, image.fibreId.data(), image.depth.data(), growth.gap() }, facts, {});
  struct Known
  {
    int fibreId;
    const char* outer;
    const char* inner;
  };
  ASSERT_EQ(surfaces.size(), 38u);
  for (const Known& known : {
         Known{ 1, "5ba2b374e00a0e804dfd26ab059d29572c4c9a6108de262a1be2f9f7230f1ea9",
           "1483540a4867077e4301bc3cb351bce1137f47cb982e3bbfb009e132c81aafe0" },
         Known{ 20, "a050ffdfa0dcdda67878b3c2c5eb140411545e2408269dc8470565f79f734037",
           "ccea80f1e18bc686082838934060c48bd7bbca9f1b7cb5bb0d13f435e7dc4d65" },
         Known{ 38, "ed3eaf3c88314dc59ec4d13100f4dcdfaa0476ea3a0badefa270f3fd5f292f71",
           "9ce1c837e3f88be728ce710372069ae16c8f572b36a72c78c5dc35aee6dfcf85" },
       })
  {
    const FibreSurfacePair& pair = surfaces[static_cast<std::size_t>(known.fibreId) - 1];
    ASSERT_EQ(pair.fibreId, known.fibreId);
    EXPECT_EQ(digest(pair.outer), known.outer) << known.fibreId;
    EXPECT_EQ(digest(pair.inner), known.inner) << known.fibreId;
  }
}
