// SPDX-License-Identifier: BSD-3-Clause
#include "io/NiftiFile.h"

#include "base/ByteOrder.h"
#include "base/Error.h"
#include "base/PosixFile.h"
#include "io/GzipFile.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <vector>

namespace cactus
{

namespace
{

namespace fs = std::filesystem;

constexpr std::size_t firstVersionSize = 348;
constexpr std::size_t secondVersionSize = 540;

/// How the numbers of a voxel are stored, by the code of their type.
struct VoxelType
{
  int code;
  NiftiNumber number;
  std::size_t bytes; ///< of one number
  std::size_t channels;
};

constexpr VoxelType voxelTypes[] = {
  { 2, NiftiNumber::UInt8, 1, 1 }, { 4, NiftiNumber::Int16, 2, 1 }, { 8, NiftiNumber::Int32, 4, 1 },
  { 16, NiftiNumber::Float32, 4, 1 }, { 32, NiftiNumber::Float32, 4, 2 }, // complex
  { 64, NiftiNumber::Float64, 8, 1 }, { 128, NiftiNumber::UInt8, 1, 3 },  // red, green and blue
  { 256, NiftiNumber::Int8, 1, 1 }, { 512, NiftiNumber::UInt16, 2, 1 }, { 768, NiftiNumber::UInt32, 4, 1 },
  { 1024, NiftiNumber::Int64, 8, 1 }, { 1280, NiftiNumber::UInt64, 8, 1 }, { 1792, NiftiNumber::Float64, 8, 2 }, // complex
  { 2304, NiftiNumber::UInt8, 1, 4 },                                                                            // with opacity
};

std::size_t sizeOfNumber(NiftiNumber number)
{
  const auto* found =
    std::find_if(std::begin(voxelTypes), std::end(voxelTypes), [number](const VoxelType& type) { return type.number == number; });
  return found->bytes;
}

/// The numbers of a header of either version and byte order.
class NiftiBytes
{
public:
  NiftiBytes(const std::string& bytes, const std::string& name)
    : Bytes(bytes)
    , Name(name)
  {
    const auto hasMagic = [&bytes](std::size_t at, const char* rest)
    {
      return bytes.size() > at + 3 && bytes[at] == 'n' && (bytes[at + 1] == '+' || bytes[at + 1] == 'i') &&
             bytes.compare(at + 2, 2, rest, 2) == 0;
    };
    if (bytes.size() >= firstVersionSize && hasMagic(344, "1\0") && this->hasSize(firstVersionSize))
    {
      this->Version = 1;
      this->HasOwnFile = bytes[345] == 'i';
    }
    else if (bytes.size() >= secondVersionSize && hasMagic(4, "2\0") && this->hasSize(secondVersionSize))
    {
      this->Version = 2;
      this->HasOwnFile = bytes[5] == 'i';
    }
  }

  /// 1 or 2; 0 if the bytes are no such header.
  int version() const { return this->Version; }
  bool isSwapped() const { return this->Swapped; }
  bool hasOwnFile() const { return this->HasOwnFile; }

  /// Returns the number at this place in a header of version 1, or at another place and of another type in one of version 2.
  template <typename First, typename Second>
  double number(std::size_t first, std::size_t second) const
  {
    return this->Version == 1 ? double(this->at<First>(first)) : double(this->at<Second>(second));
  }
  std::int64_t dimension(std::size_t i) const
  {
    return this->Version == 1 ? this->at<std::int16_t>(40 + 2 * i) : this->at<std::int64_t>(16 + 8 * i);
  }
  double voxelSize(std::size_t i) const { return this->number<float, double>(76 + 4 * i, 104 + 8 * i); }

  [[noreturn]] void fail(const std::string& what) const { throw FileError(this->Name + ": " + what); }

private:
  template <typename Number>
  Number at(std::size_t place) const
  {
    Number value;
    std::memcpy(&value, this->Bytes.data() + place, sizeof(Number));
    if (this->Swapped)
    {
      swapBytes(&value, 1);
    }
    return value;
  }

  /// Finds the byte order by the size that the header gives itself.
  bool hasSize(std::size_t size)
  {
    this->Swapped = this->at<std::int32_t>(0) != std::int32_t(size);
    return this->at<std::int32_t>(0) == std::int32_t(size);
  }

