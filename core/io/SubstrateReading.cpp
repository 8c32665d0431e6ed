// SPDX-License-Identifier: BSD-3-Clause
#include "io/SubstrateReading.h"

#include "base/Error.h"
#include "base/JsonText.h"
#include "base/PosixFile.h"
#include "io/FolderFormat.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>

namespace cactus
{

namespace
{

constexpr const char* wasChanged = "was changed after it was written, by its SHA-256: copy or write the folder again";

[[noreturn]] void refuseFile(const std::string& path, const std::string& why)
{
  throw FileError(path + " " + why);
}

std::string contentOf(const std::string& path)
{
  std::error_code unknown;
  if (std::filesystem::exists(path, unknown) && !std::filesystem::is_regular_file(path, unknown))
  {
    refuseFile(path, "is no file: name a substrate folder, or its manifest.json");
  }
  std::ifstream file(path, std::ios::binary);
  std::string content((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  if (!file)
  {
    throw FileError("cannot read " + path + ": " + systemMessage(errno));
  }
  return content;
}

/// Returns the format of that name.
const FolderFormat& formatNamed(const std::string& name, const std::string& manifest)
{
  const auto* const found = std::find(std::begin(formatNames), std::end(formatNames), name);
  if (found == std::end(formatNames))
  {
    throw InvalidInput(manifest + ": this CACTUS does not know Format " + excerpt(name));
  }
  const FolderFormat& format = formatOf(static_cast<SubstrateFormat>(found - std::begin(formatNames)));
  if (!format.isReadable())
  {
    throw InvalidInput(manifest + ": surfaces of Format " + name + " cannot be read again, only those of Format " +
                       formatsThat(&FolderFormat::isReadable));
  }
  return format;
}

Domain domainOf(const Json& manifest)
{
  Domain domain;
  const auto bounds = manifest.at("domain").get<std::array<double, 6>>();
  for (int axis = 0; axis < 3; ++axis)
  {
    domain.lower[axis] = bounds[std::size_t(2 * axis)];
    domain.upper[axis] = bounds[std::size_t(2 * axis + 1)];
  }
  domain.periodic = manifest.value("periodic", domain.periodic);
  return domain;
}

SubstrateFile fileOf(const Json& entry)
{
  SubstrateFile file;
  file.path = entry.at("path").get<std::string>();
  file.surface = entry.at("surface").get<std::string>();
  file.fibreId = entry.at("fibre").get<int>();
  file.bundleId = entry.at("bundle").get<int>();
  file.triangles = entry.at("triangles").get<std::size_t>();
  const Json& volume = entry.at("volume_um3");
  file.volume = volume.is_number() ? volume.get<double>() : std::numeric_limits<double>::quiet_NaN();
  return file;
}

/// Fills in what a manifest's values say.
void describe(const Json& manifest, const std::string& path, SubstrateDescription& substrate)
{
  const FolderFormat& format = formatNamed(manifest.at("simulator").get<std::string>(), path);
  substrate.unit = format.surfaceUnit();
  substrate.strands = substrate.written.checksums.count(format.strandsName()) > 0 ? format.strandsName() : "";
  substrate.strandFibres = manifest.value("strand_fibres", substrate.strandFibres);
  substrate.strandBundles = manifest.value("strand_bundles", substrate.strandBundles);
  substrate.domain = domainOf(manifest);
  substrate.isOpen = manifest.value("periodic_faces", "") == periodicFacesNames[std::size_t(PeriodicFaces::Open)];
  substrate.sampledFibres = manifest.value("sample_of_fibres", std::size_t(0));
  for (const Json& stage : manifest.at("provenance"))
  {
    substrate.provenance.push_back(stage.is_string() ? stage.get<std::string>() : singleLine(stage));
  }
  for (const Json& entry : manifest.at("files"))
  {
    substrate.files.push_back(fileOf(entry));
  }
}

} // namespace

std::string manifestOf(const std::string& path)
{
  std::error_code error;
  return std::filesystem::is_directory(path, error) ? (std::filesystem::path(path) / manifestName).string() : path;
}

bool isSubstrate(const std::string& path)
{
  const std::string manifest = manifestOf(path);
  std::error_code error;
  if (!std::filesystem::is_regular_file(manifest, error))
  {
    return false;
  }
  // The name of the format comes first, so that a large JSON file of others is not read whole.
  std::array<char, 256> begin{};
  std::ifstream(manifest, std::ios::binary).read(begin.data(), begin.size());
  return std::string(begin.data(), begin.size()).find("\"CACTUS substrate folder\"") != std::string::npos;
}

SubstrateDescription describeSubstrate(const std::string& path)
{
  const std::string place = manifestOf(path);
  const std::string text = contentOf(place);
  const auto manifest = readManifest(text);
  const auto values = parsedJson(text);
  if (!manifest || !values)
  {
    refuseFile(place, "is no manifest of a substrate folder");
  }
  if (!manifest->asWritten)
  {
    refuseFile(place, manifest->hasChecksums ? wasChanged : "is of CACTUS 0.1.0, which kept no checksums of its files");
  }
  SubstrateDescription substrate;
  substrate.folder = folderOf(place).string();
  substrate.written = manifest->written;
  try
  {
    describe(*values, place, substrate);
  }
  catch (const Json::exception& error)
  {
    refuseFile(place, std::string("does not describe its surfaces: ") + error.what());
  }
  return substrate;
}

std::string fileAsWritten(const SubstrateDescription& substrate, const std::string& name)
{
  std::string path = (std::filesystem::path(substrate.folder) / name).string();
  const auto checksum = substrate.written.checksums.find(name);
  if (checksum == substrate.written.checksums.end())
  {
    refuseFile(path, "is not among the files that the manifest lists");
  }
  if (sha256OfFile(path) != checksum->second)
  {
    refuseFile(path, wasChanged);
  }
  return path;
}

std::optional<Fibres> centreLines(const SubstrateDescription& substrate)
{
  if (substrate.strands.empty() || substrate.strandFibres.empty())
  {
    return std::nullopt;
  }
  const std::string path = fileAsWritten(substrate, substrate.strands);
  Fibres fibres = readStrandFile(path);
  if (fibres.size() != substrate.strandFibres.size() || fibres.size() != substrate.strandBundles.size())
  {
    refuseFile(path, "does not hold the centre lines that the manifest lists");
  }
  fibres.domain = substrate.domain;
  fibres.fibreIds = substrate.strandFibres;
  fibres.bundleIds = substrate.strandBundles;
  return fibres;
}

} // namespace cactus
