// SPDX-License-Identifier: BSD-3-Clause
#include "io/StartFiles.h"

#include "base/Numbers.h"
#include "io/FolderFormat.h"
#include "judge/StartPositions.h"

namespace cactus
{

namespace
{

constexpr int digits = 9;

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

/// In the boxes of these simulations, and, where there is none, in the format's start domain.
StartPositions drawFor(const std::vector<McdcSimulation>& simulations, const SubstrateFolderContents& contents, std::size_t count,
  const Context& context)
{
  // The seed is a choice of those who ask for StartPositions.
  const std::uint64_t seed = contents.startPositions > 0 ? contents.seed : SubstrateFolderContents().seed;
  const auto draw = [&](const Domain& box, const StartCounts& counts)
  { return drawStartPositions(box, contents.outer, contents.inner, counts, seed, context); };
  if (simulations.empty())
  {
    return draw(formatOf(contents.format).startDomain(contents.domain), { count, count, count });
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

int startPointCount(const SubstrateFolderContents& contents)
{
  return contents.startPositions == 0 && formatOf(contents.format).needsStartPositions(contents) ? contents.mcdc.walkers
                                                                                                 : contents.startPositions;
}

void writeStartPositions(const SubstrateFolderContents& contents, const std::vector<McdcSimulation>& simulations,
  FolderWriter& writer, const Context& context)
{
  const int count = startPointCount(contents);
  if (count == 0)
  {
    return;
  }
  const StartPositions points = drawFor(simulations, contents, static_cast<std::size_t>(count), context);
  const FolderFormat& format = formatOf(contents.format);
  const auto boxOf = [&](const FibreSurfaces& surfaces) { return format.startBox(surfaces, contents.domain, context); };
  const double unit = format.startUnit();
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
