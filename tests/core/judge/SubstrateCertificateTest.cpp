// SPDX-License-Identifier: BSD-3-Clause
#include "judge/SubstrateCertificate.h"

#include "../FindingsInMemory.h"
#include "ExampleSurfaces.h"
#include "base/Constants.h"
#include "base/Error.h"
#include "judge/CertificateTables.h"
#include "mesh/CappedSurface.h"
#include "mesh/SurfaceDistance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>

namespace
{

using cactus::TriangleMesh;
using example::both;
using example::tube;
using Meshes = std::map<int, TriangleMesh>;

constexpr double halfSide = 2.0;

cactus::FibreSurfaces surfaces(const Meshes& meshes)
{
  cactus::FibreSurfaces result;
  std::vector<TriangleMesh> list;
  for (const auto& entry : meshes)
  {
    result.fibreIds.push_back(entry.first);
    result.bundleIds.push_back(1);
    list.push_back(entry.second);
  }
  result.mesh = [list](std::size_t i) { return list[i]; };
  return result;
}

cactus::SubstrateCertificate certified(const Meshes& outer, const Meshes& inner, double gap = 0.02, int threads = 1)
{
  cactus::SubstrateCertificateOptions options;
  options.minimumGap = gap;
  cactus::Context context;
  context.threads = threads;
  return cactus::certify(cactus::Domain::cube(2 * halfSide), surfaces(outer), surfaces(inner), nullptr, options, context);
}

/// Five tubes with axons: 1 and 2 are 0.05 µm apart, 2 and 3 0.04, 4 and 5 0.03, all others further.
struct Substrate
{
  Meshes outer;
  Meshes inner;

  Substrate()
  {
    const double x[] = { -1.55, -0.5, 0.54, -0.5, 0.53 };
    const double y[] = { 0.0, 0.0, 0.0, 1.2, 1.2 };
    for (int i = 0; i < 5; ++i)
    {
      this->outer[i + 1] = tube(x[i], y[i], 0.5, -halfSide, halfSide);
      this->inner[i + 1] = tube(x[i], y[i], 0.35, -halfSide + 0.02, halfSide - 0.02);
    }
  }
  cactus::SubstrateCertificate certificate(double gap = 0.02, int threads = 1) const
  {
    return certified(this->outer, this->inner, gap, threads);
  }
};

/// Expects just one kind of fault.
void expectFault(const cactus::SubstrateCertificate& certificate, const std::string& words)
{
  EXPECT_FALSE(certificate.certified());
  ASSERT_EQ(certificate.faults.size(), 1U) << certificate.faults[1];
  EXPECT_NE(certificate.faults[0].find(words), std::string::npos) << certificate.faults[0];
}

} // namespace

// The certificate of a sound substrate, with every number known by formula.
TEST(SubstrateCertificate, CertifiesWhatIsSound)
{
  const Substrate sound;
  const auto certificate = sound.certificate();
  EXPECT_TRUE(certificate.certified());
  EXPECT_EQ(certificate.outerSurfaces, 5U);
  EXPECT_EQ(certificate.innerSurfaces, 5U);
  EXPECT_NEAR(certificate.smallestGap, 0.03, 1e-12);
  EXPECT_EQ(certificate.gapFibreA, 4);
  EXPECT_EQ(certificate.gapFibreB, 5);
  const double polygon = 12.0 * std::sin(2.0 * cactus::pi / 24.0); // area over squared radius
  const double apothem = std::cos(cactus::pi / 24.0);
  // From a corner of the axon to the flat side: the sides are parallel.
  EXPECT_NEAR(certificate.smallestMyelin, 0.15 * apothem, 1e-12);
  EXPECT_NEAR(certificate.fibreVolumeFraction, 5 * 0.25 * polygon * 4.0 / 64.0, 1e-12);
  EXPECT_NEAR(certificate.axonVolumeFraction, 5 * 0.35 * 0.35 * polygon * 3.96 / 64.0, 1e-12);
  EXPECT_NEAR(certificate.aggregateGRatio, 0.7 * std::sqrt(0.99), 1e-12);
  EXPECT_NEAR(certificate.fibres[1].gap, 0.04, 1e-12);
  EXPECT_EQ(certificate.fibres[1].nearestFibre, 3);
  EXPECT_NEAR(certificate.fibres[0].gap, 0.05, 1e-12);
  EXPECT_EQ(certificate.fibres[0].nearestFibre, 2);
  EXPECT_TRUE(std::isnan(certificate.fibres[0].outerRadius.mean)) << "without centre lines";
  const auto columns = cactus::substrateColumns(certificate);
  EXPECT_EQ(columns[0].name, "Certified");
  EXPECT_EQ(columns[0].values, std::vector<double>{ 1.0 });
  for (const auto& column : cactus::fibreColumns(certificate))
  {
    EXPECT_EQ(column.values.size(), 5U) << column.name;
  }
}

