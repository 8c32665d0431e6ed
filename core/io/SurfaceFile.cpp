// SPDX-License-Identifier: BSD-3-Clause
#include "io/SurfaceFile.h"

#include "base/AtomicFile.h"
#include "base/Bytes.h"
#include "base/Error.h"
#include "base/Hash64.h"
#include "base/PosixFile.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstddef>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <tuple>
#include <unistd.h>
#include <utility>
#include <vector>

namespace cactus
{

namespace
{

const std::string surfaceTitle = "CACTUS surface 4\n";
/// Reads as another number if the byte order differs.
constexpr std::uint64_t orderOfBytes = 0x0102030405060708u;

constexpr double leastLayerHeight = 1.0; ///< µm
constexpr std::size_t trianglesOfLayer = 128;

/// Returns the front of a file: everything that distinguishes one surface file from another; the number of the surface comes
/// last.
std::string frontOf(const SurfaceFileOwner& owner)
{
  return surfaceTitle + bytesOf(orderOfBytes, owner.fingerprint, owner.index);
}

/// What a file says of its surface after the front: the numbers of points and triangles, and the layers along z.
struct SurfaceHeader
{
  /// Returns the layer of a height, which may be outside all layers.
  std::uint64_t layerAt(double z) const
  {
    const double place = std::floor((z - this->lowest) / this->height);
    return place > 0.0 ? static_cast<std::uint64_t>(std::min(place, static_cast<double>(this->layers - 1))) : 0;
  }

  std::uint64_t points = 0;
  std::uint64_t triangles = 0;
  std::uint64_t layers = 1;
  double lowest = 0.0; ///< µm, lower end of the first layer
  double height = 1.0; ///< µm, of each layer
};

auto membersOf(SurfaceHeader& header)
{
  return std::tie(header.points, header.triangles, header.layers, header.lowest, header.height);
}

SurfaceHeader headerOf(const TriangleMesh& surface)
{
  SurfaceHeader header;
  header.points = surface.points.size();
  header.triangles = surface.triangles.size();
  if (!surface.points.empty())
  {
    const auto isBelow = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return a[2] < b[2]; };
    const auto [lowest, highest] = std::minmax_element(surface.points.begin(), surface.points.end(), isBelow);
    const double height = (*highest)[2] - (*lowest)[2];
    const std::size_t mostByTriangles = surface.triangles.size() / trianglesOfLayer;
    const double most = std::min(height / leastLayerHeight, static_cast<double>(mostByTriangles));
    header.lowest = (*lowest)[2];
    header.layers = most > 1.0 ? static_cast<std::uint64_t>(most) : 1;
    header.height = header.layers > 1 ? height / static_cast<double>(header.layers) : 1.0;
  }
  return header;
}

/// Writes numbers in as many bytes each as the largest one needs: 1, 2 or 4.
void putNumbers(ByteWriter& put, const std::vector<std::int32_t>& numbers)
{
  const std::int32_t largest = numbers.empty() ? 0 : *std::max_element(numbers.begin(), numbers.end());
  const std::uint8_t width = largest < 0x100 ? 1 : largest < 0x10000 ? 2 : 4;
  put(width);
  put(static_cast<std::uint32_t>(numbers.size()));
  for (const std::int32_t number : numbers)
  {
    width == 1 ? put(static_cast<std::uint8_t>(number)) : width == 2 ? put(static_cast<std::uint16_t>(number)) : put(number);
  }
}

std::vector<std::int32_t> getNumbers(ByteReader& get)
{
  const auto width = get.get<std::uint8_t>();
  std::vector<std::int32_t> numbers(get.get<std::uint32_t>());
  for (std::int32_t& number : numbers)
  {
    number = width == 1 ? get.get<std::uint8_t>() : width == 2 ? get.get<std::uint16_t>() : get.get<std::int32_t>();
  }
  return numbers;
}

/// Does the same for increasing numbers, by their differences.
void putIncreasing(ByteWriter& put, std::vector<std::int32_t> numbers)
{
  std::adjacent_difference(numbers.begin(), numbers.end(), numbers.begin());
  putNumbers(put, numbers);
}

std::vector<std::int32_t> getIncreasing(ByteReader& get)
{
  std::vector<std::int32_t> numbers = getNumbers(get);
  std::partial_sum(numbers.begin(), numbers.end(), numbers.begin());
  return numbers;
}

/// Returns the place of one of some increasing numbers.
std::int32_t placeOf(std::int32_t number, const std::vector<std::int32_t>& numbers)
{
  return static_cast<std::int32_t>(std::lower_bound(numbers.begin(), numbers.end(), number) - numbers.begin());
}

/// Some of a surface's triangles, and the points that they use, both in increasing order.
struct SurfaceLayer
{
  /// Returns the corners of a triangle, by their numbers in the surface.
  std::array<std::int32_t, 3> cornersOf(std::size_t triangle) const
  {
    const std::int32_t* place = &this->corners[3 * triangle];
    return { { this->pointOf[std::size_t(place[0])], this->pointOf[std::size_t(place[1])],
      this->pointOf[std::size_t(place[2])] } };
  }

