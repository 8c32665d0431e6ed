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
  EXPECT_EQ(digest(fibres), "ffdbee8a769a1391d6c45c8f7c2b291124b38e4b5fd93e966e4bce0f6dc8b17f");

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
         Known{ 1, "602e73a234d48cb49cdfe6c32070c5e6ecb10e2da2c8737e2484c464434ef27b",
           "1e5c45842eb0bba9c4a938a60ec08fcdac2a1ca585fb6093ad5b1e6ed07faeae" },
         Known{ 20, "035c56aa038bc73d02cd6dd2256a996aa0fd5a875e6e483b62cc9f0dc990cf83",
           "1cc45bfc0c56eef8468e3b869005135014a8474cf82fa2f12f66ca0dc31d55ac" },
         Known{ 38, "7d0ef264d9a7e1a848a9f2bf7067f8136eb607efb0aa4c91f64fac4249e54032",
           "084e6118d9cd3815ab41711e7d12d62a249a8630f407ebd3d556557d01fe8f51" },
       })
  {
    const FibreSurfacePair& pair = surfaces[static_cast<std::size_t>(known.fibreId) - 1];
    ASSERT_EQ(pair.fibreId, known.fibreId);
    EXPECT_EQ(digest(pair.outer), known.outer) << known.fibreId;
    EXPECT_EQ(digest(pair.inner), known.inner) << known.fibreId;
  }
}
