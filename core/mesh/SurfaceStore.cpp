// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/SurfaceStore.h"

#include "base/Bytes.h"

namespace cactus
{

std::string SurfacesInMemory::bytesOf(std::size_t index) const
{
  return cactus::bytesOf(this->Surfaces[index].points, this->Surfaces[index].triangles);
}

void SurfacesInMemory::putElsewhere(std::size_t index, const std::string& bytes)
{
  TriangleMesh mesh;
  getAll(bytes, mesh.points, mesh.triangles);
  this->Surfaces[index] = std::move(mesh);
}

} // namespace cactus