  const std::string& Bytes;
  std::string Name;
  int Version = 0;
  bool Swapped = false;
  bool HasOwnFile = false;
};

void readSize(const NiftiBytes& bytes, NiftiHeader& header)
{
  const std::int64_t rank = bytes.dimension(0);
  if (rank < 1 || rank > 7)
  {
    bytes.fail(text("its header gives the image ", rank, " dimensions"));
  }
  double numbers = 1.0;
  for (std::size_t i = 1; i <= std::size_t(rank); ++i)
  {
    const std::int64_t size = bytes.dimension(i);
    if (size < 1 || size > std::numeric_limits<std::int32_t>::max())
    {
      bytes.fail(text("its header gives the image ", size, " voxels along dimension ", i));
    }
    if (i > 5 && size > 1)
    {
      bytes.fail(text("it has ", rank, " dimensions: images of three, series (the fourth) and vectors (the fifth) can be read"));
    }
    numbers *= double(size);
    (i <= 3 ? header.size[i - 1] : header.volumes) *= std::size_t(size);
  }
  // Bytes that a 64-bit number can count, and components that VTK's whole numbers can.
  if (numbers > 1e17 || header.volumes > std::size_t(1) << 20)
  {
    bytes.fail(text("its header gives the image ", numbers, " numbers, ", header.volumes, " to a voxel: more than can be read"));
  }
}

void readType(const NiftiBytes& bytes, NiftiHeader& header)
{
  const int code = int(bytes.number<std::int16_t, std::int16_t>(70, 12));
  const int bits = int(bytes.number<std::int16_t, std::int16_t>(72, 14));
  const auto* type =
    std::find_if(std::begin(voxelTypes), std::end(voxelTypes), [code](const VoxelType& known) { return known.code == code; });
  if (type == std::end(voxelTypes) || bits != int(8 * type->bytes * type->channels))
  {
    bytes.fail(text("its voxels have type ", code, " with ", bits,
      " bits: whole numbers of 8 to 64 bits, floating-point and complex numbers "
      "of single and double precision and colours can be read"));
  }
  header.stored = type->number;
  header.channels = type->channels;
}

void readScale(const NiftiBytes& bytes, NiftiHeader& header)
{
  const double slope = bytes.number<float, double>(112, 176);
  const double intercept = bytes.number<float, double>(116, 184);
  // 0 says that there is no scale. NaN is what nibabel writes for it before it knows one.
  if (slope == 0.0 || std::isnan(slope) || header.channels > 2)
  {
    return;
  }
  if (!std::isfinite(slope) || !std::isfinite(intercept))
  {
    bytes.fail(text("its header scales numbers by ", slope, " and adds ", intercept));
  }
  header.slope = slope;
  header.intercept = intercept;
}

void readOffset(const NiftiBytes& bytes, NiftiHeader& header)
{
  const double offset = bytes.number<float, std::int64_t>(108, 168);
  const std::size_t least = bytes.version() == 1 ? firstVersionSize + 4 : secondVersionSize + 4; // whether extensions follow
  if (!(offset >= (header.hasOwnFile ? 0.0 : double(least))) || offset > 1e15)
  {
    bytes.fail(text("its header places the voxels at byte ", offset, " of the file"));
  }
  header.offset = std::uint64_t(offset);
}

/// Returns the edges of a voxel in the header's unit. Without a length, an axis of one voxel gets 1.
Eigen::Vector3d voxelSizes(const NiftiBytes& bytes, const NiftiHeader& header)
{
  Eigen::Vector3d sizes;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double size = std::abs(bytes.voxelSize(axis + 1));
    sizes[Eigen::Index(axis)] = size == 0.0 && header.size[axis] == 1 ? 1.0 : size;
  }
  return sizes;
}

Eigen::Affine3d placeByQForm(const NiftiBytes& bytes, const NiftiHeader& header)
{
  const Eigen::Vector3d imaginary(
    bytes.number<float, double>(256, 352), bytes.number<float, double>(260, 360), bytes.number<float, double>(264, 368));
  const double real = std::sqrt(std::max(0.0, 1.0 - imaginary.squaredNorm()));
  Eigen::Vector3d sizes = voxelSizes(bytes, header);
  if (bytes.voxelSize(0) < 0.0) // 0 counts as 1
  {
    sizes[2] = -sizes[2];
  }
  Eigen::Affine3d place = Eigen::Affine3d::Identity();
  place.linear() =
    Eigen::Quaterniond(real, imaginary[0], imaginary[1], imaginary[2]).normalized().toRotationMatrix() * sizes.asDiagonal();
  place.translation() << bytes.number<float, double>(268, 376), bytes.number<float, double>(272, 384),
    bytes.number<float, double>(276, 392);
  return place;
}

Eigen::Affine3d placeBySForm(const NiftiBytes& bytes)
{
  Eigen::Affine3d place = Eigen::Affine3d::Identity();
  for (std::size_t i = 0; i < 12; ++i)
  {
    place.matrix()(Eigen::Index(i / 4), Eigen::Index(i % 4)) = bytes.number<float, double>(280 + 4 * i, 400 + 8 * i);
  }
  return place;
}

double millimetresIn(int unit)
{
  return unit == 1 ? 1000.0 : unit == 3 ? 0.001 : 1.0; // m; µm; mm, or no unit
}

void readPlace(const NiftiBytes& bytes, NiftiHeader& header)
{
  const bool hasQForm = bytes.number<std::int16_t, std::int32_t>(252, 344) > 0;
  const bool hasSForm = bytes.number<std::int16_t, std::int32_t>(254, 348) > 0;
  if (!hasQForm && !hasSForm)
  {
    bytes.fail(
      "it does not say where it lies: the codes of its s-form and of its q-form are 0. Set one, for instance by mrconvert or "
      "nibabel");
  }
  header.toScanner = hasSForm ? placeBySForm(bytes) : placeByQForm(bytes, header);
  const int units = int(bytes.number<std::uint8_t, std::int32_t>(123, 500));
  header.toScanner = Eigen::Scaling(millimetresIn(units & 7)) * header.toScanner;
  const Eigen::Matrix3d axes = header.toScanner.linear();
  const Eigen::Vector3d sizes = axes.colwise().norm();
  // As a fraction of the volume that the same edges would have at right angles.
  if (!header.toScanner.matrix().allFinite() || header.toScanner.matrix().cwiseAbs().maxCoeff() > 1e12 ||
      !(std::abs(axes.determinant()) > 1e-6 * sizes.prod()))
  {
    const Eigen::IOFormat rows(4, Eigen::DontAlignCols, " ", ", ");
    TextStream matrix;
    matrix << header.toScanner.matrix().topRows(3).format(rows);
    bytes.fail("the affine of its header, " + matrix.str() + ", leaves the image no volume");
  }
}

/// The two files of an image, which are one as a rule.
struct NiftiFiles
{
  std::string header;
  std::string voxels;

