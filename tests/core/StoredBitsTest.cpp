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
  EXPECT_EQ(digest(initialiseBundles(cut)), "db4dc5dc44f817275e34e86ae811cc73053ee547fa9125d615b557b46b5ba681");

  BundleBetweenWalls wanted;
  wanted.side = 8.0;
  wanted.meanDispersion = 10.0;
  const Fibres initial = initialiseBundles(wanted);
  EXPECT_EQ(digest(initial), "c1032f53505dfff021f4f24f931b7bc283bdf85b9539fff702c2b0e2ad5494dd");

  Fibres fibres = initial;
  optimise(fibres, CapsuleOptimizerOptions{}, {});
  fibres = trimToDomain(fibres);
  EXPECT_EQ(digest(fibres), "7b46b2948254eb099cf18e1f1e8170a074861315e9c38051939dfe711cfb794e");

  const FibreRadialGrowthOptions growth;
  const Fibres aimed = aimAtTargetRadii(fibres, growth);
  const LabelImage image = growFibres(aimed, growth, growthFor(aimed, growth).growth, growthGrid(fibres.domain, growth));
  EXPECT_EQ(digest(image), "4c704233c0d760f561a6d6ce73f3296856b7d7195a519a46a3861c47cb4bfaf4");

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
         Known{ 1, "d1274c4b10f27dba0712dfdd80d31f92007636f9da6ac3f2bd03635cd24024e2",
           "2c976301f24363a83df6e6eed702472130bb13cc2f0c76042a05d6583ec85ab7" },
         Known{ 20, "307e43b08e8dda1c8b6b306df844464d71a3702e8e3cdbaea67937c4bf3c3688",
           "f460176089b30ac7f6a1afb52e5700a37c3015d410f149dfd1f20b811ce2eafd" },
         Known{ 38, "4e2a7effbe19dcd0dc08b16db0c9997bed302916eecbfc1ad5355c11bdebe230",
           "70ce8162ed8dd044855e4d67de46f860d4246b56fedd3ab21a76913814108376" },
       })
  {
    const FibreSurfacePair& pair = surfaces[static_cast<std::size_t>(known.fibreId) - 1];
    ASSERT_EQ(pair.fibreId, known.fibreId);
    EXPECT_EQ(digest(pair.outer), known.outer) << known.fibreId;
    EXPECT_EQ(digest(pair.inner), known.inner) << known.fibreId;
  }
}
