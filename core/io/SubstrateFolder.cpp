// SPDX-License-Identifier: BSD-3-Clause
#include "io/SubstrateFolder.h"

#include "base/AtomicFile.h"
#include "base/Error.h"
#include "base/Memory.h"
#include "base/Parallel.h"
#include "fibres/SelectFibres.h"
#include "io/CertificateText.h"
#include "io/CombinedSurfaces.h"
#include "io/ElementFiles.h"
#include "io/FolderReplacement.h"
#include "io/FolderWriter.h"
#include "io/McdcFiles.h"
#include "io/McmrGeometry.h"
#include "io/NumberedName.h"
#include "io/OpenSurfaces.h"
#include "io/PlyFile.h"
#include "io/RmsFiles.h"
#include "io/StartFiles.h"
#include "io/StrandFile.h"
#include "io/SubstrateManifest.h"
#include "io/SubstrateReadme.h"
#include "mesh/SurfaceCheck.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <thread>

namespace cactus
{

namespace
{

/// The files of surfaces by kind, "outer" or "inner", and ids.
class SurfacePaths
{
public:
  explicit SurfacePaths(const SubstrateFolderContents& contents)
    : Format(contents.format)
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
    const std::string digits = numbered(std::size_t(id), this->LargestFibre);
    switch (this->Format)
    {
    case SubstrateFormat::Reference:
      return "meshes/simulations/strand_" + digits + '_' + kind + "_erode_0.ply";
    case SubstrateFormat::Camino:
      return kind + ".ply";
    case SubstrateFormat::Disimpy:
      return kind + "_vertices.npy";
    case SubstrateFormat::Bundles:
      return kind + "/bundle_" + numbered(std::size_t(bundleId), this->LargestBundle) + ".ply";
    default:
      return kind + '/' + this->thousand(id) + "fibre_" + digits + ".ply";
    }
  }

private:
  /// The folder, with a slash, that ids of the same thousand share where there are many.
  std::string thousand(int id) const
  {
    return this->IsMany ? numbered(std::size_t(id) / filesInAFolder, this->LargestFibre / filesInAFolder) + '/' : "";
  }

  SubstrateFormat Format;
  bool IsMany;
  std::size_t LargestFibre = 0;
  std::size_t LargestBundle = 0;
};

/// Tells whether all surfaces of one kind go into one file.
bool isCombined(SubstrateFormat format)
{
  return format == SubstrateFormat::Camino || format == SubstrateFormat::Disimpy;
}

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

/// Makes the folders of these files, the outer ones first, and lists the files.
void prepare(const std::vector<SubstrateFile>& files, FolderWriter& writer)
{
  std::set<std::string> made = writer.written().folders;
  std::vector<std::string> paths;
  for (const SubstrateFile& file : files)
  {
    for (std::size_t end = file.path.find('/'); end != std::string::npos; end = file.path.find('/', end + 1))
    {
      if (made.insert(file.path.substr(0, end)).second)
      {
        writer.makeFolder(file.path.substr(0, end));
      }
    }
    paths.push_back(file.path);
  }
  writer.list(paths);
}

/// Writes each surface to its own file.
void writeSeparately(const FibreSurfaces& surfaces, const std::vector<SubstrateFile>& files, PlyEncoding encoding,
  FolderWriter& writer, const SharedRun& run, double from, double to)
{
  std::vector<std::string> checksums(surfaces.size());
  run.sharing.loop(
    surfaces.size(), run.context,
    [&](std::size_t i)
    {
      const std::string comment = "CACTUS " CACTUS_VERSION ", " + files[i].surface + " surface of fibre " +
                                  std::to_string(files[i].fibreId) + ", micrometres";
      checksums[i] = writer.put(files[i].path, plyText(surfaces.mesh(i), comment, encoding));
    },
    [&](std::size_t i) { return checksums[i]; }, [&](std::size_t i, const std::string& checksum) { checksums[i] = checksum; },
    "Writing surfaces", from, to);
  for (std::size_t i = 0; i < files.size(); ++i)
  {
    writer.remember(files[i].path, checksums[i]);
  }
}

/// The surfaces of a bundle.
struct BundleSurfaces
{
  FibreSurfaces surfaces;
  std::vector<std::size_t> places; ///< indices among all
};

/// Groups the surfaces by bundle. `all` has to outlive the result.
std::map<int, BundleSurfaces> byBundle(const FibreSurfaces& all)
{
  std::map<int, BundleSurfaces> bundles;
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    BundleSurfaces& bundle = bundles[all.bundleIds[i]];
    bundle.surfaces.fibreIds.push_back(all.fibreIds[i]);
    bundle.surfaces.bundleIds.push_back(all.bundleIds[i]);
    bundle.places.push_back(i);
  }
  for (auto& entry : bundles)
  {
    BundleSurfaces& bundle = entry.second;
    bundle.surfaces.mesh = [&all, &bundle](std::size_t i) { return all.mesh(bundle.places[i]); };
  }
  return bundles;
}

