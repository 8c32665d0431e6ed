// SPDX-License-Identifier: BSD-3-Clause
#include "io/SubstrateFolder.h"

#include "base/AtomicFile.h"
#include "base/Error.h"
#include "base/Parallel.h"
#include "io/CertificateText.h"
#include "io/FolderReplacement.h"
#include "io/PlyFile.h"
#include "io/StrandFile.h"
#include "io/SubstrateManifest.h"
#include "io/SubstrateReadme.h"
#include "mesh/SurfaceCheck.h"

#include <algorithm>
#include <functional>

namespace cactus
{

namespace
{

std::string padded(int id)
{
  std::string digits = std::to_string(id);
  return digits.size() < 5 ? std::string(5 - digits.size(), '0') + digits : digits;
}

/// Writes the files of a folder, and remembers them for its manifest.
class FolderWriter
{
public:
  explicit FolderWriter(const StagingFolder& folder)
    : Folder(folder)
  {
  }
  void makeFolder(const std::string& path)
  {
    this->Folder.makeFolder(path);
    this->Written.folders.insert(path);
  }
  void write(const std::string& path, const std::string& text) { this->remember(path, this->Folder.write(path, text)); }
  void writeBy(const std::string& path, const std::function<void(const std::string&)>& how)
  {
    this->remember(path, this->Folder.writeBy(path, how));
  }
  void remember(const std::string& path, const std::string& checksum) { this->Written.checksums[path] = checksum; }
  const StagingFolder& folder() const { return this->Folder; }
  const WrittenFiles& written() const { return this->Written; }

private:
  const StagingFolder& Folder;
  WrittenFiles Written;
};

void requireSound(const SurfaceReport& report, const std::string& what)
{
  if (report.sound())
  {
    return;
  }
  std::string why = " points inward";
  if (!report.closed())
  {
    why = " is not closed (" + std::to_string(report.openEdges) + " open, " + std::to_string(report.crowdedEdges) +
          " crowded and " + std::to_string(report.flippedEdges) + " flipped edges)";
  }
  else if (!report.closedManifold())
  {
    why = " is pinched at " + std::to_string(report.pinchedPoints) + " points";
  }
  throw InvalidInput(what + why + ", and walkers would leak: mend it, or turn on AllowOpenSurfaces to write it all the same");
}

/// Throws for the first surface, in the order of fibres, that is not sound.
void requireSound(const SubstrateCertificate& certificate)
{
  for (const FibreCertificate& fibre : certificate.fibres)
  {
    if (fibre.hasOuter)
    {
      requireSound(fibre.outer, "the outer surface of fibre " + std::to_string(fibre.fibreId));
    }
    if (fibre.hasInner)
    {
      requireSound(fibre.inner, "the inner surface of fibre " + std::to_string(fibre.fibreId));
    }
  }
}

std::vector<SubstrateFile> writeSurfaces(const FibreSurfaces& surfaces, const std::string& kind,
  const SubstrateCertificate& certificate, FolderWriter& writer, const Context& context, double from, double to)
{
  std::vector<SubstrateFile> files(surfaces.size());
  std::vector<std::string> checksums(surfaces.size());
  writer.makeFolder(kind);
  parallelFor(
    surfaces.size(), context,
    [&](std::size_t i)
    {
      const int id = surfaces.fibreIds[i];
      const auto fibre = std::lower_bound(certificate.fibres.begin(), certificate.fibres.end(), id,
        [](const FibreCertificate& f, int wanted) { return f.fibreId < wanted; });
      const SurfaceReport& report = kind == "outer" ? fibre->outer : fibre->inner;
      const std::string path = kind + "/fibre_" + padded(id) + ".ply";
      const std::string comment =
        "CACTUS " CACTUS_VERSION ", " + kind + " surface of fibre " + std::to_string(id) + ", micrometres";
      checksums[i] = writer.folder().write(path, plyText(surfaces.mesh(i), comment));
      files[i] = { path, kind, id, surfaces.bundleIds[i], report.triangles, report.volume, report.area, report.sound() };
    },
    "Writing " + kind + " surfaces", from, to);
  for (std::size_t i = 0; i < files.size(); ++i)
  {
    writer.remember(files[i].path, checksums[i]);
  }
  return files;
}

/// The surfaces as a reader of the files gets them.
FibreSurfaces asWritten(const FibreSurfaces& surfaces)
{
  FibreSurfaces written = surfaces;
  written.mesh = [&surfaces](std::size_t i) { return asWritten(surfaces.mesh(i)); };
  return written;
}

void writeMcdc(const SubstrateFolderContents& contents, const std::vector<SubstrateFile>& files, FolderWriter& writer)
{
  writer.makeFolder("mcdc");
  writer.makeFolder("mcdc/output");
  writer.write("mcdc/pgse.scheme", mcdcScheme(contents.mcdc));
  const auto simulate = [&](const std::string& compartment, const std::string& surface)
  {
    std::vector<std::string> paths;
    for (const SubstrateFile& file : files)
    {
      if (file.surface == surface)
      {
        paths.push_back(file.path);
      }
    }
    if (!paths.empty())
    {
      const std::string list = "mcdc/" + compartment + "_ply_list.txt";
      writer.write(list, mcdcPlyList(paths));
      writer.write("mcdc/" + compartment + ".conf",
        mcdcConfiguration(contents.mcdc, contents.domain, list, "mcdc/pgse.scheme", "mcdc/output/" + compartment, compartment));
    }
  };
  simulate("intra", contents.inner.size() > 0 ? "inner" : "outer");
  simulate("extra", "outer");
}

void requireWritable(const SubstrateFolderContents& contents, const std::string& folder)
{
  contents.certificate.validate();
  if (folder.empty())
  {
    throw InvalidInput("FolderName is empty: name the folder to write");
  }
  if (contents.outer.size() + contents.inner.size() == 0)
  {
    throw InvalidInput("there are no surfaces to write: connect MyelinSurface's Outer and Inner");
  }
}

/// Writes everything but the surfaces, the manifest last: where there is one, the folder is whole.
void writeTexts(const SubstrateFolderContents& contents, const WrittenSubstrate& substrate, FolderWriter& writer)
{
  if (contents.fibres != nullptr)
  {
    writer.writeBy("fibres.strands", [&](const std::string& path) { writeStrandFile(*contents.fibres, path); });
  }
  writeMcdc(contents, substrate.files, writer);
  writer.write("certificate.csv", certificateText(substrate.certificate));
  writer.write("certificate_fibres.csv", fibresText(substrate.certificate));
  writer.write("README.txt", readmeText(contents, substrate.certificate));
  writer.folder().writeBy(manifestName,
    [&](const std::string& path)
    {
      AtomicFile manifest(path);
      manifest.stream() << manifestText(contents, substrate, writer.written());
      manifest.commit();
    });
}

} // namespace

WrittenSubstrate writeSubstrateFolder(const SubstrateFolderContents& contents, const std::string& folder, const Context& context)
{
  requireWritable(contents, folder);
  FolderReplacement replacement(folder, context);
  FolderWriter writer(replacement.staging());
  // Judging takes about as long as writing.
  constexpr double judged = 0.5;
  Context judging = context;
  judging.progress = [&context](double fraction, const std::string& message) { context.report(judged * fraction, message); };
  WrittenSubstrate substrate;
  substrate.certificate = certify(
    contents.domain, asWritten(contents.outer), asWritten(contents.inner), contents.fibres, contents.certificate, judging);
  if (!contents.allowOpenSurfaces)
  {
    requireSound(substrate.certificate);
  }
  const double share =
    static_cast<double>(contents.outer.size()) / static_cast<double>(contents.outer.size() + contents.inner.size());
  const double between = judged + (1.0 - judged) * share;
  if (contents.outer.size() > 0)
  {
    substrate.files = writeSurfaces(contents.outer, "outer", substrate.certificate, writer, context, judged, between);
  }
  if (contents.inner.size() > 0)
  {
    const auto more = writeSurfaces(contents.inner, "inner", substrate.certificate, writer, context, between, 1.0);
    substrate.files.insert(substrate.files.end(), more.begin(), more.end());
  }
  writeTexts(contents, substrate, writer);
  replacement.commit(context);
  substrate.leftovers = replacement.leftovers();
  return substrate;
}

} // namespace cactus
