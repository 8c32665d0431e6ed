// SPDX-License-Identifier: BSD-3-Clause
// All surfaces of one kind in one file, or those of a bundle. Fibres are taken one after the other, so that no two meshes are
// held at once; each is made once to be measured, and once or twice to be written.
#pragma once

#include "base/Context.h"
#include "io/FolderWriter.h"
#include "io/PlyFile.h"
#include "mesh/FibreSurfaces.h"

#include <Eigen/Core>

#include <cstddef>
#include <string>

namespace cactus
{

/// What a file of surfaces says before them.
struct SurfaceBox
{
  std::size_t points = 0;
  std::size_t triangles = 0;
  Eigen::Vector3d lower = Eigen::Vector3d::Zero(); ///< µm
  Eigen::Vector3d upper = Eigen::Vector3d::Zero();
  Eigen::Vector3d origin = Eigen::Vector3d::Zero(); ///< where the file counts from
};

/// Of the surfaces as they are written (see asWritten()), with the lower corner as origin. Throws Cancelled.
SurfaceBox surfaceBox(const FibreSurfaces& surfaces, const Context& context);

/// What `KIND.ply` begins with. Throws InvalidInput for more points than the format can number.
std::string caminoHead(const SurfaceBox& box);

/// µm by which Camino's repeats of a substrate are farther apart than its sides: where they touch, walkers outside end the run.
constexpr double caminoSpacing = 0.1;

/// `KIND.ply` for Camino: ASCII, metres, with the comment by which it tells inside from outside. Throws as caminoHead() does,
/// FileError and Cancelled.
void writeCaminoSurfaces(const FibreSurfaces& surfaces, const std::string& kind, FolderWriter& writer, const Context& context);

/// What a file of a bundle's surfaces begins with. Throws as caminoHead() does.
std::string bundleHead(const SurfaceBox& box, const std::string& comment, PlyEncoding encoding);

/// One PLY file (µm) of surfaces, one after the other, as plyText() has one; returns its checksum. Throws as bundleHead() does,
/// FileError and Cancelled.
std::string writeBundleSurfaces(const FibreSurfaces& surfaces, const std::string& path, const std::string& comment,
  PlyEncoding encoding, const StagingFolder& folder, const Context& context);

/// `KIND_vertices.npy` (n × 3, float64, metres from the lower corner of the box around them, as Disimpy moves them) and
/// `KIND_faces.npy` (m × 3, int64). Throws FileError and Cancelled.
void writeDisimpySurfaces(const FibreSurfaces& surfaces, const std::string& kind, FolderWriter& writer, const Context& context);

} // namespace cactus