// In a file in single precision, the face of a domain moves by more than the tolerance for rounding.
TEST(SubstrateCertificate, KnowsCapsInAFile)
{
  const double face = 35.1;
  ASSERT_LT(double(float(face)), face - 1e-6);
  cactus::SubstrateCertificateOptions options;
  options.minimumGap = 0.02;
  const auto inFile = [](const TriangleMesh& mesh) { return cactus::inSinglePrecision(mesh); };
  const auto certificate =
    cactus::certify(cactus::Domain::cube(2 * face), surfaces({ { 1, inFile(tube(0, 0, 0.5, -face, face)) } }),
      surfaces({ { 1, inFile(tube(0, 0, 0.35, -face + 0.02, face - 0.02)) } }), nullptr, options);
  EXPECT_TRUE(certificate.certified()) << certificate.faults.front();
  EXPECT_NEAR(certificate.smallestMyelin, 0.15 * std::cos(cactus::pi / 24.0), 1e-5);
}

TEST(SubstrateCertificate, WantsTheGapAskedFor)
{
  const Substrate sound;
  expectFault(sound.certificate(0.031), "fibres 4 and 5 come as near as");
  EXPECT_TRUE(sound.certificate(0.0299).certified());
  EXPECT_THROW(sound.certificate(-0.5), cactus::InvalidInput);
  EXPECT_THROW(certified({}, {}), cactus::InvalidInput);
}

