// SPDX-License-Identifier: BSD-3-Clause
#include "base/Numbers.h"
#include "io/FolderFormat.h"
#include "io/McdcFiles.h"
#include "io/StartFiles.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace cactus
{

namespace
{

/// What permeable surfaces mean to MC/DC.
std::string permeableText(double permeability, bool hasInner)
{
  std::string text = "Surfaces are permeable: " + cactus::text(permeability) +
                     " of the hits on a surface lead through it. The last number of each line in\n"
                     "mcdc/*_ply_list.txt is that of its surface, to be edited; 0 lets nobody through. Leave out a line "
                     "`permeability` in a .conf:\n"
                     "MC/DC would take its number for all surfaces, whatever the lists say. `deportation 0` is needed, or MC/DC "
                     "throws out walkers\n"
                     "that have crossed, as errors of its own.\n";
  if (hasInner)
  {
    text +=
      "intra.conf has inner surfaces alone: a walker that goes through one of them is outside, in water that takes the place of\n"
      "myelin and extra-axonal space alike, up to the next inner surface. There is neither myelin nor an outer wall in its "
      "way.\n";
  }
  text += hasInner
            ? "extra.conf has outer surfaces alone: a walker that goes through one of them is in a fibre without an inner wall.\n"
            : "intra.conf and extra.conf have the same surfaces, and differ in where walkers start.\n";
  return text + '\n';
}

/// How many walkers leave the substrate.
std::string leavingText(const std::optional<LeavingShare>& leaving, double echoTime)
{
  const std::string time = cactus::text(1e3 * echoTime) + " ms";
  if (!leaving)
  {
    return "How many walkers of extra.conf leave the substrate within its " + time + " is not known.\n";
  }
  const std::string share = cactus::text(0.1 * std::round(1000.0 * leaving->share)) + " %";
  return leaving->walkers == 0 ? "Fewer than " + cactus::text(std::max(0.1, 0.1 * std::ceil(1000.0 * leaving->share))) +
                                   " % of the walkers of extra.conf leave the substrate within its " + time +
                                   ": free ones would not leave more often.\n"
                               : share + " of the walkers of extra.conf leave the substrate within its " + time +
                                   ", by a walk of " + std::to_string(leaving->walkers) + " walkers.\n";
}

/// How MC/DC is run here.
std::string mcdcText(const SubstrateFolderContents& contents, const WrittenSubstrate& substrate)
{
  const bool hasInner = contents.inner.size() > 0;
  const bool hasOuter = contents.outer.size() > 0;
  std::string text = "mcdc/           configurations for the MC/DC simulator (github.com/jonhrafe/MCDC_Simulator_public)\n\n";
  text += "To simulate, start MC/DC in this folder; it looks for all files from where it is started:\n\n";
  text += "    MC-DC_Simulator --conf mcdc/intra.conf\n";
  if (hasOuter)
  {
    text += "    MC-DC_Simulator --conf mcdc/extra.conf\n";
  }
  text +=
    "\nMC/DC before December 2024 takes the file without --conf, where later ones end without a word.\n"
    "The signals come to mcdc/output/.\n"
    "Writing the substrate again replaces the surfaces and all else that is as it was written. Where you have changed or added\n"
    "anything (results, a .conf, notes), the writer refuses and says what: move it away, or write to another folder.\n\n";
  text += std::string("intra.conf  walkers inside the ") + (hasInner ? "inner" : "outer") + " surfaces\n";
  if (hasOuter)
  {
    text += "extra.conf  walkers outside the outer surfaces\n";
  }
  text +=
    "\nMyelin has no walkers: MC/DC knows the inside and the outside of a surface, and no third compartment. For the signal of\n"
    "both, divide each by its number of walkers and weight it with its compartment's share of the domain (manifest.json): "
    "inside,\n"
    "the volume of the surfaces used over the domain's; outside, 1 - outer_volume_um3 over the domain's.\n\n";
  if (contents.mcdc.permeability > 0.0)
  {
    text += permeableText(contents.mcdc.permeability, hasInner);
  }
  if (hasOuter)
  {
    text += leavingText(substrate.leaving, contents.mcdc.echoTime) +
            "Outside the substrate water is free, and a walker there no longer tells of the substrate. A shorter duration, a\n"
            "larger substrate or a periodic one (Border Periodic) keeps them in.\n\n";
  }
  text +=
    contents.periodicFaces == PeriodicFaces::Open && contents.domain.periodic[2]
      ? "Axons go on through the faces. Keep ini_walkers_file: for ini_walkers_pos MC/DC counts walls along a line, and takes "
        "the\n"
        "inside of open surfaces for the outside.\n\n"
      : "Axons end in closed caps at the boundary, which reflect. So nobody leaves them, but along an axon walkers go no farther "
        "than\n"
        "its ends: in times in which they get there, diffusion along it comes out slower than in an axon that goes on.\n\n";
  text +=
    "What to edit: N (walkers) and num_process first, and pgse.scheme. After a change of duration or diffusivity, change T, too: "
    "a\n"
    "step, the root of 6 diffusivity duration / T, stays below 0.05 micrometres outside, and below the smallest radius (at most\n"
    "0.3) inside. ";
  text += startPointCount(contents) > 0
            ? "Walkers start from the points in start/, one each; where N is larger than the number of lines, MC/DC takes\n"
              "points again from the first. "
            : "Walkers start in <spawning_area> (mm), off the substrate's boundary. ";
  text += contents.domain.isPeriodic()
            ? "<voxels> ends with the substrate where that\n"
              "repeats, as MC/DC continues a walker that leaves it on the opposite side.\n"
            : "<voxels> is wider than the substrate, because\n"
              "MC/DC continues a walker that leaves it on the opposite side, where there is another fibre.\n";
  return text;
}

/// MC/DC: configurations that run as written, beside a PLY file per surface.
class McdcFormat : public FolderFormat
{
public:
  bool mayBeOpen() const override { return true; }
  double startUnit() const override { return 1e-3; }

  /// A walker that MC/DC has placed inside meets the walls of its own axon alone; those who can get out of it have to start from
  /// a file. So have walkers among open surfaces, which do not tell it what is inside.
  bool needsStartPositions(const SubstrateFolderContents& contents) const override
  {
    return contents.mcdc.permeability > 0.0 || contents.periodicFaces == PeriodicFaces::Open;
  }

  std::vector<McdcSimulation> startSimulations(
    const SubstrateFolderContents& contents, const std::vector<SubstrateFile>& files) const override
  {
    return mcdcSimulations(contents, files);
  }

  void writeOwnFiles(const SubstrateFolderContents& contents, WrittenSubstrate& substrate, FolderWriter& writer,
    const Context& context) const override
  {
    // Surfaces are written, and progress does not go back.
    writeMcdc(contents, mcdcSimulations(contents, substrate.files), substrate, writer, context.part(1.0, 1.0));
  }

  std::string readme(const SubstrateFolderContents& contents, const WrittenSubstrate& substrate) const override
  {
    return mcdcText(contents, substrate);
  }
};

} // namespace

const FolderFormat& mcdcFormat()
{
  static const McdcFormat format;
  return format;
}

} // namespace cactus
