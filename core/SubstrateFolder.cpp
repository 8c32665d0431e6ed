// SPDX-License-Identifier: BSD-3-Clause
#include "SubstrateFolder.h"

#include "Error.h"
#include "Parallel.h"
#include "PlyFile.h"
#include "StrandFile.h"
#include "SurfaceCheck.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <system_error>
#include <unistd.h>

namespace cactus
{

namespace
{

namespace fs = std::filesystem;

/// What the manifest says it is; by this a folder is known as one of ours.
const std::string format = "CACTUS substrate folder";
const std::set<std::string> ownEntries{ "outer", "inner", "mcdc", "fibres.strands", "certificate.csv", "certificate_fibres.csv",
  "manifest.json", "README.txt" };

void writeText(const fs::path& path, const std::string& text)
{
  std::ofstream file(path, std::ios::binary);
  file.write(text.data(), static_cast<std::streamsize>(text.size()));
  file.close();
  if (!file)
  {
    throw FileError("cannot write " + path.string() + ": " + std::strerror(errno));
  }
}

std::string padded(int id)
{
  std::string digits = std::to_string(id);
  return digits.size() < 5 ? std::string(5 - digits.size(), '0') + digits : digits;
}

std::string quoted(const std::string& text)
{
  std::string result = "\"";
  for (const char c : text)
  {
    if (c == '"' || c == '\\')
    {
      result += '\\';
      result += c;
    }
    else if (static_cast<unsigned char>(c) < 0x20)
    {
      char escape[8];
      std::snprintf(escape, sizeof(escape), "\\u%04x", static_cast<unsigned>(c));
      result += escape;
    }
    else
    {
      result += c;
    }
  }
  return result + '"';
}

/// The shortest text that reads back as the same number.
std::string number(double value)
{
  if (!std::isfinite(value))
  {
    return "null"; // JSON has no NaN
  }
  char text[32];
  return std::string(text, std::to_chars(text, text + sizeof(text), value).ptr);
}

/// A certificate's value: nothing where it is not a number.
std::string cell(const CertificateColumn& column, std::size_t row)
{
  const double value = column.values[row];
  if (!std::isfinite(value))
  {
    return "";
  }
  return column.whole ? std::to_string(static_cast<long long>(value)) : number(value);
}

/// One line for each quantity, which is how a person reads a single row.
std::string certificateText(const SubstrateCertificate& certificate)
{
  std::string text = "quantity,value\n";
  for (const CertificateColumn& column : substrateColumns(certificate))
  {
    text += column.name + "," + cell(column, 0) + "\n";
  }
  return text;
}

std::string fibresText(const SubstrateCertificate& certificate)
{
  const auto columns = fibreColumns(certificate);
  std::string text;
  for (std::size_t c = 0; c < columns.size(); ++c)
  {
    text += (c > 0 ? "," : "") + columns[c].name;
  }
  for (std::size_t row = 0; row < certificate.fibres.size(); ++row)
  {
    for (std::size_t c = 0; c < columns.size(); ++c)
    {
      text += (c > 0 ? "," : "\n") + cell(columns[c], row);
    }
  }
  return text + "\n";
}

/// A folder beside `place` that goes away unless it is moved there.
class StagedFolder
{
public:
  explicit StagedFolder(const std::string& folder)
    : Place(fs::absolute(fs::path(folder)).lexically_normal())
  {
    if (!this->Place.has_filename())
    {
      this->Place = this->Place.parent_path(); // a trailing slash
    }
    this->Staging = this->Place.string() + ".partial-" + std::to_string(::getpid());
    this->requireReplaceable();
    std::error_code error;
    if (!fs::create_directory(this->Staging, error))
    {
      throw FileError("cannot write folder " + this->Place.string() + ": " +
                      (error ? error.message() : this->Staging.string() + " is in the way"));
    }
  }
  StagedFolder(const StagedFolder&) = delete;
  StagedFolder& operator=(const StagedFolder&) = delete;
  ~StagedFolder()
  {
    std::error_code ignored;
    fs::remove_all(this->Staging, ignored);
  }

  const fs::path& path() const { return this->Staging; }