// Meshes broken on purpose, one fault at a time.
TEST(SubstrateCertificate, NamesEachFault)
{
  Substrate hole;
  hole.outer[2].triangles.erase(hole.outer[2].triangles.begin() + 300);
  auto certificate = hole.certificate();
  EXPECT_EQ(certificate.notClosed, 1U);
  EXPECT_EQ(certificate.leavingInner, 1U) << "an open surface holds nothing";
  EXPECT_NE(certificate.faults[0].find("not closed (fibre 2 first)"), std::string::npos) << certificate.faults[0];

  Substrate flipped;
  std::swap(flipped.inner[3].triangles[100][0], flipped.inner[3].triangles[100][1]);
  expectFault(flipped.certificate(), "not closed (fibre 3 first)");

  Substrate inward;
  for (auto& triangle : inward.inner[4].triangles)
  {
    std::swap(triangle[0], triangle[1]);
  }
  expectFault(inward.certificate(), "do not point outward (fibre 4 first)");

  Substrate crowded;
  crowded.inner[1].triangles.push_back(crowded.inner[1].triangles.front());
  certificate = crowded.certificate();
  EXPECT_EQ(certificate.notClosed, 1U);
  EXPECT_EQ(certificate.selfIntersecting, 1U);

  Substrate pinched; // two pieces that share a point
  auto pieces = both(tube(0.54, 0, 0.2, -1.5, -0.5), tube(0.54, 0, 0.2, 0.5, 1.5));
  for (auto& triangle : pieces.triangles)
  {
    for (auto& corner : triangle)
    {
      corner = corner == 21 * 24 + 1 ? 2 * (21 * 24 + 2) - 2 : corner; // the upper pole of one is the lower pole of the other
    }
  }
  pieces.points[2 * (21 * 24 + 2) - 2] = { 0.54, 0.0, 0.0 };
  pinched.inner[3] = pieces;
  expectFault(pinched.certificate(), "pinched in a point or use a corner twice (fibre 3 first)");

  Substrate dented;
  dented.inner[5].points[10 * 24][0] -= 0.8; // through the opposite wall, but not through the myelin
  certificate = dented.certificate();
  EXPECT_EQ(certificate.selfIntersecting, 1U);
  EXPECT_GT(certificate.fibres[4].innerSelfIntersections, 0U);

  Substrate overlapping;
  overlapping.outer[1] = tube(-1.5 + 1e-6, 0, 0.5, -halfSide, halfSide);
  expectFault(overlapping.certificate(), "1 pairs of outer surfaces cut or touch each other (fibre 1 first)");
  overlapping.outer[1] = tube(-1.5, 0, 0.5, -halfSide, halfSide); // now they share a line
  certificate = overlapping.certificate();
  EXPECT_EQ(certificate.meetingPairs, 1U);
  EXPECT_EQ(certificate.smallestGap, 0.0);
  EXPECT_EQ(certificate.fibres[0].meetingFibres, 1U);
  EXPECT_EQ(certificate.fibres[1].meetingFibres, 1U);
  EXPECT_EQ(certificate.fibres[2].meetingFibres, 0U);

  Substrate touching; // in a single point
  touching.outer[6] = example::tetrahedron({ 1.04, 0.0, -halfSide + 0.2 }, 0.3);
  EXPECT_EQ(touching.certificate().meetingPairs, 1U);
  touching.outer[6] = example::tetrahedron({ 1.04 + 1e-12, 0.0, -halfSide + 0.2 }, 0.3);
  expectFault(touching.certificate(), "fibres 3 and 6 come as near as");

  Substrate nested;
  nested.outer[6] = tube(0.54, 0.0, 0.1, -1.0, 1.0);
  expectFault(nested.certificate(), "1 pairs of fibres lie inside one another");

  Substrate doubled; // an axon in two pieces, one inside the other
  doubled.inner[3] = both(doubled.inner[3], tube(0.54, 0.0, 0.1, -1.0, 1.0));
  expectFault(doubled.certificate(), "1 surfaces have a piece inside another of their pieces (fibre 3 first)");
  doubled.inner[3] = both(tube(0.54, 0.0, 0.1, -1.5, -0.5), tube(0.54, 0.0, 0.1, 0.5, 1.5));
  EXPECT_TRUE(doubled.certificate().certified()) << "side by side";

  Substrate poking;
  poking.inner[2].points[10 * 24][0] += 0.16;
  expectFault(poking.certificate(), "1 inner surfaces leave their outer ones (fibre 2 first)");

  Substrate coplanar; // an axon as long as its fibre: their caps lie in one plane
  coplanar.inner[2] = tube(-0.5, 0.0, 0.35, -halfSide, halfSide);
  expectFault(coplanar.certificate(), "1 inner surfaces leave their outer ones (fibre 2 first)");

  Substrate swapped;
  swapped.inner[1] = swapped.inner[5];
  expectFault(swapped.certificate(), "1 inner surfaces leave their outer ones (fibre 1 first)");
}

TEST(SubstrateCertificate, SaysNoFractionOfWhatIsNotClipped)
{
  Substrate longer;
  longer.outer[1] = tube(-1.55, 0.0, 0.5, -halfSide, halfSide + 0.5);
  const auto certificate = longer.certificate();
  EXPECT_TRUE(std::isnan(certificate.fibreVolumeFraction));
  EXPECT_NEAR(certificate.reach, 0.5, 1e-12);
  const auto damaged = []
  {
    Substrate broken;
    broken.outer[3].points[7][1] = std::numeric_limits<double>::quiet_NaN();
    return broken.certificate();
  };
  EXPECT_THROW(damaged(), cactus::InvalidInput);
}

TEST(SubstrateCertificate, RemarksOnSurfacesThatReachOutOfTheDomain)
{
  EXPECT_TRUE(Substrate().certificate().remarks.empty());
  Substrate longer;
  longer.outer[1] = tube(-1.55, 0.0, 0.5, -halfSide, halfSide + 0.5);
  const auto certificate = longer.certificate();
  ASSERT_EQ(certificate.remarks.size(), 1u);
  EXPECT_NE(certificate.remarks[0].find("reach 0.5"), std::string::npos) << certificate.remarks[0];
}

