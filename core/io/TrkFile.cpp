// SPDX-License-Identifier: BSD-3-Clause
#include "io/TrkFile.h"

#include "base/Error.h"
#include "base/Memory.h"
#include "io/BinaryReader.h"
#include "io/TrkOrientation.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <vector>

namespace cactus
{

namespace
{

constexpr std::size_t headerSize = 1000;
constexpr std::size_t namesPerKind = 10;
constexpr std::size_t nameLength = 20;

// Positions in the header.
constexpr std::size_t dimensionsAt = 6;
constexpr std::size_t voxelSizesAt = 12;
constexpr std::size_t scalarsAt = 36;
constexpr std::size_t scalarNamesAt = 38;
constexpr std::size_t propertiesAt = 238;
constexpr std::size_t propertyNamesAt = 240;
constexpr std::size_t voxelToRasAt = 440;
constexpr std::size_t voxelOrderAt = 948;
constexpr std::size_t countAt = 988;
constexpr std::size_t versionAt = 992;
constexpr std::size_t headerSizeAt = 996;

/// The first 1000 bytes of a file, and the numbers in them.
class HeaderBytes
{
public:
  explicit HeaderBytes(BinaryReader& reader)
  {
    reader.numbers(this->Bytes.data(), headerSize, "the header of 1000 bytes");
    if (std::memcmp(this->Bytes.data(), "TRACK", 5) != 0)
    {
      reader.fail("this is no .trk file: it does not begin with 'TRACK'");
    }
    constexpr auto wanted = static_cast<std::int32_t>(headerSize);
    this->Swapped = this->number<std::int32_t>(headerSizeAt) != wanted;
    if (this->number<std::int32_t>(headerSizeAt) != wanted) // also in the other order
    {
      reader.fail("its header gives its own size as other than 1000 in either byte order: it is damaged");
    }
    reader.setSwapped(this->Swapped);
  }

  template <typename Number>
  Number number(std::size_t at) const
  {
    Number value;
    std::memcpy(&value, this->Bytes.data() + at, sizeof(Number));
    if (this->Swapped)
    {
      swapBytes(&value, 1);
    }
    return value;
  }

  /// Returns the text up to its first zero.
  std::string text(std::size_t at, std::size_t length) const
  {
    std::string found(this->Bytes.data() + at, length);
    return found.substr(0, found.find('\0'));
  }

private:
  std::array<char, headerSize> Bytes{};
  bool Swapped = false;
};

TrkSpace spaceOf(const HeaderBytes& header)
{
  TrkSpace space;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    space.dimensions[Eigen::Index(axis)] = header.number<std::int16_t>(dimensionsAt + 2 * axis);
    space.voxelSizes[Eigen::Index(axis)] = header.number<float>(voxelSizesAt + 4 * axis);
  }
  space.voxelOrder = header.text(voxelOrderAt, 4);
  if (header.number<std::int32_t>(versionAt) > 1)
  {
    for (std::size_t i = 0; i < 16; ++i)
    {
      space.voxelToRas(Eigen::Index(i / 4), Eigen::Index(i % 4)) = header.number<float>(voxelToRasAt + 4 * i);
    }
  }
  return space;
}

/// Returns how many numbers a name stands for: a digit or two after the zero that ends it, as in nibabel; else one.
std::size_t componentsOf(const HeaderBytes& header, std::size_t at, const std::string& name)
{
  std::size_t components = 1;
  if (name.size() + 1 < nameLength)
  {
    const std::string more = header.text(at + name.size() + 1, nameLength - name.size() - 1);
    std::from_chars(more.data(), more.data() + more.size(), components);
  }
  return components;
}

/// Returns the values with their names in the header; those without a name are called "KIND n".
std::vector<TractogramValues> valuesOf(const HeaderBytes& header, std::size_t count, std::size_t namesAt, const std::string& kind)
{
  std::vector<TractogramValues> all;
  std::size_t left = count;
  for (std::size_t i = 0; i < namesPerKind && left > 0; ++i)
  {
    const std::size_t at = namesAt + i * nameLength;
    const std::string name = header.text(at, nameLength);
    const std::size_t components = componentsOf(header, at, name);
    if (!name.empty() && components >= 1 && components <= left)
    {
      all.push_back({ name, components, {} });
      left -= components;
    }
  }
  for (; left > 0; --left)
  {
    all.push_back({ kind + ' ' + std::to_string(count - left + 1), 1, {} });
  }
  return all;
}

void append(std::vector<TractogramValues>& all, const float* numbers)
{
  for (TractogramValues& values : all)
  {
    values.values.insert(values.values.end(), numbers, numbers + values.components);
    numbers += values.components;
  }
}

/// Reads streamlines, one after the other, in the header's layout.
class TrackReader
{
public:
  TrackReader(BinaryReader& reader, const Eigen::Affine3d& toScanner, Tractogram& tractogram)
    : Reader(reader)
    , ToScanner(toScanner)
    , Tracks(tractogram)
    , Columns(3 + total(tractogram.pointValues))
    , Properties(total(tractogram.streamlineValues))
  {
  }

