// SPDX-License-Identifier: BSD-3-Clause
#include "io/CombinedSurfaces.h"

#include "base/AtomicFile.h"
#include "base/ByteOrder.h"
#include "base/Error.h"
#include "base/Numbers.h"
#include "io/PlyFile.h"

#include <cstdint>
#include <functional>
#include <limits>

namespace cactus
{

namespace
{

constexpr double metre = 1e-6; ///< of one µm

/// Writes a file of a head and of what text(mesh, points before it) gives for each surface, in each of `passes` over them.
void writeInPasses(const FibreSurfaces& surfaces, const std::string& path, const std::string& head, FolderWriter& writer,
  const Context& context, const std::vector<std::function<std::string(const TriangleMesh&, std::size_t)>>& passes)
{
  writer.writeBy(path,
    [&](const std::string& place)
    {
      AtomicFile file(place);
      file.stream() << head;
      for (const auto& text : passes)
      {
        std::size_t before = 0;
        for (std::size_t i = 0; i < surfaces.size(); ++i)
        {
          context.checkpoint();
          const TriangleMesh mesh = asWritten(surfaces.mesh(i));
          file.stream() << text(mesh, before);
          before += mesh.points.size();
        }
      }
      file.commit();
    });
}

std::string plyVertices(const TriangleMesh& mesh)
{
  constexpr int digits = 9;
  std::string text;
  for (const Eigen::Vector3d& point : mesh.points)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      appendNumber(text, metre * point[axis], digits);
      text += axis < 2 ? ' ' : '\n';
    }
  }
  return text;
}

std::string plyFaces(const TriangleMesh& mesh, std::size_t before)
{
  std::string text;
  for (const auto& triangle : mesh.triangles)
  {
    text += '3';
    for (const std::int32_t corner : triangle)
    {
      text += ' ' + std::to_string(before + std::size_t(corner));
    }
    text += '\n';
  }
  return text;
}

/// The head of a file of rows of three numbers (NumPy's format 1.0), which ends at a multiple of 64 bytes.
std::string npyHead(const char* type, std::size_t rows)
{
  std::string description =
    std::string("{'descr': '") + type + "', 'fortran_order': False, 'shape': (" + std::to_string(rows) + ", 3), }";
  constexpr std::size_t before = 10;
  constexpr std::size_t step = 64;
  description += std::string(step - (before + description.size() + 1) % step, ' ') + '\n';
  const auto length = static_cast<std::uint16_t>(description.size());
  const char size[2] = { static_cast<char>(length & 0xff), static_cast<char>(length >> 8) };
  return std::string("\x93NUMPY\x01\x00", 8) + std::string(size, 2) + description;
}

} // namespace

SurfaceBox surfaceBox(const FibreSurfaces& surfaces, const Context& context)
{
  SurfaceBox box;
  box.lower.setConstant(std::numeric_limits<double>::infinity());
  box.upper = -box.lower;
  for (std::size_t i = 0; i < surfaces.size(); ++i)
  {
    context.checkpoint();
    const TriangleMesh mesh = asWritten(surfaces.mesh(i));
    box.points += mesh.points.size();
    box.triangles += mesh.triangles.size();
    for (const Eigen::Vector3d& point : mesh.points)
    {
      box.lower = box.lower.cwiseMin(point);
      box.upper = box.upper.cwiseMax(point);
    }
  }
  box.origin = box.lower;
  return box;
}

std::string caminoHead(const SurfaceBox& box)
{
  if (box.points > std::size_t(std::numeric_limits<std::int32_t>::max()))
  {
    throw InvalidInput("Format Camino has all surfaces in one file, which numbers " +
                       std::to_string(std::numeric_limits<std::int32_t>::max()) + " points at most, and these have " +
                       std::to_string(box.points) + ": write fewer fibres, or choose another Format");
  }
  return "ply\nformat ascii 1.0\ncomment closed surface\nelement vertex " + std::to_string(box.points) +
         "\nproperty float x\nproperty float y\nproperty float z\nelement face " + std::to_string(box.triangles) +
         "\nproperty list uchar int vertex_indices\nend_header\n";
}

void writeCaminoSurfaces(const FibreSurfaces& surfaces, const std::string& kind, FolderWriter& writer, const Context& context)
{
  writeInPasses(surfaces, kind + ".ply", caminoHead(surfaceBox(surfaces, context)), writer, context,
    { [](const TriangleMesh& mesh, std::size_t) { return plyVertices(mesh); },
      [](const TriangleMesh& mesh, std::size_t before) { return plyFaces(mesh, before); } });
}

void writeDisimpySurfaces(const FibreSurfaces& surfaces, const std::string& kind, FolderWriter& writer, const Context& context)
{
  const SurfaceBox box = surfaceBox(surfaces, context);
  const auto vertices = [&](const TriangleMesh& mesh, std::size_t)
  {
    std::string bytes;
    for (const Eigen::Vector3d& point : mesh.points)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        appendLittleEndian(bytes, metre * (point[axis] - box.origin[axis]));
      }
    }
    return bytes;
  };
  const auto faces = [](const TriangleMesh& mesh, std::size_t before)
  {
    std::string bytes;
    for (const auto& triangle : mesh.triangles)
    {
      for (const std::int32_t corner : triangle)
      {
        appendLittleEndian(bytes, static_cast<std::int64_t>(before) + corner);
      }
    }
    return bytes;
  };
  writeInPasses(surfaces, kind + "_vertices.npy", npyHead("<f8", box.points), writer, context, { vertices });
  writeInPasses(surfaces, kind + "_faces.npy", npyHead("<i8", box.triangles), writer, context, { faces });
}

} // namespace cactus