// Without ClipToDomain fibres reach to the end of the image, where they are cut off as flat as at the domain's faces.
TEST(SubstrateCertificate, LeavesOutTheCapsBeyondTheDomain)
{
  const double end = halfSide + 0.3;
  const auto certificate =
    certified({ { 1, tube(0.0, 0.0, 0.5, -end, end) } }, { { 1, tube(0.0, 0.0, 0.35, -end + 0.001, end - 0.001) } });
  EXPECT_TRUE(certificate.certified());
  EXPECT_NEAR(certificate.smallestMyelin, 0.15, 0.01);
}

// Missing surfaces are reported, from the surfaces' own data or from the fibres.
TEST(SubstrateCertificate, TellsWhichFibresAreMissing)
{
  const Substrate all;
  const auto domain = cactus::Domain::cube(2 * halfSide);
  cactus::FibreSurfaces outer = surfaces(all.outer);
  cactus::FibreSurfaces inner = surfaces(all.inner);
  outer.wantedIds = { 1, 2, 3, 4, 5, 8, 9 };
  auto certificate = cactus::certify(domain, outer, inner, nullptr);
  EXPECT_EQ(certificate.wantedFibres, 7u);
  EXPECT_EQ(certificate.withoutOuter, 2u);
  EXPECT_EQ(certificate.verdict(), "2 of 7 fibres have no outer surface (fibre 8 first)");
  EXPECT_EQ(certificate.fibres[5].fibreId, 8);
  EXPECT_FALSE(certificate.fibres[5].hasOuter);

  cactus::Fibres fibres;
  fibres.domain = domain;
  for (const double x : { 0.0, 1.0, 9.0 }) // the last one passes outside
  {
    fibres.addFibre(5 + static_cast<int>(x), 2, 0.1);
    fibres.addPoint({ x, 0.0, -3.0 }, 0.1);
    fibres.addPoint({ x, 0.0, 3.0 }, 0.1);
  }
  outer.wantedIds.clear();
  certificate = cactus::certify(domain, outer, inner, &fibres);
  EXPECT_EQ(certificate.verdict(), "1 of 6 fibres have no outer surface (fibre 6 first)");
  EXPECT_EQ(certificate.fibres[5].bundleId, 2);

  // A verdict is given even if all are lost; their fraction is 0.
  cactus::FibreSurfaces nothing;
  nothing.isGiven = true;
  nothing.wantedIds = { 1, 2 };
  certificate = cactus::certify(domain, nothing, nothing, nullptr);
  EXPECT_EQ(certificate.verdict(), "2 of 2 fibres have no outer surface (fibre 1 first)");
  EXPECT_EQ(certificate.fibreVolumeFraction, 0.0);
  EXPECT_EQ(certificate.aggregateGRatio, 0.0);
}

TEST(SubstrateCertificate, TellsMissingAxonsAndThinMyelin)
{
  Substrate some;
  some.inner.erase(2);
  const auto domain = cactus::Domain::cube(2 * halfSide);
  cactus::FibreSurfaces inner = surfaces(some.inner);
  auto certificate = cactus::certify(domain, surfaces(some.outer), inner, nullptr);
  EXPECT_TRUE(certificate.certified()) << certificate.verdict(); // myelin throughout
  EXPECT_EQ(certificate.withoutInner, 1u);
  inner.promisedGap = certificate.smallestMyelin;
  EXPECT_TRUE(cactus::certify(domain, surfaces(some.outer), inner, nullptr).certified());
  inner.promisedGap = 2.0 * certificate.smallestMyelin;
  certificate = cactus::certify(domain, surfaces(some.outer), inner, nullptr);
  EXPECT_GT(certificate.thinMyelin, 0u);
  EXPECT_NE(certificate.verdict().find("have myelin thinner than"), std::string::npos) << certificate.verdict();
}

