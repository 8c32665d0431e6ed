// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/SurfacePart.h"
#include "mesh/TriangleMesh.h"

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace cactus
{

/// Surfaces by their numbers, from wherever they are. May be used from several threads.
class SurfaceSource
{
public:
  virtual ~SurfaceSource() = default;

  virtual std::size_t size() const = 0;
  /// A surface, which may have no triangles; it stays as it is until it is changed for another one.
  virtual std::shared_ptr<const TriangleMesh> get(std::size_t index) const = 0;
  /// What of a surface touches `lower` <= z <= `upper` (µm), for those who need no more of it at a time.
  virtual SurfacePart part(std::size_t index, double lower, double upper) const
  {
    return cutOut(*this->get(index), lower, upper);
  }
};

/// Surfaces that are kept, each in the place of the one before; none has triangles at first. What is made of them does not depend
/// on where they are.
class SurfaceStore : public SurfaceSource
{
public:
  /// Several threads may put different ones.
  virtual void put(std::size_t index, TriangleMesh surface) = 0;
  /// Another process has put a surface, into a store that several have in common.
  virtual void putElsewhere(std::size_t /*index*/) {}
};

/// All of them in memory.
class SurfacesInMemory : public SurfaceStore
{
public:
  explicit SurfacesInMemory(std::size_t count)
    : Surfaces(count)
  {
  }

  std::size_t size() const override { return this->Surfaces.size(); }
  std::shared_ptr<const TriangleMesh> get(std::size_t index) const override
  {
    return { std::shared_ptr<const TriangleMesh>(), &this->Surfaces[index] }; // which stays here
  }
  void put(std::size_t index, TriangleMesh surface) override { this->Surfaces[index] = std::move(surface); }
  /// Gives a surface away.
  TriangleMesh take(std::size_t index) { return std::exchange(this->Surfaces[index], TriangleMesh()); }

private:
  std::vector<TriangleMesh> Surfaces;
};

} // namespace cactus
