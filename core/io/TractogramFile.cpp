// SPDX-License-Identifier: BSD-3-Clause
#include "io/TractogramFile.h"

#include "base/Error.h"
#include "base/Limits.h"
#include "base/PosixFile.h"
#include "io/FileCollection.h"
#include "io/GzipFile.h"
#include "io/TckFile.h"
#include "io/TrkFile.h"
#include "io/TrxFile.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string_view>

namespace cactus
{

namespace
{

/// Returns the extension in lower case, with its dot.
std::string extensionOf(std::string path)
{
  while (path.size() > 1 && path.back() == '/')
  {
    path.pop_back(); // of a folder
  }
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
    [](unsigned char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : static_cast<char>(c); });
  return extension;
}

/// How a name says what the file holds.
struct TractogramName
{
  std::string extension;  ///< in lower case, with its dot: .tck, .trk, .trx or another one
  bool isPacked = false;  ///< .gz follows
  bool hasOthers = false; ///< dots are left before the extension, between which other programs look for theirs

  explicit TractogramName(const std::string& path)
    : extension(extensionOf(path))
  {
    std::filesystem::path rest = std::filesystem::path(path).stem();
    if (extension == ".gz")
    {
      isPacked = true;
      extension = extensionOf(rest.string());
      rest = rest.stem();
    }
    hasOthers = rest.has_extension();
  }

  bool isTractogram() const { return extension == ".tck" || extension == ".trk" || (extension == ".trx" && !isPacked); }
};

/// Opens the file, or folder, after a check of its name.
std::ifstream opened(const std::string& path)
{
  if (!TractogramName(path).isTractogram())
  {
    throw FileError(path + ": a tractogram's name ends in .tck, .tck.gz, .trk, .trk.gz or .trx");
  }
  requireNoPipe("tractogram " + path, path);
  std::ifstream file(path, std::ios::binary);
  if (!file)
  {
    throw FileError("cannot open tractogram " + path + ": " + std::strerror(errno));
  }
  return file;
}

Tractogram readAny(const std::string& path, const Context& context)
{
  std::ifstream file = opened(path);
  const TractogramName name(path);
  std::stringstream content;
  if (name.isPacked)
  {
    unpackGzip(path, content, context);
  }
  std::istream& stream = name.isPacked ? static_cast<std::istream&>(content) : file;
  if (name.extension == ".tck")
  {
    return readTck(stream, path, context);
  }
  if (name.extension == ".trk")
  {
    return readTrk(stream, path, context);
  }
  std::error_code error;
  return std::filesystem::is_directory(path, error) ? readTrx(Folder(path), path) : readTrx(ZipArchive(path), path);
}

/// Whether the header of a .trx is there.
bool isTrx(const FileCollection& files)
{
  constexpr char header[] = "header.json";
  constexpr std::uint64_t longest = 1 << 20;
  constexpr std::string_view key = "\"NB_STREAMLINES\"";
  if (files.size(header) > longest)
  {
    return false;
  }
  const std::vector<char> bytes = files.read(header);
  return std::search(bytes.begin(), bytes.end(), key.begin(), key.end()) != bytes.end();
}

bool hasContentOf(const std::string& extension, const std::string& path)
{
  std::error_code error;
  if (extension != ".trx")
  {
    const std::string wanted = extension == ".tck" ? "mrtrix tracks" : "TRACK";
    return beginningOfFile(path, wanted.size()) == wanted;
  }
  if (std::filesystem::is_directory(path, error))
  {
    return isTrx(Folder(path));
  }
  return beginningOfFile(path, 2) == "PK" && isTrx(ZipArchive(path));
}

void requireWithinScanner(const Tractogram& tractogram, const std::string& path)
{
  const auto& points = tractogram.points;
  const auto bad =
    std::find_if(points.begin(), points.end(), [](double value) { return !limits::scannerCoordinate.holds(value); });
  if (bad != points.end())
  {
    const auto point = static_cast<std::size_t>(bad - points.begin()) / 3;
    const auto after = std::upper_bound(tractogram.offsets.begin(), tractogram.offsets.end(), point);
    throw FileError(text(path, ": streamline ", after - tractogram.offsets.begin(), ", point ", point - *std::prev(after) + 1,
      " has a coordinate of ", *bad, " mm: give ", limits::scannerCoordinate.lowest, " to ", limits::scannerCoordinate.highest));
  }
}

/// Throws InvalidInput unless the fibres can be written: there are some, and their points lie where a scanner has them. They need
/// not be fit for a substrate, so that a tractogram that was read can be saved: it may be as large as a head, its points may
/// coincide, and it need not have radii.
void requireWritable(const Fibres& fibres, const Placement& placement)
{
  require(fibres.size() > 0, "the input holds no fibres: there is nothing to write");
  const bool needsRadii = hasRadii(fibres);
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    const std::string name = text("fibre ", fibres.fibreIds[f], " (cell ", f, ")");
    if (fibres.pointCount(f) < 2)
    {
      throw InvalidInput(text(name, " has ", fibres.pointCount(f), " control point(s): a fibre needs at least two"));
    }
    for (std::size_t i = fibres.offsets[f]; i < fibres.offsets[f + 1]; ++i)
    {
      for (const double coordinate : placement.toImage(fibres.points[i]))
      {
        requireWithin((name + ": a coordinate").c_str(), coordinate, limits::scannerCoordinate);
      }
      if (needsRadii && !(std::isfinite(fibres.radii[i]) && fibres.radii[i] > 0.0))
      {
        throw InvalidInput(text(name, ": Radius is ", fibres.radii[i], ", not a positive length"));
      }
    }
  }
}

} // namespace

Tractogram readTractogram(const std::string& path, const Context& context)
{
  Tractogram tractogram = readAny(path, context);
  requireWithinScanner(tractogram, path);
  dropShortStreamlines(tractogram);
  return tractogram;
}

void requireTractogram(const std::string& path)
{
  opened(path);
}

bool isTractogram(const std::string& path)
{
  const TractogramName name(path);
  std::error_code error;
  const bool isFile = std::filesystem::is_regular_file(path, error);
  if (!name.isTractogram() || (!isFile && !std::filesystem::is_directory(path, error)))
  {
    return false;
  }
  try
  {
    return (isFile && !name.hasOthers) || hasContentOf(name.extension, path);
  }
  catch (const FileError&)
  {
    return false;
  }
}

void writeTractogram(const Fibres& fibres, const Placement& placement, const std::string& path, LengthUnit unit)
{
  const std::string extension = extensionOf(path);
  requireWritable(fibres, placement);
  if (extension == ".tck")
  {
    writeTck(fibres, placement, path, unit);
  }
  else if (extension == ".trx")
  {
    writeTrx(fibres, placement.in(unit), path);
  }
  else
  {
    throw InvalidInput("FileName is " + path + ": fibres are written as .tck or .trx");
  }
}

} // namespace cactus
