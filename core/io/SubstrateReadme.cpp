// SPDX-License-Identifier: BSD-3-Clause
#include "io/SubstrateReadme.h"

#include "base/Numbers.h"
#include "io/FolderFormat.h"
#include "io/StartFiles.h"

#include <algorithm>
#include <cmath>

namespace cactus
{

namespace
{

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
  const FolderFormat& format = formatOf(contents.format);
  if (startPointCount(contents) > 0 && format.hasStartPositions())
  {
    text += "start/          points for walkers to start from, one a line, in the unit of the simulator, or micrometres\n";
  }
  if (format.hasSurfaceFolders())
  {
    if (hasOuter)
    {
      text += std::string("outer/          outer surfaces, one ") +
              (contents.encoding == PlyEncoding::Binary ? "binary" : "ASCII") + " PLY file per " + format.fileHolds() +
              ", in micrometres, normals outward\n";
    }
    if (hasInner)
    {
      text += "inner/          inner surfaces (the axons), likewise\n";
    }
    if (hasStrandFile(contents))
    {
      text += "fibres.strands  centre lines and radii\n";
    }
  }
  text += "certificate.csv what was checked on the surfaces; certificate_fibres.csv the same for each fibre\n";
  return text + format.readme(contents, substrate);
}

} // namespace cactus
