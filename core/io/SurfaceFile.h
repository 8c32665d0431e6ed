// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/SurfacePart.h"
#include "mesh/TriangleMesh.h"

#include <cstdint>
#include <string>

namespace cactus
{

/// Identifies the production and the fibre that a surface file belongs to.
struct SurfaceFileOwner
{
  std::uint64_t fingerprint = 0; ///< of the fibres and options that it was made for
  std::uint64_t index = 0;       ///< index of the surface
};

/// Writes a surface into a file that can be read in parts: binary, in the byte order of this machine, and whole or not at all
/// (see AtomicFile).
///
/// Layout: title with the format number, a mark for the byte order, owner, and the totals; the places of the layers; the surface
/// in layers along z, of 1 µm or more and 128 triangles or more on average. Each has the triangles whose lowest corners are in
/// it, all their corners, and the number of the lowest layer that reaches it. A triangle takes about 15 bytes, or 23 if
/// coordinates are not in single precision. Each layer and the beginning have a Hash64; that of a layer includes the beginning's.
///
/// Throws FileError, also if something else is at `path` already, or a file with another fingerprint.
void writeSurface(const std::string& path, const SurfaceFileOwner& owner, const TriangleMesh& surface);

/// Reads the surface, with the same bits. Throws FileError if the file cannot be read, belongs to another surface, or any byte is
/// damaged.
TriangleMesh readSurface(const std::string& path, const SurfaceFileOwner& owner);

/// Returns cutOut() of that surface. It reads only the layers between these heights, and those below that reach them, so that its
/// cost does not depend on the length of the surface; it detects damage only in these. Throws as readSurface().
SurfacePart readSurfacePart(const std::string& path, const SurfaceFileOwner& owner, double lower, double upper);

} // namespace cactus