/// Returns a context for several threads: only the thread that made it asks the caller whether to stop.
Context askedByOne(const Context& context)
{
  Context shared = context;
  shared.cancelled = [&context, own = std::this_thread::get_id(), isStopped = std::make_shared<std::atomic<bool>>(false)]
  {
    if (std::this_thread::get_id() == own && context.stopRequested())
    {
      *isStopped = true;
    }
    return isStopped->load();
  };
  return shared;
}

/// Writes the surfaces of each bundle to a file.
void writeByBundle(const FibreSurfaces& surfaces, const std::vector<SubstrateFile>& files, PlyEncoding encoding,
  FolderWriter& writer, const SharedRun& run, double from, double to)
{
  const std::map<int, BundleSurfaces> bundles = byBundle(surfaces);
  std::vector<const BundleSurfaces*> inTurn;
  inTurn.reserve(bundles.size());
  for (const auto& entry : bundles)
  {
    inTurn.push_back(&entry.second);
  }
  const auto fileOf = [&](std::size_t i) -> const SubstrateFile& { return files[inTurn[i]->places.front()]; };
  const Context context = askedByOne(run.context);
  std::vector<std::string> checksums(inTurn.size());
  run.sharing.loop(
    inTurn.size(), context,
    [&](std::size_t i)
    {
      const SubstrateFile& file = fileOf(i);
      const std::string comment =
        "CACTUS " CACTUS_VERSION ", " + file.surface + " surfaces of bundle " + std::to_string(file.bundleId) + ", micrometres";
      checksums[i] = writeBundleSurfaces(inTurn[i]->surfaces, file.path, comment, encoding, writer, context);
    },
    [&](std::size_t i) { return checksums[i]; }, [&](std::size_t i, const std::string& checksum) { checksums[i] = checksum; },
    "Writing surfaces", from, to);
  for (std::size_t i = 0; i < inTurn.size(); ++i)
  {
    writer.remember(fileOf(i).path, checksums[i]);
  }
}

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
  if (isCombined(contents.format))
  {
    run.context.report(from, "Writing surfaces");
    if (run.sharing.isFirst())
    {
      contents.format == SubstrateFormat::Camino ? writeCaminoSurfaces(surfaces, kind, writer, run.context)
                                                 : writeDisimpySurfaces(surfaces, kind, writer, run.context);
    }
    return files;
  }
  if (run.sharing.isFirst())
  {
    prepare(files, writer);
  }
  run.sharing.exchange();
  const auto write = contents.format == SubstrateFormat::Bundles ? &writeByBundle : &writeSeparately;
  write(surfaces, files, contents.encoding, writer, run, from, to);
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
  if (contents.format == SubstrateFormat::Reference && (contents.fibres == nullptr || contents.inner.size() == 0))
  {
    throw InvalidInput(
      "Format Reference program has both surfaces of each fibre and their centre lines: connect Inner and Fibres");
  }
  requireEncoding(contents.format, contents.encoding);
  requireOpenable(contents.periodicFaces, contents.format, contents.allowOpenSurfaces);
  requirePeriodic(contents.periodicFaces, contents.domain);
  requireRoom(contents.format, contents.domain, contents.voxelSize);
  if (contents.format == SubstrateFormat::SpinDoctor && contents.outer.size() == 0)
  {
    throw InvalidInput("Format SpinDoctor has a compartment outside the fibres: connect MyelinSurface's Outer");
  }
}

