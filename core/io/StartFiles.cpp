// SPDX-License-Identifier: BSD-3-Clause
#include "io/StartFiles.h"

#include "base/Numbers.h"
#include "io/CombinedSurfaces.h"
#include "judge/StartPositions.h"

namespace cactus
{

namespace
{

constexpr int digits = 9;

/// Returns the simulator's lengths per µm.
double unitOf(SubstrateFormat format)
{
  switch (format)
  {
  case SubstrateFormat::Mcdc:
    return 1e-3;
  case SubstrateFormat::Reference:
  case SubstrateFormat::Surfaces:
  case SubstrateFormat::Bundles:
  case SubstrateFormat::Mcmr:
    return 1.0;
  default:
    return 1e-6;
  }
}

std::string pointsText(const std::vector<Eigen::Vector3d>& points, const SurfaceBox& box, double unit)
{
  std::string text;
  for (const Eigen::Vector3d& point : points)
  {
    if ((point - box.lower).minCoeff() < 0.0 || (box.upper - point).minCoeff() < 0.0)
    {
      continue;
    }
    for (int axis = 0; axis < 3; ++axis)
    {
      appendNumber(text, unit * (point[axis] - box.origin[axis]), digits);
      text += axis < 2 ? ' ' : '\n';
    }
  }
  return text;
}

/// In the boxes of these simulations, and, where there is none, in the domain.
StartPositions drawFor(const std::vector<McdcSimulation>& simulations, const SubstrateFolderContents& contents, std::size_t count,
  const Context& context)
{
  // The seed is a choice of those who ask for StartPositions.
  const std::uint64_t seed = contents.startPositions > 0 ? contents.seed : SubstrateFolderContents().seed;
  const auto draw = [&](const Domain& box, const StartCounts& counts)
  { return drawStartPositions(box, contents.outer, contents.inner, counts, seed, context); };
  if (simulations.empty())
  {
    return draw(contents.domain, { count, count, count });
  }
  StartPositions points = draw(contents.domain, { 0, count, 0 });
  for (const McdcSimulation& simulation : simulations)
  {
    if (simulation.compartment == "intra")
    {
      points.intra = draw(simulation.start, { count, 0, 0 }).intra;
    }
    else
    {
      points.extra = draw(simulation.start, { 0, 0, count }).extra;
    }
  }
  return points;
}

} // namespace

void writeStartPositions(const SubstrateFolderContents& contents, const std::vector<McdcSimulation>& simulations,
  FolderWriter& writer, const Context& context)
{
  const int count = startPointCount(contents);
  if (count == 0)
  {
    return;
  }
  const StartPositions points = drawFor(simulations, contents, static_cast<std::size_t>(count), context);
  SurfaceBox around; // of everything
  around.lower = contents.domain.lower;
  around.upper = contents.domain.upper;
  const bool isDisimpy = contents.format == SubstrateFormat::Disimpy;
  const auto boxOf = [&](const FibreSurfaces& surfaces) { return isDisimpy ? surfaceBox(surfaces, context) : around; };
  const double unit = unitOf(contents.format);
  writer.makeFolder("start");
  writer.write(
    "start/intra.txt", pointsText(points.intra, boxOf(contents.inner.size() > 0 ? contents.inner : contents.outer), unit));
  if (!points.myelin.empty())
  {
    writer.write("start/myelin.txt", pointsText(points.myelin, boxOf(contents.outer), unit));
  }
  if (!points.extra.empty())
  {
    writer.write("start/extra.txt", pointsText(points.extra, boxOf(contents.outer), unit));
  }
}

} // namespace cactus
