// SPDX-License-Identifier: BSD-3-Clause
// Guarantees: a surface is read back with the same bits, and any part of it as if it were cut out of the whole; reading a part
// costs no more for a longer surface; damage is found anywhere, except in layers that a part does not read; another surface's
// file is neither read nor replaced.
#include "io/SurfaceFile.h"

#include "ExampleSurfaces.h"
#include "ScratchPath.h"
#include "base/Error.h"
#include "mesh/CappedSurface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <functional>
#include <limits>
#include <numeric>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace
{

using namespace cactus;
using cactus_testing::contentOf;

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr SurfaceFileOwner own{ 0x1234567890abcdefu, 7 };

void replaceContent(const std::string& path, const std::string& content)
{
  std::ofstream(path, std::ios::binary).write(content.data(), static_cast<std::streamsize>(content.size()));
}

/// Returns the same surface with its points and triangles in another order.
TriangleMesh shuffled(const TriangleMesh& mesh, unsigned seed)
{
  std::mt19937 engine(seed);
  std::vector<std::int32_t> placeOf(mesh.points.size());
  std::iota(placeOf.begin(), placeOf.end(), 0);
  std::shuffle(placeOf.begin(), placeOf.end(), engine);
  TriangleMesh result = mesh;
  for (std::size_t p = 0; p < placeOf.size(); ++p)
  {
    result.points[std::size_t(placeOf[p])] = mesh.points[p];
  }
  std::shuffle(result.triangles.begin(), result.triangles.end(), engine);
  for (auto& t : result.triangles)
  {
    t = { { placeOf[std::size_t(t[0])], placeOf[std::size_t(t[1])], placeOf[std::size_t(t[2])] } };
  }
  return result;
}

/// Returns the bytes that this process has read from files so far.
std::uint64_t bytesRead()
{
  std::ifstream file("/proc/self/io");
  std::string name;
  std::uint64_t bytes = 0;
  file >> name >> bytes;
  return name == "rchar:" ? bytes : 0;
}

/// Subtracts the bytes of reading the counter itself.
std::uint64_t bytesReadBy(const std::function<void()>& work)
{
  const std::uint64_t before = bytesRead();
  work();
  const std::uint64_t after = bytesRead();
  return after - before - (bytesRead() - after);
}

class SurfaceFile : public ::testing::Test
{
protected:
  void TearDown() override { std::remove(this->path.c_str()); }

  const std::string path = cactus_testing::scratchPath("surface");
};

void expectSame(const TriangleMesh& a, const TriangleMesh& b, const std::string& what)
{
  EXPECT_EQ(a.points, b.points) << what;
  EXPECT_EQ(a.triangles, b.triangles) << what;
}

TEST_F(SurfaceFile, GivesTheSurfaceAndAnyPartOfIt)
{
  TriangleMesh loose = example::tube(0.0, 0.0, 0.5, -3.0, 4.0, 24, 40);
  loose.points.insert(loose.points.begin() + 50, Eigen::Vector3d(7.0, -8.0, 99.0)); // without triangles
  for (auto& t : loose.triangles)
  {
    for (std::int32_t& corner : t)
    {
      corner += corner >= 50 ? 1 : 0;
    }
  }
  TriangleMesh pointsOnly;
  pointsOnly.points = { { 1.0, 2.0, 3.0 }, { 1.0, 2.0, -3.0 } };
  const TriangleMesh shortPoints = inSinglePrecision(shuffled(example::tube(1.0, 2.0, 0.6, -20.0, 21.0, 24, 160, 0.2), 6));
  TriangleMesh someShort = shortPoints; // like caps on a face that is no such number
  for (Eigen::Vector3d& point : someShort.points)
  {
    point[2] = point[2] > 20.5 ? 20.6 : point[2];
  }
  const TriangleMesh hugeNumbers = example::tetrahedron({ 1e300, 1e-300, 2.0 }, 1e299);
  const std::vector<std::pair<std::string, TriangleMesh>> surfaces{
    { "nothing", {} },
    { "points alone", pointsOnly },
    { "one layer", example::tetrahedron({ -0.5, 1.0, 2.0 }, 0.25) },
    { "a tube", example::tube(1.0, 2.0, 0.6, -20.0, 21.0, 24, 160) },
    { "in disorder", shuffled(example::tube(1.0, 2.0, 0.6, -20.0, 21.0, 24, 160, 0.2), 3) },
    { "triangles through all", example::both(example::tube(0.0, 0.0, 0.5, -20.0, 20.0, 24, 1),
                                 shuffled(example::tube(9.0, 0.0, 0.5, -20.0, 20.0, 24, 99), 4)) },
    { "flat", example::both(example::tube(0.0, 0.0, 0.5, 3.0, 3.0, 40, 12), example::tube(2.0, 0.0, 0.5, 3.0, 3.0, 40, 12)) },
    { "with a loose point", loose },
    { "in single precision", shortPoints },
    { "some of it in single precision", someShort },
    { "numbers beyond single precision", hugeNumbers },
    { "a layer of many points", example::tube(0.0, 0.0, 0.5, 0.0, 0.9, 700, 100) },
  };
  for (const auto& [name, surface] : surfaces)
  {
    writeSurface(this->path, own, surface);
    expectSame(readSurface(this->path, own), surface, name);
    std::vector<std::pair<double, double>> ranges{ { -infinite, infinite }, { -infinite, 0.0 }, { 0.0, infinite },
      { 500.0, 600.0 }, { -600.0, -500.0 }, { 3.0, 3.0 } };
    for (double z = -22.0; z < 23.0; z += 1.7)
    {
      ranges.emplace_back(z, z + 0.3);
      ranges.emplace_back(z, z + 10.02);
    }
    for (const auto& [lower, upper] : ranges)
    {
      const SurfacePart wanted = cutOut(surface, lower, upper);
      const SurfacePart found = readSurfacePart(this->path, own, lower, upper);
      const std::string what = name + " from " + std::to_string(lower) + " to " + std::to_string(upper);
      expectSame(found.mesh, wanted.mesh, what);
      EXPECT_EQ(found.pointOf, wanted.pointOf) << what;
    }
  }
}

// Like the surfaces of fibres: 75 triangles per µm and in single precision, in files of some 14 bytes per triangle.
TEST_F(SurfaceFile, TakesLittleRoomAndLittleReading)
{
  if (bytesRead() == 0)
  {
    GTEST_SKIP() << "this system does not count what is read";
  }
  for (const int length : { 50, 500, 5000 })
  {
    const TriangleMesh surface = inSinglePrecision(shuffled(example::tube(0.0, 0.0, 0.65, 0.0, length, 12, 3 * length), 5));
    writeSurface(this->path, own, surface);
    const auto bytes = static_cast<double>(contentOf(this->path).size());
    EXPECT_LT(bytes / double(surface.triangles.size()), 16.0);
    EXPECT_LT(double(bytesReadBy([&] { readSurface(this->path, own); })), 1.01 * bytes + 4096.0);
    double read = 0.0;
    for (int z = 0; z < length; z += 10)
    {
      read += double(bytesReadBy([&] { readSurfacePart(this->path, own, z - 0.02, z + 10.02); }));
    }
    EXPECT_LT(read, 1.5 * bytes) << length << " µm, slab by slab";
  }
}

TEST_F(SurfaceFile, FindsDamage)
{
  const TriangleMesh surface = example::tube(0.0, 0.0, 0.6, 0.0, 20.0, 12, 90);
  writeSurface(this->path, own, surface);
  const std::string whole = contentOf(this->path);
  ASSERT_GT(whole.size(), 20000u);
  const auto isRefused = [&](const std::string& content)
  {
    replaceContent(this->path, content);
    EXPECT_THROW(
      {
        const SurfacePart part = readSurfacePart(this->path, own, 5.0, 7.0);
        const SurfacePart wanted = cutOut(surface, 5.0, 7.0);
        // Damage elsewhere does not matter for it.
        EXPECT_EQ(part.mesh.points, wanted.mesh.points);
        EXPECT_EQ(part.mesh.triangles, wanted.mesh.triangles);
        readSurface(this->path, own);
      },
      FileError);
  };
  for (std::size_t at = 0; at < whole.size(); at += 1 + at / 500)
  {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ (1 << at % 8));
    isRefused(damaged);
  }
  for (std::size_t length = 0; length < whole.size(); length += 1 + length / 40)
  {
    isRefused(whole.substr(0, length));
    EXPECT_THROW(readSurfacePart(this->path, own, 5.0, 7.0), FileError) << "cut to " << length;
  }
  isRefused(whole + '\0');
  isRefused(whole + whole);
  isRefused(whole.substr(0, 100) + whole.substr(200));
  // A layer's damage is found where the layer is read.
  std::string damaged = whole;
  for (std::size_t at = 3000; at < 16000; at += 500)
  {
    damaged[at] ^= 1;
  }
  replaceContent(this->path, damaged);
  EXPECT_THROW(readSurfacePart(this->path, own, 5.0, 7.0), FileError);
}

TEST_F(SurfaceFile, IsOfItsOwner)
{
  const TriangleMesh surface = example::tube(0.0, 0.0, 0.6, 0.0, 20.0, 12, 90);
  writeSurface(this->path, own, surface);
  for (const SurfaceFileOwner& other : { SurfaceFileOwner{ own.fingerprint, 8 }, SurfaceFileOwner{ own.fingerprint + 1, 7 } })
  {
    EXPECT_THROW(readSurface(this->path, other), FileError);
    EXPECT_THROW(readSurfacePart(this->path, other, 0.0, 1.0), FileError);
  }
  const std::string before = contentOf(this->path);
  EXPECT_THROW(writeSurface(this->path, { own.fingerprint + 1, 7 }, {}), FileError);
  EXPECT_EQ(contentOf(this->path), before);
  writeSurface(this->path, own, {});
  EXPECT_TRUE(readSurface(this->path, own).points.empty());
  replaceContent(this->path, "my thesis");
  EXPECT_THROW(writeSurface(this->path, own, surface), FileError);
  EXPECT_EQ(contentOf(this->path), "my thesis");
  EXPECT_THROW(readSurface(cactus_testing::scratchPath("nowhere"), own), FileError);
}

} // namespace
