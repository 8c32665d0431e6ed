// SPDX-License-Identifier: BSD-3-Clause
#include "io/SurfaceFile.h"

#include "base/AtomicFile.h"
#include "base/Bytes.h"
#include "base/Error.h"
#include "base/Hash64.h"
#include "base/PosixFile.h"
#include "mesh/CappedSurface.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstddef>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>
#include <vector>

namespace cactus
{

namespace
{

const std::string surfaceTitle = "CACTUS surface 3\n";
/// Reads as another number if the byte order differs.
constexpr std::uint64_t orderOfBytes = 0x0102030405060708u;

constexpr double leastLayerHeight = 1.0; ///< µm
constexpr std::size_t trianglesOfLayer = 128;
/// Adjacent layers are read at once, up to this many bytes.
constexpr std::uint64_t longestRead = 1 << 20;

/// Returns the front of a file: everything that distinguishes one surface file from another.
std::string frontOf(const SurfaceFileOwner& owner)
{
  ByteWriter put;
  put(orderOfBytes);
  put(owner.fingerprint);
  put(owner.index);
  return surfaceTitle + put.bytes();
}

std::uint64_t checksumOf(const std::string& bytes, std::uint64_t before)
{
  return hash64(bytes.data(), bytes.size(), before);
}

std::uint64_t seedOf(const SurfaceFileOwner& owner)
{
  return checksumOf(frontOf(owner), 0);
}

/// Returns a seed that distinguishes layers, and their entries, from each other.
std::uint64_t seedOf(std::uint64_t before, std::uint64_t layer)
{
  return hash64(&layer, sizeof(layer), before);
}

/// The division of a surface into layers.
struct Layering
{
  /// Returns the layer of a height, which may be outside all layers.
  std::uint64_t at(double z) const
  {
    const double place = std::floor((z - this->first) / this->height);
    return place > 0.0 ? static_cast<std::uint64_t>(std::min(place, static_cast<double>(this->count - 1))) : 0;
  }