/// Writes everything but the surfaces, the manifest last: its existence shows that the folder is complete.
void writeTexts(const SubstrateFolderContents& contents, const WrittenSubstrate& substrate, FolderWriter& writer)
{
  if (hasStrandFile(contents))
  {
    const bool isReference = contents.format == SubstrateFormat::Reference;
    // By id, as in certificate and manifest: a strand file has no ids, and the pieces of a fibre have theirs at the end.
    const std::vector<int>& ids = contents.fibres->fibreIds;
    const bool isSorted = std::is_sorted(ids.begin(), ids.end());
    writer.writeBy(isReference ? "optimized_final.txt" : "fibres.strands", [&](const std::string& path)
      { writeStrandFile(isSorted ? *contents.fibres : selectFibres(*contents.fibres, orderById(*contents.fibres)), path); });
  }
  if (contents.format == SubstrateFormat::Camino)
  {
    writer.write("pgse.scheme", mcdcScheme(contents.mcdc)); // in Camino's own format
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

/// Checks the memory for format SpinDoctor, which joins all surfaces in memory.
void requireMemoryForElements(const SubstrateCertificate& certificate)
{
  constexpr double bytesOfTriangle = 80.0; // twice with its part of the points, once with the compartments of its sides
  double triangles = 0.0;
  for (const FibreCertificate& fibre : certificate.fibres)
  {
    triangles += double(fibre.outer.triangles) + double(fibre.inner.triangles);
  }
  requireMemory(bytesOfTriangle * triangles,
    "Format SpinDoctor, which joins " + std::to_string(std::uint64_t(triangles)) + " triangles,",
    "choose another Format, or make a smaller substrate");
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
  if (contents.format == SubstrateFormat::SpinDoctor)
  {
    requireMemoryForElements(substrate.certificate);
  }
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
  if (contents.format == SubstrateFormat::Rms)
  {
    writeRms(contents, substrate, writer, context);
  }
  else if (contents.format == SubstrateFormat::SpinDoctor)
  {
    substrate.remarks = writeElementFiles(contents, substrate.certificate.smallestGap, writer, context);
  }
  else if (contents.format == SubstrateFormat::Mcdc)
  {
    const std::vector<McdcSimulation> simulations = mcdcSimulations(contents, substrate.files);
    const Context last = context.part(1.0, 1.0); // surfaces are written, and progress does not go back
    writeMcdc(contents, simulations, substrate, writer, last);
    writeStartPositions(contents, simulations, writer, last);
  }
  else
  {
    writeStartPositions(contents, {}, writer, context);
  }
  if (contents.format == SubstrateFormat::Mcmr)
  {
    writeMcmrGeometry(contents, writer, context);
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
  require(encoding == PlyEncoding::Ascii || mayBeBinary(format),
    "Encoding Binary is not for simulators whose readers of PLY files take ASCII only: choose Encoding ASCII, or Format Surfaces "
    "alone, Surfaces by bundle, RMS, SpinDoctor or MCMRSimulator");
}

void requireRoom(SubstrateFormat format, const Domain& domain, double voxelSize)
{
  require(format != SubstrateFormat::Reference || (fitsStrandFile(domain) && isCube(domain)),
    "Format Reference program has the fibres in a strand file, of which that program reads only those of a cube centred on the "
    "origin, and the Domain "
    "is something else: choose another Format");
  if (format == SubstrateFormat::Rms)
  {
    requireRmsVoxels(domain, voxelSize);
  }
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
