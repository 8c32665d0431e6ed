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
  BundleBetweenWalls wanted;
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
  const LabelImage image = growFibres(aimed, growth, growthFor(aimed, growth).growth, growthGrid(fibres.domain, growth));
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
         Known{ 1, "ece0b3b7617c2033040ed874d063aba09021ffdd7ac6023b01ac622eac5723e1",
           "f89d7c7c5990ac1a1a6309d4080b30805869e905d24fafbe4fa1e5a2a333b95b" },
         Known{ 20, "e9615f1ba602b213e940f88bb2d3035e7719929e7df7fe1b5ed39cadc15e179e",
           "d5f50ce51fda994de869e076b5548300c2651a55caf2847f20f3c6cef908c7a1" },
         Known{ 38, "cf71a087b1eaed0fe44198883c05452409ac2c91eff85b78023ee7241e020725",
           "6c9746afca114afb8ab00981cd37ad94b661ef3147a7a26938dbad74802231fb" },
       })
  {
    const FibreSurfacePair& pair = surfaces[static_cast<std::size_t>(known.fibreId) - 1];
    ASSERT_EQ(pair.fibreId, known.fibreId);
    EXPECT_EQ(digest(pair.outer), known.outer) << known.fibreId;
    EXPECT_EQ(digest(pair.inner), known.inner) << known.fibreId;
  }
}
