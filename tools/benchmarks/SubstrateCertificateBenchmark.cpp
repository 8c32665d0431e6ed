// SPDX-License-Identifier: BSD-3-Clause
// Benchmark of certifying a hexagonal bundle of wavy tubes, 0.05 µm apart, with axons inside; rates are triangles per second and
// thread.
#include "base/Constants.h"
#include "judge/SubstrateCertificate.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace
{

using namespace cactus;

using cactus::pi;

/// A closed tube of triangles with edges of about `edge`, its middle line a wave along z.
TriangleMesh tube(double x, double y, double radius, double lower, double upper, double edge)
{
  const int sides = std::max(8, static_cast<int>(2.0 * pi * radius / edge));
  const int rings = static_cast<int>((upper - lower) / edge);
  TriangleMesh mesh;
  for (int ring = 0; ring <= rings; ++ring)
  {
    const double z = lower + (upper - lower) * ring / rings;
    for (int side = 0; side < sides; ++side)
    {
      const double angle = 2.0 * pi * (side + 0.5 * (ring % 2)) / sides;
      mesh.points.emplace_back(
        x + 0.3 * std::sin(0.4 * z) + radius * std::cos(angle), y + 0.3 * std::cos(0.3 * z) + radius * std::sin(angle), z);
    }
  }
  const auto bottom = static_cast<std::int32_t>(mesh.points.size());
  mesh.points.emplace_back(x + 0.3 * std::sin(0.4 * lower), y + 0.3 * std::cos(0.3 * lower), lower);
  mesh.points.emplace_back(x + 0.3 * std::sin(0.4 * upper), y + 0.3 * std::cos(0.3 * upper), upper);
  for (int side = 0; side < sides; ++side)
  {
    const int next = (side + 1) % sides;
    for (int ring = 0; ring < rings; ++ring)
    {
      const int low = ring * sides;
      const int high = low + sides;
      const bool even = ring % 2 == 0;
      mesh.triangles.push_back({ { low + side, low + next, even ? high + side : high + next } });
      mesh.triangles.push_back({ { even ? low + next : low + side, high + next, high + side } });
    }
    mesh.triangles.push_back({ { bottom, next, side } });
    mesh.triangles.push_back({ { bottom + 1, rings * sides + side, rings * sides + next } });
  }
  return mesh;
}

void certifyBundle(benchmark::State& state)
{
  const auto rows = static_cast<int>(state.range(0));
  Context context;
  context.threads = static_cast<int>(state.range(1));
  const double half = 15.0;
  std::vector<TriangleMesh> meshes[2];
  FibreSurfaces surfaces[2];
  for (int row = 0; row < rows; ++row)
  {
    for (int column = 0; column < rows; ++column)
    {
      const double x = 1.45 * (column + 0.5 * (row % 2));
      const double y = 1.45 * std::sqrt(0.75) * row;
      meshes[0].push_back(tube(x, y, 0.7, -half, half, 0.25));
      meshes[1].push_back(tube(x, y, 0.5, -half + 0.02, half - 0.02, 0.25));
      for (FibreSurfaces& kind : surfaces)
      {
        kind.fibreIds.push_back(rows * row + column + 1);
        kind.bundleIds.push_back(1);
      }
    }
  }
  surfaces[0].mesh = [&meshes](std::size_t i) { return meshes[0][i]; };
  surfaces[1].mesh = [&meshes](std::size_t i) { return meshes[1][i]; };
  std::size_t triangles = 0;
  for (auto _ : state)
  {
    const auto certificate = certify(Domain::cube(1000.0), surfaces[0], surfaces[1], nullptr, {}, context);
    if (!certificate.certified())
    {
      state.SkipWithError(certificate.verdict().c_str());
    }
    triangles += certificate.triangles;
  }
  state.counters["triangles"] = static_cast<double>(triangles) / static_cast<double>(state.iterations());
  state.counters["triangles/s/thread"] =
    benchmark::Counter(static_cast<double>(triangles) / static_cast<double>(context.threads), benchmark::Counter::kIsRate);
}

BENCHMARK(certifyBundle)
  ->ArgNames({ "rows", "threads" })
  ->Args({ 8, 1 })
  ->Args({ 8, 2 })
  ->Unit(benchmark::kMillisecond)
  ->UseRealTime();

} // namespace
