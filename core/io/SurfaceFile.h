// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/SurfacePart.h"
#include "mesh/TriangleMesh.h"

#include <cstdint>
#include <string>

namespace cactus
{

/// Whose a surface's file is.
struct SurfaceFileOwner
{
  std::uint64_t fingerprint = 0; ///< of what it was made for
  std::uint64_t index = 0;       ///< of the surface
};

/// Writes a surface into a file of which parts can be read: binary, for the kind of machine that wrote it, and whole or not at
/// all (see AtomicFile).
///
/// Title with the number of the format, a mark for the order of bytes, owner; the surface in layers along z, of 1 µm or more
/// and 128 triangles or more on average, each with the triangles whose lowest corners are in it and all their corners; for each
/// layer where it is, how far up it reaches, and the lowest layer that reaches it; the numbers of all; 17 bytes a triangle or
/// so, 25 where coordinates are no single-precision numbers. Layers, their entries and the rest have each a CRC-64 that holds
/// the owner's, too.
///
/// Throws FileError, also where something else is at `path` already, or what has another fingerprint.
void writeSurface(const std::string& path, const SurfaceFileOwner& owner, const TriangleMesh& surface);

/// The surface that was written, to the bit. Throws FileError where it cannot be read, is another one's, or any byte is damaged.
TriangleMesh readSurface(const std::string& path, const SurfaceFileOwner& owner);

/// cutOut() of that surface. Only the layers between these heights are read, and those below that reach them, so that what it
/// takes does not depend on how long the surface is; and only in them is damage found. Throws as readSurface().
SurfacePart readSurfacePart(const std::string& path, const SurfaceFileOwner& owner, double lower, double upper);

} // namespace cactus
