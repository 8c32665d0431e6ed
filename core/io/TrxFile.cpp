// SPDX-License-Identifier: BSD-3-Clause
#include "io/TrxFile.h"

#include "base/Error.h"
#include "base/JsonText.h"
#include "base/Memory.h"
#include "io/TrxNumbers.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace cactus
{

namespace
{

constexpr char headerName[] = "header.json";

/// Reads the parts of a tractogram, each a file of numbers of one type.
class TrxReader
{
public:
  TrxReader(const FileCollection& files, const std::string& name)
    : Files(files)
    , Name(name)
  {
  }

  Tractogram read()
  {
    this->readHeader();
    for (const std::string& path : this->Files.names())
    {
      this->readPart(path);
    }
    const bool isEmpty = this->Vertices == 0 && this->Streamlines == 0;
    if (isEmpty)
    {
      this->Tracks.remarks.emplace_back("it holds no streamlines");
    }
    else if (!this->HasPositions || !this->HasOffsets)
    {
      this->fail("it has no positions.3.float16, 32 or 64, or no offsets.uint32 or 64: it is no whole .trx");
    }
    this->checkOffsets();
    return std::move(this->Tracks);
  }

private:
  [[noreturn]] void fail(const std::string& what) const { throw FileError(this->Name + ": " + what); }

  std::uint64_t count(const Json& header, const char* key) const
  {
    const auto found = header.find(key);
    // Some programs write floating-point numbers: whole ones are accepted.
    const double value = found != header.end() && found->is_number() ? found->get<double>() : -1.0;
    if (value < 0.0 || value != std::floor(value) || value > double(std::numeric_limits<std::uint32_t>::max()))
    {
      this->fail(std::string("its header.json has no ") + key + " that is a whole number below 4294967296");
    }
    return static_cast<std::uint64_t>(value);
  }

  void readHeader()
  {
    constexpr std::uint64_t longest = 1 << 20;
    if (this->Files.size(headerName) > longest)
    {
      this->fail("its header.json has more than a million characters: this is no .trx");
    }
    const std::vector<char> bytes = this->Files.read(headerName);
    const auto header = parsedJson(std::string(bytes.begin(), bytes.end()));
    if (!header || !header->is_object())
    {
      this->fail("its header.json is not JSON, or no object");
    }
    this->Vertices = this->count(*header, "NB_VERTICES");
    this->Streamlines = this->count(*header, "NB_STREAMLINES");
  }

  /// Reads the numbers of a file, which must have `count` of them.
  std::vector<double> numbers(const TrxPart& part, std::uint64_t count)
  {
    const std::uint64_t size = this->Files.size(part.path);
    if (size != count * part.size)
    {
      this->fail(part.path + " has " + std::to_string(size) + " bytes, and the header asks for " + std::to_string(count) +
                 " numbers of " + std::to_string(part.size) + " bytes: one of them is wrong");
    }
    requireMemory(double(size) + 8.0 * double(count), this->Name, "choose streamlines from it first");
    return trxNumbers(this->Files.read(part.path), part);
  }

  /// Throws if the name exists among others of its kind.
  void requireNew(const std::vector<TractogramValues>& all, const TrxPart& part) const
  {
    if (std::any_of(all.begin(), all.end(), [&](const TractogramValues& values) { return values.name == part.name; }))
    {
      this->fail("it holds two files of values called " + part.name + ", one of them " + part.path);
    }
  }

  void readPositions(const TrxPart& part)
  {
    if (this->HasPositions || part.components != 3 || !part.isFloating())
    {
      this->fail(part.path + ": expected one file of positions, called positions.3.float16, 32 or 64");
    }
    this->HasPositions = true;
    this->Tracks.points = this->numbers(part, 3 * this->Vertices);
    const auto bad =
      std::find_if(this->Tracks.points.begin(), this->Tracks.points.end(), [](double value) { return !std::isfinite(value); });
    if (bad != this->Tracks.points.end())
    {
      this->fail(part.path + ": a coordinate of point " + std::to_string((bad - this->Tracks.points.begin()) / 3) +
                 " (from 0) is no number");
    }
  }

  void readOffsets(const TrxPart& part)
  {
    if (this->HasOffsets || part.components != 1 || part.isFloating())
    {
      this->fail(part.path + ": expected one file of offsets, called offsets.uint32 or 64");
    }
    this->HasOffsets = true;
    const std::uint64_t size = this->Files.size(part.path);
    const bool withEnd = size == (this->Streamlines + 1) * part.size;
    const std::vector<double> offsets = this->numbers(part, this->Streamlines + (withEnd ? 1 : 0));
    this->Tracks.offsets.assign(offsets.size(), 0);
    for (std::size_t i = 0; i < offsets.size(); ++i)
    {
      if (!(offsets[i] >= 0.0 && offsets[i] <= double(this->Vertices)))
      {
        this->fail(text(part.path, ": offset ", i, " (from 0) is ", offsets[i], ", and there are ", this->Vertices, " points"));
      }
      this->Tracks.offsets[i] = static_cast<std::size_t>(offsets[i]);
    }
    if (!withEnd)
    {
      this->Tracks.offsets.push_back(this->Vertices);
    }
  }

  void checkOffsets() const
  {
    const std::vector<std::size_t>& offsets = this->Tracks.offsets;
    if (offsets.front() != 0 || offsets.back() != this->Vertices || !std::is_sorted(offsets.begin(), offsets.end()))
    {
      this->fail("its offsets do not go from 0 to the number of points without a step back: the file is damaged");
    }
  }

  void readGroup(const TrxPart& part)
  {
    if (part.isFloating() || part.components != 1)
    {
      this->fail(part.path + ": expected numbers of streamlines, uint32");
    }
    const std::vector<double> members = this->numbers(part, this->Files.size(part.path) / part.size);
    TractogramGroup group{ part.name, {} };
    std::vector<std::uint32_t>& streamlines = group.streamlines;
    for (const double member : members)
    {
      if (!(member >= 0.0 && member < double(this->Streamlines)))
      {
        this->fail(text(part.path, " names streamline ", member, " (from 0), and there are ", this->Streamlines));
      }
      streamlines.push_back(static_cast<std::uint32_t>(member));
    }
    std::sort(streamlines.begin(), streamlines.end());
    streamlines.erase(std::unique(streamlines.begin(), streamlines.end()), streamlines.end());
    this->Tracks.groups.push_back(std::move(group));
  }

  void readPart(const std::string& path)
  {
    if (path == headerName)
    {
      return;
    }
    std::string inFolders = path;
    std::replace(inFolders.begin(), inFolders.end(), '\\', '/'); // of some programs for Windows
    if (inFolders != path && !std::exchange(this->HasBackslashes, true))
    {
      this->Tracks.remarks.emplace_back("names in it have backslashes, which are read as slashes");
    }
    const std::string folder = inFolders.substr(0, inFolders.find('/') == std::string::npos ? 0 : inFolders.find('/'));
    if (folder == "dpg")
    {
      if (!this->HasGroupValues)
      {
        this->Tracks.remarks.emplace_back("values of groups (dpg) are left out");
      }
      this->HasGroupValues = true;
      return;
    }
    auto part = trxPart(inFolders);
    if (!part)
    {
      this->Tracks.remarks.push_back(excerpt(path) + " is no file of numbers that a .trx has, and is left out");
      return;
    }
    part->path = path;
    if (folder == "dpv")
    {
      this->requireNew(this->Tracks.pointValues, *part);
      this->Tracks.pointValues.push_back(
        { part->name, part->components, this->numbers(*part, this->Vertices * part->components) });
    }
    else if (folder == "dps")
    {
      this->requireNew(this->Tracks.streamlineValues, *part);
      this->Tracks.streamlineValues.push_back(
        { part->name, part->components, this->numbers(*part, this->Streamlines * part->components) });
    }
    else if (folder == "groups")
    {
      this->readGroup(*part);
    }
    else if (folder.empty() && part->name == "positions")
    {
      this->readPositions(*part);
    }
    else if (folder.empty() && part->name == "offsets")
    {
      this->readOffsets(*part);
    }
  }

  const FileCollection& Files;
  const std::string& Name;
  Tractogram Tracks;
  std::uint64_t Vertices = 0;
  std::uint64_t Streamlines = 0;
  bool HasPositions = false;
  bool HasOffsets = false;
  bool HasGroupValues = false;
  bool HasBackslashes = false;
};

} // namespace

Tractogram readTrx(const FileCollection& files, const std::string& name)
{
  return TrxReader(files, name).read();
}

} // namespace cactus