  std::uint64_t reachedFrom = 0; ///< the lowest layer that has a triangle which ends in this one or above
  std::vector<std::int32_t> pointOf;
  std::vector<std::int32_t> triangleOf;
  std::vector<std::int32_t> corners; ///< three of each triangle, by their places in pointOf
  std::vector<Eigen::Vector3d> points;
};

/// Divides a surface into layers: each has the triangles whose lowest corners are in it. Fills in their reach and numbers alone.
std::vector<SurfaceLayer> layersOf(const TriangleMesh& surface, const SurfaceHeader& header)
{
  std::vector<SurfaceLayer> layers(std::size_t(header.layers));
  for (std::size_t i = 0; i < layers.size(); ++i)
  {
    layers[i].reachedFrom = i;
  }
  std::vector<bool> isUsed(surface.points.size());
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
  {
    const auto& corners = surface.triangles[t];
    const auto z = [&](std::size_t corner) { return surface.points[std::size_t(corners[corner])][2]; };
    const auto [lowest, highest] = std::minmax({ z(0), z(1), z(2) });
    const std::uint64_t from = header.layerAt(lowest);
    SurfaceLayer& own = layers[std::size_t(from)];
    own.triangleOf.push_back(static_cast<std::int32_t>(t));
    own.pointOf.insert(own.pointOf.end(), corners.begin(), corners.end());
    SurfaceLayer& top = layers[std::size_t(header.layerAt(highest))];
    top.reachedFrom = std::min(top.reachedFrom, from);
    for (const std::int32_t corner : corners)
    {
      isUsed[std::size_t(corner)] = true;
    }
  }
  for (std::size_t p = 0; p < isUsed.size(); ++p)
  {
    if (!isUsed[p]) // a point without triangles is kept, too
    {
      layers.front().pointOf.push_back(static_cast<std::int32_t>(p));
    }
  }
  for (std::size_t i = layers.size() - 1; i > 0; --i)
  {
    layers[i - 1].reachedFrom = std::min(layers[i - 1].reachedFrom, layers[i].reachedFrom);
  }
  return layers;
}

/// Fills in the rest of a layer.
void fillIn(SurfaceLayer& layer, const TriangleMesh& surface)
{
  std::sort(layer.pointOf.begin(), layer.pointOf.end());
  layer.pointOf.erase(std::unique(layer.pointOf.begin(), layer.pointOf.end()), layer.pointOf.end());
  for (const std::int32_t point : layer.pointOf)
  {
    layer.points.push_back(surface.points[std::size_t(point)]);
  }
  for (const std::int32_t triangle : layer.triangleOf)
  {
    for (const std::int32_t corner : surface.triangles[std::size_t(triangle)])
    {
      layer.corners.push_back(placeOf(corner, layer.pointOf));
    }
  }
}

std::string layerText(const SurfaceLayer& layer, std::uint64_t seed)
{
  ByteWriter put;
  put(layer.reachedFrom);
  putIncreasing(put, layer.pointOf);
  putIncreasing(put, layer.triangleOf);
  putNumbers(put, layer.corners);
  const bool isShort = std::all_of(layer.points.begin(), layer.points.end(),
    [](const Eigen::Vector3d& point) { return point == point.cast<float>().cast<double>(); });
  put(isShort);
  for (const Eigen::Vector3d& point : layer.points)
  {
    for (const double coordinate : point)
    {
      isShort ? put(static_cast<float>(coordinate)) : put(coordinate);
    }
  }
  put(hash64(put.bytes().data(), put.bytes().size(), seed));
  return std::move(put.bytes());
}

SurfaceLayer layerFrom(const std::string& bytes)
{
  ByteReader get(bytes);
  SurfaceLayer layer;
  get(layer.reachedFrom);
  layer.pointOf = getIncreasing(get);
  layer.triangleOf = getIncreasing(get);
  layer.corners = getNumbers(get);
  const auto isShort = get.get<bool>();
  layer.points.resize(layer.pointOf.size());
  for (Eigen::Vector3d& point : layer.points)
  {
    for (double& coordinate : point)
    {
      coordinate = isShort ? static_cast<double>(get.get<float>()) : get.get<double>();
    }
  }
  return layer;
}

/// Reads parts of a surface's file.
class SurfaceFileReader
{
public:
  SurfaceFileReader(const std::string& path, const SurfaceFileOwner& owner)
    : Path(path)
    , File(::open(path.c_str(), O_RDONLY | O_CLOEXEC))
    , Size(std::max<off_t>(0, ::lseek(this->File.get(), 0, SEEK_END)))
  {
    const std::string front = frontOf(owner);
    std::uint64_t size = 0;
    const std::string head = this->read(0, front.size() + bytesOf(this->Header, this->Seed, size).size());
    getAll(head.substr(front.size()), this->Header, this->Seed, size);
    this->Table = head.size();
    this->require(head.compare(0, front.size(), front) == 0 && size == this->Size &&
                  this->Seed == hash64(head.data(), head.size() - sizeof(this->Seed) - sizeof(size)));
  }

