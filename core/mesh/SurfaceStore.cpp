// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/SurfaceStore.h"

#include "base/Bytes.h"

#include <cstdint>

namespace cactus
{

std::string SurfacesInMemory::bytesOf(std::size_t index) const
{
  const TriangleMesh& mesh = this->Surfaces[index];
  ByteWriter put;
  put(static_cast<std::uint64_t>(mesh.points.size()));
  put.addAll(mesh.points.data(), mesh.points.size());
  put(static_cast<std::uint64_t>(mesh.triangles.size()));
  put.addAll(mesh.triangles.data(), mesh.triangles.size());
  return std::move(put.bytes());
}

void SurfacesInMemory::putElsewhere(std::size_t index, const std::string& bytes)
{
  TriangleMesh mesh;
  ByteReader get(bytes);
  mesh.points.resize(get.get<std::uint64_t>());
  get.getAll(mesh.points.data(), mesh.points.size());
  mesh.triangles.resize(get.get<std::uint64_t>());
  get.getAll(mesh.triangles.data(), mesh.triangles.size());
  this->Surfaces[index] = std::move(mesh);
}

} // namespace cactus
