// SPDX-License-Identifier: BSD-3-Clause
#include "io/TractogramFile.h"

#include "base/Error.h"
#include "base/Limits.h"
#include "base/PosixFile.h"
#include "io/TckFile.h"
#include "io/TrkFile.h"
#include "io/TrxFile.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

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

/// Opens the file, or folder, after a check of its name.
std::ifstream opened(const std::string& path)
{
  const std::string extension = extensionOf(path);
  if (extension != ".tck" && extension != ".trk" && extension != ".trx")
  {
    throw FileError(path + ": a tractogram's name ends in .tck, .trk or .trx");
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
  const std::string extension = extensionOf(path);
  if (extension == ".tck")
  {
    return readTck(file, path, context);
  }
  if (extension == ".trk")
  {
    return readTrk(file, path, context);
  }
  std::error_code error;
  return std::filesystem::is_directory(path, error) ? readTrx(Folder(path), path) : readTrx(ZipArchive(path), path);
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
/// not be fit for a substrate, so that a tractogram that was read can be saved: it may be as large as a head, and its points may
/// coincide.
void requireWritable(const Fibres& fibres, const Placement& placement)
{
  require(fibres.size() > 0, "the input holds no fibres: there is nothing to write");
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
      if (!std::isfinite(fibres.radii[i]) || fibres.radii[i] <= 0.0)
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