  explicit NiftiFiles(const std::string& path)
    : header(path)
    , voxels(path)
  {
    for (const char* packed : { "", ".gz" })
    {
      for (const auto& names : { std::pair(".hdr", ".img"), std::pair(".HDR", ".IMG") })
      {
        const std::string headerEnd = std::string(names.first) + packed;
        const std::string voxelsEnd = std::string(names.second) + packed;
        if (endsWith(path, voxelsEnd))
        {
          this->header = existing(path, voxelsEnd.size(), names.first);
        }
        else if (endsWith(path, headerEnd))
        {
          this->voxels = existing(path, headerEnd.size(), names.second);
        }
      }
    }
  }

private:
  static bool endsWith(const std::string& path, const std::string& end)
  {
    return path.size() > end.size() && path.compare(path.size() - end.size(), end.size(), end) == 0;
  }

  /// Returns the name with another end, packed or not, whichever is there.
  static std::string existing(const std::string& path, std::size_t endSize, const std::string& end)
  {
    const std::string other = path.substr(0, path.size() - endSize) + end;
    std::error_code error;
    return !fs::exists(other, error) && fs::exists(other + ".gz", error) ? other + ".gz" : other;
  }
};

/// Throws unless the file can hold all voxels. What a packed one holds is known only when it is read; gzip packs no better than 1
/// to 1032.
void requireVoxels(const std::string& path, const NiftiHeader& header)
{
  const double wanted =
    double(header.offset) + double(header.voxels()) * double(header.numbersPerVoxel()) * double(sizeOfNumber(header.stored));
  std::error_code error;
  const double size = double(fs::file_size(path, error));
  if (error)
  {
    throw FileError("cannot open " + path + ", which is to have the voxels: " + error.message());
  }
  const bool isPacked = isGzip(path);
  if (wanted > (isPacked ? 1032.0 * size : size))
  {
    throw FileError(text(path, " is truncated, or its header wrong: by the header the voxels end at byte ", std::int64_t(wanted),
      ", and the file ", isPacked ? "packed " : "", "has ", std::int64_t(size)));
  }
}

/// Puts the numbers of a row along the file's first axis to their places.
template <typename Stored, typename Value>
void placeRow(const char* row, const NiftiHeader& header, Value* to, std::ptrdiff_t step)
{
  for (std::size_t i = 0; i < header.size[0]; ++i, to += step)
  {
    for (std::size_t channel = 0; channel < header.channels; ++channel, row += sizeof(Stored))
    {
      Stored number;
      std::memcpy(&number, row, sizeof(Stored));
      if (header.isSwapped)
      {
        swapBytes(&number, 1);
      }
      if (header.isScaled())
      {
        to[channel] = Value(header.slope * double(number) + header.intercept);
      }
      else
      {
        to[channel] = Value(number);
      }
    }
  }
}

template <typename Stored, typename Value>
void placeAll(
  GzipReader& file, const std::string& path, const NiftiHeader& header, const NiftiGrid& grid, Value* to, const Context& context)
{
  // What leads from one voxel to the next along each axis of the file, and to the first one.
  const auto numbers = std::ptrdiff_t(header.numbersPerVoxel());
  std::array<std::ptrdiff_t, 3> step{};
  std::ptrdiff_t along = numbers;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const std::ptrdiff_t size = std::ptrdiff_t(grid.size[axis]);
    step[std::size_t(grid.fileAxis[axis])] = grid.isReversed[axis] ? -along : along;
    to += grid.isReversed[axis] ? along * (size - 1) : 0;
    along *= size;
  }
  std::vector<char> row(header.size[0] * header.channels * sizeof(Stored));
  for (std::size_t volume = 0; volume < header.volumes; ++volume)
  {
    for (std::size_t k = 0; k < header.size[2]; ++k)
    {
      for (std::size_t j = 0; j < header.size[1]; ++j)
      {
        if (file.read(row.data(), row.size()) != row.size())
        {
          throw FileError(text(path, " is truncated, or its header wrong: it ends in slice ", k + 1, " of volume ", volume + 1));
        }
        placeRow<Stored>(row.data(), header,
          to + std::ptrdiff_t(volume * header.channels) + std::ptrdiff_t(j) * step[1] + std::ptrdiff_t(k) * step[2], step[0]);
      }
      context.checkpoint();
      context.report(double(volume * header.size[2] + k + 1) / double(header.volumes * header.size[2]), "Reading");
    }
  }
}

