// SPDX-License-Identifier: BSD-3-Clause
#include "io/FolderFormat.h"

#include "base/Numbers.h"

#include <array>
#include <iterator>
#include <set>

namespace cactus
{

void FolderFormat::requireContents(const SubstrateFolderContents& /*contents*/) const {}

void FolderFormat::requireRoom(const Domain& /*domain*/, double /*voxelSize*/) const {}

void FolderFormat::requireMemory(const SubstrateCertificate& /*certificate*/) const {}

std::string FolderFormat::surfacePath(const SurfaceName& name) const
{
  return name.kind + '/' + name.thousand + "fibre_" + name.fibre + ".ply";
}

void FolderFormat::writeSurfaces(const SurfacesToWrite& written, FolderWriter& writer, const WritingRun& run) const
{
  prepareFiles(written.files, writer, run);
  std::vector<std::string> checksums(written.surfaces.size());
  run.sharing.loop(
    written.surfaces.size(), run.context,
    [&](std::size_t i)
    {
      const SubstrateFile& file = written.files[i];
      const std::string comment =
        "CACTUS " CACTUS_VERSION ", " + file.surface + " surface of fibre " + std::to_string(file.fibreId) + ", micrometres";
      checksums[i] = writer.put(file.path, plyText(written.surfaces.mesh(i), comment, written.encoding));
    },
    [&](std::size_t i) { return checksums[i]; }, [&](std::size_t i, const std::string& checksum) { checksums[i] = checksum; },
    "Writing surfaces", run.from, run.to);
  for (std::size_t i = 0; i < written.files.size(); ++i)
  {
    writer.remember(written.files[i].path, checksums[i]);
  }
}

void FolderFormat::writeOwnFiles(const SubstrateFolderContents& /*contents*/, WrittenSubstrate& /*substrate*/,
  FolderWriter& /*writer*/, const Context& /*context*/) const
{
}

std::vector<McdcSimulation> FolderFormat::startSimulations(
  const SubstrateFolderContents& /*contents*/, const std::vector<SubstrateFile>& /*files*/) const
{
  return {};
}

bool FolderFormat::needsStartPositions(const SubstrateFolderContents& /*contents*/) const
{
  return false;
}

SurfaceBox FolderFormat::startBox(const FibreSurfaces& /*surfaces*/, const Domain& domain, const Context& /*context*/) const
{
  SurfaceBox around; // of everything
  around.lower = domain.lower;
  around.upper = domain.upper;
  return around;
}

std::string FolderFormat::readme(const SubstrateFolderContents& /*contents*/, const WrittenSubstrate& /*substrate*/) const
{
  return "";
}

const FolderFormat& formatOf(SubstrateFormat format)
{
  static const std::array<const FolderFormat*, std::size(formatNames)> formats{ &mcdcFormat(), &referenceFormat(),
    &caminoFormat(), &disimpyFormat(), &rmsFormat(), &surfacesFormat(), &spinDoctorFormat(), &bundlesFormat(), &mcmrFormat() };
  return *formats.at(static_cast<std::size_t>(format));
}

std::string formatsThat(bool (FolderFormat::*may)() const)
{
  std::vector<std::string> names;
  for (std::size_t i = 0; i < std::size(formatNames); ++i)
  {
    if ((formatOf(static_cast<SubstrateFormat>(i)).*may)())
    {
      names.emplace_back(formatNames[i]);
    }
  }
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    text += (i == 0 ? "" : i + 1 == names.size() ? " or " : ", ") + names[i];
  }
  return text;
}

namespace
{

void makeFolders(const std::vector<SubstrateFile>& files, FolderWriter& writer)
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

} // namespace

void prepareFiles(const std::vector<SubstrateFile>& files, FolderWriter& writer, const WritingRun& run)
{
  if (run.sharing.isFirst())
  {
    makeFolders(files, writer);
  }
  run.sharing.exchange();
}

std::string numberWords(const Eigen::Vector3d& values, const char* between)
{
  std::string text;
  for (int axis = 0; axis < 3; ++axis)
  {
    text += axis > 0 ? between : "";
    appendNumber(text, values[axis], 9);
  }
  return text;
}

} // namespace cactus
