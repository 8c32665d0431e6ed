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

constexpr double metre = 1e-6; ///< metres in one µm

/// Returns a surface's part of a file that already has that many points.
using SurfaceText = std::function<std::string(const TriangleMesh&, std::size_t)>;

/// Returns what writes a file of a head and of text() for each surface, in each of `passes` over them.
std::function<void(const std::string&)> inPasses(const FibreSurfaces& surfaces, const std::string& head, PlyEncoding encoding,
  const Context& context, const std::vector<SurfaceText>& passes)
{
  return [=, &surfaces, &context](const std::string& place)
  {
    AtomicFile file(place);
    file.stream() << head;
    for (const SurfaceText& text : passes)
    {
      std::size_t before = 0;
      for (std::size_t i = 0; i < surfaces.size(); ++i)
      {
        context.checkpoint();
        const TriangleMesh mesh = asWritten(surfaces.mesh(i), encoding);
        file.stream() << text(mesh, before);
        before += mesh.points.size();
      }
    }
    file.commit();
  };
}

/// Throws for more points than such a file can number.
void requireNumbered(const SurfaceBox& box, const std::string& whose)
{
  constexpr auto most = std::numeric_limits<std::int32_t>::max();
  if (box.points > std::size_t(most))
  {
    throw InvalidInput("Format " + whose + " in one file, which numbers " + std::to_string(most) +
                       " points at most, and these have " + std::to_string(box.points) +
                       ": write fewer fibres, or choose another Format");
  }
}

/// Returns the vertices in metres.
std::string caminoVertices(const TriangleMesh& mesh)
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

std::string faceText(const TriangleMesh& mesh, PlyEncoding encoding, std::size_t before)
{
  std::string text;
  appendPlyFaces(text, mesh, encoding, before);
  return text;
}

/// Returns the header of a file of rows of three numbers (NumPy's format 1.0), which ends at a multiple of 64 bytes.
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
  requireNumbered(box, "Camino has all surfaces");
  return plyHead(box.points, box.triangles, "closed surface", PlyEncoding::Ascii);
}

void writeCaminoSurfaces(const FibreSurfaces& surfaces, const std::string& kind, FolderWriter& writer, const Context& context)
{
  writer.writeBy(kind + ".ply",
    inPasses(surfaces, caminoHead(surfaceBox(surfaces, context)), PlyEncoding::Ascii, context,
      { [](const TriangleMesh& mesh, std::size_t) { return caminoVertices(mesh); },
        [](const TriangleMesh& mesh, std::size_t before) { return faceText(mesh, PlyEncoding::Ascii, before); } }));
}

std::string bundleHead(const SurfaceBox& box, const std::string& comment, PlyEncoding encoding)
{
  requireNumbered(box, "Surfaces by bundle has all surfaces of a bundle");
  return plyHead(box.points, box.triangles, comment, encoding);
}

std::string writeBundleSurfaces(const FibreSurfaces& surfaces, const std::string& path, const std::string& comment,
  PlyEncoding encoding, const FolderWriter& writer, const Context& context)
{
  const auto vertices = [encoding](const TriangleMesh& mesh, std::size_t)
  {
    std::string text;
    appendPlyVertices(text, mesh, encoding);
    return text;
  };
  const auto faces = [encoding](const TriangleMesh& mesh, std::size_t before) { return faceText(mesh, encoding, before); };
  const std::string head = bundleHead(surfaceBox(surfaces, context), comment, encoding);
  return writer.putBy(path, inPasses(surfaces, head, encoding, context, { vertices, faces }));
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
  const auto write = [&](const std::string& path, const std::string& head, const SurfaceText& text)
  { writer.writeBy(path, inPasses(surfaces, head, PlyEncoding::Ascii, context, { text })); };
  write(kind + "_vertices.npy", npyHead("<f8", box.points), vertices);
  write(kind + "_faces.npy", npyHead("<i8", box.triangles), faces);
}

} // namespace cactus