  double first = 0.0;  ///< µm, lower end of the first layer
  double height = 1.0; ///< µm, height of each layer
  std::uint64_t count = 0;
};

Layering layersOf(const TriangleMesh& surface)
{
  Layering layers;
  if (surface.points.empty())
  {
    return layers;
  }
  const auto byHeight = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return a[2] < b[2]; };
  const auto [lowest, highest] = std::minmax_element(surface.points.begin(), surface.points.end(), byHeight);
  const double height = (*highest)[2] - (*lowest)[2];
  const std::size_t mostByTriangles = surface.triangles.size() / trianglesOfLayer;
  const double most = std::min(height / leastLayerHeight, static_cast<double>(mostByTriangles));
  layers.first = (*lowest)[2];
  layers.count = most > 1.0 ? static_cast<std::uint64_t>(most) : 1;
  layers.height = layers.count > 1 ? height / static_cast<double>(layers.count) : 1.0;
  return layers;
}

double lowestCorner(const TriangleMesh& surface, const std::array<std::int32_t, 3>& t)
{
  return std::min(
    { surface.points[std::size_t(t[0])][2], surface.points[std::size_t(t[1])][2], surface.points[std::size_t(t[2])][2] });
}

double highestCorner(const TriangleMesh& surface, const std::array<std::int32_t, 3>& t)
{
  return std::max(
    { surface.points[std::size_t(t[0])][2], surface.points[std::size_t(t[1])][2], surface.points[std::size_t(t[2])][2] });
}

/// The place of a layer in the file, and the reach of its triangles.
struct LayerEntry
{
  std::uint64_t begin = 0; ///< place in the file
  std::uint64_t size = 0;  ///< bytes
  std::uint64_t checksum = 0;
  double top = -std::numeric_limits<double>::infinity(); ///< µm, highest corner
  std::uint64_t reachedFrom = 0;                         ///< the lowest layer whose highest corner is in this one or above
};
constexpr std::size_t bytesOfEntry = 48; // including its checksum

std::string entryText(const LayerEntry& entry, std::uint64_t seed)
{
  ByteWriter put;
  put(entry.begin);
  put(entry.size);
  put(entry.checksum);
  put(entry.top);
  put(entry.reachedFrom);
  put(checksumOf(put.bytes(), seed));
  return put.bytes();
}

/// The end of the file.
struct SurfaceFileEnd
{
  std::uint64_t points = 0;
  std::uint64_t triangles = 0;
  std::uint64_t entries = 0; ///< place of the entries
  Layering layers;
};
constexpr std::size_t bytesOfEnd = 56;

std::string endText(const SurfaceFileEnd& end, std::uint64_t seed)
{
  ByteWriter put;
  put(end.points);
  put(end.triangles);
  put(end.entries);
  put(end.layers.first);
  put(end.layers.height);
  put(end.layers.count);
  put(checksumOf(put.bytes(), seed));
  return put.bytes();
}

/// Writes increasing numbers, as their differences in groups of seven bits.
void putIncreasing(ByteWriter& put, const std::vector<std::int32_t>& numbers)
{
  std::uint32_t before = 0;
  for (const std::int32_t number : numbers)
  {
    auto more = static_cast<std::uint32_t>(number) - before;
    for (; more >= 0x80; more >>= 7)
    {
      put(static_cast<unsigned char>(more | 0x80));
    }
    put(static_cast<unsigned char>(more));
    before = static_cast<std::uint32_t>(number);
  }
}

/// Reads `count` increasing numbers; throws if one is not below `end`.
void getIncreasing(ByteReader& get, std::vector<std::int32_t>& numbers, std::uint32_t count, std::uint64_t end)
{
  std::uint64_t number = 0;
  for (std::uint32_t i = 0; i < count; ++i)
  {
    int shift = 0;
    for (unsigned char bits = 0x80; (bits & 0x80) != 0; shift += 7)
    {
      get(bits);
      number += static_cast<std::uint64_t>(bits & 0x7f) << std::min(shift, 32);
    }
    if (number >= end)
    {
      throw FileError("a number is too large");
    }
    numbers.push_back(static_cast<std::int32_t>(number));
  }
}

/// Some of a surface's triangles and points, both in increasing order.
struct SurfaceLayer
{
  std::vector<std::int32_t> pointOf;
  std::vector<std::int32_t> triangleOf;
  TriangleMesh mesh;
};

/// Writes points; the template gives the coordinates' type, to keep layers short.
template <typename Coordinate>
void putPoints(ByteWriter& put, const TriangleMesh& mesh)
{
  for (const Eigen::Vector3d& point : mesh.points)
  {
    for (const double coordinate : point)
    {
      put(static_cast<Coordinate>(coordinate));
    }
  }
}

template <typename Coordinate>
void getPoints(ByteReader& get, std::uint32_t count, TriangleMesh& mesh)
{
  for (std::uint32_t p = 0; p < count; ++p)
  {
    Eigen::Vector3d& point = mesh.points.emplace_back();
    for (double& coordinate : point)
    {
      coordinate = get.get<Coordinate>();
    }
  }
}

/// Writes corners; the template gives their type.
template <typename Corner>
void putCorners(ByteWriter& put, const TriangleMesh& mesh)
{
  for (const auto& t : mesh.triangles)
  {
    for (const std::int32_t corner : t)
    {
      put(static_cast<Corner>(corner));
    }
  }
}

template <typename Corner>
void getCorners(ByteReader& get, std::uint32_t count, TriangleMesh& mesh)
{
  for (std::uint32_t i = 0; i < count; ++i)
  {
    auto& t = mesh.triangles.emplace_back();
    for (std::int32_t& corner : t)
    {
      const auto found = get.get<Corner>();
      if (found >= mesh.points.size())
      {
        throw FileError("a corner is no point");
      }
      corner = static_cast<std::int32_t>(found);
    }
  }
}

constexpr std::size_t mostOfShortCorners = std::size_t(std::numeric_limits<std::uint16_t>::max()) + 1;

std::string layerText(const SurfaceLayer& layer)
{
  ByteWriter put;
  put(static_cast<std::uint32_t>(layer.pointOf.size()));
  put(static_cast<std::uint32_t>(layer.triangleOf.size()));
  putIncreasing(put, layer.pointOf);
  putIncreasing(put, layer.triangleOf);
  const bool isShort = isInSinglePrecision(layer.mesh);
  put(isShort);
  isShort ? putPoints<float>(put, layer.mesh) : putPoints<double>(put, layer.mesh);
  layer.mesh.points.size() <= mostOfShortCorners ? putCorners<std::uint16_t>(put, layer.mesh)
                                                 : putCorners<std::uint32_t>(put, layer.mesh);
  return put.bytes();
}

SurfaceLayer layerFrom(const std::string& bytes, const SurfaceFileEnd& end)
{
  ByteReader get(bytes);
  SurfaceLayer layer;
  const auto points = get.get<std::uint32_t>();
  const auto triangles = get.get<std::uint32_t>();
  getIncreasing(get, layer.pointOf, points, end.points);
  getIncreasing(get, layer.triangleOf, triangles, end.triangles);
  get.get<std::uint8_t>() != 0 ? getPoints<float>(get, points, layer.mesh) : getPoints<double>(get, points, layer.mesh);
  points <= mostOfShortCorners ? getCorners<std::uint16_t>(get, triangles, layer.mesh)
                               : getCorners<std::uint32_t>(get, triangles, layer.mesh);
  if (!get.isAtEnd())
  {
    throw FileError("a layer is too long");
  }
  return layer;
}

/// Cuts a surface into layers, from below.
class LayerCutter
{
public:
  LayerCutter(const TriangleMesh& surface, const Layering& layers)
    : Surface(surface)
    , Starts(layers.count + 1, 0)
    , Order(surface.triangles.size())
    , PlaceOf(surface.points.size(), none)
  {
    std::vector<std::uint64_t> layerOf;
    layerOf.reserve(surface.triangles.size());
    for (const auto& t : surface.triangles)
    {
      layerOf.push_back(layers.at(lowestCorner(surface, t)));
      ++this->Starts[std::size_t(layerOf.back()) + 1];
      for (const std::int32_t corner : t)
      {
        this->PlaceOf[std::size_t(corner)] = used;
      }
    }
    for (std::size_t layer = 0; layer < layers.count; ++layer)
    {
      this->Starts[layer + 1] += this->Starts[layer];
    }
    std::vector<std::size_t> next(this->Starts.begin(), this->Starts.end());
    for (std::size_t t = 0; t < layerOf.size(); ++t)
    {
      this->Order[next[std::size_t(layerOf[t])]++] = static_cast<std::int32_t>(t);
    }
  }

