// SPDX-License-Identifier: BSD-3-Clause
// Guarantees: a lesion takes the fibres asked for, thin ones first or by seed; what it leaves alone keeps its bits; it is
// certified.
#include "judge/Lesion.h"

#include "ExampleSurfaces.h"
#include "base/Error.h"
#include "judge/SubstrateCertificate.h"

#include <gtest/gtest.h>

#include <vector>

using namespace cactus;

namespace
{

/// Plates across the domain, thicker and thicker, whose axons are two thirds as thick.
struct Plates
{
  Domain domain = Domain::cube(20.0);
  std::vector<TriangleMesh> outerMeshes;
  std::vector<TriangleMesh> innerMeshes;
  FibreSurfaces outer;
  FibreSurfaces inner;

  Plates()
  {
    double low = -9.0;
    std::vector<int> ids;
    for (const double half : { 0.6, 0.3, 1.2, 0.9, 1.5 })
    {
      const double high = low + 2.0 * half;
      outerMeshes.push_back(example::box({ -10, -10, low }, { 10, 10, high }));
      innerMeshes.push_back(example::box({ -9.99, -9.99, low + half / 3.0 }, { 9.99, 9.99, high - half / 3.0 }));
      ids.push_back(static_cast<int>(ids.size()) + 1);
      low = high + 0.2;
    }
    outer = example::surfacesOf(ids, outerMeshes);
    inner = example::surfacesOf(ids, innerMeshes);
    outer.wantedIds = ids;
  }
  Lesion lesion(double axonLoss, double myelinLoss, LesionOrder order = LesionOrder::Thinnest, std::uint64_t seed = 1) const
  {
    LesionOptions options;
    options.axonLoss = axonLoss;
    options.myelinLoss = myelinLoss;
    options.order = order;
    options.seed = seed;
    return fibresInLesion(domain, outer, inner, options);
  }
};

constexpr auto whole = FibreInLesion::Whole;
constexpr auto bare = FibreInLesion::WithoutMyelin;
constexpr auto gone = FibreInLesion::Gone;

} // namespace

TEST(Lesion, ThinFibresAreTakenFirst)
{
  const Plates plates;
  // The length of a cylinder with the same wall and volume falls with thickness, so the thin ones are most of it.
  EXPECT_EQ(plates.lesion(0.0, 0.0).fibres, std::vector<FibreInLesion>(5, whole));
  const Lesion some = plates.lesion(0.4, 0.4);
  EXPECT_EQ(some.fibres, std::vector<FibreInLesion>({ bare, gone, whole, whole, whole }));
  EXPECT_NEAR(some.axonLoss, 0.44, 0.03);
  EXPECT_NEAR(some.myelinLoss, 0.39, 0.03);
  EXPECT_EQ(plates.lesion(0.0, 1.0).fibres, std::vector<FibreInLesion>(5, bare));
}

TEST(Lesion, WhatIsLeftKeepsItsBits)
{
  const Plates plates;
  const Lesion some = plates.lesion(0.4, 0.4);
  const FibreSurfaces outer = outerInLesion(some, plates.outer, plates.inner);
  const FibreSurfaces inner = innerInLesion(some, plates.outer, plates.inner);
  EXPECT_EQ(outer.fibreIds, std::vector<int>({ 1, 3, 4, 5 }));
  EXPECT_EQ(inner.fibreIds, outer.fibreIds);
  EXPECT_EQ(outer.wantedIds, outer.fibreIds);
  for (std::size_t i = 0; i < outer.size(); ++i)
  {
    const auto before = static_cast<std::size_t>(outer.fibreIds[i]) - 1;
    EXPECT_TRUE(areSame(inner.mesh(i), plates.innerMeshes[before]));
    EXPECT_TRUE(areSame(outer.mesh(i), i == 0 ? plates.innerMeshes[before] : plates.outerMeshes[before]));
  }
  const SubstrateCertificate certificate = certify(plates.domain, outer, inner, nullptr);
  EXPECT_TRUE(certificate.certified()) << certificate.verdict();
  EXPECT_EQ(certificate.bare, 1u);
  // An axon without myelin has none to lose.
  LesionOptions all;
  all.myelinLoss = 1.0;
  EXPECT_EQ(fibresInLesion(plates.domain, outer, inner, all).fibres, std::vector<FibreInLesion>({ whole, bare, bare, bare }));
}

TEST(Lesion, ASeedTakesTheSameFibresAndMore)
{
  const Plates plates;
  bool differs = false;
  const auto few = plates.lesion(0.3, 0.0, LesionOrder::Random).fibres;
  const auto more = plates.lesion(0.7, 0.0, LesionOrder::Random).fibres;
  for (std::size_t i = 0; i < few.size(); ++i)
  {
    EXPECT_TRUE(few[i] == whole || more[i] == gone);
  }
  for (std::uint64_t seed = 2; seed < 8; ++seed)
  {
    differs = differs || plates.lesion(0.3, 0.0, LesionOrder::Random, seed).fibres != few;
  }
  EXPECT_TRUE(differs);
}

TEST(Lesion, BadValuesAreNamed)
{
  const Plates plates;
  EXPECT_THROW(plates.lesion(0.99, 0.0), InvalidInput);
  EXPECT_THROW(plates.lesion(-0.1, 0.0), InvalidInput);
  EXPECT_THROW(plates.lesion(0.0, 1.1), InvalidInput);
}
