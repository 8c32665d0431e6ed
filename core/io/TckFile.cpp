// SPDX-License-Identifier: BSD-3-Clause
#include "io/TckFile.h"

#include "base/AtomicFile.h"
#include "base/Constants.h"
#include "base/Error.h"
#include "base/Memory.h"
#include "base/Numbers.h"
#include "io/BinaryReader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <vector>

namespace cactus
{

namespace
{

constexpr char firstLine[] = "mrtrix tracks";
constexpr std::size_t longestFirstLine = 64;
constexpr std::size_t longestLine = 1 << 20; ///< command_history has whole commands, with all their files
constexpr std::size_t longestHeader = 64 << 20;
/// Number of points that are read at once.
constexpr std::size_t block = 4096;

struct TckHeader
{
  bool isDouble = false;
  double count = 0.0; ///< 0 if missing
};

/// Reads a line without blanks at its end: MRtrix leaves four after the first line, in place of a former END.
std::string readLine(BinaryReader& reader, std::size_t longest)
{
  const std::string line = reader.line(longest);
  return line.substr(0, line.find_last_not_of(" \t") + 1);
}

std::string inLowerCase(std::string text)
{
  std::transform(text.begin(), text.end(), text.begin(),
    [](unsigned char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : static_cast<char>(c); });
  return text;
}

std::string trimmedKey(const std::string& key)
{
  constexpr char blanks[] = " \t";
  const std::size_t begin = key.find_first_not_of(blanks);
  return begin == std::string::npos ? "" : key.substr(begin, key.find_last_not_of(blanks) + 1 - begin);
}

/// Reads the lines `key: value` up to END; of duplicate keys the last counts. Keys come in lower case.
std::map<std::string, std::string> readLines(BinaryReader& reader)
{
  if (reader.size() == 0 || readLine(reader, longestFirstLine) != firstLine)
  {
    reader.fail("this is no .tck file: its first line is not 'mrtrix tracks'");
  }
  std::map<std::string, std::string> lines;
  while (reader.position() < longestHeader)
  {
    const std::string line = readLine(reader, longestLine);
    if (line == "END")
    {
      return lines;
    }
    const std::size_t colon = line.find(':');
    if (colon != std::string::npos)
    {
      const std::size_t begin = line.find_first_not_of(" \t", colon + 1);
      lines[inLowerCase(trimmedKey(line.substr(0, colon)))] = begin == std::string::npos ? "" : line.substr(begin);
    }
  }
  reader.fail("its header has no line END");
}

/// Returns where the points begin.
std::uint64_t dataBegin(const BinaryReader& reader, const std::map<std::string, std::string>& lines)
{
  const auto file = lines.find("file");
  if (file == lines.end())
  {
    return reader.position();
  }
  std::string_view text = file->second;
  double offset = -1.0;
  const bool isHere = text.substr(0, 1) == "."; // not in another file
  text.remove_prefix(isHere ? 1 : 0);
  skipBlanks(text);
  if (!isHere || !takeNumber(text, offset) || offset != std::floor(offset) || offset < static_cast<double>(reader.position()) ||
      offset > static_cast<double>(reader.size()))
  {
    reader.fail("its header says 'file: " + excerpt(file->second) +
                "': expected '. OFFSET', with an offset in bytes from the end of the header to that of the file");
  }
  return static_cast<std::uint64_t>(offset);
}

TckHeader readHeader(BinaryReader& reader, std::vector<std::string>& remarks)
{
  const auto lines = readLines(reader);
  TckHeader header;
  const auto type = lines.find("datatype");
  if (type == lines.end())
  {
    remarks.emplace_back("its header has no datatype, which is taken as Float32LE");
  }
  const std::string named = type == lines.end() ? "float32le" : inLowerCase(type->second);
  const bool isBig = named == "float32be" || named == "float64be";
  header.isDouble = named == "float64le" || named == "float64be";
  if (!isBig && !header.isDouble && named != "float32le")
  {
    reader.fail(
      "its header gives '" + excerpt(type->second) + "' as datatype: expected Float32LE, Float32BE, Float64LE or Float64BE");
  }
  reader.setSwapped(isBig == isLittleEndian());
  const auto count = lines.find("count");
  std::string_view text = count == lines.end() ? std::string_view() : std::string_view(count->second);
  takeNumber(text, header.count);
  reader.seek(dataBegin(reader, lines));
  return header;
}

/// Sorts points into streamlines, one after the other.
class TrackCollector
{
public:
  TrackCollector(const BinaryReader& reader, Tractogram& tractogram)
    : Reader(reader)
    , Tracks(tractogram)
  {
  }

