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
  EXPECT_EQ(digest(fibres), "c8147b3d428fb680e9b0033f90b2aa9a59e6f426b7b8bad381f7aa5d7e92a995");

  const FibreRadialGrowthOptions growth;
  const Fibres aimed = aimAtTargetRadii(fibres, growth);
  const LabelImage image = growFibres(aimed, growth, growthFor(aimed, growth), growthGrid(fibres.domain, growth));
  EXPECT_EQ(digest(image), "7a65893025575a58c6442e64f7dfbba9b7d75dcda628c72cf5964bbd35b1ef90");

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
         Known{ 1, "3ac93d76f232a1f1969b8a97d814203a425e31397c34077ffc92d8490cdae761",
           "9ddec05a7eccdab647c6674a7c7fe9b639da6b92bfece4666ee2ac06bf2e9445" },
         Known{ 20, "c44ff0cffb3536357ee33af8da3ef3f556baa60f2858a6a1a4f4609e6428ea3b",
           "9fc809a4ef65967ba789081d20fb39d5afada17e74291385257718eb38071410" },
         Known{ 38, "8e3a3e19ffa88dd6c18101999f43e4bc61905d80297e274c062e1954e8c33ce6",
           "19095693137309f98867a49ed356c032f867a00a56258507490a707096bbc125" },
       })
  {
    const FibreSurfacePair& pair = surfaces[static_cast<std::size_t>(known.fibreId) - 1];
    ASSERT_EQ(pair.fibreId, known.fibreId);
    EXPECT_EQ(digest(pair.outer), known.outer) << known.fibreId;
    EXPECT_EQ(digest(pair.inner), known.inner) << known.fibreId;
  }
}
