// SPDX-License-Identifier: BSD-3-Clause
#include "base/Numbers.h"
#include "io/FolderFormat.h"

#include <cmath>

namespace cactus
{

namespace
{

constexpr double inMetres = 1e-6; ///< of one µm

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

/// One PLY file (m) per kind of surface.
class CaminoFormat : public FolderFormat
{
public:
  bool hasSurfaceFolders() const override { return false; }
  double startUnit() const override { return inMetres; }
  double surfaceUnit() const override { return 1.0 / inMetres; }

  std::string surfacePath(const SurfaceName& name) const override { return name.kind + ".ply"; }

  void writeSurfaces(const SurfacesToWrite& written, FolderWriter& writer, const WritingRun& run) const override
  {
    run.context.report(run.from, "Writing surfaces");
    if (run.sharing.isFirst())
    {
      writeCaminoSurfaces(written.surfaces, written.kind, writer, run.context);
    }
  }

  void writeOwnFiles(const SubstrateFolderContents& contents, WrittenSubstrate& /*substrate*/, FolderWriter& writer,
    const Context& /*context*/) const override
  {
    writer.write("pgse.scheme", mcdcScheme(contents.mcdc)); // in Camino's own format
  }

  std::string readme(const SubstrateFolderContents& contents, const WrittenSubstrate& /*substrate*/) const override
  {
    return caminoText(contents);
  }
};

} // namespace

const FolderFormat& caminoFormat()
{
  static const CaminoFormat format;
  return format;
}

} // namespace cactus
