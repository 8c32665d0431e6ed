// SPDX-License-Identifier: BSD-3-Clause
// The one place that takes apart surfaces that come as one vtkPolyData.
#pragma once

#include "base/Domain.h"
#include "mesh/FibreSurfaces.h"
#include "mesh/TriangleMesh.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

class vtkDataObject;
class vtkPolyData;

namespace cactus
{

/// Triangles with cell data `FibreId` and, if there, `BundleId` and `Surface` (0 outer, 1 inner), as one surface per fibre.
///
/// Each surface numbers its points anew in the order they have in `input`, so that surfaces can be told apart although they share
/// one array of points; `input` has to stay as it is while the result is used. `port` names the input in messages, and `surface`
/// is what the array `Surface` has to hold. An input without cells gives no surfaces. The blocks of a composite data set are one
/// substrate. Throws InvalidInput where there are cells other than triangles, no FibreId or one that is no whole number from 1,
/// the other kind of surface, or two blocks with surfaces of the same FibreId.
FibreSurfaces surfacesFrom(vtkDataObject* input, const std::string& port, int surface);

/// A surface and whose it is.
struct NamedSurface
{
  int fibreId = 0;
  int bundleId = 0;
  TriangleMesh mesh;
};

/// The reverse: one vtkPolyData of all surfaces in their order, each with points of its own, with cell data `FibreId`, `BundleId`
/// and `Surface`. Meshes are let go one by one, so that a large substrate is not held twice. Corners are 32-bit numbers as long
/// as there are at most `mostInShort` of them and of points, and 64-bit ones beyond.
void toPolyData(std::vector<NamedSurface> surfaces, int surface, vtkPolyData* output,
  std::size_t mostInShort = std::size_t(std::numeric_limits<std::int32_t>::max()));

/// Throws InvalidInput where `surfaces` has field data Domain, and another one than `domain` to 1e-6 µm. Null is no surfaces.
void requireSameDomain(const Domain& domain, vtkDataObject* surfaces, const std::string& port);

} // namespace cactus