/// Calls work(Number()) with the type's number.
template <typename Work>
void withNumber(NiftiNumber type, Work&& work)
{
  switch (type)
  {
  case NiftiNumber::Int8:
    return work(std::int8_t());
  case NiftiNumber::UInt8:
    return work(std::uint8_t());
  case NiftiNumber::Int16:
    return work(std::int16_t());
  case NiftiNumber::UInt16:
    return work(std::uint16_t());
  case NiftiNumber::Int32:
    return work(std::int32_t());
  case NiftiNumber::UInt32:
    return work(std::uint32_t());
  case NiftiNumber::Int64:
    return work(std::int64_t());
  case NiftiNumber::UInt64:
    return work(std::uint64_t());
  case NiftiNumber::Float32:
    return work(float());
  case NiftiNumber::Float64:
    return work(double());
  }
}

} // namespace

double NiftiHeader::valueBytes() const
{
  return double(this->voxels()) * double(this->numbersPerVoxel()) * double(sizeOfNumber(this->valueType()));
}

NiftiNumber NiftiHeader::valueType() const
{
  if (!this->isScaled())
  {
    return this->stored;
  }
  return sizeOfNumber(this->stored) <= 2 || this->stored == NiftiNumber::Float32 ? NiftiNumber::Float32 : NiftiNumber::Float64;
}

