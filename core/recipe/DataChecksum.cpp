// SPDX-License-Identifier: BSD-3-Clause
#include "recipe/DataChecksum.h"

#include "base/Hash64.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>

namespace cactus
{

namespace
{

/// VTK's numbers for the types of its arrays.
enum class ArrayType : std::uint64_t
{
  None = 0, ///< no such array
  Int = 6,
  Float = 10,
  Double = 11
};

void addArray(Hash64& checksum, ArrayType type, const void* values, std::size_t bytes)
{
  checksum.add(static_cast<std::uint64_t>(type));
  checksum.add(bytes);
  checksum.add(values, bytes);
}

void addNone(Hash64& checksum)
{
  checksum.add(static_cast<std::uint64_t>(ArrayType::None));
}

template <typename Value>
void addArray(Hash64& checksum, ArrayType type, const std::vector<Value>& values)
{
  addArray(checksum, type, values.data(), values.size() * sizeof(Value));
}

/// Adds the values of this name, or none.
void addNamed(Hash64& checksum, const std::vector<TractogramValues>& all, const char* name)
{
  const TractogramValues* found = valuesNamed(all, name);
  if (found == nullptr)
  {
    addNone(checksum);
    return;
  }
  addArray(checksum, ArrayType::Double, found->values);
}

/// Adds one number for each triangle of each surface.
template <typename NumberOf>
void addForTriangles(
  Hash64& checksum, const std::vector<FibreSurfacePair>& fibres, const std::vector<std::size_t>& triangles, NumberOf&& numberOf)
{
  std::vector<std::int32_t> numbers;
  for (std::size_t i = 0; i < fibres.size(); ++i)
  {
    numbers.insert(numbers.end(), triangles[i], numberOf(fibres[i]));
  }
  addArray(checksum, ArrayType::Int, numbers);
}

} // namespace

std::string dataChecksum(const Fibres& fibres)
{
  Hash64 checksum;
  checksum.add(static_cast<std::uint64_t>(fibres.size()));
  addArray(checksum, ArrayType::Double, fibres.points);
  addArray(checksum, ArrayType::Double, fibres.radii);
  addArray(checksum, ArrayType::Int, fibres.fibreIds);
  addArray(checksum, ArrayType::Int, fibres.bundleIds);
  addArray(checksum, ArrayType::Double, fibres.targetRadii);
  addNone(checksum); // they have no Surface
  for (const auto& column : fibres.columns.all())
  {
    std::vector<double> values = column.second;
    values.resize(fibres.size(), std::numeric_limits<double>::quiet_NaN());
    addArray(checksum, ArrayType::Double, values);
  }
  return checksum.text();
}

std::string dataChecksum(const Tractogram& tractogram)
{
  Hash64 checksum;
  checksum.add(static_cast<std::uint64_t>(tractogram.size()));
  addArray(checksum, ArrayType::Double, tractogram.points);
  addNamed(checksum, tractogram.pointValues, "Radius");
  addNamed(checksum, tractogram.streamlineValues, "FibreId");
  if (!tractogram.groups.empty() && valuesNamed(tractogram.streamlineValues, "BundleId") == nullptr)
  {
    addArray(checksum, ArrayType::Int, bundlesByGroup(tractogram));
  }
  else
  {
    addNamed(checksum, tractogram.streamlineValues, "BundleId");
  }
  addNamed(checksum, tractogram.streamlineValues, "TargetRadius");
  addNamed(checksum, tractogram.streamlineValues, "Surface");
  for (const ColumnFacts& column : fibreColumns())
  {
    if (valuesNamed(tractogram.streamlineValues, column.name) != nullptr)
    {
      addNamed(checksum, tractogram.streamlineValues, column.name);
    }
  }
  return checksum.text();
}

std::string dataChecksum(const LabelImage& image)
{
  Hash64 checksum;
  std::array<std::int32_t, 6> extent{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    extent[2 * axis] = image.grid.lower[axis];
    extent[2 * axis + 1] = image.grid.lower[axis] + image.grid.count[axis] - 1;
  }
  const std::array<double, 3> spacing{ { image.grid.spacing, image.grid.spacing, image.grid.spacing } };
  checksum.add(extent.data(), sizeof(extent));
  checksum.add(image.grid.origin.data(), 3 * sizeof(double));
  checksum.add(spacing.data(), sizeof(spacing));
  addArray(checksum, ArrayType::Int, image.fibreId);
  addArray(checksum, ArrayType::Float, image.depth);
  addNone(checksum); // it is no Field
  return checksum.text();
}

std::string dataChecksum(const std::vector<FibreSurfacePair>& fibres, const SurfaceSource& surfaces, int kind)
{
  std::vector<Eigen::Vector3d> points;
  std::vector<std::size_t> triangles;
  std::size_t triangleCount = 0;
  for (std::size_t i = 0; i < fibres.size(); ++i)
  {
    const std::shared_ptr<const TriangleMesh> mesh = surfaces.get(i);
    points.insert(points.end(), mesh->points.begin(), mesh->points.end());
    triangles.push_back(mesh->triangles.size());
    triangleCount += mesh->triangles.size();
  }
  Hash64 checksum;
  checksum.add(static_cast<std::uint64_t>(triangleCount));
  addArray(checksum, ArrayType::Double, points);
  addNone(checksum); // they have no Radius
  addForTriangles(checksum, fibres, triangles, [](const FibreSurfacePair& fibre) { return fibre.fibreId; });
  addForTriangles(checksum, fibres, triangles, [](const FibreSurfacePair& fibre) { return fibre.bundleId; });
  addNone(checksum); // nor a TargetRadius
  addForTriangles(checksum, fibres, triangles, [kind](const FibreSurfacePair&) { return kind; });
  return checksum.text();
}

} // namespace cactus