  const SurfaceHeader& header() const { return this->Header; }

  /// Calls visit(layer) for the layers from `first` to `last`; returns the lowest layer that reaches `first`.
  template <typename Visit>
  std::uint64_t visitLayers(std::uint64_t first, std::uint64_t last, Visit&& visit) const
  {
    std::vector<std::uint64_t> begins(std::size_t(last + 2 - first));
    const std::string table = this->read(this->Table + sizeof(first) * first, sizeof(first) * begins.size());
    ByteReader(table).getAll(begins.data(), begins.size());
    this->require(std::is_sorted(begins.begin(), begins.end()));
    const std::string bytes = this->read(begins.front(), begins.back() - begins.front());
    std::uint64_t reachedFrom = first;
    for (std::size_t i = 0; i + 1 < begins.size(); ++i)
    {
      const std::string own = bytes.substr(std::size_t(begins[i] - begins.front()), std::size_t(begins[i + 1] - begins[i]));
      this->require(own.size() > sizeof(this->Seed));
      const std::size_t size = own.size() - sizeof(this->Seed);
      this->require(own.substr(size) == bytesOf(hash64(own.data(), size, this->Seed + first + i)));
      const SurfaceLayer layer = layerFrom(own);
      reachedFrom = std::min(reachedFrom, layer.reachedFrom);
      visit(layer);
    }
    return reachedFrom;
  }

private:
  std::string read(std::uint64_t begin, std::uint64_t size) const
  {
    this->require(begin <= this->Size && size <= this->Size - begin);
    std::string bytes(std::size_t(size), '\0');
    for (std::size_t done = 0; done < bytes.size();)
    {
      const ssize_t count = ::pread(this->File.get(), &bytes[done], bytes.size() - done, static_cast<off_t>(begin + done));
      this->require(count > 0 || (count < 0 && errno == EINTR));
      done += static_cast<std::size_t>(std::max<ssize_t>(0, count));
    }
    return bytes;
  }
  void require(bool isGood) const
  {
    if (!isGood)
    {
      throw FileError(this->Path + " cannot be read, is damaged, or another one's");
    }
  }

  std::string Path;
  Descriptor File;
  std::uint64_t Size;
  std::uint64_t Table = 0; ///< where the places of the layers are
  std::uint64_t Seed = 0;  ///< the hash of the head; distinguishes its layers from others
  SurfaceHeader Header;
};

} // namespace

