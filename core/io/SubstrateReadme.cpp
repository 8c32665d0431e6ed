// SPDX-License-Identifier: BSD-3-Clause
#include "io/SubstrateReadme.h"

#include "base/Error.h"
#include "base/Numbers.h"
#include "io/CombinedSurfaces.h"
#include "io/McmrGeometry.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace cactus
{

namespace
{

constexpr double inMetres = 1e-6; ///< of one µm

/// µm: steps outside the fibres that are longer make diffusion there too slow, see docs/simulators/mcdc.md.
constexpr double longestStep = 0.05;

/// Numbers that words of a command are made of, with blanks between them.
std::string numberWords(const Eigen::Vector3d& values, const char* between = " ")
{
  std::string text;
  for (int axis = 0; axis < 3; ++axis)
  {
    text += axis > 0 ? between : "";
    appendNumber(text, values[axis], 9);
  }
  return text;
}

/// The commands for Camino, which repeats the substrate: see caminoSpacing.
std::string caminoText(const SubstrateFolderContents& contents)
{
  constexpr double stepInside = 0.1; // µm
  const McdcOptions& run = contents.mcdc;
  const auto command = [&](const std::string& where, const std::string& kind, double micrometres)
  {
    const double step = inMetres * micrometres;
    const auto steps = std::llround(6.0 * run.diffusivity * run.echoTime / (step * step));
    return "    datasynth -walkers " + std::to_string(run.walkers) + " -tmax " + std::to_string(steps) +
           " -p 0 -voxels 1 -initial " + where + " -diffusivity " + text(run.diffusivity) +
           " \\\n      -substrate ply -plyfile " + kind + ".ply -meshsep " +
           numberWords(inMetres * (contents.domain.size().array() + caminoSpacing).matrix()) +
           " \\\n      -voxelsizefrac 1 -schemefile pgse.scheme > " + where + ".bfloat\n";
  };
  return "outer.ply, inner.ply   all outer, and all inner, surfaces, in metres (Camino)\n"
         "pgse.scheme     the acquisition of MC/DC's folders, in Camino's format\n\n" +
         command("intra", contents.inner.size() > 0 ? "inner" : "outer", stepInside) +
         (contents.outer.size() > 0 ? command("extra", "outer", longestStep) : "") +
         "\nThe signal is a big-endian 32-bit number for each line of pgse.scheme: the sum of cos(phase) over the walkers. -tmax "
         "is\n"
         "the number of steps. They are " +
         text(stepInside) + " µm long inside, where a fifth of an axon's radius will do, and " + text(longestStep) +
         " µm outside, where longer ones\nslow diffusion down. -meshsep is the distance of repeats: the sides of the domain "
         "and " +
         text(caminoSpacing) +
         " µm, as\nCamino stops (\"has crossed\") where repeats touch. With -p 0 it tests each walker against all triangles "
         "after each "
         "step,\nwhich takes most of its time: -p 1e-20 leaves that out, and walls let as few walkers through.\n";
}

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
  const double step = inMetres * longestStep;
  const double milliseconds = 1e3 * step * step / (6.0 * contents.mcdc.diffusivity);
  return std::string("geometry.json   the geometry for MCMRSimulator.jl (git.fmrib.ox.ac.uk/ndcn0236/mcmrsimulator.jl): a Mesh "
                     "of all outer\n"
                     "                surfaces, one of all inner ones, and ") +
         (contents.domain.periodic[2]     ? "repeats after the sides of the domain\n\n"
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

/// What stands in a folder besides what all have, and how it is used.
std::string filesFor(const SubstrateFolderContents& contents, bool hasBare)
{
  switch (contents.format)
  {
  case SubstrateFormat::Reference:
    return "optimized_final.txt, meshes/simulations/   as the reference program leaves them, in micrometres\n\n"
           "    from dmipy_sim.io.cactus import load_cactus_bundle\n"
           "    bundle = load_cactus_bundle('.', volume_reference='box')\n";
  case SubstrateFormat::Camino:
    return caminoText(contents);
  case SubstrateFormat::Mcmr:
    return mcmrText(contents, hasBare);
  case SubstrateFormat::Rms:
    return "intra/, extra/  simulations for RMS (extra/ where the labels hold it): fiber.txt holds the labels of the voxels (1: "
           "walkers), simParamInput.txt their\n"
           "                size and numbers, the time step and how many "
           "(github.com/NYU-DiffusionMRI/monte-carlo-simulation-3D-RMS)\n\n"
           "    cd intra && cp .../hpc_code/lib/main.cu . && nvcc main.cu -o main_cuda && ./main_cuda\n";
  case SubstrateFormat::Surfaces:
    return "";
  case SubstrateFormat::Bundles:
    return "\nIn a file fibres follow each other by their ids, each with the triangles that manifest.json tells of it.\n";
  case SubstrateFormat::SpinDoctor:
    return "substrate_dir/  all surfaces and the faces of the domain as one complex of triangles, in micrometres\n"
           "compartments.csv   which compartment is which fibre's, with its volume\n\n"
           "    tetgen -pqA substrate_dir/substrate_mesh.poly   (any finite elements)\n\n"
           "setup_substrate.m, substrate_cells   for SpinDoctor (github.com/SpinDoctorMRI/SpinDoctor), in MATLAB, in its "
           "folder:\n\n"
           "    addpath(genpath('src')); run('.../setup_substrate.m')\n"
           "    setup.pde = prepare_pde(setup); setup = prepare_experiments(setup);\n"
           "    femesh = create_geometry(setup);\n";
  default:
    return std::string(
             "outer_vertices.npy, outer_faces.npy, inner_...   all outer, and all inner, surfaces, in metres, with their box's "
             "lower\n"
             "corner at the origin (Disimpy)\n\n"
             "    vertices, faces = numpy.load('inner_vertices.npy'), numpy.load('inner_faces.npy')\n"
             "    substrate = disimpy.substrates.mesh(vertices, faces, periodic=False, init_pos='intra')\n") +
           (contents.domain.periodic[2]
               ? "\nOutside the fibres: outer_vertices.npy, outer_faces.npy, periodic=True, init_pos='extra'.\n"
               : "");
  }
}

/// Returns the description of the substrate, and whether it is certified.
std::string headText(const SubstrateFolderContents& contents, const SubstrateCertificate& certificate)
{
  const bool hasInner = contents.inner.size() > 0;
  const bool hasOuter = contents.outer.size() > 0;
  const std::string count = std::to_string(std::max(contents.outer.size(), contents.inner.size()));
  std::string text =
    (contents.sample ? "A sample, " + count + " of the " + std::to_string(contents.sample->fibres) + " fibres of a substrate"
                     : "A substrate of " + count + " fibres") +
    (hasInner ? "" : " without inner surfaces") + (hasOuter ? "" : " without outer surfaces") +
    ", written by CACTUS " CACTUS_VERSION ".\n\n";
  const std::string scope = certificate.scope();
  const std::string closed =
    contents.periodicFaces == PeriodicFaces::Open ? "closed but for the domain's periodic faces" : "closed";
  text += certificate.certified() ? "CERTIFIED" + (scope.empty() ? "" : " " + scope) + ": every surface is " + closed +
                                      ", no two meet, and no walker can leak (certificate.csv).\n\n"
                                  : "NOT CERTIFIED (certificate.csv):\n\n";
  for (const std::string& fault : certificate.faults)
  {
    text += "  - " + fault + "\n";
  }
  text += certificate.certified() ? "" : "\n";
  if (certificate.bare > 0)
  {
    text +=
      std::to_string(certificate.bare) +
      " of the fibres are axons without myelin. One surface bounds each: its outer surface and its inner one are the same,\n"
      "so that it is an axon where inner surfaces are used, and an obstacle where outer ones are. Do not use both at once.\n\n";
  }
  if (contents.domain.isPeriodic())
  {
    text +=
      std::string("It repeats along x") + (contents.domain.periodic[2] ? ", y and z" : " and y") +
      " after the sides of its domain (manifest.json): copies side by side are one tissue, in which surfaces fit together at\n"
      "the faces, point by point. " +
      (contents.periodicFaces == PeriodicFaces::Open
          ? "Surfaces are open there: their copies join to endless ones, so that walkers outside and inside\n"
            "the fibres see endless tissue in a simulator that repeats the domain. Without repeats walkers leak, and inside and\n"
            "outside cannot be told by counting walls along a line. What was checked are the same surfaces with a cap on each\n"
            "piece (PeriodicFaces Caps). Volumes in manifest.json are with caps, triangles and areas without.\n\n"
          : "Each piece of a fibre is closed by a cap there. So walkers outside the fibres see endless\n"
            "tissue in a simulator that repeats the domain, and those inside a fibre stay in its piece.\n\n");
  }
  if (contents.sample)
  {
    text +=
      "The other fibres are in their places, and have no surfaces here: space between the surfaces is not extra-axonal space.\n"
      "With all of them, fibres would fill about " +
      cactus::text(0.001 * std::round(1000.0 * certificate.fibreVolumeFraction / contents.sample->share)) + " of the domain.\n\n";
  }
  return text;
}

/// Tells whether each surface has its own file below outer and inner.
bool hasFilePerSurface(SubstrateFormat format)
{
  return format == SubstrateFormat::Mcdc || mayBeBinary(format);
}

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
            "Outside the substrate water is free, and a walker there no longer tells of the substrate. A shorter duration or a\n"
            "larger substrate keeps them in.\n\n";
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

} // namespace

std::string readmeText(const SubstrateFolderContents& contents, const WrittenSubstrate& substrate)
{
  const bool hasInner = contents.inner.size() > 0;
  const bool hasOuter = contents.outer.size() > 0;
  std::string text = headText(contents, substrate.certificate);
  for (const std::vector<std::string>& sentences : { substrate.remarks, substrate.notes })
  {
    for (const std::string& sentence : sentences)
    {
      text += sentence + ".\n\n";
    }
  }
  text += "manifest.json   what this is, how it was made, and every surface with its fibre, bundle, volume and area\n";
  const bool isVolume = contents.format == SubstrateFormat::Rms || contents.format == SubstrateFormat::SpinDoctor;
  if (startPointCount(contents) > 0 && !isVolume)
  {
    text += "start/          points for walkers to start from, one a line, in the unit of the simulator, or micrometres\n";
  }
  const std::string certificateLine =
    "certificate.csv what was checked on the surfaces; certificate_fibres.csv the same for each fibre\n";
  if (!hasFilePerSurface(contents.format))
  {
    return text + certificateLine + filesFor(contents, substrate.certificate.bare > 0);
  }
  if (hasOuter)
  {
    text += std::string("outer/          outer surfaces, one ") +
            (contents.encoding == PlyEncoding::Binary ? "binary" : "ASCII") + " PLY file per " +
            (contents.format == SubstrateFormat::Bundles ? "bundle" : "fibre") + ", in micrometres, normals outward\n";
  }
  if (hasInner)
  {
    text += "inner/          inner surfaces (the axons), likewise\n";
  }
  if (hasStrandFile(contents))
  {
    text += "fibres.strands  centre lines and radii\n";
  }
  text += certificateLine;
  return text + (contents.format == SubstrateFormat::Mcdc ? mcdcText(contents, substrate)
                                                          : filesFor(contents, substrate.certificate.bare > 0));
}

} // namespace cactus