  SurfaceLayer cut(std::size_t number)
  {
    SurfaceLayer layer;
    layer.triangleOf.assign(
      this->Order.begin() + std::ptrdiff_t(this->Starts[number]), this->Order.begin() + std::ptrdiff_t(this->Starts[number + 1]));
    for (const std::int32_t t : layer.triangleOf)
    {
      const auto& corners = this->Surface.triangles[std::size_t(t)];
      layer.pointOf.insert(layer.pointOf.end(), corners.begin(), corners.end());
    }
    for (std::size_t p = 0; number == 0 && p < this->PlaceOf.size(); ++p)
    {
      if (this->PlaceOf[p] == none) // a point without triangles is kept, too
      {
        layer.pointOf.push_back(static_cast<std::int32_t>(p));
      }
    }
    std::sort(layer.pointOf.begin(), layer.pointOf.end());
    layer.pointOf.erase(std::unique(layer.pointOf.begin(), layer.pointOf.end()), layer.pointOf.end());
    for (const std::int32_t p : layer.pointOf)
    {
      this->PlaceOf[std::size_t(p)] = static_cast<std::int32_t>(layer.mesh.points.size());
      layer.mesh.points.push_back(this->Surface.points[std::size_t(p)]);
    }
    for (const std::int32_t t : layer.triangleOf)
    {
      auto corners = this->Surface.triangles[std::size_t(t)];
      for (std::int32_t& corner : corners)
      {
        corner = this->PlaceOf[std::size_t(corner)];
      }
      layer.mesh.triangles.push_back(corners);
    }
    return layer;
  }

private:
  static constexpr std::int32_t none = -1;
  static constexpr std::int32_t used = 0;

