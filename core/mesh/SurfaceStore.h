// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/SurfacePart.h"
#include "mesh/TriangleMesh.h"

#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace cactus
{

/// A source of surfaces by number. Thread-safe.
class SurfaceSource
{
public:
  virtual ~SurfaceSource() = default;

  virtual std::size_t size() const = 0;
  /// Returns a surface, possibly without triangles; it stays unchanged until it is replaced by another one.
  virtual std::shared_ptr<const TriangleMesh> get(std::size_t index) const = 0;
  /// Returns the part of a surface that touches `lower` <= z <= `upper` (µm), for callers that need no more at a time.
  virtual SurfacePart part(std::size_t index, double lower, double upper) const
  {
    return cutOut(*this->get(index), lower, upper);
  }
};

/// A store of surfaces, initially without triangles. Results do not depend on where the surfaces are stored.
class SurfaceStore : public SurfaceSource
{
public:
  /// Replaces a surface. Thread-safe for different surfaces.
  virtual void put(std::size_t index, TriangleMesh surface) = 0;
  /// Returns a surface as the bytes that another process needs; none if processes share the store.
  virtual std::string bytesOf(std::size_t /*index*/) const { return {}; }
  /// Takes a surface that another process has put, given as that one's bytesOf().
  virtual void putElsewhere(std::size_t index, const std::string& bytes) = 0;
  /// Marks that all surfaces are made, and that those put from now on are moved ones. A run that is killed before endMoving()
  /// leaves the surfaces as they were made.
  virtual void beginMoving() {}
  /// Marks that surfaces are moved no more. `moved` are those put since beginMoving(), by this run or by one before it.
  virtual void endMoving(const std::vector<std::size_t>& /*moved*/) {}
};

/// Stores all surfaces in memory: of processes that share work, each has all of them.
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
    return { std::shared_ptr<const TriangleMesh>(), &this->Surfaces[index] }; // owned by this store
  }
  void put(std::size_t index, TriangleMesh surface) override { this->Surfaces[index] = std::move(surface); }
  std::string bytesOf(std::size_t index) const override;
  void putElsewhere(std::size_t index, const std::string& bytes) override;
  /// Moves a surface out of the store.
  TriangleMesh take(std::size_t index) { return std::exchange(this->Surfaces[index], TriangleMesh()); }

private:
  std::vector<TriangleMesh> Surfaces;
};

} // namespace cactus