TEST(SubstrateCertificate, AnAxonWithoutMyelinIsItsOuterSurface)
{
  Substrate some;
  some.inner[2] = some.outer[2];
  const auto domain = cactus::Domain::cube(2 * halfSide);
  cactus::FibreSurfaces inner = surfaces(some.inner);
  inner.promisedGap = 0.01;
  auto certificate = cactus::certify(domain, surfaces(some.outer), inner, nullptr);
  EXPECT_TRUE(certificate.certified()) << certificate.verdict();
  EXPECT_EQ(certificate.bare, 1u);
  EXPECT_EQ(certificate.fibres[1].gRatio, 1.0);
  EXPECT_TRUE(std::isnan(certificate.fibres[1].myelinThickness));
  // One that touches it in all but a point is none.
  some.inner[2].points[0] += Eigen::Vector3d(0.0, 0.0, 1e-9);
  certificate = cactus::certify(domain, surfaces(some.outer), surfaces(some.inner), nullptr);
  EXPECT_EQ(certificate.bare, 0u);
  EXPECT_EQ(certificate.leavingInner, 1u) << certificate.verdict();
}

// Damaged surfaces get a verdict or one clear error.
TEST(SubstrateCertificate, TakesWhatIsNoSurface)
{
  const TriangleMesh whole = tube(0.0, 0.0, 0.5, -1.0, 1.0);
  const auto verdictOf = [](const TriangleMesh& mesh)
  {
    try
    {
      return certified({ { 7, mesh } }, {}).verdict();
    }
    catch (const cactus::InvalidInput& error)
    {
      return std::string(error.what());
    }
  };
  const auto expect = [&](const TriangleMesh& mesh, const std::string& wanted)
  { EXPECT_NE(verdictOf(mesh).find(wanted), std::string::npos) << verdictOf(mesh); };
  const auto spoilt = [&](auto&& spoil)
  {
    TriangleMesh mesh = whole;
    spoil(mesh);
    return mesh;
  };
  expect(spoilt([](TriangleMesh& m) { m.points[3][0] = 1e40; }), "1e+40 µm from 0");
  expect(spoilt([](TriangleMesh& m) { m.points[3][0] = -1e300; }), "fibre 7");
  expect(spoilt([](TriangleMesh& m) { m.points[3][0] = std::numeric_limits<double>::infinity(); }), "not finite");
  expect(spoilt([](TriangleMesh& m) { m.triangles[5][1] = 100000; }), "uses point 100000");
  expect(spoilt([](TriangleMesh& m) { m.triangles[5][1] = -1; }), "uses point -1");
  expect(spoilt([](TriangleMesh& m) { m.triangles[5][1] = m.triangles[5][0]; }), "not closed");
  expect(spoilt([](TriangleMesh& m) { m.points[3] = m.points[4]; }), "cut or touch themselves");
  expect(spoilt([](TriangleMesh& m) { m.triangles.resize(1); }), "not closed");
  expect(spoilt([](TriangleMesh& m) { m.points.assign(m.points.size(), Eigen::Vector3d::Zero()); }), "cut or touch themselves");
  expect(TriangleMesh(), "not closed");
  cactus::SubstrateCertificateOptions options;
  for (const double value : { std::nan(""), std::numeric_limits<double>::infinity(), -0.5, 1e300 })
  {
    options.minimumGap = value;
    EXPECT_THROW(options.validate(), cactus::InvalidInput) << value;
    options.minimumGap = 0.0;
    options.cutSpacing = value;
    EXPECT_THROW(options.validate(), cactus::InvalidInput) << value;
    options.cutSpacing = 1.0;
  }
  options.validate();
  options.cutSpacing = 1e-9;
  EXPECT_THROW(options.validate(), cactus::InvalidInput);
}

