// SPDX-License-Identifier: BSD-3-Clause
#include "io/McdcFiles.h"

#include "base/Error.h"
#include "io/StartFiles.h"
#include "judge/ExtraAxonalWalk.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace cactus
{

namespace
{

/// The part of free walkers that may leave before a walk among the fibres is needed.
constexpr double hardlyAny = 0.01;
/// The part of walkers outside that may leave without a warning.
constexpr double bearable = 0.05;
constexpr std::uint64_t walkSeed = 1;

/// Those in which walkers inside start.
const char* innermost(const SubstrateFolderContents& contents)
{
  return contents.inner.size() > 0 ? "inner" : "outer";
}

/// Radius (µm) of the narrowest of these surfaces, taken for cylinders: twice the volume over the area.
double smallestRadius(const std::vector<SubstrateFile>& files, const std::string& surface)
{
  double smallest = std::numeric_limits<double>::infinity();
  for (const SubstrateFile& file : files)
  {
    if (file.surface == surface && file.area > 0.0)
    {
      smallest = std::min(smallest, 2.0 * std::abs(file.volume) / file.area);
    }
  }
  return smallest;
}

std::string percent(double share)
{
  return text(std::lround(100.0 * share), " %");
}

/// To two digits, downwards or upwards.
double rounded(double value, double (*direction)(double))
{
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - 1.0);
  return unit * direction(value / unit);
}

/// What would do where too many walkers leave; nothing where few do. Distances in space that walkers reach go with the root of
/// time, so that a substrate that is wider by some factor holds them for the square of it.
std::string leavingRemark(const LeavingWalkers& leaving, const McdcOptions& options, const Domain& domain)
{
  if (leaving.share() <= bearable)
  {
    return "";
  }
  // What free walkers have moved when one too many leaves.
  const auto borne = static_cast<std::size_t>(std::floor(bearable * double(leaving.early)));
  const double distance = borne < leaving.distances.size() ? leaving.distances[borne] : leaving.until;
  const double wider = options.displacement() / distance;
  const double milliseconds = 1e3 * options.echoTime / (wider * wider);
  return text(percent(leaving.share()), " of the walkers of mcdc/extra.conf leave the substrate within its ",
    1e3 * options.echoTime, " ms, and beyond it water is free, so that their signal is not that of the substrate (a walk of ",
    leaving.walkers, " walkers outside the fibres): for at most ", percent(bearable), ", shorten duration to ",
    rounded(milliseconds, std::floor), " ms, with timings in mcdc/pgse.scheme to match, or make the substrate ",
    rounded(wider, std::ceil), " times as wide (", rounded(wider * domain.size().minCoeff(), std::ceil),
    " µm along its shortest side), or one that nobody leaves (Border Periodic in BundleInitializer)");
}

void noteLeaving(
  const SubstrateFolderContents& contents, const McdcSimulation& outside, WrittenSubstrate& substrate, const Context& context)
{
  const double free = freeLeavingShare(contents.domain, outside.start, contents.mcdc.displacement());
  substrate.leaving = LeavingShare{ free, 0 };
  if (free < hardlyAny)
  {
    return;
  }
  try
  {
    const LeavingWalkers leaving =
      walkUntilLeaving(contents.domain, outside.start, contents.outer, contents.mcdc.displacement(), walkSeed, context);
    if (leaving.walkers == 0)
    {
      substrate.leaving.reset();
      substrate.remarks.push_back(
        "there is no room outside the fibres in the middle of the substrate for walkers of mcdc/extra.conf to start from");
      return;
    }
    substrate.leaving = LeavingShare{ leaving.share(), leaving.walkers };
    const std::string remark = leavingRemark(leaving, contents.mcdc, contents.domain);
    if (!remark.empty())
    {
      substrate.remarks.push_back(remark);
    }
  }
  catch (const OutOfMemory& error)
  {
    substrate.remarks.push_back(text("how many walkers of mcdc/extra.conf leave the substrate is not known, but ", percent(free),
      " of free ones would, which is the most: ", error.what()));
  }
}

} // namespace

std::vector<McdcSimulation> mcdcSimulations(const SubstrateFolderContents& contents, const std::vector<SubstrateFile>& files)
{
  std::vector<McdcSimulation> simulations{ intraSimulation(
    contents.mcdc, contents.domain, contents.periodicFaces == PeriodicFaces::Open, smallestRadius(files, innermost(contents))) };
  if (contents.outer.size() > 0)
  {
    simulations.push_back(extraSimulation(contents.mcdc, contents.domain));
  }
  for (McdcSimulation& simulation : simulations)
  {
    simulation.startPositions = startPointCount(contents);
  }
  return simulations;
}

void writeMcdc(const SubstrateFolderContents& contents, const std::vector<McdcSimulation>& simulations,
  WrittenSubstrate& substrate, FolderWriter& writer, const Context& context)
{
  writer.makeFolder("mcdc");
  writer.makeFolder("mcdc/output");
  writer.write("mcdc/pgse.scheme", mcdcScheme(contents.mcdc));
  for (const McdcSimulation& simulation : simulations)
  {
    const bool isExtra = simulation.compartment == "extra";
    std::vector<std::string> paths;
    bool areClosed = true;
    for (const SubstrateFile& file : substrate.files)
    {
      if (file.surface == (isExtra ? "outer" : innermost(contents)))
      {
        paths.push_back(file.path);
        areClosed = areClosed && (file.closed || contents.periodicFaces == PeriodicFaces::Open);
      }
    }
    const std::string start = "mcdc/" + simulation.compartment;
    writer.write(start + "_ply_list.txt", mcdcPlyList(paths, contents.mcdc.permeability));
    writer.write(start + ".conf", mcdcConfiguration(contents.mcdc, contents.domain, simulation));
    if (isExtra && contents.domain.isPeriodic() && contents.periodicFaces == PeriodicFaces::Caps)
    {
      substrate.remarks.push_back(
        "some walkers of mcdc/extra.conf pass a wall where it ends in the faces across which MC/DC repeats the domain, and where "
        "caps of fibres lie there, too, 1 of 75 ends inside a fibre within 2 ms: choose PeriodicFaces Open, among whose "
        "surfaces "
        "MC/DC notices such walkers and starts others");
    }
    if (isExtra && areClosed)
    {
      noteLeaving(contents, simulation, substrate, context);
    }
  }
}

} // namespace cactus