NiftiGrid::NiftiGrid(const NiftiHeader& header)
{
  const Eigen::Vector3d edges = header.toScanner.linear().colwise().norm();
  const Eigen::Matrix3d directions = header.toScanner.linear() * edges.cwiseInverse().asDiagonal();
  // Pairs of an axis of space and one of the file, the closest first.
  Eigen::Matrix3d left = directions.cwiseAbs();
  for (int pair = 0; pair < 3; ++pair)
  {
    Eigen::Index space = 0;
    Eigen::Index file = 0;
    left.maxCoeff(&space, &file);
    left.row(space).setConstant(-1.0);
    left.col(file).setConstant(-1.0);
    this->fileAxis[std::size_t(space)] = int(file);
    this->isReversed[std::size_t(space)] = directions(space, file) < 0.0;
  }
  const auto arrange = [&]
  {
    Eigen::Vector3d first = Eigen::Vector3d::Zero(); // voxel of the file
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const auto file = std::size_t(this->fileAxis[axis]);
      this->size[axis] = header.size[file];
      this->spacing[Eigen::Index(axis)] = edges[Eigen::Index(file)];
      this->axes.col(Eigen::Index(axis)) = (this->isReversed[axis] ? -1.0 : 1.0) * directions.col(Eigen::Index(file));
      first[Eigen::Index(file)] = this->isReversed[axis] ? double(header.size[file] - 1) : 0.0;
    }
    this->origin = header.toScanner * first;
  };
  arrange();
  if (this->axes.determinant() < 0.0) // sheared so far that none of them leads along its axis of space
  {
    this->isReversed[2] = !this->isReversed[2];
    arrange();
  }
}

bool isNifti(const std::string& path)
{
  const std::string bytes = beginningOfFile(NiftiFiles(path).header, secondVersionSize);
  if (NiftiBytes(bytes, path).version() > 0)
  {
    return true;
  }
  fs::path name = fs::path(path).filename();
  if (name.extension() == ".gz")
  {
    name = name.stem();
  }
  std::error_code error;
  return name.extension() == ".nii" && !name.stem().has_extension() && fs::is_regular_file(path, error);
}

NiftiHeader parseNiftiHeader(const std::string& bytes, const std::string& name)
{
  const NiftiBytes numbers(bytes, name);
  if (numbers.version() == 0)
  {
    numbers.fail("this is no NIfTI image");
  }
  NiftiHeader header;
  header.isSwapped = numbers.isSwapped();
  header.hasOwnFile = numbers.hasOwnFile();
  readSize(numbers, header);
  readType(numbers, header);
  readScale(numbers, header);
  readOffset(numbers, header);
  readPlace(numbers, header);
  return header;
}

NiftiHeader readNiftiHeader(const std::string& path)
{
  const NiftiFiles files(path);
  requireNoPipe("image " + files.header, files.header);
  std::string bytes(secondVersionSize, '\0');
  bytes.resize(GzipReader(files.header).read(bytes.data(), bytes.size()));
  NiftiHeader header = parseNiftiHeader(bytes, files.header);
  if (header.hasOwnFile && files.header == files.voxels)
  {
    throw FileError(path + ": its voxels are in another file: name header and voxels alike, NAME.hdr and NAME.img");
  }
  requireVoxels(header.hasOwnFile ? files.voxels : files.header, header);
  return header;
}

void readNiftiValues(const std::string& path, const NiftiHeader& header, const NiftiGrid& grid, void* to, const Context& context)
{
  const NiftiFiles files(path);
  const std::string& name = header.hasOwnFile ? files.voxels : files.header;
  GzipReader file(name);
  if (!file.skip(header.offset))
  {
    throw FileError(name + " is truncated, or its header wrong: it ends before its voxels");
  }
  withNumber(header.stored,
    [&](auto stored)
    {
      using Stored = decltype(stored);
      if (!header.isScaled())
      {
        placeAll<Stored>(file, name, header, grid, static_cast<Stored*>(to), context);
      }
      else if (header.valueType() == NiftiNumber::Float32)
      {
        placeAll<Stored>(file, name, header, grid, static_cast<float*>(to), context);
      }
      else
      {
        placeAll<Stored>(file, name, header, grid, static_cast<double*>(to), context);
      }
    });
}

} // namespace cactus
