// SPDX-License-Identifier: BSD-3-Clause
#include "io/SurfaceNumbers.h"

#include "base/Error.h"

#include <cstdint>
#include <cstring>
#include <type_traits>

namespace cactus
{

namespace
{

/// Calls visit(number) for every number of a report, which may be const.
template <typename Report, typename Visit>
void visitReport(Report& report, Visit&& visit)
{
  visit(report.triangles);
  visit(report.points);
  visit(report.components);
  visit(report.openEdges);
  visit(report.crowdedEdges);
  visit(report.flippedEdges);
  visit(report.pinchedPoints);
  visit(report.degenerateTriangles);
  visit(report.repeatedCorners);
  visit(report.inwardComponents);
  visit(report.volume);
  visit(report.area);
  visit(report.smallestAngle);
  visit(report.largestSquaredEdgeRatio);
  visit(report.smallestAltitude);
  visit(report.largestAspect);
}

/// The same for a pair, except for the pieces of its reports.
template <typename Pair, typename Visit>
void visitPair(Pair& pair, Visit&& visit)
{
  visit(pair.fibreId);
  visit(pair.bundleId);
  visit(pair.targetRadius);
  visitReport(pair.outerReport, visit);
  visitReport(pair.innerReport, visit);
  visit(pair.state);
  visit(pair.volumeAsMade);
  visit(pair.outerLevel);
  visit(pair.thickness);
  visit(pair.targetGRatio);
  visit(pair.gRatio);
  visit(pair.droppedVolume);
  visit(pair.isWanted);
  visit(pair.isFlawed);
  visit(pair.largestMove);
}

class Reader
{
public:
  explicit Reader(const std::string& bytes)
    : Bytes(bytes)
  {
  }

  template <typename Value>
  void operator()(Value& value)
  {
    static_assert(std::is_trivially_copyable_v<Value>);
    if (sizeof(value) > this->Bytes.size() - this->At)
    {
      throw FileError("the journal of surfaces is damaged");
    }
    std::memcpy(&value, this->Bytes.data() + this->At, sizeof(value));
    this->At += sizeof(value);
  }
  std::size_t left() const { return this->Bytes.size() - this->At; }

private:
  const std::string& Bytes;
  std::size_t At = 0;
};

} // namespace

std::string bytesOf(const FibreSurfacePair& pair)
{
  std::string bytes;
  const auto put = [&bytes](const auto& value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof(value)); };
  visitPair(pair, put);
  for (const SurfaceReport* report : { &pair.outerReport, &pair.innerReport })
  {
    put(static_cast<std::uint64_t>(report->pieces.size()));
    for (const std::int32_t piece : report->pieces)
    {
      put(piece);
    }
  }
  return bytes;
}

FibreSurfacePair pairFrom(const std::string& bytes)
{
  FibreSurfacePair pair;
  Reader get(bytes);
  visitPair(pair, get);
  for (SurfaceReport* report : { &pair.outerReport, &pair.innerReport })
  {
    std::uint64_t count = 0;
    get(count);
    if (count > get.left() / sizeof(std::int32_t))
    {
      throw FileError("the journal of surfaces is damaged");
    }
    report->pieces.resize(count);
    for (std::int32_t& piece : report->pieces)
    {
      get(piece);
    }
  }
  return pair;
}

} // namespace cactus
