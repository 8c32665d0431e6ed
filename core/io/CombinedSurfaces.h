// SPDX-License-Identifier: BSD-3-Clause
// Writes all surfaces of one kind, or those of a bundle, into one file.
//
// Fibres are processed one after the other, so that no two meshes are in memory at once; each is made once to be measured, and
// once or twice to be written.
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

/// The summary of a file's surfaces.
struct SurfaceBox
{
  std::size_t points = 0;
  std::size_t triangles = 0;
  Eigen::Vector3d lower = Eigen::Vector3d::Zero(); ///< µm
  Eigen::Vector3d upper = Eigen::Vector3d::Zero();
  Eigen::Vector3d origin = Eigen::Vector3d::Zero(); ///< origin of the file's coordinates
};

/// Returns that of the surfaces as they are written (see asWritten()), with the lower corner as origin. Throws Cancelled.
SurfaceBox surfaceBox(const FibreSurfaces& surfaces, const Context& context);

/// Returns the header of `KIND.ply`. Throws InvalidInput for more points than the format can number.
std::string caminoHead(const SurfaceBox& box);

/// µm by which Camino's repeats of a substrate are farther apart than its sides. Camino lets a walker into the next repeat only
/// 1e-9 sides beyond the border (`a` in its Substrate.java). Repeats that touch have the ends of their fibres in between, so that
/// the walker comes to be inside a fibre, and Camino stops. Twice that distance would do; 0.001 is ample for sides below 0.5 m.
constexpr double caminoSpacing = 0.001;

/// `KIND.ply` for Camino: ASCII, metres, with the comment by which it tells inside from outside. Throws as caminoHead() does,
/// FileError and Cancelled.
void writeCaminoSurfaces(const FibreSurfaces& surfaces, const std::string& kind, FolderWriter& writer, const Context& context);

/// Returns the header of a file of a bundle's surfaces. Throws as caminoHead() does.
std::string bundleHead(const SurfaceBox& box, const std::string& comment, PlyEncoding encoding);

/// Writes one PLY file (µm) of consecutive surfaces, in the format of plyText(), as FolderWriter::put() does. Throws as
/// bundleHead() does, FileError and Cancelled.
std::string writeBundleSurfaces(const FibreSurfaces& surfaces, const std::string& path, const std::string& comment,
  PlyEncoding encoding, const FolderWriter& writer, const Context& context);

/// Writes `KIND_vertices.npy` (n × 3, float64, metres from the lower corner of their bounding box, where Disimpy moves them) and
/// `KIND_faces.npy` (m × 3, int64). Throws FileError and Cancelled.
void writeDisimpySurfaces(const FibreSurfaces& surfaces, const std::string& kind, FolderWriter& writer, const Context& context);

} // namespace cactus
