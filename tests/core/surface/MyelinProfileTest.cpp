// SPDX-License-Identifier: BSD-3-Clause
// Guarantees: places along a centre line change evenly and follow its images; nodes of Ranvier lie at equal distances, and fit a
// periodic domain; with MyelinFollowsAxon each cross-section has the g-ratio; in a node the fibre is as thick as the constricted
// axon and a wall, elsewhere as without nodes; axons swell by as much as asked or possible, with the same volumes and in the same
// outer surfaces; surfaces with nodes or swellings keep all guarantees, in periodic domains and on any number of
// threads.
#include "surface/MyelinProfile.h"

#include "BundleBetweenWalls.h"
#include "base/Constants.h"
#include "base/Error.h"
#include "bundle/Beads.h"
#include "bundle/BundleInitializer.h"
#include "fibres/TrimToDomain.h"
#include "growth/FibreRadialGrowth.h"
#include "growth/GrowthTarget.h"
#include "growth/TargetRadii.h"
#include "judge/FibreProfile.h"
#include "judge/SurfaceFaults.h"
#include "mesh/SurfaceDistance.h"
#include "mesh/SurfaceIntersection.h"
#include "optimiser/CapsuleOptimizer.h"
#include "surface/FibreLine.h"
#include "surface/MyelinSurface.h"
#include "surface/NodesOfRanvier.h"
#include "surface/SurfaceRemarks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>
#include <vector>

namespace
{

using namespace cactus;

/// Fibres, grown by `by` µm as they are.
struct GrownFibres
{
  std::shared_ptr<Fibres> fibres = std::make_shared<Fibres>();
  FibreRadialGrowthOptions growth;
  double by = 0.0;

  GrownFibres() { this->growth.surfaceRoughness = 0.0; }