  void commit()
  {
    this->requireReplaceable();
    std::error_code error;
    const fs::path old = this->Place.string() + ".old-" + std::to_string(::getpid());
    const bool replaces = fs::exists(this->Place);
    if (replaces)
    {
      fs::rename(this->Place, old, error);
    }
    if (!error)
    {
      fs::rename(this->Staging, this->Place, error);
    }
    if (error)
    {
      std::error_code ignored;
      if (replaces && !fs::exists(this->Place))
      {
        fs::rename(old, this->Place, ignored);
      }
      throw FileError("cannot write folder " + this->Place.string() + ": " + error.message());
    }
    std::error_code ignored;
    fs::remove_all(old, ignored);
  }

private:
  void refuse(const std::string& why) const
  {
    throw FileError("folder " + this->Place.string() + " is there already and " + why + ": choose another FolderName");
  }

  void requireReplaceable() const
  {
    std::error_code error;
    const auto status = fs::symlink_status(this->Place, error);
    if (!fs::exists(status))
    {
      return;
    }
    if (!fs::is_directory(status))
    {
      throw FileError("FolderName " + this->Place.string() + " is there already and not a folder: choose another one");
    }
    if (fs::is_empty(this->Place, error))
    {
      return;
    }
    std::ifstream manifest(this->Place / "manifest.json");
    const std::string text((std::istreambuf_iterator<char>(manifest)), std::istreambuf_iterator<char>());
    if (text.find(quoted(format)) == std::string::npos)
    {
      this->refuse("is not a substrate folder (it has no manifest.json of ours)");
    }
    for (const auto& entry : fs::directory_iterator(this->Place, error))
    {
      if (ownEntries.count(entry.path().filename().string()) == 0)
      {
        this->refuse("holds other data (" + entry.path().filename().string() + ")");
      }
    }
    const fs::path results = this->Place / "mcdc" / "output";
    if (fs::exists(results, error) && !fs::is_empty(results, error))
    {
      this->refuse("holds results of simulations (mcdc/output)");
    }
    if (error)
    {
      throw FileError("cannot read folder " + this->Place.string() + ": " + error.message());
    }
  }