void writeSurface(const std::string& path, const SurfaceFileOwner& owner, const TriangleMesh& surface)
{
  const SurfaceHeader header = headerOf(surface);
  const std::string head = frontOf(owner) + bytesOf(header);
  const std::uint64_t seed = hash64(head.data(), head.size());
  std::string layers;
  std::vector<std::uint64_t> begins{ head.size() + sizeof(seed) * (header.layers + 3) };
  for (SurfaceLayer& layer : layersOf(surface, header))
  {
    fillIn(layer, surface);
    layers += layerText(layer, seed + begins.size() - 1);
    begins.push_back(begins.front() + layers.size());
    layer = {};
  }
  ByteWriter table;
  table.addAll(begins.data(), begins.size());
  AtomicFile file(path);
  file.stream() << head << bytesOf(seed, begins.back()) << table.bytes() << layers;
  if (std::filesystem::exists(path))
  {
    // Only this run's own file is replaced.
    const std::string own = frontOf(owner).substr(0, frontOf(owner).size() - sizeof(owner.index));
    std::string there(own.size(), '\0');
    std::ifstream(path, std::ios::binary).read(&there[0], static_cast<std::streamsize>(there.size()));
    if (there != own)
    {
      throw FileError(path + " is not of this run, and is kept: remove it");
    }
  }
  file.commit();
}

TriangleMesh readSurface(const std::string& path, const SurfaceFileOwner& owner)
{
  const SurfaceFileReader file(path, owner);
  TriangleMesh surface;
  surface.points.resize(std::size_t(file.header().points));
  surface.triangles.resize(std::size_t(file.header().triangles));
  file.visitLayers(0, file.header().layers - 1,
    [&](const SurfaceLayer& layer)
    {
      for (std::size_t p = 0; p < layer.pointOf.size(); ++p)
      {
        surface.points[std::size_t(layer.pointOf[p])] = layer.points[p];
      }
      for (std::size_t t = 0; t < layer.triangleOf.size(); ++t)
      {
        surface.triangles[std::size_t(layer.triangleOf[t])] = layer.cornersOf(t);
      }
    });
  return surface;
}

SurfacePart readSurfacePart(const std::string& path, const SurfaceFileOwner& owner, double lower, double upper)
{
  const SurfaceFileReader file(path, owner);
  std::vector<std::pair<std::int32_t, Eigen::Vector3d>> points;
  std::vector<std::pair<std::int32_t, std::array<std::int32_t, 3>>> triangles;
  const auto take = [&](const SurfaceLayer& layer)
  {
    for (std::size_t p = 0; p < layer.pointOf.size(); ++p)
    {
      points.emplace_back(layer.pointOf[p], layer.points[p]);
    }
    for (std::size_t t = 0; t < layer.triangleOf.size(); ++t)
    {
      triangles.emplace_back(layer.triangleOf[t], layer.cornersOf(t));
    }
  };
  const std::uint64_t from = file.header().layerAt(lower);
  const std::uint64_t first = file.visitLayers(from, std::max(from, file.header().layerAt(upper)), take);
  if (first < from)
  {
    file.visitLayers(first, from - 1, take);
  }
  const auto byNumber = [](const auto& a, const auto& b) { return a.first < b.first; };
  std::sort(points.begin(), points.end(), byNumber);
  std::sort(triangles.begin(), triangles.end(), byNumber);
  std::vector<std::int32_t> numbers;
  TriangleMesh around;
  for (const auto& [number, point] : points)
  {
    if (numbers.empty() || number != numbers.back())
    {
      numbers.push_back(number);
      around.points.push_back(point);
    }
  }
  for (auto& triangle : triangles)
  {
    for (std::int32_t& corner : triangle.second)
    {
      corner = placeOf(corner, numbers);
    }
    around.triangles.push_back(triangle.second);
  }
  SurfacePart part = cutOut(around, lower, upper);
  for (std::int32_t& point : part.pointOf)
  {
    point = numbers[std::size_t(point)];
  }
  return part;
}

} // namespace cactus