  std::vector<FibreSurfacePair> surfaces(const MyelinSurfaceOptions& options, int threads = 0) const
  {
    const LabelImage image = growFibres(*this->fibres, this->growth, this->by, growthGrid(this->fibres->domain, this->growth));
    LabelImageFacts facts = labelImageFacts(*this->fibres, this->growth);
    facts.centreLines = this->fibres;
    Context context;
    context.threads = threads;
    return myelinSurfaces({ image.grid, image.fibreId.data(), image.depth.data(), this->growth.gap() }, facts, options, context);
  }
};

/// One fibre along z through a cube, whose radius is radiusAt(z).
template <typename Radius>
GrownFibres singleFibre(double side, double target, const Radius& radiusAt)
{
  GrownFibres grown;
  grown.fibres->domain = Domain::cube(side);
  grown.fibres->addFibre(1, 1, target);
  for (double z = -0.5 * side - 1.0; z < 0.5 * side + 1.05; z += 0.1)
  {
    grown.fibres->addPoint({ 0.013, 0.027, z }, radiusAt(z));
  }
  return grown;
}

MyelinSurfaceOptions withNodes(double internodeFactor)
{
  MyelinSurfaceOptions options;
  options.nodeLength = 1.0;
  options.paranodeLength = 1.0;
  options.internodeFactor = internodeFactor;
  return options;
}

/// Equivalent radii of a surface's cuts, by their places along the fibre.
std::vector<double> radiiOf(const Fibres& fibres, const TriangleMesh& mesh, double spacing)
{
  std::vector<double> radii;
  for (const FibreCut& cut : cutsAlongFibre(fibres, 0, mesh, spacing))
  {
    radii.resize(std::max(radii.size(), cut.number + 1), 0.0);
    radii[cut.number] = equivalentRadius(cut);
  }
  return radii;
}

/// Checks what the certificate asks of surfaces: nothing meets, axons lie in their fibres, fibres are `gap` apart.
void expectSound(std::vector<FibreSurfacePair> pairs, const Domain& domain, double gap)
{
  for (const FibreSurfacePair& pair : pairs)
  {
    EXPECT_FALSE(pair.isFlawed) << pair.fibreId;
    EXPECT_EQ(pair.state, MyelinState::AsAsked) << pair.fibreId;
    EXPECT_TRUE(pair.outerReport.sound() && pair.innerReport.sound()) << pair.fibreId;
  }
  markFaults(pairs, domain, gap, {});
  std::vector<TriangleTree> trees;
  trees.reserve(pairs.size());
  for (const FibreSurfacePair& pair : pairs)
  {
    EXPECT_FALSE(pair.isFlawed) << pair.fibreId << ", by the certificate's means";
    const TriangleTree& outer = trees.emplace_back(pair.outer);
    EXPECT_FALSE(surfacesMeet(TriangleTree(pair.inner), outer)) << pair.fibreId;
    for (std::size_t other = 0; other + 1 < trees.size(); ++other)
    {
      EXPECT_FALSE(smallestGap(outer, trees[other], gap).found()) << pair.fibreId << ' ' << pairs[other].fibreId;
    }
  }
}

TEST(FibreLine, PlacesChangeEvenlyBesideBends)
{
  Fibres fibres;
  fibres.domain = Domain::cube(10.0);
  fibres.addFibre(1, 1, 0.5);
  const double arc = 4.0; // radius of a circle's quarter in corners of 9°
  for (int i = 0; i <= 10; ++i)
  {
    const double angle = 0.05 * i * pi;
    fibres.addPoint({ arc * std::cos(angle), arc * std::sin(angle), 0.0 }, 0.5);
  }
  const FibreLine line(fibres, 0);
  const FibreLine::Near near = line.near({ Eigen::Vector3d(0, 0, -1), Eigen::Vector3d(5, 5, 1) });
  EXPECT_NEAR(line.length(), 0.5 * pi * arc, 0.01);
  for (const double radius : { 3.0, 4.0, 5.0 })
  {
    double before = 0.0;
    for (int i = 20; i <= 160; ++i) // the planes at its ends are across its last segments
    {
      const double angle = pi * i / 360.0;
      const LinePlace place = near.at({ radius * std::cos(angle), radius * std::sin(angle), 0.3 });
      EXPECT_NEAR(place.along, arc * angle, 0.02) << radius << ' ' << i;
      EXPECT_NEAR(place.along - before, i > 20 ? arc * pi / 360.0 : place.along, 0.006) << radius << ' ' << i;
      before = place.along;
    }
  }
  EXPECT_NEAR((line.point(1.0) - line.point(1.5)).norm(), 0.5, 0.01);
  EXPECT_NEAR(near.at({ 5.0, -1.0, 0.0 }).along, 0.0, 1e-12) << "before its first control point";
}

TEST(FibreLine, FindsTheNearestImage)
{
  Fibres fibres;
  fibres.domain = Domain::cube(4.0);
  fibres.domain.periodic = { { true, true, false } };
  fibres.addFibre(1, 1, 0.3);
  fibres.addPoint({ -1.0, 0.0, -3.0 }, 0.3);
  fibres.addPoint({ 5.0, 0.0, 3.0 }, 0.3); // leaves at x = 2, and is there again from -2 on
  const FibreLine line(fibres, 0);
  for (const double along : { 2.0, 4.0, 6.0 })
  {
    const Eigen::Vector3d point = line.point(along);
    const Eigen::Vector3d image = fibres.domain.inside(point);
    const LinePlace place = line.near({ image, image }).at(image);
    EXPECT_NEAR(place.along, along, 1e-9);
    EXPECT_NEAR(place.distance, 0.0, 1e-7);
  }
}

TEST(NodesOfRanvier, LieAtEqualDistances)
{
  MyelinSurfaceOptions options = withNodes(30.0);
  const NodesOfRanvier nodes(options, 7, 0.5, options.internodeLoss, 0.0);
  EXPECT_NEAR(nodes.spacing(), 16.0, 1e-12);
  const std::vector<double> middles = nodes.between(0.0, 160.0);
  ASSERT_EQ(middles.size(), 10u);
  for (const double middle : middles)
  {
    EXPECT_EQ(nodes.myelinPart(middle), 0.0);
    EXPECT_EQ(nodes.myelinPart(middle + 0.499), 0.0);
    EXPECT_NEAR(nodes.myelinPart(middle - 1.0), 0.5, 1e-9) << "in the middle of the paranode";
    EXPECT_EQ(nodes.myelinPart(middle + 1.501), 1.0);
    EXPECT_EQ(nodes.myelinPart(middle + 8.0), 1.0);
  }
  EXPECT_TRUE(nodes.reachInto(middles[2] + 1.4, middles[2] + 2.0));
  EXPECT_FALSE(nodes.reachInto(middles[2] + 1.6, middles[2] + 2.0));
  EXPECT_EQ(NodesOfRanvier(options, 7, 0.5, options.internodeLoss, 0.0).between(0.0, 160.0), middles);
  EXPECT_NE(NodesOfRanvier(options, 8, 0.5, options.internodeLoss, 0.0).between(0.0, 160.0), middles);
  options.nodeSeed = 2;
  EXPECT_NE(NodesOfRanvier(options, 7, 0.5, options.internodeLoss, 0.0).between(0.0, 160.0), middles);
  EXPECT_NEAR(NodesOfRanvier(options, 7, 0.01, options.internodeLoss, 0.0).spacing(), 5.0, 1e-12)
    << "an internode of four paranodes at least";
}

// Guarantee: with Thinnest first all internodes of thin fibres are taken before any of thicker ones, in all as many as asked for.
TEST(NodesOfRanvier, ALesionTakesThoseOfThinFibresFirst)
{
  Fibres fibres;
  fibres.domain = Domain::cube(40.0);
  for (const auto& [id, radius] : { std::pair(4, 0.6), std::pair(2, 0.3), std::pair(9, 0.4), std::pair(1, 0.2) })
  {
    fibres.addFibre(id, 1, radius);
    fibres.addPoint({ 0.0, 0.0, -20.0 }, radius);
    fibres.addPoint({ 0.0, 0.0, id == 9 ? 80.0 : 20.0 }, radius); // 40 µm of each are in the domain
  }
  fibres.columns.set(targetGRatioColumn.name, 3, bareGRatio);
  MyelinSurfaceOptions options = withNodes(30.0);
  const auto countOf = [&](std::size_t f) { return 40.0 / (1.0 + 60.0 * fibres.targetRadii[f]); };
  const double all = countOf(0) + countOf(1) + countOf(2);
  options.internodeLoss = 0.6;
  EXPECT_EQ(internodeLosses(fibres, options), std::vector<double>(4, 0.6));
  options.internodeOrder = InternodeOrder::ThinnestFirst;
  const std::vector<double> losses = internodeLosses(fibres, options);
  EXPECT_EQ(losses[1], 1.0);
  EXPECT_GT(losses[2], 0.0);
  EXPECT_LT(losses[2], 1.0);
  EXPECT_EQ(losses[0], 0.0);
  EXPECT_EQ(losses[3], 0.0) << "it has no myelin";
  EXPECT_NEAR(losses[1] * countOf(1) + losses[2] * countOf(2), 0.6 * all, 1e-9 * all);
  options.internodeLoss = 1.0;
  const std::vector<double> most = internodeLosses(fibres, options);
  EXPECT_NEAR(most[0], 1.0, 1e-12);
  EXPECT_EQ(most[3], 0.0);
}

// On average as many as in fibres that do not repeat.
TEST(NodesOfRanvier, AWholeNumberFitsAPeriod)
{
  const MyelinSurfaceOptions options = withNodes(30.0);
  double count = 0.0;
  const int fibres = 2000;
  for (int id = 1; id <= fibres; ++id)
  {
    const NodesOfRanvier nodes(options, id, 0.5, options.internodeLoss, 10.0);
    const double here = nodes.spacing() > 0.0 ? 10.0 / nodes.spacing() : 0.0;
    EXPECT_EQ(here, std::round(here));
    EXPECT_EQ(nodes.between(0.3, 10.3 - 1e-9).size(), std::size_t(here));
    count += here;
  }
  EXPECT_NEAR(count / fibres, 10.0 / 16.0, 0.04);
}

TEST(NodesOfRanvier, ALesionTakesInternodesAtRandom)
{
  MyelinSurfaceOptions options = withNodes(30.0);
  const auto statesOf = [&](double loss, double remyelinated, double period)
  {
    options.internodeLoss = loss;
    options.remyelinatedFraction = remyelinated;
    std::vector<Internode> states;
    for (int id = 1; id <= 100; ++id)
    {
      const NodesOfRanvier nodes(options, id, 0.5, options.internodeLoss, period);
      for (const double middle : nodes.between(-400.0, 400.0))
      {
        states.push_back(nodes.internodeAt(middle + 0.01));
        EXPECT_EQ(nodes.internodeAt(middle + nodes.spacing() - 0.01), states.back());
        EXPECT_TRUE(period == 0.0 || nodes.internodeAt(middle + 0.01 + 3.0 * period) == states.back());
      }
    }
    return states;
  };
  const auto part = [](const std::vector<Internode>& states, Internode state)
  { return double(std::count(states.begin(), states.end(), state)) / double(states.size()); };
  for (const double period : { 0.0, 50.0 })
  {
    EXPECT_EQ(part(statesOf(0.0, 1.0, period), Internode::Whole), 1.0);
    EXPECT_EQ(part(statesOf(1.0, 0.0, period), Internode::Lost), 1.0);
    const auto less = statesOf(0.3, 0.4, period);
    EXPECT_NEAR(part(less, Internode::Whole), 0.7, period > 0.0 ? 0.08 : 0.02);
    EXPECT_NEAR(part(less, Internode::Remyelinated), 0.12, period > 0.0 ? 0.06 : 0.015);
    const auto more = statesOf(0.5, 0.4, period);
    ASSERT_EQ(more.size(), less.size());
    for (std::size_t i = 0; i < less.size(); ++i)
    {
      EXPECT_TRUE(less[i] == Internode::Whole || more[i] == less[i]);
    }
  }
}

// The radius is between 0.5 and 0.9 µm.
TEST(MyelinProfile, EachCrossSectionHasTheGRatio)
{
  const GrownFibres grown = singleFibre(6.0, 0.7, [](double z) { return 0.7 + 0.2 * std::sin(2.0 * pi * z / 5.0); });
  MyelinSurfaceOptions options;
  options.decimationError = 0.0; // its errors count in the g-ratio of a cut
  for (const bool follows : { false, true })
  {
    options.myelinFollowsAxon = follows;
    const auto pairs = grown.surfaces(options);
    expectSound(pairs, grown.fibres->domain, grown.growth.minimumGap);
    EXPECT_NEAR(pairs[0].gRatio, 0.7, 0.001);
    const std::vector<double> outer = radiiOf(*grown.fibres, pairs[0].outer, 0.25);
    const std::vector<double> inner = radiiOf(*grown.fibres, pairs[0].inner, 0.25);
    double lowest = 1.0;
    double highest = 0.0;
    for (std::size_t i = 0; i < std::min(outer.size(), inner.size()); ++i)
    {
      const double g = outer[i] > 0.0 && inner[i] > 0.0 ? inner[i] / outer[i] : 0.7;
      lowest = std::min(lowest, g);
      highest = std::max(highest, g);
    }
    EXPECT_GT(*std::max_element(outer.begin(), outer.end()), 0.87);
    if (follows)
    {
      EXPECT_GT(lowest, 0.69);
      EXPECT_LT(highest, 0.71);
    }
    else
    {
      EXPECT_LT(lowest, 0.61);
      EXPECT_GT(highest, 0.75);
    }
  }
}

// Against the radii that the options state, and the volumes of the bodies with these radii.
TEST(MyelinProfile, AFibreComesDownToItsAxonInNodes)
{
  const double radius = 0.6;
  const double side = 11.0;
  const GrownFibres grown = singleFibre(side, radius, [&](double) { return radius; });
  MyelinSurfaceOptions options = withNodes(4.0);
  const auto whole = grown.surfaces(MyelinSurfaceOptions());
  const double wall = grown.growth.minimumGap + 4.0 * grown.growth.surfaceTolerance;
  for (const double constriction : { 1.0, 0.7 })
  {
    for (const bool follows : { false, true })
    {
      options.nodeConstriction = constriction;
      options.myelinFollowsAxon = follows;
      const auto pairs = grown.surfaces(options);
      expectSound(pairs, grown.fibres->domain, grown.growth.minimumGap);
      const FibreSurfacePair& pair = pairs[0];
      const NodesOfRanvier nodes(options, 1, 2.0 * radius, options.internodeLoss, 0.0);
      EXPECT_EQ(pair.nodes, int(nodes.between(1.0, side + 1.0).size())); // its line begins 1 µm outside
      EXPECT_GE(pair.nodes, 2);
      EXPECT_NEAR(pair.internodeLength, 4.8, 1e-9); // four diameters
      EXPECT_EQ(pair.targetGRatio, 0.7);
      const auto axonAt = [&](double along)
      { return 0.7 * radius * (1.0 - (1.0 - constriction) * (1.0 - nodes.myelinPart(along))); };
      const auto fibreAt = [&](double along)
      { return radius - (1.0 - nodes.myelinPart(along)) * (radius - axonAt(along) - wall); };
      const double spacing = 0.25;
      const std::vector<double> outer = radiiOf(*grown.fibres, pair.outer, spacing);
      const std::vector<double> inner = radiiOf(*grown.fibres, pair.inner, spacing);
      for (std::size_t i = 0; i < std::min(outer.size(), inner.size()); ++i)
      {
        const double along = (double(i) + 0.5) * spacing;
        EXPECT_TRUE(outer[i] == 0.0 || std::abs(outer[i] - fibreAt(along)) < 0.02) << outer[i] << ' ' << fibreAt(along);
        EXPECT_TRUE(inner[i] == 0.0 || std::abs(inner[i] - axonAt(along)) < 0.02) << inner[i] << ' ' << axonAt(along);
      }
      double fibreVolume = 0.0;
      double axonVolume = 0.0;
      const double step = 0.01;
      for (double z = 0.5 * step; z < side; z += step)
      {
        fibreVolume += step * pi * std::pow(fibreAt(1.0 + z), 2);
        axonVolume += step * pi * std::pow(axonAt(1.0 + z), 2);
      }
      EXPECT_NEAR(pair.outerReport.volume, fibreVolume, 0.015 * fibreVolume);
      EXPECT_NEAR(pair.innerReport.volume, axonVolume, 0.015 * axonVolume);
      const double myelin = whole[0].outerReport.volume - whole[0].innerReport.volume;
      EXPECT_NEAR(pair.lostMyelin(), 1.0 - (pair.outerReport.volume - pair.innerReport.volume) / myelin, 0.005);
      EXPECT_GT(pair.lostMyelin(), 0.2);
    }
  }
}

// Against radii that the options state. Axons are those of the fibre without a lesion, bit for bit.
TEST(MyelinProfile, MyelinIsThinnerWhereALesionTookIt)
{
  const double radius = 0.6;
  const double side = 11.0;
  const GrownFibres grown = singleFibre(side, radius, [&](double) { return radius; });
  MyelinSurfaceOptions options = withNodes(4.0);
  const auto healthy = grown.surfaces(options);
  options.internodeLoss = 0.7;
  options.remyelinatedFraction = 0.5;
  options.remyelinatedGRatio = 0.85;
  const double wall = grown.growth.minimumGap + 4.0 * grown.growth.surfaceTolerance;
  const double spacing = 0.25;
  std::set<Internode> seen;
  for (options.nodeSeed = 1; options.nodeSeed <= 4; ++options.nodeSeed)
  {
    const auto pairs = grown.surfaces(options);
    expectSound(pairs, grown.fibres->domain, grown.growth.minimumGap);
    const FibreSurfacePair& pair = pairs[0];
    if (options.nodeSeed == 1)
    {
      EXPECT_TRUE(pair.inner.points == healthy[0].inner.points && pair.inner.triangles == healthy[0].inner.triangles);
      EXPECT_GT(pair.lostMyelin(), healthy[0].lostMyelin());
    }
    const NodesOfRanvier nodes(options, 1, 2.0 * radius, options.internodeLoss, 0.0);
    const std::vector<double> outer = radiiOf(*grown.fibres, pair.outer, spacing);
    for (std::size_t i = 0; i < outer.size(); ++i)
    {
      const double along = (double(i) + 0.5) * spacing;
      if (outer[i] == 0.0 || nodes.myelinPart(along) < 1.0)
      {
        continue;
      }
      const Internode state = nodes.internodeAt(along);
      seen.insert(state);
      const double axon = 0.7 * radius;
      const double right = state == Internode::Whole ? radius : state == Internode::Lost ? axon + wall : axon / 0.85;
      EXPECT_NEAR(outer[i], right, 0.02) << along << ' ' << int(state);
    }
  }
  EXPECT_EQ(seen.size(), 3u);

  options.internodeFactor = 500.0;
  options.internodeLoss = 1.0;
  options.remyelinatedFraction = 0.0;
  const auto bare = grown.surfaces(options); // within one internode
  expectSound(bare, grown.fibres->domain, grown.growth.minimumGap);
  EXPECT_EQ(bare[0].nodes, 0);
  EXPECT_EQ(bare[0].internodeLength, 0.0);
  EXPECT_NEAR(bare[0].outerReport.volume / (pi * std::pow(0.7 * radius + wall, 2) * side), 1.0, 0.05);
}

// Along z the fraction falls from 1 to 0, stays there, and rises to 1 again.
TEST(MyelinProfile, MyelinIsAsThickAsTheFibresSay)
{
  const double radius = 0.6;
  const double side = 11.0;
  const GrownFibres grown = singleFibre(side, radius, [&](double) { return radius; });
  const auto whole = grown.surfaces({});
  Fibres& fibres = *grown.fibres;
  const auto fractionAt = [](double z) { return std::clamp((std::abs(z) - 1.0) / 2.0, 0.0, 1.0); };
  for (const Eigen::Vector3d& point : fibres.points)
  {
    fibres.myelinFractions.push_back(fractionAt(point.z()));
  }
  const double wall = grown.growth.minimumGap + 4.0 * grown.growth.surfaceTolerance;
  const auto pairs = grown.surfaces({});
  expectSound(pairs, fibres.domain, grown.growth.minimumGap);
  EXPECT_EQ(pairs[0].nodes, 0);
  EXPECT_GT(pairs[0].lostMyelin(), 0.2);
  EXPECT_NEAR(pairs[0].innerReport.volume, whole[0].innerReport.volume, 5e-3 * whole[0].innerReport.volume);
  const double spacing = 0.25;
  const std::vector<double> outer = radiiOf(fibres, pairs[0].outer, spacing);
  const double first = fibres.points.front().z();
  for (std::size_t i = 0; i < outer.size(); ++i)
  {
    const double left = fractionAt(first + (double(i) + 0.5) * spacing);
    const double axon = 0.7 * radius;
    EXPECT_TRUE(outer[i] == 0.0 || std::abs(outer[i] - (axon + wall + left * (radius - axon - wall))) < 0.03)
      << i << ' ' << outer[i];
  }
  std::fill(fibres.myelinFractions.begin(), fibres.myelinFractions.end(), 1.0);
  EXPECT_TRUE(grown.surfaces({})[0].outer.points == whole[0].outer.points) << "nothing is lost";

  MyelinSurfaceOptions options;
  options.model = GRatioModel::TargetAxonVolumeFraction;
  options.targetAxonVolumeFraction = 0.01;
  EXPECT_THROW(grown.surfaces(options), InvalidInput);
}

/// A bundle with nodes every few µm, optimised and grown.
GrownFibres bundleWithNodes()
{
  BundleBetweenWalls bundle;
  bundle.side = 6.0;
  bundle.meanDispersion = 10.0;
  GrownFibres grown;
  *grown.fibres = initialiseBundles(bundle);
  optimise(*grown.fibres, {}, {});
  grown.growth.targetFibreVolumeFraction = 0.85;
  *grown.fibres = aimAtTargetRadii(trimToDomain(*grown.fibres), grown.growth);
  grown.by = growthFor(*grown.fibres, grown.growth).growth;
  return grown;
}

void expectSameSurfaces(const std::vector<FibreSurfacePair>& pairs, const std::vector<FibreSurfacePair>& again)
{
  ASSERT_EQ(pairs.size(), again.size());
  for (std::size_t i = 0; i < pairs.size(); ++i)
  {
    EXPECT_TRUE(pairs[i].outer.points == again[i].outer.points && pairs[i].outer.triangles == again[i].outer.triangles);
    EXPECT_TRUE(pairs[i].inner.points == again[i].inner.points && pairs[i].inner.triangles == again[i].inner.triangles);
  }
}

TEST(MyelinProfile, ABundleWithNodesIsSound)
{
  const GrownFibres grown = bundleWithNodes();
  MyelinSurfaceOptions options = withNodes(3.0);
  options.myelinFollowsAxon = true;
  const auto pairs = grown.surfaces(options, 2);
  expectSound(pairs, grown.fibres->domain, grown.growth.minimumGap);
  int nodes = 0;
  for (const FibreSurfacePair& pair : pairs)
  {
    nodes += pair.nodes;
  }
  EXPECT_GT(nodes, int(pairs.size()) / 2);
  expectSameSurfaces(pairs, grown.surfaces(options, 1));
}

/// Checks that axons with swellings lie in the same outer surfaces, and have the same volumes.
void expectTwins(const std::vector<FibreSurfacePair>& healthy, const std::vector<FibreSurfacePair>& swollen)
{
  ASSERT_EQ(healthy.size(), swollen.size());
  for (std::size_t i = 0; i < healthy.size(); ++i)
  {
    EXPECT_TRUE(healthy[i].outer.points == swollen[i].outer.points && healthy[i].outer.triangles == swollen[i].outer.triangles);
    EXPECT_FALSE(healthy[i].inner.points == swollen[i].inner.points);
    EXPECT_NEAR(swollen[i].innerReport.volume, healthy[i].innerReport.volume, 0.003 * healthy[i].innerReport.volume);
  }
}

// Against the radii that the options state, whether myelin is equally thick or not.
TEST(MyelinProfile, AxonsSwellInsideTheSameFibres)
{
  const double side = 14.0;
  const auto radiusAt = [](double z) { return 0.6 + 0.06 * std::sin(2.0 * pi * z / 9.0); };
  const GrownFibres grown = singleFibre(side, 0.6, radiusAt);
  MyelinSurfaceOptions options;
  const double half = 0.5 * side + 1.0; // of the line, which begins 1 µm outside
  for (const bool follows : { false, true })
  {
    options.myelinFollowsAxon = follows;
    options.swellingAmplitude = 0.0;
    const auto healthy = grown.surfaces(options);
    const std::vector<double> before = radiiOf(*grown.fibres, healthy[0].inner, 0.25);
    for (const double amplitude : { 0.15, 0.3 })
    {
      options.swellingAmplitude = amplitude;
      const auto swollen = grown.surfaces(options);
      expectSound(swollen, grown.fibres->domain, grown.growth.minimumGap);
      expectTwins(healthy, swollen);
      EXPECT_EQ(remarkOnSwellings(swollen, labelImageFacts(*grown.fibres, grown.growth), options), "");
      const BeadShape shape = options.swellings();
      const Beads beads(shape, options.seed, 1, half, false, RandomStage::Swellings);
      const auto shapeAt = [&](std::size_t i)
      { return 1.0 + shape.heightOf(amplitude) * beads.at((double(i) + 0.5) * 0.25 - half); };
      const std::vector<double> radii = radiiOf(*grown.fibres, swollen[0].inner, 0.25);
      ASSERT_EQ(radii.size(), before.size());
      double mean = 0.0;
      double count = 0.0;
      for (std::size_t i = 0; i < radii.size(); ++i)
      {
        const bool isWhole = radii[i] > 0.0 && before[i] > 0.0;
        mean += isWhole ? std::pow(shapeAt(i), 2) : 0.0;
        count += isWhole ? 1.0 : 0.0;
      }
      ASSERT_GT(count, 40.0);
      for (std::size_t i = 0; i < radii.size(); ++i)
      {
        const double asked = before[i] * shapeAt(i) / std::sqrt(mean / count);
        EXPECT_TRUE(radii[i] == 0.0 || before[i] == 0.0 || std::abs(radii[i] - asked) < 0.02) << radii[i] << ' ' << asked;
      }
    }
  }
}

TEST(MyelinProfile, SwellingsEndAtTheMyelinsLeastThickness)
{
  const GrownFibres grown = singleFibre(14.0, 0.6, [](double) { return 0.6; });
  const auto healthy = grown.surfaces({});
  MyelinSurfaceOptions options;
  options.swellingAmplitude = 0.8;
  const auto swollen = grown.surfaces(options);
  expectSound(swollen, grown.fibres->domain, grown.growth.minimumGap);
  expectTwins(healthy, swollen);
  const std::vector<double> radii = radiiOf(*grown.fibres, swollen[0].inner, 0.25);
  const double most = *std::max_element(radii.begin(), radii.end());
  EXPECT_GT(most, 0.54);
  EXPECT_LT(most, 0.6 - grown.growth.minimumGap);
  EXPECT_EQ(remarkOnSwellings(swollen, labelImageFacts(*grown.fibres, grown.growth), options)
              .find("1 of 1 axons with myelin swell by less than SwellingAmplitude 0.8"),
    0u);
}

// Lost myelin lets the outer surface come down to the axon, which swells as far as in the whole fibre.
TEST(MyelinProfile, LostMyelinDoesNotLimitSwellings)
{
  const GrownFibres grown = singleFibre(14.0, 0.6, [](double) { return 0.6; });
  MyelinSurfaceOptions options = withNodes(6.0);
  options.internodeLoss = 1.0;
  options.swellingAmplitude = 0.2;
  const auto swollen = grown.surfaces(options);
  expectSound(swollen, grown.fibres->domain, grown.growth.minimumGap);
  EXPECT_GT(swollen[0].gRatio, 0.8);
  EXPECT_EQ(remarkOnSwellings(swollen, labelImageFacts(*grown.fibres, grown.growth), options), "");
}

TEST(MyelinProfile, ABundleWithSwellingsIsSoundAndATwin)
{
  const GrownFibres grown = bundleWithNodes();
  MyelinSurfaceOptions options;
  options.swellingAmplitude = 0.4;
  options.swellingSpacing = 3.0;
  options.swellingLength = 1.0;
  const auto swollen = grown.surfaces(options, 2);
  expectSound(swollen, grown.fibres->domain, grown.growth.minimumGap);
  expectTwins(grown.surfaces({}), swollen);
  expectSameSurfaces(swollen, grown.surfaces(options, 1));
}

TEST(MyelinProfile, WhatCannotBeMadeIsRefused)
{
  GrownFibres grown = singleFibre(4.0, 0.5, [](double) { return 0.5; });
  MyelinSurfaceOptions options = withNodes(4.0);
  options.model = GRatioModel::TargetAxonVolumeFraction;
  options.targetAxonVolumeFraction = 0.01;
  EXPECT_THROW(grown.surfaces(options), InvalidInput);
  options = withNodes(4.0);
  options.nodeLength = 0.3;
  grown.growth.voxelSize = 0.2;
  EXPECT_THROW(grown.surfaces(options), InvalidInput) << "voxels too coarse for the nodes";
  grown.growth.voxelSize = 0.1;
  const LabelImage image = growFibres(*grown.fibres, grown.growth, 0.0, growthGrid(grown.fibres->domain, grown.growth));
  const LabelImageFacts facts = labelImageFacts(*grown.fibres, grown.growth);
  options = MyelinSurfaceOptions();
  options.myelinFollowsAxon = true;
  EXPECT_THROW(
    myelinSurfaces({ image.grid, image.fibreId.data(), image.depth.data(), grown.growth.gap() }, facts, options), InvalidInput)
    << "no centre lines";
  options = MyelinSurfaceOptions();
  options.swellingAmplitude = 0.5;
  options.swellingSpacing = 2.0;
  EXPECT_THROW(grown.surfaces(options), InvalidInput) << "swellings that run into each other";
  options.swellingSpacing = 5.0;
  grown.growth.voxelSize = 0.26;
  EXPECT_THROW(grown.surfaces(options), InvalidInput) << "voxels too coarse for swellings";
}

} // namespace
