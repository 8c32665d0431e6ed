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
  EXPECT_EQ(digest(fibres), "7c2acbb23ccdb02b4673ff3057b4921b0f7171236a3142a10cf4c2efd0863711");

  const FibreRadialGrowthOptions growth;
  const Fibres aimed = aimAtTargetRadii(fibres, growth);
  const LabelImage image = growFibres(aimed, growth, growthFor(aimed, growth).growth, growthGrid(fibres.domain, growth));
  EXPECT_EQ(digest(image), "14b7050cdb823fef885868a979b478007a2e4c507379044a7646b8dc8e8a7eec");

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
         Known{ 1, "d324e18763b81996b4b8bd88b07099cc5139c7d36d7cdaf85ac741e2d4ec4819",
           "5513e92e8d2e30360ac1b6efed676e0ac068cfdf2ceeb6d444f681d9db502a75" },
         Known{ 20, "8db1af8c7c7561b8426afa55c2a3904f9936ae3c2ac2338700b7ca4d33543914",
           "62ad7ac3ba410f17711a80cb0ebd512c4c531dded9fa4c9fc817b6d1fdcbb83b" },
         Known{ 38, "b26053456983f69fb4966751afb91b9b72a3545ad00b84abffd42b29af176836",
           "5db4cae763419b0ce543c12dc187021d680a4a284d64137259d7050a943dcdee" },
       })
  {
    const FibreSurfacePair& pair = surfaces[static_cast<std::size_t>(known.fibreId) - 1];
    ASSERT_EQ(pair.fibreId, known.fibreId);
    EXPECT_EQ(digest(pair.outer), known.outer) << known.fibreId;
    EXPECT_EQ(digest(pair.inner), known.inner) << known.fibreId;
  }
}
