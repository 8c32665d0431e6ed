// SPDX-License-Identifier: BSD-3-Clause
#include "io/SubstrateFolder.h"

#include "base/AtomicFile.h"
#include "base/Error.h"
#include "fibres/SelectFibres.h"
#include "io/CertificateText.h"
#include "io/FolderFormat.h"
#include "io/FolderReplacement.h"
#include "io/NumberedName.h"
#include "io/OpenSurfaces.h"
#include "io/StartFiles.h"
#include "io/StrandFile.h"
#include "io/SubstrateManifest.h"
#include "io/SubstrateReadme.h"
#include "mesh/SurfaceCheck.h"

#include <algorithm>
#include <optional>

namespace cactus
{

namespace
{

/// The files of surfaces by kind, "outer" or "inner", and ids.
class SurfacePaths
{
public:
  explicit SurfacePaths(const SubstrateFolderContents& contents)
    : Format(formatOf(contents.format))
    , IsMany(std::max(contents.outer.size(), contents.inner.size()) > filesInAFolder)
  {
    for (const FibreSurfaces* surfaces : { &contents.outer, &contents.inner })
    {
      for (std::size_t i = 0; i < surfaces->size(); ++i)
      {
        this->LargestFibre = std::max(this->LargestFibre, std::size_t(surfaces->fibreIds[i]));
        this->LargestBundle = std::max(this->LargestBundle, std::size_t(surfaces->bundleIds[i]));
      }
    }
  }

  std::string path(const std::string& kind, int id, int bundleId) const
  {
    return this->Format.surfacePath({ kind, this->thousand(id), numbered(std::size_t(id), this->LargestFibre),
      numbered(std::size_t(bundleId), this->LargestBundle) });
  }

private:
  /// The folder, with a slash, that ids of the same thousand share where there are many.
  std::string thousand(int id) const
  {
    return this->IsMany ? numbered(std::size_t(id) / filesInAFolder, this->LargestFibre / filesInAFolder) + '/' : "";
  }