  /// Takes a point; false at the end of the file.
  bool take(const std::array<double, 3>& point)
  {
    if (std::isfinite(point[0]) && std::isfinite(point[1]) && std::isfinite(point[2]))
    {
      this->Tracks.points.insert(this->Tracks.points.end(), point.begin(), point.end());
      return true;
    }
    const std::size_t points = this->Tracks.pointCount();
    if (std::isnan(point[0]) && std::isnan(point[1]) && std::isnan(point[2]))
    {
      this->Tracks.offsets.push_back(points);
      return true;
    }
    if (std::isinf(point[0]) && std::isinf(point[1]) && std::isinf(point[2]))
    {
      if (points > this->Tracks.offsets.back())
      {
        this->Tracks.offsets.push_back(points); // the last one, if its writer has omitted the mark
      }
      return false;
    }
    this->Reader.fail(text("streamline ", this->Tracks.size() + 1, ", point ", points - this->Tracks.offsets.back() + 1,
      ": its coordinates are ", point[0], ' ', point[1], ' ', point[2], ", which are no numbers"));
  }

private:
  const BinaryReader& Reader;
  Tractogram& Tracks;
};

template <typename Number>
void readPoints(BinaryReader& reader, Tractogram& tractogram, const Context& context)
{
  TrackCollector collector(reader, tractogram);
  std::vector<Number> numbers(3 * block);
  const double begin = static_cast<double>(reader.position());
  while (true)
  {
    const std::size_t points = std::min<std::uint64_t>(block, reader.left() / (3 * sizeof(Number)));
    if (points == 0)
    {
      throw FileError(reader.name() + " is truncated: it ends without the mark for its end (three infinities)");
    }
    reader.numbers(numbers.data(), 3 * points, "points");
    for (std::size_t i = 0; i < points; ++i)
    {
      if (!collector.take({ { double(numbers[3 * i]), double(numbers[3 * i + 1]), double(numbers[3 * i + 2]) } }))
      {
        return;
      }
    }
    context.checkpoint();
    context.report((static_cast<double>(reader.position()) - begin) / (static_cast<double>(reader.size()) - begin), "Reading");
  }
}

} // namespace

Tractogram readTck(std::istream& stream, const std::string& name, const Context& context)
{
  BinaryReader reader(stream, name);
  Tractogram tractogram;
  const TckHeader header = readHeader(reader, tractogram.remarks);
  // Reserves memory for all triplets as points and as ends: unused memory is never touched, and so costs nothing.
  const std::uint64_t triplets = reader.left() / (3 * (header.isDouble ? sizeof(double) : sizeof(float)));
  requireMemory(double(triplets) * bytesPerPoint, name, "choose streamlines from it first, e.g. with tckedit");
  tractogram.points.reserve(3 * triplets);
  tractogram.offsets.reserve(triplets + 1);
  header.isDouble ? readPoints<double>(reader, tractogram, context) : readPoints<float>(reader, tractogram, context);
  if (header.count != 0.0 && header.count != static_cast<double>(tractogram.size()))
  {
    tractogram.remarks.push_back("the header says that there are " + exactText(header.count) + " streamlines, and there are " +
                                 std::to_string(tractogram.size()));
  }
  return tractogram;
}

void writeTck(const Fibres& fibres, const Placement& placement, const std::string& path, LengthUnit unit)
{
  const Placement placed = placement.in(unit);
  const std::string count = std::to_string(fibres.size());
  std::string header = std::string("mrtrix tracks\ndatatype: Float32LE\nlength_unit: ") +
                       (unit == LengthUnit::Millimetre ? "mm" : "um") + "\ncount: " + count + "\ntotal_count: " + count + '\n';
  // The offset stands in the header, and counts its own digits.
  constexpr char before[] = "file: . ";
  constexpr char after[] = "\nEND\n";
  std::size_t offset = header.size() + sizeof(before) + sizeof(after) - 2;
  offset += std::to_string(offset + std::to_string(offset).size()).size();
  header += before + std::to_string(offset) + after;

  AtomicFile file(path);
  file.stream() << header;
  const auto write = [&](float x, float y, float z)
  {
    float point[3] = { x, y, z };
    if (!isLittleEndian())
    {
      swapBytes(point, 3);
    }
    file.stream().write(reinterpret_cast<const char*>(point), sizeof(point));
  };
  constexpr float none = std::numeric_limits<float>::quiet_NaN();
  constexpr float end = std::numeric_limits<float>::infinity();
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    for (std::size_t i = fibres.offsets[f]; i < fibres.offsets[f + 1]; ++i)
    {
      const Eigen::Vector3f point = placed.toImage(fibres.points[i]).cast<float>();
      write(point[0], point[1], point[2]);
    }
    write(none, none, none);
  }
  write(end, end, end);
  file.commit();
}

} // namespace cactus
