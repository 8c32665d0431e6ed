// SPDX-License-Identifier: BSD-3-Clause
// Guarantees: thin fibres keep their shape; models give the g-ratios that they state; fibres are the gap apart, and myelin as
// thick, even if growth left less, voxels are coarse or nothing is coarsened; deviations are counted.
#include "surface/MyelinSurface.h"
#include "BundleBetweenWalls.h"
#include "ThreadTeam.h"
#include "base/Bytes.h"
#include "base/Constants.h"
#include "base/Error.h"
#include "bundle/BundleInitializer.h"
#include "fibres/TrimToDomain.h"
#include "growth/FibreRadialGrowth.h"
#include "growth/GrowthTarget.h"
#include "growth/TargetRadii.h"
#include "judge/SurfaceFaults.h"
#include "mesh/SurfaceDistance.h"
#include "mesh/SurfaceIntersection.h"
#include "mesh/SurfaceSide.h"
#include "optimiser/CapsuleOptimizer.h"
#include "surface/FibreField.h"
#include "surface/FibreMesher.h"
#include "surface/GRatio.h"
#include "surface/MeetingFibres.h"
#include "surface/SurfaceFinishing.h"
#include "surface/SurfaceMaker.h"
#include "surface/SurfaceRemarks.h"
#include "surface/VanishingFibre.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace
{

using namespace cactus;

/// A straight fibre of 0.6 µm along z through a cube of 3 µm, grown as by default.
struct StraightFibre
{
  LabelImageFacts facts;
  LabelImage image;
  double gap = 0.0;

  StraightFibre()
  {
    FibreRadialGrowthOptions options;
    options.surfaceRoughness = 0.1;
    Fibres fibres;
    fibres.domain = Domain::cube(3.0);
    fibres.addFibre(1, 1, 0.6);
    fibres.addPoint({ 0.0, 0.0, -2.0 }, 0.6);
    fibres.addPoint({ 0.0, 0.0, 2.0 }, 0.6);
    image = growFibres(fibres, options, 0.0, growthGrid(fibres.domain, options));
    gap = options.gap();
    facts.domain = fibres.domain;
    facts.fibreIds = facts.bundleIds = { 1 };
    facts.targetRadii = { 0.6 };
    facts.minimumGap = options.minimumGap;
    facts.surfaceTolerance = options.surfaceTolerance;
  }
  std::shared_ptr<LabelImageInMemory> source() const
  {
    return std::make_shared<LabelImageInMemory>(LabelImageView{ image.grid, image.fibreId.data(), image.depth.data(), gap });
  }
};

/// Moves points towards the axis of a StraightFibre near where the x axis is at `x`, by at most `by` (µm).
void pushIn(TriangleMesh& mesh, double x, double by)
{
  for (Eigen::Vector3d& p : mesh.points)
  {
    const double distance = (p - Eigen::Vector3d(x, 0.0, 0.0)).norm();
    p[0] -= distance < 0.4 ? by * (1.0 - distance / 0.4) : 0.0;
  }
}

TEST(FibreMesher, OuterSurfacesLieAsMuchDeeperAsWanted)
{
  const StraightFibre fibre;
  for (const int smoothing : { 0, 3 })
  {
    for (const double error : { 0.0, 0.0075 })
    {
      MyelinSurfaceOptions options;
      options.smoothingIterations = smoothing;
      options.decimationError = error;
      const FibreMesher mesher(fibre.source(), fibre.facts, options);
      const SmoothedField field = mesher.smoothed(1);
      std::vector<double> radii;
      for (const double deeper : { 0.0, 0.005, 0.01 })
      {
        FibreSurfacePair pair;
        pair.fibreId = 1;
        mesher.makeOuter(field, pair, {}, deeper);
        radii.push_back(std::sqrt(pair.outerReport.volume / (pi * 3.0)));
      }
      EXPECT_NEAR(radii[0] - radii[1], 0.005, 2e-4) << smoothing << " " << error;
      EXPECT_NEAR(radii[0] - radii[2], 0.01, 4e-4) << smoothing << " " << error;
    }
  }
}

// Like a sliver of a fibre that met itself when it was moved and is made again, deeper.
TEST(FibreMesher, NothingStaysOfAnOuterSurfaceWhereThereIsNoneSoDeep)
{
  const StraightFibre fibre;
  const MyelinSurfaceOptions options;
  const FibreMesher mesher(fibre.source(), fibre.facts, options);
  const SmoothedField field = mesher.smoothed(1);
  FibreSurfacePair pair;
  pair.fibreId = 1;
  mesher.makeOuter(field, pair);
  ASSERT_EQ(pair.state, MyelinState::NoAxon);
  mesher.makeOuter(field, pair, {}, 0.7);
  EXPECT_EQ(pair.state, MyelinState::NoFibre);
  EXPECT_TRUE(pair.outer.triangles.empty());
  EXPECT_EQ(pair.outerReport.triangles, 0u);
}

/// A StraightFibre and its outer surface, coarsened so little that its wall has points to move.
struct FineSurface
{
  const StraightFibre fibre;
  MyelinSurfaceOptions options;
  const FibreMesher mesher;
  const SmoothedField field;
  FibreSurfacePair pair;

  FineSurface()
    : options(fineOptions())
    , mesher(fibre.source(), fibre.facts, options)
    , field(mesher.smoothed(1))
  {
    pair.fibreId = 1;
    pair.targetGRatio = 0.7;
    mesher.makeOuter(field, pair);
  }

private:
  static MyelinSurfaceOptions fineOptions()
  {
    MyelinSurfaceOptions fine;
    fine.decimationError = 0.0005;
    return fine;
  }
};

TEST(FibreMesher, AxonStaysInsideASurfaceThatWasPushedIn)
{
  FineSurface fine;
  const FibreMesher& mesher = fine.mesher;
  const SmoothedField& field = fine.field;
  FibreSurfacePair& pair = fine.pair;
  mesher.makeInner(field, pair);
  EXPECT_EQ(pair.state, MyelinState::AsAsked);
  const double volume = pair.innerReport.volume;
  pushIn(pair.outer, 0.6, 0.25); // through the myelin, 0.18 µm thick
  EXPECT_FALSE(meetingTriangles(TriangleTree(pair.inner), TriangleTree(pair.outer)).empty());
  EXPECT_TRUE(mesher.checkOuter(pair).empty());
  mesher.makeInner(field, pair);
  EXPECT_EQ(pair.state, MyelinState::Thicker);
  EXPECT_TRUE(meetingTriangles(TriangleTree(pair.inner), TriangleTree(pair.outer)).empty());
  EXPECT_FALSE(pair.isFlawed);
  EXPECT_LT(pair.innerReport.volume, volume);
  EXPECT_GT(pair.innerReport.volume, 0.5 * volume);
  // If it is pushed in to its middle, the fibre has no room for an axon, and gets none.
  pushIn(pair.outer, 0.35, 0.8);
  mesher.makeInner(field, pair);
  EXPECT_EQ(pair.state, MyelinState::NoAxon);
  EXPECT_TRUE(pair.inner.triangles.empty());
}

TEST(FibreMesher, AnInnerSurfaceStaysWhereTheOuterOneIsMovedALittle)
{
  FineSurface fine;
  const FibreMesher& mesher = fine.mesher;
  const SmoothedField& field = fine.field;
  FibreSurfacePair& made = fine.pair;
  made.volumeAsMade = made.outerReport.volume;
  mesher.makeInner(field, made);
  ASSERT_EQ(made.state, MyelinState::AsAsked);
  for (const double by : { 0.0005, 0.25 })
  {
    FibreSurfacePair pushed = made;
    pushIn(pushed.outer, 0.6, by);
    EXPECT_TRUE(mesher.checkOuter(pushed).empty());
    EXPECT_LT(pushed.outerReport.volume, made.outerReport.volume);
    FibreSurfacePair kept = pushed;
    EXPECT_EQ(mesher.keepsInner(kept), by < 0.1);
    // Making it anew for the present outer surface gives the same, or what there is room for.
    mesher.makeInner(field, pushed);
    EXPECT_EQ(pushed.inner.points == made.inner.points && pushed.inner.triangles == made.inner.triangles, by < 0.1);
    if (by < 0.1)
    {
      EXPECT_EQ(kept.gRatio, pushed.gRatio);
      EXPECT_EQ(kept.thickness, pushed.thickness);
      EXPECT_EQ(kept.state, pushed.state);
      EXPECT_GT(kept.gRatio, made.gRatio);
    }
    else
    {
      // The outer surface determines its place, even if that goes back a little.
      EXPECT_EQ(pushed.state, MyelinState::Thicker);
      EXPECT_FALSE(mesher.keepsInner(pushed));
    }
  }
  // A fibre that has become thinner all around gets a thinner axon.
  FibreSurfacePair thinner = made;
  for (Eigen::Vector3d& p : thinner.outer.points)
  {
    p.head<2>() *= 0.997;
  }
  EXPECT_TRUE(mesher.checkOuter(thinner).empty());
  EXPECT_FALSE(mesher.keepsInner(thinner));
  mesher.makeInner(field, thinner);
  EXPECT_NEAR(thinner.gRatio, 0.7, 5e-4);
  EXPECT_LT(thinner.innerReport.volume, 0.996 * made.innerReport.volume);
}

TEST(FibreMesher, SplitsNeedlesThatMovingHasMade)
{
  FineSurface fine;
  const FibreMesher& mesher = fine.mesher;
  FibreSurfacePair& pair = fine.pair;
  // A point away from the caps is moved next to another one.
  const auto isInside = [&](std::int32_t p) { return std::abs(pair.outer.points[std::size_t(p)].z()) < 0.5; };
  const auto found = std::find_if(pair.outer.triangles.begin(), pair.outer.triangles.end(),
    [&](const auto& t) { return std::all_of(t.begin(), t.end(), isInside); });
  ASSERT_NE(found, pair.outer.triangles.end());
  const Eigen::Vector3d& target = pair.outer.points[std::size_t((*found)[1])];
  Eigen::Vector3d& moved = pair.outer.points[std::size_t((*found)[0])];
  moved = target + 0.005 * (moved - target).normalized();
  EXPECT_GT(checkSurface(pair.outer).largestSquaredEdgeRatio, 1000.0);
  mesher.checkOuter(pair);
  EXPECT_LE(pair.outerReport.largestSquaredEdgeRatio, 800.0);
  EXPECT_LE(checkSurface(pair.outer).largestSquaredEdgeRatio, 800.0);
  EXPECT_TRUE(pair.outerReport.closedManifold() && pair.outerReport.outward());
}

TEST(FibreMesher, NormalsOfVerticesStandForWallsAndCaps)
{
  const StraightFibre fibre;
  for (const double error : { 0.0, 0.0075 })
  {
    const double largest = error > 0.0 ? 75.0 : 80.0; // of the small triangles of a contour not all can be helped
    MyelinSurfaceOptions options;
    options.decimationError = error;
    const FibreMesher mesher(fibre.source(), fibre.facts, options);
    const SmoothedField field = mesher.smoothed(1);
    FibreSurfacePair pair;
    pair.fibreId = 1;
    pair.targetGRatio = 0.7;
    mesher.makeOuter(field, pair);
    mesher.makeInner(field, pair);
    EXPECT_LT(checkSurface(pair.outer).largestNormalAngle, largest) << error;
    EXPECT_LT(checkSurface(pair.inner).largestNormalAngle, largest) << error;
    EXPECT_EQ(pair.outerReport.largestNormalAngle, checkSurface(pair.outer).largestNormalAngle);
    // And where a surface was moved, so that its triangles weigh otherwise.
    for (Eigen::Vector3d& p : pair.outer.points)
    {
      p.x() *= std::abs(p.z()) < 1.5 ? 1.0 : 0.98;
    }
    mesher.checkOuter(pair);
    EXPECT_LT(checkSurface(pair.outer).largestNormalAngle, largest) << error;
    EXPECT_TRUE(pair.outerReport.sound());
  }
}

TEST(GRatio, LogLinearSolvesItsRelation)
{
  for (const double outer : { 1.0, 1.7, 3.0, 8.0 })
  {
    const double inner = logLinearGRatio(outer) * outer;
    EXPECT_NEAR(inner + 2.0 * (0.35 + 0.006 * inner + 0.024 * std::log(inner)), outer, 1e-9);
  }
  EXPECT_EQ(logLinearGRatio(0.5), smallestGRatio);
  EXPECT_EQ(logLinearGRatio(1e3), largestGRatio);
  EXPECT_THROW(logLinearGRatio(0.0), InvalidInput);
  EXPECT_THROW(logLinearGRatio(std::nan("")), InvalidInput);
}

TEST(GRatio, DistributedHasItsMeanAndDeviationAndDependsOnSeedAndFibre)
{
  double sum = 0.0;
  double squares = 0.0;
  const int count = 20000;
  for (int fibre = 1; fibre <= count; ++fibre)
  {
    const double g = distributedGRatio(0.7, 0.05, 3, fibre);
    EXPECT_GE(g, smallestGRatio);
    EXPECT_LE(g, largestGRatio);
    sum += g;
    squares += g * g;
  }
  EXPECT_NEAR(sum / count, 0.7, 0.002);
  EXPECT_NEAR(std::sqrt(squares / count - sum * sum / count / count), 0.05, 0.002);
  EXPECT_EQ(distributedGRatio(0.7, 0.05, 3, 17), distributedGRatio(0.7, 0.05, 3, 17));
  EXPECT_NE(distributedGRatio(0.7, 0.05, 3, 17), distributedGRatio(0.7, 0.05, 4, 17));
  EXPECT_NE(distributedGRatio(0.7, 0.05, 3, 17), distributedGRatio(0.7, 0.05, 3, 18));
  EXPECT_EQ(distributedGRatio(0.6, 0.0, 1, 1), 0.6);
  EXPECT_THROW(distributedGRatio(0.2, 0.05, 1, 1), InvalidInput);
  EXPECT_THROW(distributedGRatio(0.7, -0.1, 1, 1), InvalidInput);
}

/// Returns the surfaces of fibres after this growth, kept `gap` apart.
std::vector<FibreSurfacePair> surfacesOf(const Fibres& fibres, const FibreRadialGrowthOptions& growth, double by, double gap)
{
  const LabelImage image = growFibres(fibres, growth, by, growthGrid(fibres.domain, growth));
  LabelImageFacts facts = labelImageFacts(fibres, growth);
  facts.minimumGap = gap;
  return myelinSurfaces({ image.grid, image.fibreId.data(), image.depth.data(), growth.gap() }, facts, MyelinSurfaceOptions());
}

TEST(MyelinSurfaces, ThinFibresKeepTheirVolumeAndHaveAnAxon)
{
  // Alone in its cube, with two voxels on either side of its axis.
  const double radius = 0.2;
  const double slope = 0.3;
  Fibres fibres;
  fibres.domain = Domain::cube(4.0);
  fibres.addFibre(1, 1, radius);
  fibres.addPoint({ -3.0 * slope + 0.013, 0.027, -3.0 }, radius);
  fibres.addPoint({ 3.0 * slope + 0.013, 0.027, 3.0 }, radius);
  FibreRadialGrowthOptions growth;
  growth.surfaceRoughness = 0.0;
  const auto pairs = surfacesOf(fibres, growth, 0.0, growth.minimumGap);
  ASSERT_EQ(pairs.size(), 1u);
  EXPECT_EQ(pairs[0].state, MyelinState::AsAsked);
  const double volume = 4.0 * std::sqrt(1.0 + slope * slope) * cactus::pi * radius * radius;
  EXPECT_NEAR(pairs[0].outerReport.volume, volume, 0.05 * volume);
  EXPECT_NEAR(pairs[0].innerReport.volume, 0.49 * pairs[0].outerReport.volume, 0.002 * volume);
}

/// A bundle that is tight after growth, and its growth.
struct TightBundle
{
  FibreRadialGrowthOptions growth;
  Fibres fibres;
  double by = 0.0;

  explicit TightBundle(double side = 8.0, std::uint64_t seed = 1)
  {
    BundleBetweenWalls bundle;
    bundle.side = side;
    bundle.meanDispersion = 10.0;
    bundle.seed = seed;
    fibres = initialiseBundles(bundle);
    optimise(fibres, {}, {});
    growth.targetFibreVolumeFraction = 0.93;
    growth.surfaceRoughness = 0.1;
    fibres = aimAtTargetRadii(trimToDomain(fibres), growth);
    by = growthFor(fibres, growth).growth;
  }
};

// Surfaces are moved by much more than the coarsening error; some fold, and are made again.
TEST(MyelinSurfaces, PartsFibresThatGrowthLeftTooNear)
{
  const TightBundle bundle(8.0, 3);
  const auto pairs = surfacesOf(bundle.fibres, bundle.growth, bundle.by, 0.06);
  for (std::size_t i = 0; i < pairs.size(); ++i)
  {
    EXPECT_FALSE(pairs[i].isFlawed) << pairs[i].fibreId;
    const TriangleTree tree(pairs[i].outer);
    EXPECT_TRUE(selfIntersections(tree).empty()) << pairs[i].fibreId;
    for (std::size_t j = i + 1; j < pairs.size(); ++j)
    {
      const TriangleTree other(pairs[j].outer);
      EXPECT_FALSE(smallestGap(tree, other, 0.06).found()) << pairs[i].fibreId << ", " << pairs[j].fibreId;
    }
  }
}

// Files are in single precision, and all findings here must hold for them; some of these surfaces are moved.
TEST(MyelinSurfaces, AreWhatFilesHold)
{
  const TightBundle bundle(6.3);
  const double face = bundle.fibres.domain.upper[0];
  ASSERT_NE(double(float(face)), face);
  for (const FibreSurfacePair& pair : surfacesOf(bundle.fibres, bundle.growth, bundle.by, bundle.growth.minimumGap + 0.002))
  {
    for (const TriangleMesh* mesh : { &pair.outer, &pair.inner })
    {
      for (const Eigen::Vector3d& p : mesh->points)
      {
        for (const double x : p)
        {
          EXPECT_TRUE(x == double(float(x)) || std::abs(x) == face) << pair.fibreId << ": " << x;
        }
      }
      const TriangleMesh written = inSinglePrecision(*mesh);
      EXPECT_TRUE(selfIntersections(TriangleTree(written)).empty()) << pair.fibreId;
      EXPECT_TRUE(checkSurface(written).sound()) << pair.fibreId;
    }
  }
}

// A lid so flat that single precision puts it in one plane with the surface below it.
TEST(SurfaceFinishing, FindsWhatMeetsInAFileAlone)
{
  TriangleMesh mesh;
  mesh.points = { { 10.0, 10.0, 10.0 }, { 12.0, 10.0, 10.0 }, { 10.0, 12.0, 10.0 }, { 10.5, 10.5, 10.0 + 1e-9 } };
  mesh.triangles = { { { 0, 2, 1 } }, { { 0, 1, 3 } }, { { 1, 2, 3 } }, { { 2, 0, 3 } } };
  ASSERT_TRUE(selfIntersections(TriangleTree(mesh)).empty());
  EXPECT_FALSE(placesThatMeet(mesh).empty());
  mesh.points[3][2] = 11.0;
  EXPECT_TRUE(placesThatMeet(mesh).empty());
}

// The inner surface is the same whether it was made before the outer one was moved, and stayed, or is made later, as by a filter
// with other g-ratios.
TEST(MyelinSurfaces, InnerOnesAreTheSameWheneverTheyAreMade)
{
  const TightBundle bundle;
  const LabelImage image = growFibres(bundle.fibres, bundle.growth, bundle.by, growthGrid(bundle.fibres.domain, bundle.growth));
  LabelImageFacts facts = labelImageFacts(bundle.fibres, bundle.growth);
  const auto source = std::make_shared<LabelImageInMemory>(
    LabelImageView{ image.grid, image.fibreId.data(), image.depth.data(), bundle.growth.gap() });
  for (const double further : { 0.0002, 0.002, 0.04 })
  {
    facts.minimumGap = bundle.growth.minimumGap + further;
    const MyelinSurfaceOptions options;
    SurfaceMaker maker(source, facts, options, {});
    SurfacesInMemory outer(maker.fibres().size());
    SurfacesInMemory inner(maker.fibres().size());
    maker.makeOuter(outer, inner);
    std::size_t moved = 0;
    std::size_t kept = 0;
    for (const FibreSurfacePair& pair : maker.fibres())
    {
      const bool isMoved = pair.outerReport.volume != pair.volumeAsMade;
      moved += isMoved ? 1 : 0;
      kept += isMoved && pair.isInnerMade ? 1 : 0;
      EXPECT_EQ(pair.outer.points.capacity() + pair.outer.triangles.capacity(), 0u)
        << "what is in its store takes no memory here";
      EXPECT_EQ(pair.inner.points.capacity() + pair.inner.triangles.capacity(), 0u);
    }
    EXPECT_GT(moved, 0u) << further;
    EXPECT_EQ(kept > 0, further < 0.01) << further;
    maker.makeInner(outer, inner);
    SurfaceMaker later(source, facts, options, {});
    SurfacesInMemory innerLater(maker.fibres().size());
    later.takeOuter(maker.fibres());
    later.makeInner(outer, innerLater);
    for (std::size_t i = 0; i < maker.fibres().size(); ++i)
    {
      EXPECT_EQ(innerLater.get(i)->points, inner.get(i)->points) << further << ", fibre " << maker.fibres()[i].fibreId;
      EXPECT_EQ(innerLater.get(i)->triangles, inner.get(i)->triangles);
      EXPECT_EQ(later.fibres()[i].gRatio, maker.fibres()[i].gRatio);
      EXPECT_EQ(later.fibres()[i].state, maker.fibres()[i].state);
      EXPECT_EQ(later.fibres()[i].thickness, maker.fibres()[i].thickness);
      EXPECT_EQ(later.fibres()[i].largestMove(), maker.fibres()[i].largestMove());
    }
  }
}

// Each process makes some of the surfaces, and has them all in its own memory.
TEST(MyelinSurfaces, AreTheSameInProcessesThatShareThem)
{
  const TightBundle bundle(6.3);
  const LabelImage image = growFibres(bundle.fibres, bundle.growth, bundle.by, growthGrid(bundle.fibres.domain, bundle.growth));
  LabelImageFacts facts = labelImageFacts(bundle.fibres, bundle.growth);
  const auto source = std::make_shared<LabelImageInMemory>(
    LabelImageView{ image.grid, image.fibreId.data(), image.depth.data(), bundle.growth.gap() });
  for (const double fraction : { 0.0, 0.2 })
  {
    // Some are moved, in the second case so far that they are made again.
    facts.minimumGap = bundle.growth.minimumGap + (fraction > 0.0 ? 0.05 : 0.002);
    MyelinSurfaceOptions options;
    options.model = fraction > 0.0 ? GRatioModel::TargetAxonVolumeFraction : GRatioModel::Constant;
    options.targetAxonVolumeFraction = fraction;
    const auto made = [&](Team* team)
    {
      const Sharing sharing(team);
      std::string bytes;
      sharing.together(
        [&]
        {
          SurfaceMaker maker(source, facts, options, {}, nullptr, sharing);
          SurfacesInMemory outer(maker.fibres().size());
          SurfacesInMemory inner(maker.fibres().size());
          maker.makeOuter(outer, inner);
          maker.makeInner(outer, inner);
          for (std::size_t i = 0; i < maker.fibres().size(); ++i)
          {
            bytes += bytesOf(maker.fibres()[i]) + outer.bytesOf(i) + inner.bytesOf(i);
          }
        });
      return bytes;
    };
    const std::string alone = made(nullptr);
    EXPECT_GT(alone.size(), 100000u);
    for (const int size : { 2, 3 })
    {
      for (const std::string& one : cactus_testing::inTeam(size, [&](Team& team) { return made(&team); }))
      {
        EXPECT_TRUE(one == alone) << one.size() << " bytes, not " << alone.size() << ": " << one.substr(0, 100);
      }
    }
  }
}

/// Surfaces of three fibres that meet, and the gap that growth kept between them.
struct Meeting
{
  FibreRadialGrowthOptions growth;
  MyelinSurfaceOptions options;
  LabelImageFacts facts;
  LabelImage image;

  std::vector<FibreSurfacePair> surfaces()
  {
    this->image = example::meetingFibres(this->growth);
    this->facts.domain = Domain::cube(3.0);
    this->facts.minimumGap = this->growth.minimumGap;
    this->facts.surfaceTolerance = this->growth.surfaceTolerance;
    this->facts.fibreIds = { 1, 2, 3 };
    this->facts.bundleIds = { 1, 1, 1 };
    this->facts.targetRadii = { 0.5, 0.5, 0.5 };
    return myelinSurfaces(this->view(), this->facts, this->options);
  }

  LabelImageView view() const
  {
    return { this->image.grid, this->image.fibreId.data(), this->image.depth.data(), this->growth.gap() };
  }
};

/// Expects that surfaces are sound and keep `gap` from each other, as axons do from the walls of their fibres.
void expectSound(const std::vector<FibreSurfacePair>& pairs, double gap)
{
  for (std::size_t i = 0; i < pairs.size(); ++i)
  {
    SCOPED_TRACE(pairs[i].fibreId);
    EXPECT_FALSE(pairs[i].isFlawed);
    const TriangleTree outer(pairs[i].outer);
    EXPECT_TRUE(selfIntersections(outer).empty());
    for (std::size_t j = i + 1; j < pairs.size(); ++j)
    {
      EXPECT_FALSE(smallestGap(outer, TriangleTree(pairs[j].outer), gap).found()) << pairs[j].fibreId;
    }
    if (pairs[i].inner.triangles.empty())
    {
      EXPECT_EQ(pairs[i].state, MyelinState::NoAxon);
      continue;
    }
    const TriangleTree inner(pairs[i].inner);
    EXPECT_TRUE(selfIntersections(inner).empty());
    EXPECT_FALSE(surfacesMeet(inner, outer));
    std::vector<std::uint32_t> wall;
    for (std::size_t t = 0; t < pairs[i].outer.triangles.size(); ++t)
    {
      const auto& triangle = pairs[i].outer.triangles[t];
      bool isCap = false;
      for (Eigen::Index face = 0; face < 6; ++face)
      {
        isCap = isCap || std::all_of(triangle.begin(), triangle.end(),
                           [&](std::int32_t p)
                           { return pairs[i].outer.points[std::size_t(p)][face / 2] == (face % 2 == 0 ? -1.5 : 1.5); });
      }
      if (!isCap)
      {
        wall.push_back(static_cast<std::uint32_t>(t));
      }
    }
    EXPECT_FALSE(smallestGap(inner, TriangleTree(pairs[i].outer, wall), gap).found());
  }
}

TEST(MyelinSurfaces, FibresThatMayTouchDoNotMeet)
{
  Meeting without;
  without.growth.minimumGap = 0.0;
  without.growth.surfaceTolerance = 0.0;
  without.options.decimationError = 0.0;
  for (const double voxelSize : { 0.1, 0.25 })
  {
    without.growth.voxelSize = voxelSize;
    expectSound(without.surfaces(), leastSeparation);
  }
}

TEST(MyelinSurfaces, ThinMyelinOnCoarseVoxelsIsAsThickAsPromised)
{
  Meeting thin;
  thin.options.gRatio = 0.95;
  for (const double error : { 0.0, 0.005 })
  {
    for (const double voxelSize : { 0.2, 0.3 })
    {
      thin.growth.voxelSize = voxelSize;
      thin.options.decimationError = error;
      const auto pairs = thin.surfaces();
      expectSound(pairs, thin.growth.minimumGap);
      for (const FibreSurfacePair& pair : pairs)
      {
        EXPECT_TRUE(
          pair.state == MyelinState::Thicker || pair.state == MyelinState::NoAxon || pair.state == MyelinState::AsAsked);
      }
    }
  }
}

TEST(MyelinSurfaces, VoxelsOfAnySizeGiveSoundSurfacesOrNone)
{
  Meeting coarse;
  for (const double voxelSize : { 0.5, 0.75, 1.0, 1.5, 3.0 })
  {
    for (const double error : { 0.0, 0.005 })
    {
      SCOPED_TRACE(voxelSize);
      coarse.growth.voxelSize = voxelSize;
      coarse.options.decimationError = error;
      const auto pairs = coarse.surfaces();
      for (const FibreSurfacePair& pair : pairs)
      {
        const bool isNone = pair.state == MyelinState::NoFibre;
        EXPECT_EQ(isNone, pair.outer.triangles.empty());
        EXPECT_TRUE(isNone || (pair.outerReport.closedManifold() && pair.outerReport.outward()));
        EXPECT_EQ(isNone || pair.state == MyelinState::NoAxon, pair.inner.triangles.empty());
        EXPECT_TRUE(pair.inner.triangles.empty() || (pair.innerReport.closedManifold() && pair.innerReport.outward()));
      }
    }
  }
}

/// A small bundle and voxels about as large as its fibres.
struct CoarseBundle
{
  double side;
  std::uint64_t seed;
  double dispersion;
  DispersionModel model;
  double voxelSize;
  double gRatio;
  int smoothing;
  bool clips;
};

std::vector<FibreSurfacePair> surfacesOf(const CoarseBundle& coarse, double gap)
{
  BundleBetweenWalls bundle;
  bundle.side = coarse.side;
  bundle.seed = coarse.seed;
  bundle.fibreVolumeFraction = 0.5;
  bundle.meanDispersion = coarse.dispersion;
  bundle.dispersionModel = coarse.model;
  Fibres fibres = initialiseBundles(bundle);
  optimise(fibres, {}, {});
  fibres = trimToDomain(fibres);
  FibreRadialGrowthOptions growth;
  growth.voxelSize = coarse.voxelSize;
  growth.targetFibreVolumeFraction = 0.9;
  growth.minimumGap = gap;
  growth.surfaceTolerance = 0.02;
  fibres = aimAtTargetRadii(fibres, growth);
  const LabelImage image = growFibres(fibres, growth, growthFor(fibres, growth).growth, growthGrid(fibres.domain, growth));
  LabelImageFacts facts = labelImageFacts(fibres, growth);
  facts.minimumGap = gap;
  MyelinSurfaceOptions options;
  options.gRatio = coarse.gRatio;
  options.decimationError = 0.0;
  options.smoothingIterations = coarse.smoothing;
  options.clipToDomain = coarse.clips;
  return myelinSurfaces({ image.grid, image.fibreId.data(), image.depth.data(), growth.gap() }, facts, options);
}

// Unmarked surfaces keep all guarantees. In the first bundle an axon's largest part lies in a part of its fibre that is left out;
// in the second, surfaces that are moved apart come nearer to a third one.
TEST(MyelinSurfaces, CoarseBundlesAreSoundOrMarked)
{
  constexpr double gap = 0.02;
  const CoarseBundle bundles[] = { { 6.0, 28, 10.0, DispersionModel::Coherent, 1.5, 0.5, 9, false },
    { 4.0, 14, 5.0, DispersionModel::Watson, 1.0, 0.9, 1, true } };
  for (const CoarseBundle& bundle : bundles)
  {
    const auto pairs = surfacesOf(bundle, gap);
    std::size_t unmarked = 0;
    for (std::size_t i = 0; i < pairs.size(); ++i)
    {
      SCOPED_TRACE(pairs[i].fibreId);
      if (pairs[i].isFlawed || pairs[i].outer.triangles.empty())
      {
        continue;
      }
      ++unmarked;
      const TriangleTree outer(pairs[i].outer);
      EXPECT_TRUE(selfIntersections(outer).empty());
      for (std::size_t j = 0; j < i; ++j)
      {
        EXPECT_FALSE(smallestGap(outer, TriangleTree(pairs[j].outer), gap).found()) << pairs[j].fibreId;
      }
      if (!pairs[i].inner.triangles.empty())
      {
        EXPECT_FALSE(surfacesMeet(TriangleTree(pairs[i].inner), outer));
        for (const std::int32_t point : pairs[i].innerReport.pieces)
        {
          EXPECT_EQ(sideOf(outer, pairs[i].inner.points[std::size_t(point)]), Side::Inside);
        }
      }
    }
    EXPECT_GT(unmarked, 3u);
  }
}

// It disappears when it is moved, away from two others that were too near to it.
TEST(MyelinSurfaces, AFibreThatGoesIsNoLongerTooNear)
{
  const Fibres fibres = example::fibresOfWhichOneGoes();
  const FibreRadialGrowthOptions growth = example::growthInWhichOneGoes();
  const Fibres aimed = aimAtTargetRadii(fibres, growth);
  const LabelImage image = growFibres(aimed, growth, growthFor(aimed, growth).growth, growthGrid(aimed.domain, growth));
  MyelinSurfaceOptions options;
  options.gRatio = 0.608349;
  options.decimationError = 0.00374472;
  auto pairs = myelinSurfaces(
    { image.grid, image.fibreId.data(), image.depth.data(), growth.gap() }, labelImageFacts(aimed, growth), options);
  std::vector<int> marked;
  std::vector<int> atFault;
  const auto note = [&](std::vector<int>& ids)
  {
    for (const FibreSurfacePair& pair : pairs)
    {
      if (pair.isFlawed)
      {
        ids.push_back(pair.fibreId);
      }
    }
  };
  note(marked);
  EXPECT_TRUE(
    std::any_of(pairs.begin(), pairs.end(), [](const FibreSurfacePair& pair) { return pair.state == MyelinState::NoFibre; }));
  markFaults(pairs, aimed.domain, growth.minimumGap, {});
  note(atFault);
  EXPECT_EQ(marked, atFault);
}

// Whatever the model is for the others.
TEST(MyelinSurfaces, AFibresOwnGRatioComesFirst)
{
  Fibres fibres;
  fibres.domain = Domain::cube(4.0);
  for (const double x : { -1.2, 0.0, 1.2 })
  {
    fibres.addFibre(static_cast<int>(fibres.size()) + 1, 1, 0.5);
    fibres.addPoint({ x, 0.0, -3.0 }, 0.5);
    fibres.addPoint({ x, 0.0, 3.0 }, 0.5);
  }
  fibres.columns.set("TargetGRatio", 1, 0.85);
  const FibreRadialGrowthOptions growth;
  const LabelImage image = growFibres(fibres, growth, 0.0, growthGrid(fibres.domain, growth));
  const LabelImageView view{ image.grid, image.fibreId.data(), image.depth.data(), growth.gap() };
  LabelImageFacts facts = labelImageFacts(fibres, growth);
  MyelinSurfaceOptions options;
  options.targetAxonVolumeFraction = 0.065;
  for (const GRatioModel model :
    { GRatioModel::Constant, GRatioModel::LogLinear, GRatioModel::Distributed, GRatioModel::TargetAxonVolumeFraction })
  {
    options.model = model;
    const auto pairs = myelinSurfaces(view, facts, options);
    EXPECT_EQ(pairs[1].targetGRatio, 0.85);
    EXPECT_NEAR(pairs[1].gRatio, 0.85, 0.003);
    double axons = 0.0;
    for (const std::size_t other : { std::size_t(0), std::size_t(2) })
    {
      EXPECT_LT(pairs[other].gRatio, 0.75);
      EXPECT_NEAR(pairs[other].gRatio, pairs[other].targetGRatio, 0.003);
      axons += pairs[other].innerReport.volume;
    }
    if (model == GRatioModel::TargetAxonVolumeFraction)
    {
      EXPECT_NEAR(axons + pairs[1].innerReport.volume, 0.065 * 64.0, 0.01 * 0.065 * 64.0);
    }
  }
  facts.columns.set("TargetGRatio", 0, 0.8);
  facts.columns.set("TargetGRatio", 2, 0.8);
  EXPECT_THROW(myelinSurfaces(view, facts, options), InvalidInput) << "nothing is left to aim with";
  facts.columns.set("TargetGRatio", 2, 1.5);
  EXPECT_THROW(myelinSurfaces(view, facts, options), InvalidInput);
}

// One surface bounds it, also where that was moved, and whatever the model is for the others.
TEST(MyelinSurfaces, AnAxonWithoutMyelinHasOneSurface)
{
  Meeting near;
  near.surfaces();
  near.facts.columns.set("TargetGRatio", 0, 1.0);
  MyelinSurfaceOptions options;
  options.targetAxonVolumeFraction = 0.35;
  for (const GRatioModel model : { GRatioModel::Constant, GRatioModel::TargetAxonVolumeFraction })
  {
    options.model = model;
    const auto pairs = myelinSurfaces(near.view(), near.facts, options);
    EXPECT_FALSE(pairs[0].outer.triangles.empty());
    EXPECT_TRUE(areSame(pairs[0].outer, pairs[0].inner));
    EXPECT_EQ(pairs[0].state, MyelinState::AsAsked);
    EXPECT_EQ(pairs[0].gRatio, 1.0);
    EXPECT_EQ(pairs[0].innerReport.volume, pairs[0].outerReport.volume);
    EXPECT_FALSE(areSame(pairs[1].outer, pairs[1].inner));
    EXPECT_LT(pairs[1].gRatio, 0.9);
  }
}

TEST(MyelinSurfaces, CountsWhatIsNotAsAsked)
{
  Meeting lost;
  EXPECT_EQ(notAsAsked(lost.surfaces(), lost.view().grid.spacing, lost.facts), "");
  lost.facts.lengths = { 3.0, 3.0, 0.0 };
  auto pairs = lost.surfaces();
  pairs[2].state = MyelinState::NoFibre; // passes outside
  EXPECT_EQ(notAsAsked(pairs, lost.view().grid.spacing, lost.facts), "");
  pairs[1].state = MyelinState::NoFibre;
  const std::string one = notAsAsked(pairs, lost.view().grid.spacing, lost.facts);
  EXPECT_EQ(one.find("1 of 2 fibres are not as asked, see Fibre statistics: 1 without any surface (Myelin 4); choose a smaller "
                     "VoxelSize (it is 0.1 µm"),
    0u)
    << one;
  pairs[0].isFlawed = true;
  pairs[0].state = MyelinState::Thicker;
  const std::string two = notAsAsked(pairs, lost.view().grid.spacing, lost.facts);
  EXPECT_EQ(two.find("2 of 2 fibres are not as asked, see Fibre statistics: 1 without any surface (Myelin 4), 1 with thicker "
                     "myelin (2), 1 with a"),
    0u)
    << two;
  pairs[2].isFlawed = true;
  EXPECT_EQ(notAsAsked(pairs, lost.view().grid.spacing, lost.facts).find("3 of 3 fibres"), 0u);
  auto unknown = pairs;
  for (auto& pair : unknown)
  {
    pair.targetRadius = 0.0;
  }
  const std::string any = notAsAsked(unknown, lost.view().grid.spacing, lost.facts);
  EXPECT_NE(any.find("choose a smaller VoxelSize (it is 0.1 µm) in"), std::string::npos) << any;
  lost.facts.minimumGap = 0.3;
  lost.image.grid.spacing = 0.3;
  const std::string three = notAsAsked(pairs, lost.view().grid.spacing, lost.facts);
  EXPECT_NE(three.find("VoxelSize 0.3 µm is coarse for fibres of radii 0.5 to 0.5 µm: choose 0.25 or less"), std::string::npos)
    << three;
  EXPECT_NE(three.find("MinimumGap 0.3"), std::string::npos) << three;
}

// A fibre thicker than the domain shows only caps.
TEST(MyelinSurfaces, AFibreMayFillTheDomain)
{
  Fibres fibres;
  fibres.domain = Domain::cube(2.0);
  fibres.addFibre(1, 1, 5.0);
  fibres.addPoint({ 0.0, 0.0, -9.0 }, 5.0);
  fibres.addPoint({ 0.0, 0.0, 9.0 }, 5.0);
  const FibreRadialGrowthOptions options;
  const LabelImage image = growFibres(fibres, options, 0.0, growthGrid(fibres.domain, options));
  LabelImageFacts facts;
  facts.domain = fibres.domain;
  facts.minimumGap = options.minimumGap;
  facts.surfaceTolerance = options.surfaceTolerance;
  facts.fibreIds = facts.bundleIds = { 1 };
  facts.targetRadii = { 5.0 };
  const auto pairs =
    myelinSurfaces(LabelImageView{ image.grid, image.fibreId.data(), image.depth.data(), options.gap() }, facts, {});
  EXPECT_NEAR(pairs[0].outerReport.volume, 8.0, 1e-9);
  EXPECT_TRUE(std::isfinite(pairs[0].outerLevel));
  EXPECT_TRUE(std::isfinite(pairs[0].thickness));
}

// Files with six digits shift an image slightly relative to its domain; surfaces end at the domain all the same.
TEST(MyelinSurfaces, EndWhereTheDomainDoes)
{
  StraightFibre straight;
  const FibreField whole(straight.source(), straight.facts.domain, true);
  straight.image.grid.origin += Eigen::Vector3d(4e-5, -4e-5, 4e-5);
  straight.image.grid.spacing *= 1.0 - 1e-6;
  const FibreField moved(straight.source(), straight.facts.domain, true);
  EXPECT_EQ(moved.box().lower, whole.box().lower);
  EXPECT_EQ(moved.box().upper, whole.box().upper);
}

TEST(MyelinSurfaces, RefusesMoreSmoothingThanFibresBear)
{
  MyelinSurfaceOptions options;
  for (const int passes : { -1, 21, 1000 })
  {
    options.smoothingIterations = passes;
    EXPECT_THROW(validate(options), InvalidInput);
  }
  options.smoothingIterations = 20;
  validate(options);
}

} // namespace