  const TriangleMesh& Surface;
  std::vector<std::size_t> Starts;   ///< per layer, its start in Order, and the end
  std::vector<std::int32_t> Order;   ///< triangles by layer, increasing in each
  std::vector<std::int32_t> PlaceOf; ///< per point, its place in the last layer cut that has it
};

/// Fills in, for each layer, the lowest layer that reaches it.
void noteReach(std::vector<LayerEntry>& entries, const Layering& layers)
{
  std::uint64_t done = 0;
  for (std::uint64_t from = 0; from < entries.size(); ++from)
  {
    const std::uint64_t last = std::max(from, layers.at(entries[std::size_t(from)].top));
    for (done = std::max(done, from); done <= last; ++done)
    {
      entries[std::size_t(done)].reachedFrom = from;
    }
  }
}

/// Reads parts of a surface's file.
class SurfaceFileReader
{
public:
  SurfaceFileReader(const std::string& path, const SurfaceFileOwner& owner)
    : Path(path)
    , Seed(seedOf(owner))
    , File(::open(path.c_str(), O_RDONLY | O_CLOEXEC))
  {
    struct stat status = {};
    if (!this->File || ::fstat(this->File.get(), &status) != 0)
    {
      throw FileError("cannot read " + path + ": " + systemMessage(errno));
    }
    this->Size = static_cast<std::uint64_t>(status.st_size);
    const std::uint64_t front = frontOf(owner).size();
    this->require(this->Size >= front + bytesOfEnd);
    const std::string bytes = this->read(this->Size - bytesOfEnd, bytesOfEnd);
    ByteReader get(bytes);
    get(this->End.points);
    get(this->End.triangles);
    get(this->End.entries);
    get(this->End.layers.first);
    get(this->End.layers.height);
    get(this->End.layers.count);
    this->require(endText(this->End, this->Seed) == bytes);
    const std::uint64_t left = this->Size - bytesOfEnd - front;
    // A point takes at least 13 bytes, and a triangle 7.
    this->require(this->End.points <= left / 13 && this->End.triangles <= left / 7 &&
                  this->End.layers.count <= left / bytesOfEntry &&
                  this->End.entries == this->Size - bytesOfEnd - bytesOfEntry * this->End.layers.count);
  }

  const SurfaceFileEnd& end() const { return this->End; }

  std::string read(std::uint64_t begin, std::uint64_t size) const
  {
    this->require(begin <= this->Size && size <= this->Size - begin);
    std::string bytes(std::size_t(size), '\0');
    for (std::size_t done = 0; done < bytes.size();)
    {
      const ssize_t count =
        ::pread(this->File.get(), &bytes[done], bytes.size() - done, static_cast<off_t>(begin + std::uint64_t(done)));
      if (count < 0 && errno != EINTR)
      {
        throw FileError("cannot read " + this->Path + ": " + systemMessage(errno));
      }
      this->require(count != 0);
      done += count > 0 ? static_cast<std::size_t>(count) : 0;
    }
    return bytes;
  }

  /// Returns the entries of the layers from `first` to `last`.
  std::vector<LayerEntry> entries(std::uint64_t first, std::uint64_t last) const
  {
    const std::string bytes = this->read(this->End.entries + bytesOfEntry * first, bytesOfEntry * (last + 1 - first));
    ByteReader get(bytes);
    std::vector<LayerEntry> entries(std::size_t(last + 1 - first));
    for (std::size_t i = 0; i < entries.size(); ++i)
    {
      LayerEntry& entry = entries[i];
      get(entry.begin);
      get(entry.size);
      get(entry.checksum);
      get(entry.top);
      get(entry.reachedFrom);
      get.get<std::uint64_t>();
      this->require(entryText(entry, seedOf(this->Seed, first + i)) == bytes.substr(bytesOfEntry * i, bytesOfEntry));
    }
    return entries;
  }