// Gaps against all pairs of fibres, and the same bits on any number of threads.
TEST(SubstrateCertificate, GapsAreThoseOfAllPairsOnAnyNumberOfThreads)
{
  Meshes outer;
  for (int row = 0; row < 5; ++row)
  {
    for (int column = 0; column < 5; ++column)
    {
      const int id = 1 + 5 * row + column;
      outer[id] = tube(0.7 * (column - 2), 0.7 * (row - 2), 0.2 + 0.02 * (id % 5), -1.8, 1.8, 16, 12, 0.05, unsigned(id));
    }
  }
  std::map<int, double> gaps;
  for (const auto& one : outer)
  {
    gaps[one.first] = std::numeric_limits<double>::infinity();
    for (const auto& other : outer)
    {
      if (one.first != other.first)
      {
        const auto gap = cactus::smallestGap(cactus::TriangleTree(one.second), cactus::TriangleTree(other.second));
        gaps[one.first] = std::min(gaps[one.first], gap.distance);
      }
    }
  }
  const auto reference = certified(outer, {}, 0.0, 1);
  for (const auto& fibre : reference.fibres)
  {
    EXPECT_DOUBLE_EQ(fibre.gap, gaps[fibre.fibreId]);
  }
  for (const int threads : { 2, 4 })
  {
    const auto again = certified(outer, {}, 0.0, threads);
    const auto wanted = cactus::fibreColumns(reference);
    const auto found = cactus::fibreColumns(again);
    for (std::size_t c = 0; c < wanted.size(); ++c)
    {
      EXPECT_EQ(std::memcmp(wanted[c].values.data(), found[c].values.data(), wanted[c].values.size() * sizeof(double)), 0)
        << wanted[c].name;
    }
  }
}

// Pairs that are near each other across x, y, z and an edge, and far from all in the domain. By brute force over all images.
TEST(SubstrateCertificate, GapsReachAcrossPeriodicFaces)
{
  using example::box;
  const Meshes outer{ { 1, box({ -1.95, -1, -1 }, { -1.2, -0.2, -0.2 }) }, { 2, box({ 1.3, -1, -1 }, { 1.85, -0.2, -0.2 }) },
    { 3, box({ -0.5, -1.9, 0 }, { 0.5, -1.2, 0.6 }) }, { 4, box({ -0.5, 1.2, 0 }, { 0.5, 1.93, 0.6 }) },
    { 5, box({ 0.9, 0.2, -1.95 }, { 1.3, 0.8, -1.4 }) }, { 6, box({ 0.9, 0.2, 1.4 }, { 1.3, 0.8, 1.94 }) },
    { 7, box({ -1.9, -1.96, 1.2 }, { -1.3, -1.5, 1.7 }) }, { 8, box({ 1.4, 1.5, 1.2 }, { 1.93, 1.95, 1.7 }) } };
  cactus::Domain domain = cactus::Domain::cube(2 * halfSide);
  const auto inside = cactus::certify(domain, surfaces(outer), {}, nullptr);
  for (const std::array<bool, 3>& periodic : { std::array<bool, 3>{ { true, true, false } }, { { true, true, true } } })
  {
    domain.periodic = periodic;
    for (const int threads : { 1, 3 })
    {
      cactus::Context context;
      context.threads = threads;
      const auto certificate = cactus::certify(domain, surfaces(outer), {}, nullptr, {}, context);
      ASSERT_EQ(certificate.fibres.size(), outer.size());
      double smallest = 1e300;
      for (std::size_t f = 0; f < outer.size(); ++f)
      {
        const cactus::FibreCertificate& fibre = certificate.fibres[f];
        const cactus::TriangleTree own(outer.at(fibre.fibreId));
        std::map<double, int> nearest;
        for (const auto& [id, mesh] : outer)
        {
          for (int n = 0; n < 27 && id != fibre.fibreId; ++n)
          {
            TriangleMesh image = mesh;
            for (Eigen::Vector3d& point : image.points)
            {
              point += 2.0 * halfSide * Eigen::Vector3d(n % 3 - 1, n / 3 % 3 - 1, periodic[2] ? n / 9 - 1 : 0);
            }
            nearest.emplace(cactus::smallestGap(own, cactus::TriangleTree(image)).distance, id);
          }
        }
        EXPECT_NEAR(fibre.gap, nearest.begin()->first, 1e-12);
        EXPECT_EQ(fibre.nearestFibre, nearest.begin()->second);
        const bool isAlongZ = fibre.fibreId == 5 || fibre.fibreId == 6;
        EXPECT_EQ(fibre.gap < 0.5 * inside.fibres[f].gap, !isAlongZ || periodic[2]) << fibre.fibreId;
        smallest = std::min(smallest, nearest.begin()->first);
      }
      EXPECT_NEAR(certificate.smallestGap, smallest, 1e-12);
      EXPECT_EQ(certificate.meetingPairs, 0U);
    }
  }
}

