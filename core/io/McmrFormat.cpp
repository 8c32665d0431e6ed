// SPDX-License-Identifier: BSD-3-Clause
#include "base/Numbers.h"
#include "io/FolderFormat.h"
#include "io/McmrGeometry.h"

namespace cactus
{

namespace
{

/// Which walkers MCMRSimulator.jl is asked for, and what the numbers mean.
struct McmrSubsets
{
  std::string subsets;
  std::string meaning;
};

McmrSubsets mcmrSubsets(const SubstrateFolderContents& contents, bool hasBare)
{
  if (contents.inner.size() == 0 || contents.outer.size() == 0)
  {
    return { "Subset(inside=1), Subset(inside=0)", "1 in a fibre, 0 outside the fibres" };
  }
  if (!hasBare)
  {
    return { "Subset(inside=2), Subset(inside=1), Subset(inside=0)", "2 in an axon, 1 in myelin, 0 outside the fibres" };
  }
  return {
    "Subset(inside=true, geometry_index=2), Subset(inside=0)",
    "1 in myelin and in an axon without myelin, whose wall is\nin the second Mesh, that of the axons, alone; 0 outside the fibres"
  };
}

/// How MCMRSimulator.jl is run here.
std::string mcmrText(const SubstrateFolderContents& contents, bool hasBare)
{
  const McmrSubsets asked = mcmrSubsets(contents, hasBare);
  const Domain box = mcmrBox(contents.domain);
  const double step = 1e-6 * longestStep; // m
  const double milliseconds = 1e3 * step * step / (6.0 * contents.mcdc.diffusivity);
  return std::string("geometry.json   the geometry for MCMRSimulator.jl (git.fmrib.ox.ac.uk/ndcn0236/mcmrsimulator.jl): a Mesh "
                     "of all outer\n"
                     "                surfaces, one of all inner ones, and ") +
         (contents.domain.periodic[2]
             ? "repeats after the sides of the domain and 0.2 nm,\n                so that no two caps are in one plane\n\n"
           : contents.domain.isPeriodic() ? "repeats along x and y, and Walls across z, as walkers would leave it else\n\n"
                                          : "Walls at the faces of the domain, as walkers would leave it else\n\n") +
         "In Julia, in this folder, with a sequence of your own:\n\n"
         "    using MCMRSimulator\n"
         "    geometry = read_geometry(\"geometry.json\")\n"
         "    simulation = Simulation(read_pulseq(\"FILE.seq\"); geometry=geometry, diffusivity=" +
         text(1e9 * contents.mcdc.diffusivity) + ", timestep=" + text(milliseconds) +
         ")\n"
         "    box = BoundingBox([" +
         numberWords(box.lower, ", ") + "], [" + numberWords(box.upper, ", ") +
         "])\n"
         "    signals = readout(" +
         std::to_string(contents.mcdc.walkers) + ", simulation; bounding_box=box, subset=[" + asked.subsets + "])\n\n" +
         "inside= is the number of surfaces that a walker is in: " + asked.meaning +
         ". Walkers start all over the box, so that\n"
         "signals are weighted by volume. Take the signal of myelin for what the tissue has: none, where its T2 is short.\n"
         "timestep is in ms, and makes steps of " +
         text(longestStep) + " µm: outside, longer ones slow diffusion down.\n";
}

/// MCMRSimulator.jl: its geometry file, beside a PLY file per surface.
class McmrFormat : public FolderFormat
{
public:
  bool mayBeBinary() const override { return true; }

  void writeOwnFiles(const SubstrateFolderContents& contents, WrittenSubstrate& /*substrate*/, FolderWriter& writer,
    const Context& context) const override
  {
    writeMcmrGeometry(contents, writer, context);
  }

  Domain startDomain(const Domain& domain) const override { return mcmrBox(domain); }

  std::string readme(const SubstrateFolderContents& contents, const WrittenSubstrate& substrate) const override
  {
    return mcmrText(contents, substrate.certificate.bare > 0);
  }
};

} // namespace

const FolderFormat& mcmrFormat()
{
  static const McmrFormat format;
  return format;
}

} // namespace cactus
