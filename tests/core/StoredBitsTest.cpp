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
  EXPECT_EQ(digest(fibres), "0d8d6a1d25ec49963c60d9eae432bf44d5214cdddf723bf79ceec4412c34538d");

  const FibreRadialGrowthOptions growth;
  const Fibres aimed = aimAtTargetRadii(fibres, growth);
  const LabelImage image = growFibres(aimed, growth, growthFor(aimed, growth), growthGrid(fibres.domain, growth));
  EXPECT_EQ(digest(image), "3f8b8fb22af8d3e16786f151cfd1d6cc97858ce42eff95079af4d3589a0f9eca");

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
         Known{ 1, "9373447c608687e41de8eb8822093e61319ad8d5cd6290b9372a2148e256f92b",
           "10c94ba5fb232634c75d7f4fa3a0b5bfe43fe04c2e35ab2a98d87d06467e8d07" },
         Known{ 20, "52a25bda38718049f2ba069ca8681e13c342dda36af505791b3b195b0a0a4e76",
           "005ef83f5d930309d0c209e0086894eeada1a5842f475d7d46ce42c52c90b337" },
         Known{ 38, "28906c204933ca2fa8edd872b553c461660f17dd3e4e286c33d619ea8992bb8f",
           "f42f8b9c644f7367d555fc64c389206428cd747ef1204e90710a9a2a26ff9a91" },
       })
  {
    const FibreSurfacePair& pair = surfaces[static_cast<std::size_t>(known.fibreId) - 1];
    ASSERT_EQ(pair.fibreId, known.fibreId);
    EXPECT_EQ(digest(pair.outer), known.outer) << known.fibreId;
    EXPECT_EQ(digest(pair.inner), known.inner) << known.fibreId;
  }
}
