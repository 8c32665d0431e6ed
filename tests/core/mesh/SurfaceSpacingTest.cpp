// SPDX-License-Identifier: BSD-3-Clause
// Guarantees: surfaces that are too near are moved to the gap, by no more than necessary, wherever they lie relative to the
// slabs; others keep every bit. Reading grows no faster than the surfaces.
#include "mesh/SurfaceSpacing.h"

#include "../FindingsInMemory.h"
#include "ExampleSurfaces.h"
#include "TriangleGap.h"
#include "base/Domain.h"
#include "base/Error.h"
#include "mesh/SurfaceCheck.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

namespace
{

using namespace cactus;

/// A closed tube along z from face to face of the box [-1, 1]³, with a bulge of height `bulge` towards +x in its middle.
TriangleMesh tube(double x, double radius, double bulge = 0.0)
{
  TriangleMesh mesh = example::tube(x, 0.0, radius, -1.0, 1.0, 48, 40);
  for (Eigen::Vector3d& p : mesh.points)
  {
    const Eigen::Vector3d outwards(p[0] - x, p[1], 0.0);
    const double angle = std::atan2(p[1], p[0] - x);
    p += bulge * std::exp(-20.0 * (p[2] * p[2] + angle * angle)) * outwards / radius;
  }
  return mesh;
}

/// Returns the shortest distance of the points of one mesh to densely sampled points of the other's triangles: never less than
/// the true one.
double sampledDistance(const TriangleMesh& a, const TriangleMesh& b)
{
  double least = 1e300;
  for (const auto& t : b.triangles)
  {
    for (int i = 0; i <= 8; ++i)
    {
      for (int j = 0; i + j <= 8; ++j)
      {
        const Eigen::Vector3d p = b.points[std::size_t(t[0])] +
                                  (i / 8.0) * (b.points[std::size_t(t[1])] - b.points[std::size_t(t[0])]) +
                                  (j / 8.0) * (b.points[std::size_t(t[2])] - b.points[std::size_t(t[0])]);
        if (p[0] > -0.2 && p[0] < 0.3)
        {
          for (const auto& q : a.points)
          {
            least = std::min(least, (p - q).norm());
          }
        }
      }
    }
  }
  return least;
}

/// Calls keepApart() on meshes in a store.
template <typename... More>
SpacingReport keepApart(const std::vector<TriangleMesh*>& meshes, More&&... more)
{
  SurfacesInMemory store(meshes.size());
  for (std::size_t i = 0; i < meshes.size(); ++i)
  {
    store.put(i, *meshes[i]);
  }
  const SpacingReport report = cactus::keepApart(store, std::forward<More>(more)...);
  for (std::size_t i = 0; i < meshes.size(); ++i)
  {
    *meshes[i] = store.take(i);
  }
  return report;
}

const Eigen::AlignedBox3d domainBox(Eigen::Vector3d(-1, -1, -1), Eigen::Vector3d(1, 1, 1));

// Two tips, one above the other, whose normals point nearly sideways: an inward move hardly moves them apart.
TEST(SurfaceSpacing, PartsCornersThatMoveAskew)
{
  const auto tip = [](double z, double up)
  {
    TriangleMesh mesh;
    mesh.points = { { 0.0, 0.0, z }, { -0.3, -0.5, z - up }, { -0.3, 0.5, z - up }, { -0.34, 0.0, z - 0.1 * up } };
    mesh.triangles = { { 0, 1, 2 }, { 0, 2, 3 }, { 0, 3, 1 }, { 1, 3, 2 } };
    for (auto& t : mesh.triangles)
    {
      if (up < 0.0)
      {
        std::swap(t[1], t[2]);
      }
    }
    return mesh;
  };
  TriangleMesh lower = tip(0.0, 0.9);
  TriangleMesh upper = tip(0.019, -0.9);
  ASSERT_TRUE(checkSurface(lower).outward() && checkSurface(upper).outward());
  const SpacingReport report = keepApart({ &lower, &upper }, 0.02, domainBox);
  EXPECT_TRUE(report.tooNear.empty());
  EXPECT_GE((upper.points[0] - lower.points[0]).norm(), 0.02);
}

/// Returns the distance of a surface to the image of another one.
double distanceToImage(const TriangleMesh& own, TriangleMesh other, const Eigen::Vector3d& shift)
{
  for (Eigen::Vector3d& point : other.points)
  {
    point += shift;
  }
  return smallestGap(TriangleTree(own), TriangleTree(other)).distance;
}

// Left and right are 0.018 apart beyond the face, and 0.8 in the box; above and below so across the other faces.
TEST(SurfaceSpacing, MovesWhatIsTooNearAcrossHeldFaces)
{
  const Eigen::AlignedBox3d box(Eigen::Vector3d(-1, -1, -20), Eigen::Vector3d(1, 1, 20));
  constexpr std::uint8_t across = 0x0f;
  constexpr std::uint8_t all = 0x3f;
  for (const std::uint8_t held : { std::uint8_t(0), across, all })
  {
    TriangleMesh left = tube(-0.7, 0.29);
    TriangleMesh right = tube(0.7, 0.28, 0.012);
    TriangleMesh above = example::tube(0.0, 0.0, 0.1, 18.0, 19.992, 24, 10);
    TriangleMesh below = example::tube(0.0, 0.0, 0.1, -19.99, -18.0, 24, 10);
    const SpacingReport report = keepApart({ &left, &below, &right, &above }, std::vector<std::size_t>{ 0, 1, 2, 3 }, 0.02, box,
      Context(), 0.0, 1.0, Sharing(), Recollection(), held);
    const std::vector<std::size_t> none;
    const std::vector<std::size_t> sides{ 0, 2 };
    const std::vector<std::size_t> everything{ 0, 1, 2, 3 };
    EXPECT_EQ(report.moved, held == 0 ? none : held == across ? sides : everything);
    EXPECT_TRUE(report.tooNear.empty());
    EXPECT_EQ(distanceToImage(right, left, { 2.0, 0.0, 0.0 }) >= 0.02, held != 0);
    EXPECT_EQ(distanceToImage(above, below, { 0.0, 0.0, 40.0 }) >= 0.02, held == all);
    EXPECT_LT(distanceToImage(right, left, { 2.0, 0.0, 0.0 }), 0.0215);
  }
}

// Two boxes that are 0.018 apart across a face, an edge or a corner of a domain of four slabs.
TEST(SurfaceSpacing, LooksAcrossAllHeldFacesEdgesAndCorners)
{
  Domain domain;
  domain.lower = { -3, -3, -20 };
  domain.upper = { 3, 3, 20 };
  domain.periodic = { { true, true, true } };
  const Eigen::AlignedBox3d box(domain.lower, domain.upper);
  ASSERT_EQ(domain.shiftsToImages().size(), 13U);
  for (const Eigen::Vector3d& shift : domain.shiftsToImages())
  {
    const Eigen::Vector3d side = shift.cwiseSign();
    const double way = 0.018 / side.norm(); // along each axis
    // In the middle between the faces along an axis that is not crossed.
    const auto boxAt = [&](double sign, double part)
    {
      const Eigen::Vector3d middle = sign * side.cwiseProduct(domain.upper - Eigen::Vector3d::Constant(0.5 + part * way));
      return example::box(middle - Eigen::Vector3d::Constant(0.5), middle + Eigen::Vector3d::Constant(0.5));
    };
    for (const int threads : { 1, 3 })
    {
      Context context;
      context.threads = threads;
      TriangleMesh one = boxAt(1.0, 0.4);
      TriangleMesh other = boxAt(-1.0, 0.6);
      ASSERT_NEAR(distanceToImage(one, other, shift), 0.018, 1e-9);
      const SpacingReport report = keepApart({ &one, &other }, std::vector<std::size_t>{ 1 }, 0.02, box, context, 0.0, 1.0,
        Sharing(), Recollection(), std::uint8_t(0x3f));
      EXPECT_EQ(report.moved.size(), 2U) << shift.transpose();
      EXPECT_TRUE(report.tooNear.empty());
      const double distance = distanceToImage(one, other, shift);
      EXPECT_GE(distance, 0.02) << shift.transpose();
      EXPECT_LT(distance, 0.0225);
    }
  }
}

TEST(SurfaceSpacing, MovesWhatIsTooNearToTheGap)
{
  // 0.03 apart, but for the bulge, which leaves 0.015.
  TriangleMesh left = tube(-0.5, 0.5, 0.015);
  TriangleMesh right = tube(0.53, 0.5);
  TriangleMesh far = tube(-0.5, 0.2);
  for (auto& p : far.points)
  {
    p[1] += 5.0;
  }
  const TriangleMesh oldLeft = left;
  const TriangleMesh oldFar = far;
  TriangleMesh empty;
  ASSERT_LT(sampledDistance(left, right), 0.0151);
  const SpacingReport report = keepApart({ &left, &empty, &far, &right }, 0.02, domainBox);
  EXPECT_EQ(report.moved, (std::vector<std::size_t>{ 0, 3 }));
  EXPECT_TRUE(report.tooNear.empty());
  const double distance = sampledDistance(left, right);
  EXPECT_GE(distance, 0.02);
  EXPECT_LT(distance, 0.0215);
  double largest = 0.0;
  for (std::size_t p = 0; p < left.points.size(); ++p)
  {
    largest = std::max(largest, (left.points[p] - oldLeft.points[p]).norm());
  }
  EXPECT_LT(largest, 0.005);
  EXPECT_EQ(far.points, oldFar.points);
  for (const TriangleMesh* mesh : { &left, &right })
  {
    const SurfaceReport check = checkSurface(*mesh);
    EXPECT_TRUE(check.closedManifold());
    EXPECT_TRUE(check.outward());
  }
}

TEST(SurfaceSpacing, PointsOnTheBoxStayOnIt)
{
  TriangleMesh left = tube(-0.5, 0.5);
  TriangleMesh right = tube(0.515, 0.5);
  const TriangleMesh before = left;
  const SpacingReport report = keepApart({ &left, &right }, 0.02, domainBox);
  EXPECT_EQ(report.moved.size(), 2u);
  EXPECT_TRUE(report.tooNear.empty());
  EXPECT_GE(sampledDistance(left, right), 0.02);
  for (std::size_t p = 0; p < left.points.size(); ++p)
  {
    EXPECT_EQ(left.points[p][2] == 1.0, before.points[p][2] == 1.0);
    EXPECT_EQ(left.points[p][2] == -1.0, before.points[p][2] == -1.0);
  }
}

TEST(SurfaceSpacing, NamesWhatItCannotPart)
{
  // One through the other: moving each inwards does not help.
  TriangleMesh left = tube(-0.1, 0.5);
  TriangleMesh right = tube(0.1, 0.5);
  EXPECT_EQ(keepApart({ &left, &right }, 0.02, domainBox).tooNear, (std::vector<std::size_t>{ 0, 1 }));
}

TEST(SurfaceSpacing, SameBitsOnAnyNumberOfThreadsAndStops)
{
  std::vector<TriangleMesh> results;
  for (const int threads : { 1, 2, 4 })
  {
    TriangleMesh left = tube(-0.5, 0.5, 0.015);
    TriangleMesh right = tube(0.53, 0.5);
    TriangleMesh beyond = tube(1.545, 0.5);
    Context context;
    context.threads = threads;
    keepApart({ &left, &right, &beyond }, 0.02, domainBox, context);
    results.push_back(right);
  }
  EXPECT_EQ(results[0].points, results[1].points);
  EXPECT_EQ(results[0].points, results[2].points);
  TriangleMesh left = tube(-0.5, 0.5, 0.015);
  TriangleMesh right = tube(0.53, 0.5);
  Context context;
  context.cancelled = [] { return true; };
  EXPECT_THROW(keepApart({ &left, &right }, 0.02, domainBox, context), Cancelled);
}

TEST(SurfaceSpacing, LooksOnlyAtWhatHasChangedOrIsMoved)
{
  TriangleMesh far = tube(-1.71, 0.2);
  TriangleMesh near = tube(-1.3, 0.2);
  TriangleMesh left = tube(-0.5, 0.49);
  TriangleMesh middle = tube(0.5, 0.495);
  TriangleMesh right = tube(1.5, 0.49);
  const std::vector<TriangleMesh*> all{ &far, &near, &left, &middle, &right };
  const TriangleMesh oldFar = far;
  const TriangleMesh oldLeft = left;
  EXPECT_EQ(keepApart(all, std::vector<std::size_t>{ 1 }, 0.005, domainBox).moved, std::vector<std::size_t>{});
  const SpacingReport report = keepApart(all, std::vector<std::size_t>{ 4 }, 0.02, domainBox);
  EXPECT_EQ(report.moved, (std::vector<std::size_t>{ 2, 3, 4 })) << "0 and 1 are too near, too, but neither has changed";
  EXPECT_EQ(far.points, oldFar.points);
  EXPECT_NE(left.points, oldLeft.points) << "3 has moved, and is too near to 2";
  EXPECT_EQ(keepApart(all, std::vector<std::size_t>{ 1 }, 0.02, domainBox).moved, (std::vector<std::size_t>{ 0, 1 }));
}

/// Returns the mesh with its axes rotated: z becomes x.
TriangleMesh alongX(TriangleMesh mesh)
{
  for (Eigen::Vector3d& p : mesh.points)
  {
    p = Eigen::Vector3d(p[2], p[0], p[1]);
  }
  return mesh;
}

/// Whether any triangle of the one is nearer than `gap` to any of the other.
bool tooNear(const TriangleMesh& one, const TriangleMesh& other, double gap)
{
  const auto corners = [](const TriangleMesh& mesh, const std::array<std::int32_t, 3>& t)
  {
    return std::array<Eigen::Vector3d, 3>{ mesh.points[std::size_t(t[0])], mesh.points[std::size_t(t[1])],
      mesh.points[std::size_t(t[2])] };
  };
  const auto boxOf = [](const std::array<Eigen::Vector3d, 3>& t) { return Eigen::AlignedBox3d(t[0]).extend(t[1]).extend(t[2]); };
  for (const auto& s : one.triangles)
  {
    const auto a = corners(one, s);
    const Eigen::AlignedBox3d around = boxOf(a);
    for (const auto& t : other.triangles)
    {
      const auto b = corners(other, t);
      if (around.squaredExteriorDistance(boxOf(b)) < gap * gap && triangleGap(a, b, gap).found())
      {
        return true;
      }
    }
  }
  return false;
}

/// Returns the surfaces that are too near to another.
std::vector<std::size_t> allTooNear(const std::vector<TriangleMesh>& surfaces, double gap)
{
  std::set<std::size_t> found;
  for (std::size_t i = 0; i < surfaces.size(); ++i)
  {
    for (std::size_t j = 0; j < i; ++j)
    {
      if (tooNear(surfaces[i], surfaces[j], gap))
      {
        found.insert({ i, j });
      }
    }
  }
  return { found.begin(), found.end() };
}

TEST(SurfaceSpacing, FindsAllThatIsNearInALongBox)
{
  // Slabs are 10 thick: their borders are at -10, 0 and 10.
  const Eigen::AlignedBox3d longBox(Eigen::Vector3d(-20, -20, -20), Eigen::Vector3d(20, 20, 20));
  const auto tubeAt = [](double x, double lower, double upper, int rings)
  { return example::tube(x, 0.0, 0.5, lower, upper, 24, rings); };
  std::vector<TriangleMesh> before{
    tubeAt(-12.0, -20.0, 20.0, 40), tubeAt(-10.99, -20.0, 20.0, 40), // all along, with rings on the borders
    tubeAt(-9.0, -20.0, 20.0, 37), tubeAt(-7.9, -20.0, 20.0, 40),    // at one height, on a border, see below
    tubeAt(-6.0, 3.0, 9.995, 7), tubeAt(-6.0, 10.005, 17.0, 7),      // end to end, to either side of a border
    tubeAt(-4.0, -9.0, 0.0, 9), tubeAt(-4.0, 0.01, 9.0, 9),          // end to end, the one on a border
    tubeAt(-2.0, -9.0, -0.01, 9), tubeAt(-2.0, 0.0, 9.0, 9),         // the same from the other side
    tubeAt(0.0, -20.0, 20.0, 1), tubeAt(1.01, 12.0, 18.0, 6),        // triangles through all slabs, and a short neighbour
    tubeAt(5.0, -20.0, 20.0, 40), alongX(example::tube(1.01, -10.0, 0.5, 3.0, 7.0, 24, 5)), // one across it, on a border
    tubeAt(9.0, -20.0, 20.0, 40), tubeAt(10.03, -20.0, 20.0, 40),                           // far enough
  };
  for (Eigen::Vector3d& p : before[3].points)
  {
    p[0] -= p[2] == 10.0 ? 0.09 : 0.0;
  }
  std::vector<std::size_t> near(14);
  std::iota(near.begin(), near.end(), std::size_t(0));
  ASSERT_EQ(allTooNear(before, 0.02), near);
  std::vector<TriangleMesh> results[2];
  for (const int threads : { 1, 3 })
  {
    std::vector<TriangleMesh>& surfaces = results[threads / 2];
    surfaces = before;
    std::vector<TriangleMesh*> pointers;
    for (TriangleMesh& mesh : surfaces)
    {
      pointers.push_back(&mesh);
    }
    Context context;
    context.threads = threads;
    const SpacingReport report = keepApart(pointers, 0.02, longBox, context);
    EXPECT_EQ(report.moved, near);
    EXPECT_TRUE(report.tooNear.empty());
  }
  EXPECT_TRUE(allTooNear(results[0], 0.02).empty());
  for (std::size_t i = 0; i < before.size(); ++i)
  {
    EXPECT_EQ(results[0][i].points, results[1][i].points) << i;
    for (std::size_t p = 0; p < before[i].points.size(); ++p)
    {
      EXPECT_LT((results[0][i].points[p] - before[i].points[p]).norm(), 0.02) << i;
    }
  }
}

/// Counts the requests that it gets.
class CountingStore : public SurfacesInMemory
{
public:
  explicit CountingStore(const std::vector<TriangleMesh>& surfaces)
    : SurfacesInMemory(surfaces.size())
  {
    for (std::size_t s = 0; s < surfaces.size(); ++s)
    {
      this->SurfacesInMemory::put(s, surfaces[s]);
    }
  }