  /// Calls visit(layer) for the layers of `entries`, the first of which is layer `first`, if `isWanted(entry)`.
  template <typename IsWanted, typename Visit>
  void visitLayers(const std::vector<LayerEntry>& entries, std::uint64_t first, IsWanted&& isWanted, Visit&& visit) const
  {
    for (std::size_t from = 0; from < entries.size();)
    {
      std::size_t to = from;
      std::uint64_t size = 0;
      while (to < entries.size() && isWanted(entries[to]) && entries[to].begin == entries[from].begin + size &&
             (to == from || size + entries[to].size <= longestRead))
      {
        size += entries[to++].size;
      }
      const std::string bytes = this->read(entries[from].begin, size);
      for (std::size_t i = from; i < to; ++i)
      {
        const std::string own = bytes.substr(std::size_t(entries[i].begin - entries[from].begin), std::size_t(entries[i].size));
        this->require(checksumOf(own, seedOf(this->Seed, first + i)) == entries[i].checksum);
        visit(layerFrom(own, this->End));
      }
      from = std::max(to, from + 1);
    }
  }

  void require(bool isGood) const
  {
    if (!isGood)
    {
      throw FileError(this->Path + " is damaged, or another one's");
    }
  }

private:
  std::string Path;
  std::uint64_t Seed;
  Descriptor File;
  std::uint64_t Size = 0;
  SurfaceFileEnd End;
};

/// Adds a layer's triangles and points, with their indices in the whole surface.
void addLayer(const SurfaceLayer& layer, std::vector<std::pair<std::int32_t, Eigen::Vector3d>>& points,
  std::vector<std::pair<std::int32_t, std::array<std::int32_t, 3>>>& triangles)
{
  for (std::size_t p = 0; p < layer.pointOf.size(); ++p)
  {
    points.emplace_back(layer.pointOf[p], layer.mesh.points[p]);
  }
  for (std::size_t t = 0; t < layer.triangleOf.size(); ++t)
  {
    auto corners = layer.mesh.triangles[t];
    for (std::int32_t& corner : corners)
    {
      corner = layer.pointOf[std::size_t(corner)];
    }
    triangles.emplace_back(layer.triangleOf[t], corners);
  }
}

} // namespace

void writeSurface(const std::string& path, const SurfaceFileOwner& owner, const TriangleMesh& surface)
{
  const std::string front = frontOf(owner);
  const std::uint64_t seed = seedOf(owner);
  AtomicFile file(path);
  const auto write = [&file](const std::string& bytes)
  { file.stream().write(bytes.data(), static_cast<std::streamsize>(bytes.size())); };
  write(front);
  SurfaceFileEnd end;
  end.points = surface.points.size();
  end.triangles = surface.triangles.size();
  end.entries = front.size();
  end.layers = layersOf(surface);
  std::vector<LayerEntry> entries(std::size_t(end.layers.count));
  LayerCutter cutter(surface, end.layers);
  for (std::size_t i = 0; i < entries.size(); ++i)
  {
    const SurfaceLayer layer = cutter.cut(i);
    const std::string bytes = layerText(layer);
    for (const std::int32_t t : layer.triangleOf)
    {
      entries[i].top = std::max(entries[i].top, highestCorner(surface, surface.triangles[std::size_t(t)]));
    }
    entries[i].begin = end.entries;
    entries[i].size = bytes.size();
    entries[i].checksum = checksumOf(bytes, seedOf(seed, i));
    write(bytes);
    end.entries += bytes.size();
  }
  noteReach(entries, end.layers);
  for (std::size_t i = 0; i < entries.size(); ++i)
  {
    write(entryText(entries[i], seedOf(seed, i)));
  }
  write(endText(end, seed));
  if (std::filesystem::exists(path))
  {
    // Only this run's own file is replaced.
    const std::size_t shared = front.size() - sizeof(owner.index);
    std::string there(shared, '\0');
    std::ifstream(path, std::ios::binary).read(&there[0], static_cast<std::streamsize>(shared));
    if (there != front.substr(0, shared))
    {
      throw FileError(path + " is not of this run, and is kept: remove it");
    }
  }
  file.commit();
}