  /// Reserves memory for the whole file: unused memory is never touched, and so costs nothing.
  void reserve(std::size_t count)
  {
    const std::size_t points = this->Reader.left() / (sizeof(float) * this->Columns);
    this->Tracks.points.reserve(3 * points);
    this->Tracks.offsets.reserve(
      1 + (count > 0 ? std::min(count, std::size_t(this->Reader.left()) / sizeof(std::int32_t)) : points));
    for (TractogramValues& values : this->Tracks.pointValues)
    {
      values.values.reserve(values.components * points);
    }
  }

  void next()
  {
    const std::string name = "streamline " + std::to_string(this->Tracks.size() + 1);
    std::int32_t points = 0;
    this->Reader.numbers(&points, 1, "the number of points of " + name);
    if (points < 0)
    {
      this->Reader.fail(name + " has " + std::to_string(points) + " points: the file is damaged");
    }
    const std::size_t numbers = std::size_t(points) * this->Columns + this->Properties;
    this->Reader.require(numbers, sizeof(float), name);
    this->Numbers.resize(numbers);
    this->Reader.numbers(this->Numbers.data(), numbers, name);
    for (std::size_t p = 0; p < std::size_t(points); ++p)
    {
      this->take(this->Numbers.data() + p * this->Columns, name, p);
    }
    append(this->Tracks.streamlineValues, this->Numbers.data() + std::size_t(points) * this->Columns);
    this->Tracks.offsets.push_back(this->Tracks.pointCount());
  }

private:
  static std::size_t total(const std::vector<TractogramValues>& all)
  {
    std::size_t sum = 0;
    for (const TractogramValues& values : all)
    {
      sum += values.components;
    }
    return sum;
  }

  void take(const float* numbers, const std::string& name, std::size_t point)
  {
    const Eigen::Vector3d inScanner = this->ToScanner * Eigen::Vector3d(numbers[0], numbers[1], numbers[2]);
    if (!inScanner.allFinite())
    {
      this->Reader.fail(text(name, ", point ", point + 1, ": its coordinates are ", numbers[0], ' ', numbers[1], ' ', numbers[2],
        ", which are no numbers"));
    }
    this->Tracks.points.insert(this->Tracks.points.end(), inScanner.data(), inScanner.data() + 3);
    append(this->Tracks.pointValues, numbers + 3);
  }

  BinaryReader& Reader;
  const Eigen::Affine3d& ToScanner;
  Tractogram& Tracks;
  std::size_t Columns;
  std::size_t Properties;
  std::vector<float> Numbers;
};

void readStreamlines(BinaryReader& reader, std::int32_t count, TrackReader& tracks, const Context& context)
{
  constexpr std::int32_t between = 1024;
  for (std::int32_t s = 0; count > 0 ? s < count : reader.left() > 0; ++s)
  {
    tracks.next();
    if (s % between == 0)
    {
      context.checkpoint();
      context.report(static_cast<double>(reader.position()) / static_cast<double>(reader.size()), "Reading");
    }
  }
}

} // namespace

Tractogram readTrk(std::istream& stream, const std::string& name, const Context& context)
{
  BinaryReader reader(stream, name);
  const HeaderBytes header(reader);
  const auto version = header.number<std::int32_t>(versionAt);
  const auto scalars = header.number<std::int16_t>(scalarsAt);
  const auto properties = header.number<std::int16_t>(propertiesAt);
  const auto count = header.number<std::int32_t>(countAt);
  if (version < 1 || version > 3 || scalars < 0 || properties < 0 || count < 0)
  {
    reader.fail(text("its header has version ", version, ", ", scalars, " scalars, ", properties, " properties and ", count,
      " streamlines: versions 1 to 3 can be read, and no number is below 0"));
  }
  Tractogram tractogram;
  if (version == 3)
  {
    tractogram.remarks.emplace_back("its header has version 3, which is read as version 2");
  }
  tractogram.pointValues = valuesOf(header, std::size_t(scalars), scalarNamesAt, "Scalar");
  tractogram.streamlineValues = valuesOf(header, std::size_t(properties), propertyNamesAt, "Property");
  Eigen::Affine3d toScanner;
  try
  {
    toScanner = trkToScanner(spaceOf(header), tractogram.remarks);
  }
  catch (const InvalidInput& error)
  {
    reader.fail(error.what());
  }
  // All numbers of the file in double precision, and the further memory of polylines.
  requireMemory(
    bytesPerPoint / (3.0 * sizeof(float)) * static_cast<double>(reader.left()), name, "choose streamlines from it first");
  TrackReader tracks(reader, toScanner, tractogram);
  tracks.reserve(static_cast<std::size_t>(count));
  readStreamlines(reader, count, tracks, context);
  if (reader.left() > 0)
  {
    tractogram.remarks.push_back("after the " + std::to_string(count) + " streamlines that the header speaks of there are " +
                                 std::to_string(reader.left()) + " bytes more, which are not read");
  }
  return tractogram;
}

} // namespace cactus