  std::shared_ptr<const TriangleMesh> get(std::size_t index) const override
  {
    ++this->wholes;
    const auto surface = this->SurfacesInMemory::get(index);
    this->bytes += bytesIn(*surface);
    return surface;
  }
  SurfacePart part(std::size_t index, double lower, double upper) const override
  {
    const SurfacePart part = cutOut(*this->SurfacesInMemory::get(index), lower, upper);
    this->bytes += bytesIn(part.mesh);
    const std::lock_guard<std::mutex> lock(this->Mutex);
    ++this->parts[{ index, lower }];
    return part;
  }

  static std::size_t bytesIn(const TriangleMesh& mesh)
  {
    return mesh.points.size() * sizeof(mesh.points[0]) + mesh.triangles.size() * sizeof(mesh.triangles[0]);
  }

  mutable std::atomic<std::size_t> wholes{ 0 };
  mutable std::atomic<std::size_t> bytes{ 0 };
  mutable std::map<std::pair<std::size_t, double>, int> parts; ///< number of requests for each

private:
  mutable std::mutex Mutex;
};

/// Three tubes that wave side by side along z from 0, of which the second and third are too near between `from` and `to`.
std::vector<TriangleMesh> longTubes(double length, double from, double to)
{
  std::vector<TriangleMesh> tubes;
  for (int i = 0; i < 3; ++i)
  {
    tubes.push_back(example::tube(1.021 * i, 0.0, 0.5, 0.0, length, 24, static_cast<int>(2 * length)));
    for (Eigen::Vector3d& p : tubes.back().points)
    {
      p[0] += 0.2 * std::sin(0.5 * p[2]);
    }
  }
  for (Eigen::Vector3d& p : tubes[2].points)
  {
    p[0] -= p[2] > from && p[2] < to ? 0.01 : 0.0;
  }
  return tubes;
}

Eigen::AlignedBox3d boxOfLength(double length)
{
  return { Eigen::Vector3d(-20.0, -20.0, 0.0), Eigen::Vector3d(20.0, 20.0, length) };
}

TEST(SurfaceSpacing, ReadsNoMoreOfSurfacesForEachSlab)
{
  for (const double length : { 40.0, 400.0 })
  {
    const std::vector<TriangleMesh> tubes = longTubes(length, 0.0, 0.0);
    std::size_t all = 0;
    for (const TriangleMesh& mesh : tubes)
    {
      all += CountingStore::bytesIn(mesh);
    }
    CountingStore store(tubes);
    EXPECT_TRUE(cactus::keepApart(store, 0.02, boxOfLength(length)).moved.empty());
    EXPECT_EQ(store.wholes, 3u);
    EXPECT_EQ(store.parts.size(), std::size_t(3 * length / 10.0));
    EXPECT_LT(double(store.bytes), 2.3 * double(all)) << length << " µm: once whole, once slab by slab, and what slabs share";
  }
}

TEST(SurfaceSpacing, LooksAgainOnlyWhereAnythingWasMoved)
{
  const std::vector<TriangleMesh> tubes = longTubes(400.0, 203.0, 207.0);
  CountingStore store(tubes);
  const SpacingReport report = cactus::keepApart(store, 0.02, boxOfLength(400.0));
  EXPECT_EQ(report.moved, (std::vector<std::size_t>{ 1, 2 }));
  EXPECT_TRUE(report.tooNear.empty());
  EXPECT_EQ(store.parts.size(), 3u * 40u);
  for (const auto& [of, times] : store.parts)
  {
    const bool isMoved = of.second > 199.0 && of.second < 201.0;
    EXPECT_EQ(times > 1, isMoved) << "surface " << of.first << " above " << of.second;
  }
}

// The measurements of a killed run are not repeated.
TEST(SurfaceSpacing, MeasuresNoSlabThatIsKnown)
{
  const std::vector<TriangleMesh> tubes = longTubes(100.0, 23.0, 27.0);
  cactus_testing::FindingsInMemory findings;
  const auto partsAsked = [&](std::vector<TriangleMesh>& result)
  {
    CountingStore store(tubes);
    const SpacingReport report = cactus::keepApart(
      store, { 0, 1, 2 }, 0.02, boxOfLength(100.0), {}, 0.0, 1.0, Sharing(), Recollection(findings).part("apart"));
    EXPECT_EQ(report.moved, (std::vector<std::size_t>{ 1, 2 }));
    EXPECT_TRUE(report.tooNear.empty());
    result = { store.take(0), store.take(1), store.take(2) };
    std::map<double, int> slabs;
    for (const auto& entry : store.parts)
    {
      slabs[entry.first.second] += entry.second;
    }
    return slabs;
  };
  const auto isKept = [&](const char* round, int slab)
  { return findings.kept.count("apart/round " + std::string(round) + "/0 of 1/" + std::to_string(slab)) > 0; };
  std::vector<TriangleMesh> wanted;
  ASSERT_EQ(partsAsked(wanted).size(), 10u);
  ASSERT_TRUE(isKept("0", 9) && isKept("1", 2));
  std::vector<TriangleMesh> found;
  const auto expectSame = [&]
  {
    for (std::size_t s = 0; s < wanted.size(); ++s)
    {
      EXPECT_EQ(found[s].points, wanted[s].points) << s;
    }
  };
  // The last slabs of a round, and all after it, like a run killed in the round.
  findings.beginAgain([](const std::string& name) { return name.find("round 0") != std::string::npos && name.back() < '6'; });
  const auto slabs = partsAsked(found);
  expectSame();
  EXPECT_EQ(slabs.size(), 5u) << "six to nine, and the one where something was moved";
  EXPECT_TRUE(isKept("0", 6) && !isKept("0", 5) && isKept("1", 2));
  findings.beginAgain();
  EXPECT_EQ(partsAsked(found).size(), 6u) << "what was known then is kept by the first run alone";
  expectSame();
}

TEST(SurfaceSpacing, LooksAtTheNeighboursOfWhatItHasMovedAllAlong)
{
  // The first two are too near above, the second and third below; the third alone has changed, and then the first.
  std::vector<TriangleMesh> tubes = longTubes(40.0, 3.0, 7.0);
  for (Eigen::Vector3d& p : tubes[0].points)
  {
    p[0] += p[2] > 33.0 && p[2] < 37.0 ? 0.01 : 0.0;
  }
  CountingStore still(tubes);
  EXPECT_TRUE(cactus::keepApart(still, std::vector<std::size_t>{}, 0.02, boxOfLength(40.0)).moved.empty());
  EXPECT_TRUE(still.parts.empty());
  for (const std::size_t changed : { 2, 0 })
  {
    CountingStore store(tubes);
    const SpacingReport report = cactus::keepApart(store, std::vector<std::size_t>{ changed }, 0.02, boxOfLength(40.0));
    EXPECT_EQ(report.moved, (std::vector<std::size_t>{ 0, 1, 2 })) << changed;
    EXPECT_TRUE(report.tooNear.empty()) << changed;
    EXPECT_TRUE(allTooNear({ store.take(0), store.take(1), store.take(2) }, 0.02).empty()) << changed;
  }
}

/// With a corner at `tip`, and 1 µm long.
TriangleMesh thorn(const Eigen::Vector3d& tip, const Eigen::Vector3d& along)
{
  const Eigen::Vector3d aside = along.cross(Eigen::Vector3d::UnitZ()).normalized();
  const Eigen::Vector3d base = tip + along.normalized();
  return example::tetrahedronOf(tip, base + 0.2 * aside, base - 0.2 * aside, base + Eigen::Vector3d(0.0, 0.0, 0.2));
}

// A leaning one is moved at its top, which turns its face towards another one two slabs below.
TEST(SurfaceSpacing, FindsWhatAMoveHasBroughtNearInAnotherSlab)
{
  const Eigen::Vector3d top(-5.0, 0.0, 38.0);
  const Eigen::Vector3d right(0.0, -3.0, 1.0);
  const Eigen::Vector3d left(-1.0, 0.0, 3.0);
  const Eigen::Vector3d outwards = (left - top).cross(right - top).normalized();
  ASSERT_LT(outwards[0], -0.5);
  const Eigen::Vector3d amid = (top + right + left) / 3.0;
  std::vector<TriangleMesh> surfaces{ example::tetrahedronOf(top, right, { 0.0, 3.0, 1.0 }, left),
    thorn(amid + 0.0205 * outwards, outwards), thorn(top + Eigen::Vector3d(0.012, 0.0, 0.0), { 1.0, 0.0, 0.0 }) };
  for (const TriangleMesh& mesh : surfaces)
  {
    ASSERT_TRUE(checkSurface(mesh).outward());
  }
  ASSERT_EQ(allTooNear(surfaces, 0.02), (std::vector<std::size_t>{ 0, 2 }));
  CountingStore store(surfaces);
  const SpacingReport report = cactus::keepApart(store, 0.02, boxOfLength(40.0));
  EXPECT_EQ(report.moved, (std::vector<std::size_t>{ 0, 1, 2 }));
  EXPECT_TRUE(report.tooNear.empty());
  EXPECT_TRUE(allTooNear({ store.take(0), store.take(1), store.take(2) }, 0.02).empty());
}

} // namespace
