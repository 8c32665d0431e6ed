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
  EXPECT_EQ(digest(initial), "c1032f53505dfff021f4f24f931b7bc283bdf85b9539fff702c2b0e2ad5494dd");

  Fibres fibres = initial;
  optimise(fibres, CapsuleOptimizerOptions{}, {});
  fibres = trimToDomain(fibres);
  EXPECT_EQ(digest(fibres), "972f820e7bc1395137b97aa7229014044aef91e359277f378ec184dcac699501");

  const FibreRadialGrowthOptions growth;
  const Fibres aimed = aimAtTargetRadii(fibres, growth);
  const LabelImage image = growFibres(aimed, growth, growthFor(aimed, growth), growthGrid(fibres.domain, growth));
  EXPECT_EQ(digest(image), "defb38069c59c073e52b637f8c39f855d7c01c84d511d43cadd96a0189936b8d");

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
         Known{ 1, "28a39c07d95ed6fb73271b078c5f9af781be952a5fe3ceff5c099eb3ebc28dbd",
           "c12664864c4501e04ca2b1f5ed3e1251eac81dbde890fb1b4589c7dda8abe4c5" },
         Known{ 20, "fb03d46a7e4fb841744f5e2e4a94c596f4e0a39584925c8342675b87792302eb",
           "173ebf51433d536c954b701825d7e979189c06e9080a1fecc567afd67f0647dc" },
         Known{ 38, "fa912dc9e5bdd72e661a59dd405b95e4639b0d828cf1bb213fd49d6ec7c1632e",
           "8f5352c7e4a31bc588cf6e386e3f3474a2de03e1b492e3514d61d52c292ad34f" },
       })
  {
    const FibreSurfacePair& pair = surfaces[static_cast<std::size_t>(known.fibreId) - 1];
    ASSERT_EQ(pair.fibreId, known.fibreId);
    EXPECT_EQ(digest(pair.outer), known.outer) << known.fibreId;
    EXPECT_EQ(digest(pair.inner), known.inner) << known.fibreId;
  }
}
