// SPDX-License-Identifier: BSD-3-Clause
// Guarantee: a seed has the same bits in every version unless its CHANGELOG says otherwise, with any compiler, vector unit and
// number of threads. Only the elementary functions (std::log, std::sin, …) may differ between C libraries; if their last digits
// differ from those below, results that depend on them are not compared.
#include "BundleBetweenWalls.h"
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
  BundleInitializerOptions cut;
  cut.side = 8.0;
  EXPECT_EQ(digest(initialiseBundles(cut)), "1cc3f73616d6904199b299b546c5cb6aedd715a6f1279c889b609f590a43b43b");

  BundleBetweenWalls wanted;
  wanted.side = 8.0;
  wanted.meanDispersion = 10.0;
  wanted.calibre = CalibreVariation();
  wanted.fibreVolumeFraction = 0.6;
  const Fibres initial = initialiseBundles(wanted);
  EXPECT_EQ(digest(initial), "684ffb509a1b0637adeeda523911df178d82cc3a03d03563050fa6141a1f7031");

  Fibres fibres = initial;
  optimise(fibres, CapsuleOptimizerOptions{}, {});
  fibres = trimToDomain(fibres);
  EXPECT_EQ(digest(fibres), "3036da146a0bf3a51ceb66d60ae09966280a4a5550cbfe8f2647d4de68d04436");

  const FibreRadialGrowthOptions growth;
  const Fibres aimed = aimAtTargetRadii(fibres, growth);
  const LabelImage image = growFibres(aimed, growth, growthFor(aimed, growth).growth, growthGrid(fibres.domain, growth));
  EXPECT_EQ(digest(image), "b77793960434c99974bd032f057b9210aca4ed26377b162222c29ab6a676dbb4");

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
         Known{ 1, "a56a6e222c378f0cc65f95568ac0aa465b15ffa9a61677fefb6637c802c446e8",
           "bbf2bd66cd080055ab5c954d85d7e109253cbdf8d0a7bd9ec7cb5b81cb232729" },
         Known{ 20, "b6c190e22e1480bf76249f5f1560e8150f6dd262cc3f0a966b6c07f552fcb6ba",
           "f06c5cd16dbe67b2e268fc2c2edbcd76db85f61109c4f6678f265bbd1ba3a0cc" },
         Known{ 38, "a84a8182967c5aa91db7c5985421fcba05f79e4107e08534faa37715968b555d",
           "17b37c87c04fc2539619ef7b115941f2087be879dc7210ec8f74155917f95355" },
       })
  {
    const FibreSurfacePair& pair = surfaces[static_cast<std::size_t>(known.fibreId) - 1];
    ASSERT_EQ(pair.fibreId, known.fibreId);
    EXPECT_EQ(digest(pair.outer), known.outer) << known.fibreId;
    EXPECT_EQ(digest(pair.inner), known.inner) << known.fibreId;
  }
}
