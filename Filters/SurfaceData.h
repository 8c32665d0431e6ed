// SPDX-License-Identifier: BSD-3-Clause
// Conversion of surfaces between one vtkPolyData and core.
#pragma once

#include "base/Domain.h"
#include "mesh/FibreSurfaces.h"
#include "mesh/TriangleMesh.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <vector>

class vtkDataObject;
class vtkPolyData;

namespace cactus
{

/// Splits triangles with cell data `FibreId` and, optionally, `BundleId`, `Surface` (0 outer, 1 inner) and `GRatio` into one
/// surface per fibre.
///
/// Each surface numbers its own points in the order of `input`, so that surfaces that share one array of points are separate;
/// `input` must not change while the result is used. `port` names the input in messages, and `surface` is the required value of
/// the array `Surface`. An input without cells gives no surfaces. The blocks of a composite data set are one substrate. Throws
/// InvalidInput if there are cells other than triangles, no FibreId or one that is no whole number from 1, the other kind of
/// surface, or two blocks with surfaces of the same FibreId.
FibreSurfaces surfacesFrom(vtkDataObject* input, const std::string& port, int surface);

/// A surface with its fibre and bundle.
struct NamedSurface
{
  int fibreId = 0;
  int bundleId = 0;
  TriangleMesh mesh;
};

/// Joins all surfaces, in their order, into one vtkPolyData, each with its own points, with cell data `FibreId`, `BundleId` and
/// `Surface`. Meshes are freed one by one, so that a large substrate is not stored twice. Corners are 32-bit numbers if there are
/// at most `mostInShort` of them and of points, and 64-bit ones otherwise.
void toPolyData(std::vector<NamedSurface> surfaces, int surface, vtkPolyData* output,
  std::size_t mostInShort = std::size_t(std::numeric_limits<std::int32_t>::max()));

/// What is known of a fibre beside its surface.
struct FibreValues
{
  float radius = 0.0F; ///< µm, of the tube around its centre line that has its volume in the domain; NaN if unknown
  float gRatio = 0.0F; ///< the one reached
  std::array<unsigned char, 3> colour{}; ///< of its direction, see directionColour()
};

/// Returns the values of a fibre from its surface, whose volume (µm³) counts with caps, and the length (µm) of its centre line in
/// the domain; NaN if that is unknown. Of a fibre that only just reaches into the domain, volume over length says nothing.
FibreValues fibreValues(const TriangleMesh& mesh, double volume, double length, double gRatio, const Domain& domain);

/// Adds the values of each triangle's fibre as cell data `Radius`, `GRatio` and `Direction`, in single precision and in bytes.
void addFibreValues(vtkPolyData* surfaces, const std::map<int, FibreValues>& valuesOf);

/// Throws InvalidInput if `surfaces` has field data Domain that differs from `domain` by more than 1e-6 µm. Null means no
/// surfaces.
void requireSameDomain(const Domain& domain, vtkDataObject* surfaces, const std::string& port);

} // namespace cactus