TriangleMesh readSurface(const std::string& path, const SurfaceFileOwner& owner)
{
  const SurfaceFileReader file(path, owner);
  const std::string front = frontOf(owner);
  file.require(file.read(0, front.size()) == front);
  TriangleMesh surface;
  surface.points.resize(std::size_t(file.end().points));
  surface.triangles.resize(std::size_t(file.end().triangles));
  std::uint64_t triangles = 0;
  std::uint64_t next = front.size(); // no gaps are allowed between layers
  const std::uint64_t count = file.end().layers.count;
  const std::vector<LayerEntry> entries = count > 0 ? file.entries(0, count - 1) : std::vector<LayerEntry>();
  for (const LayerEntry& entry : entries)
  {
    file.require(entry.begin == next);
    next += entry.size;
  }
  file.require(next == file.end().entries);
  file.visitLayers(
    entries, 0, [](const LayerEntry&) { return true; },
    [&](const SurfaceLayer& layer)
    {
      for (std::size_t p = 0; p < layer.pointOf.size(); ++p)
      {
        surface.points[std::size_t(layer.pointOf[p])] = layer.mesh.points[p];
      }
      for (std::size_t t = 0; t < layer.triangleOf.size(); ++t)
      {
        auto& corners = surface.triangles[std::size_t(layer.triangleOf[t])];
        corners = layer.mesh.triangles[t];
        for (std::int32_t& corner : corners)
        {
          corner = layer.pointOf[std::size_t(corner)];
        }
      }
      triangles += layer.triangleOf.size();
    });
  file.require(triangles == file.end().triangles);
  return surface;
}

SurfacePart readSurfacePart(const std::string& path, const SurfaceFileOwner& owner, double lower, double upper)
{
  const SurfaceFileReader file(path, owner);
  const Layering& layers = file.end().layers;
  if (layers.count == 0)
  {
    return {};
  }
  const std::uint64_t from = layers.at(lower);
  const std::uint64_t last = std::max(from, layers.at(upper));
  std::vector<LayerEntry> entries = file.entries(from, last);
  const std::uint64_t first = entries.front().reachedFrom;
  file.require(first <= from);
  if (first < from)
  {
    const std::vector<LayerEntry> below = file.entries(first, from - 1);
    entries.insert(entries.begin(), below.begin(), below.end());
  }
  std::vector<std::pair<std::int32_t, Eigen::Vector3d>> points;
  std::vector<std::pair<std::int32_t, std::array<std::int32_t, 3>>> triangles;
  file.visitLayers(
    entries, first, [lower](const LayerEntry& entry) { return entry.top >= lower; },
    [&](const SurfaceLayer& layer) { addLayer(layer, points, triangles); });
  const auto byNumber = [](const auto& a, const auto& b) { return a.first < b.first; };
  std::sort(points.begin(), points.end(), byNumber);
  points.erase(
    std::unique(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.first == b.first; }), points.end());
  std::sort(triangles.begin(), triangles.end(), byNumber);
  TriangleMesh around;
  for (const auto& point : points)
  {
    around.points.push_back(point.second);
  }
  for (const auto& triangle : triangles)
  {
    auto& corners = around.triangles.emplace_back(triangle.second);
    for (std::int32_t& corner : corners)
    {
      const auto place = std::lower_bound(
        points.begin(), points.end(), corner, [](const auto& point, std::int32_t number) { return point.first < number; });
      corner = static_cast<std::int32_t>(place - points.begin());
    }
  }
  SurfacePart part = cutOut(around, lower, upper);
  for (std::int32_t& point : part.pointOf)
  {
    point = points[std::size_t(point)].first;
  }
  return part;
}

} // namespace cactus