  fs::path Place;
  fs::path Staging;
};

void requireSound(const SurfaceReport& report, const std::string& what)
{
  if (report.closedManifold() && report.outward())
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
  const SubstrateCertificate& certificate, const fs::path& folder, const Context& context, double from, double to)
{
  std::vector<SubstrateFile> files(surfaces.size());
  fs::create_directory(folder / kind);
  parallelFor(
    surfaces.size(), context,
    [&](std::size_t i)
    {
      const int id = surfaces.fibreIds[i];
      const auto fibre = std::lower_bound(certificate.fibres.begin(), certificate.fibres.end(), id,
        [](const FibreCertificate& f, int wanted) { return f.fibreId < wanted; });
      const SurfaceReport& report = kind == "outer" ? fibre->outer : fibre->inner;
      const std::string path = kind + "/fibre_" + padded(id) + ".ply";
      writeText(folder / path, plyText(surfaces.mesh(i), "CACTUS " CACTUS_VERSION ", " + kind + " surface of fibre " +
                                                           std::to_string(id) + ", micrometres"));
      files[i] = { path, kind, id, surfaces.bundleIds[i], report.triangles, report.volume, report.area,
        report.closedManifold() && report.outward() };
    },
    "Writing " + kind + " surfaces", from, to);
  return files;
}

/// The surfaces as a reader of the files gets them.
FibreSurfaces asWritten(const FibreSurfaces& surfaces)
{
  FibreSurfaces written = surfaces;
  written.mesh = [&surfaces](std::size_t i) { return asWritten(surfaces.mesh(i)); };
  return written;
}

std::string manifestText(const SubstrateFolderContents& contents, const WrittenSubstrate& written)
{
  const std::vector<SubstrateFile>& files = written.files;
  const Domain& domain = contents.domain;
  double outerVolume = 0.0;
  double innerVolume = 0.0;
  std::size_t triangles = 0;
  for (const SubstrateFile& file : files)
  {
    (file.surface == "outer" ? outerVolume : innerVolume) += file.volume;
    triangles += file.triangles;
  }
  std::string text = "{\n  \"format\": " + quoted(format) + ",\n  \"version\": " + quoted(CACTUS_VERSION) +
                     ",\n  \"length_unit\": \"micrometre\",\n  \"domain\": [";
  for (int axis = 0; axis < 3; ++axis)
  {
    text += number(domain.lower[axis]) + ", " + number(domain.upper[axis]) + (axis < 2 ? ", " : "],\n");
  }
  text += "  \"fibres\": " + (contents.fibres ? std::to_string(contents.fibres->size()) : "null") +
          ",\n  \"outer_surfaces\": " + std::to_string(contents.outer.size()) +
          ",\n  \"inner_surfaces\": " + std::to_string(contents.inner.size()) +
          ",\n  \"triangles\": " + std::to_string(triangles) + ",\n  \"outer_volume_um3\": " + number(outerVolume) +
          ",\n  \"inner_volume_um3\": " + number(innerVolume) +
          ",\n  \"certified\": " + (written.certificate.certified() ? "true" : "false") + ",\n  \"faults\": [";
  for (std::size_t i = 0; i < written.certificate.faults.size(); ++i)
  {
    text += (i > 0 ? ",\n    " : "\n    ") + quoted(written.certificate.faults[i]);
  }
  text += "\n  ],\n  \"provenance\": [";
  for (std::size_t i = 0; i < contents.provenance.size(); ++i)
  {
    text += (i > 0 ? ",\n    " : "\n    ") + quoted(contents.provenance[i]);
  }
  text += "\n  ],\n  \"files\": [";
  for (std::size_t i = 0; i < files.size(); ++i)
  {
    const SubstrateFile& file = files[i];
    text += (i > 0 ? ",\n    " : "\n    ");
    text += "{\"path\": " + quoted(file.path) + ", \"surface\": " + quoted(file.surface) +
            ", \"fibre\": " + std::to_string(file.fibreId) + ", \"bundle\": " + std::to_string(file.bundleId) +
            ", \"triangles\": " + std::to_string(file.triangles) + ", \"volume_um3\": " + number(file.volume) +
            ", \"area_um2\": " + number(file.area) + ", \"closed\": " + (file.closed ? "true" : "false") + "}";
  }
  return text + "\n  ]\n}\n";
}

std::string readmeText(const SubstrateFolderContents& contents, const SubstrateCertificate& certificate)
{
  const bool hasInner = contents.inner.size() > 0;
  const bool hasOuter = contents.outer.size() > 0;
  std::string text = "A substrate of " + std::to_string(std::max(contents.outer.size(), contents.inner.size())) +
                     " fibres, written by CACTUS " CACTUS_VERSION ".\n\n";
  text += certificate.certified()
            ? "CERTIFIED: every surface is closed, no two meet, and no walker can leak (certificate.csv).\n\n"
            : "NOT CERTIFIED (certificate.csv):\n\n";
  for (const std::string& fault : certificate.faults)
  {
    text += "  - " + fault + "\n";
  }
  text += certificate.certified() ? "" : "\n";
  text += "manifest.json   what this is, how it was made, and every surface with its fibre, bundle, volume and area\n";
  if (hasOuter)
  {
    text += "outer/          outer surfaces, one ASCII PLY file per fibre, in micrometres, normals outward\n";
  }
  if (hasInner)
  {
    text += "inner/          inner surfaces (the axons), likewise\n";
  }
  if (contents.fibres != nullptr)
  {
    text += "fibres.strands  centre lines and radii\n";
  }
  text += "certificate.csv what was checked on the surfaces; certificate_fibres.csv the same for each fibre\n";
  text += "mcdc/           configurations for the MC/DC simulator (github.com/jonhrafe/MCDC_Simulator_public)\n\n";
  text += "To simulate, start MC/DC in this folder; it looks for all files from where it is started:\n\n";
  text += "    MC-DC_Simulator --conf mcdc/intra.conf\n";
  if (hasOuter)
  {
    text += "    MC-DC_Simulator --conf mcdc/extra.conf\n";
  }
  text += "\nMC/DC before December 2024 takes the file without --conf, where later ones end without a word.\n"
          "The signals come to mcdc/output/. A folder with results is not replaced when the substrate is written again.\n\n";
  text += std::string("intra.conf  walkers inside the ") + (hasInner ? "inner" : "outer") + " surfaces\n";
  if (hasOuter)
  {
    text += "extra.conf  walkers outside the outer surfaces\n";
  }
  text +=
    "\nMyelin has no walkers: MC/DC knows the inside and the outside of a surface, and no third compartment. For the signal of\n"
    "both, divide each by its number of walkers and weight it with its compartment's share of the domain (manifest.json): "
    "inside,\n"
    "the volume of the surfaces used over the domain's; outside, 1 - outer_volume_um3 over the domain's.\n\n"
    "What to edit: N (walkers) and num_process first, T (steps: a step should be shorter than the smallest radius), and\n"
    "pgse.scheme. Walkers start in <spawning_area>, off the substrate's boundary. A fibre ends in a cap at the boundary, and\n"
    "outside it water is free: a walker that gets there no longer tells of the substrate. Choose the duration and the\n"
    "<spawning_area> (both in the .conf, in s and mm) so that few do. <voxels> is wider than the substrate, because MC/DC\n"
    "continues a walker that leaves it on the opposite side, where there is another fibre.\n";
  return text;
}

void writeMcdc(const SubstrateFolderContents& contents, const std::vector<SubstrateFile>& files, const fs::path& folder)
{
  fs::create_directories(folder / "mcdc" / "output");
  writeText(folder / "mcdc" / "pgse.scheme", mcdcScheme(contents.mcdc));
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
      writeText(folder / list, mcdcPlyList(paths));
      writeText(folder / ("mcdc/" + compartment + ".conf"),
        mcdcConfiguration(contents.mcdc, contents.domain, list, "mcdc/pgse.scheme", "mcdc/output/" + compartment, compartment));
    }
  };
  simulate("intra", contents.inner.size() > 0 ? "inner" : "outer");
  simulate("extra", "outer");
}

} // namespace

