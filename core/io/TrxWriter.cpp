// SPDX-License-Identifier: BSD-3-Clause
#include "base/AtomicFile.h"
#include "base/ByteOrder.h"
#include "base/JsonText.h"
#include "io/NumberedName.h"
#include "io/TrxFile.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace cactus
{

namespace
{

template <typename Number, typename Value>
std::string bytesOf(std::size_t count, Value&& value)
{
  std::string bytes;
  bytes.reserve(count * sizeof(Number));
  for (std::size_t i = 0; i < count; ++i)
  {
    appendLittleEndian(bytes, static_cast<Number>(value(i)));
  }
  return bytes;
}

/// Returns the header: the domain as an image, whose first voxel's centre is half a voxel from the corner.
std::string headerText(const Fibres& fibres, const Placement& placement)
{
  constexpr double most = 65535.0;                                            // voxels along a side
  const double voxel = std::max(1.0, fibres.domain.size().maxCoeff() / most); // µm
  Json affine = Json::array();
  Json dimensions = Json::array();
  const Eigen::Vector3d first = placement.toImage(fibres.domain.lower + Eigen::Vector3d::Constant(0.5 * voxel));
  for (Eigen::Index axis = 0; axis < 3; ++axis)
  {
    const Eigen::RowVector3d row = placement.scale * voxel * placement.axes.row(axis);
    affine.push_back({ row[0], row[1], row[2], first[axis] });
    dimensions.push_back(std::int64_t(std::clamp(std::ceil(fibres.domain.size()[axis] / voxel), 1.0, most)));
  }
  affine.push_back({ 0.0, 0.0, 0.0, 1.0 });
  Json header;
  header["VOXEL_TO_RASMM"] = affine;
  header["DIMENSIONS"] = dimensions;
  header["NB_VERTICES"] = fibres.points.size();
  header["NB_STREAMLINES"] = fibres.size();
  return header.dump();
}

} // namespace

bool hasRadii(const Fibres& fibres)
{
  return std::any_of(fibres.radii.begin(), fibres.radii.end(), [](double radius) { return !std::isnan(radius); });
}

void writeTrx(const Fibres& fibres, const Placement& placement, const std::string& path)
{
  std::vector<std::pair<std::string, std::string>> files;
  files.emplace_back("header.json", headerText(fibres, placement));
  const std::size_t numbers = 3 * fibres.points.size();
  const auto number = [&](std::size_t i) { return placement.toImage(fibres.points[i / 3])[Eigen::Index(i % 3)]; };
  if (placement.position.isZero(0.0))
  {
    files.emplace_back("positions.3.float32", bytesOf<float>(numbers, number));
  }
  else
  {
    files.emplace_back("positions.3.float64", bytesOf<double>(numbers, number));
  }
  files.emplace_back(
    "offsets.uint64", bytesOf<std::uint64_t>(fibres.offsets.size(), [&](std::size_t i) { return fibres.offsets[i]; }));
  if (hasRadii(fibres))
  {
    files.emplace_back("dpv/Radius.float32",
      bytesOf<float>(fibres.radii.size(), [&](std::size_t i) { return placement.scale * fibres.radii[i]; }));
  }
  files.emplace_back(
    "dps/FibreId.int32", bytesOf<std::int32_t>(fibres.size(), [&](std::size_t f) { return fibres.fibreIds[f]; }));
  files.emplace_back(
    "dps/BundleId.int32", bytesOf<std::int32_t>(fibres.size(), [&](std::size_t f) { return fibres.bundleIds[f]; }));
  for (const auto& column : fibres.columns.all())
  {
    files.emplace_back("dps/" + column.first + ".float32",
      bytesOf<float>(fibres.size(), [&](std::size_t f) { return fibres.columns.value(column.first, f); }));
  }
  std::map<int, std::string> groups;
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    appendLittleEndian(groups[fibres.bundleIds[f]], static_cast<std::uint32_t>(f));
  }
  const std::size_t largest = groups.empty() ? 0 : std::size_t(groups.rbegin()->first);
  for (auto& [bundle, members] : groups)
  {
    files.emplace_back("groups/bundle_" + numbered(std::size_t(bundle), largest) + ".uint32", std::move(members));
  }
  AtomicFile file(path);
  const std::string archive = zipText(files);
  file.stream().write(archive.data(), static_cast<std::streamsize>(archive.size()));
  file.commit();
}

} // namespace cactus