  const FolderFormat& Format;
  bool IsMany;
  std::size_t LargestFibre = 0;
  std::size_t LargestBundle = 0;
};

void requireSound(const SurfaceReport& report, const std::string& what, const std::string& wayOut)
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
  throw InvalidInput(what + why + wayOut);
}

/// Throws for the first surface, in the order of fibres, that is not sound.
void requireSound(const SubstrateCertificate& certificate, const std::string& wayOut)
{
  for (const FibreCertificate& fibre : certificate.fibres)
  {
    if (fibre.hasOuter)
    {
      requireSound(fibre.outer, "the outer surface of fibre " + std::to_string(fibre.fibreId), wayOut);
    }
    if (fibre.hasInner)
    {
      requireSound(fibre.inner, "the inner surface of fibre " + std::to_string(fibre.fibreId), wayOut);
    }
  }
}

/// Returns the manifest's entries of the surfaces.
std::vector<SubstrateFile> surfaceFiles(
  const SubstrateFolderContents& contents, const std::string& kind, const SubstrateCertificate& certificate)
{
  const FibreSurfaces& surfaces = kind == "outer" ? contents.outer : contents.inner;
  const SurfacePaths paths(contents);
  std::vector<SubstrateFile> files;
  for (std::size_t i = 0; i < surfaces.size(); ++i)
  {
    const int id = surfaces.fibreIds[i];
    const auto fibre = std::lower_bound(certificate.fibres.begin(), certificate.fibres.end(), id,
      [](const FibreCertificate& f, int wanted) { return f.fibreId < wanted; });
    const SurfaceReport& report = kind == "outer" ? fibre->outer : fibre->inner;
    files.push_back({ paths.path(kind, id, surfaces.bundleIds[i]), kind, id, surfaces.bundleIds[i], report.triangles,
      report.volume, report.area, report.sound() });
  }
  return files;
}

/// The context and the processes of a part of the writing.
struct SharedRun
{
  const Context& context;
  const Sharing& sharing;
  const Recollection& known;
};

std::vector<SubstrateFile> writeSurfaces(const SubstrateFolderContents& contents, const std::string& kind,
  const SubstrateCertificate& certificate, FolderWriter& writer, const SharedRun& run, double from, double to)
{
  const FibreSurfaces& closed = kind == "outer" ? contents.outer : contents.inner;
  if (closed.size() == 0)
  {
    return {};
  }
  auto files = surfaceFiles(contents, kind, certificate);
  const bool isOpen = contents.periodicFaces == PeriodicFaces::Open;
  if (isOpen)
  {
    const double half = 0.5 * (from + to);
    describeOpened(contents, kind, files, run.context, run.sharing, from, half);
    from = half;
  }
  const FibreSurfaces surfaces = isOpen ? openedSurfaces(closed, kind, contents.domain) : closed;
  formatOf(contents.format)
    .writeSurfaces({ surfaces, kind, files, contents.encoding }, writer, { run.context, run.sharing, from, to });
  return files;
}

/// Returns the surfaces as a reader of the files gets them.
FibreSurfaces asWritten(const FibreSurfaces& surfaces, PlyEncoding encoding)
{
  FibreSurfaces written = surfaces;
  written.mesh = [&surfaces, encoding](std::size_t i) { return asWritten(surfaces.mesh(i), encoding); };
  return written;
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
  formatOf(contents.format).requireContents(contents);
  requireEncoding(contents.format, contents.encoding);
  requireOpenable(contents.periodicFaces, contents.format, contents.allowOpenSurfaces);
  requirePeriodic(contents.periodicFaces, contents.domain);
  requireRoom(contents.format, contents.domain, contents.voxelSize);
}

/// Writes everything but the surfaces, the manifest last: its existence shows that the folder is complete.
void writeTexts(const SubstrateFolderContents& contents, const WrittenSubstrate& substrate, FolderWriter& writer)
{
  if (hasStrandFile(contents))
  {
    // By id, as in certificate and manifest: a strand file has no ids, and the pieces of a fibre have theirs at the end.
    const std::vector<int>& ids = contents.fibres->fibreIds;
    const bool isSorted = std::is_sorted(ids.begin(), ids.end());
    writer.writeBy(formatOf(contents.format).strandsName(), [&](const std::string& path)
      { writeStrandFile(isSorted ? *contents.fibres : selectFibres(*contents.fibres, orderById(*contents.fibres)), path); });
  }
  writer.write("certificate.csv", certificateText(substrate.certificate));
  writer.write("certificate_fibres.csv", fibresText(substrate.certificate));
  writer.write("README.txt", readmeText(contents, substrate));
  writer.list({ manifestName });
  writer.putBy(manifestName,
    [&](const std::string& path)
    {
      AtomicFile manifest(path);
      manifest.stream() << manifestText(contents, substrate, writer.written());
      manifest.commit();
    });
}

/// Judges and writes the parts that processes share.
WrittenSubstrate judgeAndWrite(const SubstrateFolderContents& contents, FolderWriter& writer, const SharedRun& run)
{
  // Judging takes about as long as writing.
  constexpr double judged = 0.5;
  WrittenSubstrate substrate;
  substrate.certificate =
    certify(contents.domain, asWritten(contents.outer, contents.encoding), asWritten(contents.inner, contents.encoding),
      contents.fibres, contents.certificate, run.context.part(0.0, judged), run.sharing,
      run.known.part(text(
        contents.encoding == PlyEncoding::Binary ? "binary" : "ASCII", ", cuts ", exactText(contents.certificate.cutSpacing))));
  if (!contents.allowOpenSurfaces)
  {
    requireSound(
      substrate.certificate, ", and walkers would leak: mend it, or turn on AllowOpenSurfaces to write it all the same");
  }
  else if (startPointCount(contents) > 0)
  {
    requireSound(substrate.certificate,
      ", so that nobody knows which StartPositions are inside: mend it, or set them and Permeability to 0");
  }
  formatOf(contents.format).requireMemory(substrate.certificate);
  const double share =
    static_cast<double>(contents.outer.size()) / static_cast<double>(contents.outer.size() + contents.inner.size());
  const double between = judged + (1.0 - judged) * share;
  substrate.files = writeSurfaces(contents, "outer", substrate.certificate, writer, run, judged, between);
  const auto more = writeSurfaces(contents, "inner", substrate.certificate, writer, run, between, 1.0);
  substrate.files.insert(substrate.files.end(), more.begin(), more.end());
  return substrate;
}

/// Writes the rest, and puts the folder in its place.
void finish(const SubstrateFolderContents& contents, WrittenSubstrate& substrate, FolderWriter& writer,
  FolderReplacement& replacement, const Context& context)
{
  const FolderFormat& format = formatOf(contents.format);
  format.writeOwnFiles(contents, substrate, writer, context);
  if (format.hasStartPositions())
  {
    // Surfaces are written, and progress does not go back.
    writeStartPositions(contents, format.startSimulations(contents, substrate.files), writer, context.part(1.0, 1.0));
  }
  if (contents.fibres != nullptr && !hasStrandFile(contents))
  {
    substrate.remarks.push_back(
      "the centre lines are not in the folder: a strand file can only hold a Domain centred on the origin; save the fibres as "
      ".vtp");
  }
  writeTexts(contents, substrate, writer);
  replacement.commit(context);
}

} // namespace

void requireEncoding(SubstrateFormat format, PlyEncoding encoding)
{
  if (encoding != PlyEncoding::Ascii && !formatOf(format).mayBeBinary())
  {
    throw InvalidInput(
      "Encoding Binary is not for simulators whose readers of PLY files take ASCII only: choose Encoding ASCII, or "
      "Format " +
      formatsThat(&FolderFormat::mayBeBinary));
  }
}

void requireRoom(SubstrateFormat format, const Domain& domain, double voxelSize)
{
  formatOf(format).requireRoom(domain, voxelSize);
}

WrittenSubstrate writeSubstrateFolder(const SubstrateFolderContents& contents, const std::string& folder, const Context& context,
  const Sharing& sharing, const Recollection& known)
{
  WrittenSubstrate substrate;
  std::optional<FolderReplacement> replacement; // of the first process, which removes it once nobody writes into it any more
  sharing.together(
    [&]
    {
      requireWritable(contents, folder);
      if (sharing.isFirst())
      {
        replacement.emplace(folder, context);
      }
      const std::string container = sharing.fromFirst(replacement ? replacement->container().string() : std::string());
      FolderWriter writer(folder, container);
      substrate = judgeAndWrite(contents, writer, { context, sharing, known });
      if (sharing.isFirst())
      {
        finish(contents, substrate, writer, *replacement, context);
      }
    });
  return substrate;
}

} // namespace cactus