WrittenSubstrate writeSubstrateFolder(const SubstrateFolderContents& contents, const std::string& folder, const Context& context)
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
  StagedFolder staged(folder);
  try
  {
    // Judging takes about as long as writing.
    constexpr double judged = 0.5;
    Context judging = context;
    judging.progress = [&context](double fraction, const std::string& message) { context.report(judged * fraction, message); };
    WrittenSubstrate written;
    written.certificate = certify(
      contents.domain, asWritten(contents.outer), asWritten(contents.inner), contents.fibres, contents.certificate, judging);
    if (!contents.allowOpenSurfaces)
    {
      requireSound(written.certificate);
    }
    const double share =
      static_cast<double>(contents.outer.size()) / static_cast<double>(contents.outer.size() + contents.inner.size());
    const double between = judged + (1.0 - judged) * share;
    if (contents.outer.size() > 0)
    {
      written.files = writeSurfaces(contents.outer, "outer", written.certificate, staged.path(), context, judged, between);
    }
    if (contents.inner.size() > 0)
    {
      const auto more = writeSurfaces(contents.inner, "inner", written.certificate, staged.path(), context, between, 1.0);
      written.files.insert(written.files.end(), more.begin(), more.end());
    }
    if (contents.fibres != nullptr)
    {
      writeStrandFile(*contents.fibres, (staged.path() / "fibres.strands").string());
    }
    writeMcdc(contents, written.files, staged.path());
    writeText(staged.path() / "certificate.csv", certificateText(written.certificate));
    writeText(staged.path() / "certificate_fibres.csv", fibresText(written.certificate));
    writeText(staged.path() / "README.txt", readmeText(contents, written.certificate));
    writeText(staged.path() / "manifest.json", manifestText(contents, written));
    staged.commit();
    return written;
  }
  catch (const fs::filesystem_error& error)
  {
    throw FileError(std::string("cannot write folder ") + folder + ": " + error.what());
  }
}

} // namespace cactus