TEST(SubstrateCertificate, FibresMeetAcrossPeriodicFaces)
{
  cactus::Domain domain = cactus::Domain::cube(2 * halfSide);
  const Meshes outer{ { 1, tube(-1.5, 0, 0.45, -1, 1) }, { 2, tube(1.5, 0, 0.47, -1, 1) } };
  EXPECT_NEAR(cactus::certify(domain, surfaces(outer), {}, nullptr).smallestGap, 2.08, 1e-9);
  domain.periodic = { { true, true, false } };
  cactus::SubstrateCertificateOptions options;
  options.minimumGap = 0.1;
  const auto near = cactus::certify(domain, surfaces(outer), {}, nullptr, options);
  EXPECT_NEAR(near.smallestGap, 0.08, 1e-9);
  expectFault(near, "as near as 0.08 µm");
  const Meshes meeting{ { 1, tube(-1.5, 0, 0.55, -1, 1) }, { 2, tube(1.5, 0, 0.47, -1, 1) } };
  expectFault(cactus::certify(domain, surfaces(meeting), {}, nullptr), "cut or touch each other");
}

// The findings of a killed run are not computed again.
TEST(SubstrateCertificate, LooksAtNothingThatIsKnown)
{
  Substrate substrate;
  substrate.outer[6] = tube(0.5, -1.2, 0.3, -halfSide, halfSide);
  substrate.outer[7] = tube(0.5, -1.2, 0.1, -1.0, 1.0); // inside the sixth
  cactus_testing::FindingsInMemory findings;
  const auto looks = [&](cactus::SubstrateCertificate& certificate)
  {
    std::size_t count = 0;
    const auto counted = [&](const Meshes& meshes)
    {
      cactus::FibreSurfaces all = surfaces(meshes);
      all.mesh = [&count, mesh = all.mesh](std::size_t i)
      {
        ++count;
        return mesh(i);
      };
      return all;
    };
    cactus::Context context;
    context.threads = 1;
    certificate = cactus::certify(cactus::Domain::cube(2 * halfSide), counted(substrate.outer), counted(substrate.inner), nullptr,
      {}, context, cactus::Sharing(), cactus::Recollection(findings).part("judged"));
    return count;
  };
  cactus::SubstrateCertificate wanted;
  EXPECT_EQ(looks(wanted), 12u);
  ASSERT_EQ(wanted.nestedPairs, 1u);
  const auto all = findings.kept;
  const auto expectSame = [&](const cactus::SubstrateCertificate& found)
  {
    EXPECT_EQ(found.faults, wanted.faults);
    const auto columns = cactus::fibreColumns(wanted);
    const auto same = cactus::fibreColumns(found);
    for (std::size_t c = 0; c < columns.size(); ++c)
    {
      EXPECT_EQ(std::memcmp(columns[c].values.data(), same[c].values.data(), columns[c].values.size() * sizeof(double)), 0)
        << columns[c].name;
    }
  };
  cactus::SubstrateCertificate found;
  for (const char* kept : { "judged/", "judged/fibres/", "judged/fibres/3", "judged/n", "" })
  {
    findings.kept = all;
    findings.beginAgain([&](const std::string& name) { return name.rfind(kept, 0) == 0; });
    const std::size_t looked = looks(found);
    expectSame(found);
    EXPECT_EQ(looked == 0, std::string("judged/").rfind(kept, 0) == 0) << kept;
    EXPECT_EQ(findings.kept.empty(), looked == 0) << kept;
  }
}

TEST(SubstrateCertificate, CanBeStopped)
{
  const Substrate sound;
  cactus::Context context;
  context.cancelled = [] { return true; };
  EXPECT_THROW(cactus::certify(cactus::Domain::cube(4), surfaces(sound.outer), surfaces(sound.inner), nullptr, {}, context),
    cactus::Cancelled);
}
