// SPDX-License-Identifier: BSD-3-Clause
#include "io/PlyFile.h"

#include "base/ByteOrder.h"
#include "base/Error.h"
#include "mesh/CappedSurface.h"

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <sstream>
#include <utility>

namespace cactus
{

namespace
{

constexpr std::size_t longestNumber = 32;

/// Writes a coordinate to `text` and returns where it ends.
char* writeCoordinate(char (&text)[longestNumber], double value)
{
  return std::to_chars(text, text + longestNumber, value, std::chars_format::general, 9).ptr;
}

/// Throws for a comment that a reader would misunderstand.
void requireComment(const std::string& comment)
{
  std::istringstream words(comment);
  for (std::string word; words >> word;)
  {
    if (word == "vertex" || word == "face" || word == "nx" || word == "end_header")
    {
      throw InvalidInput(
        "the comment of a PLY file must not hold the word " + word + ", which its readers take for the header's");
    }
  }
  if (comment.find_first_of("\r\n") != std::string::npos)
  {
    throw InvalidInput("the comment of a PLY file must not hold a line break");
  }
}

} // namespace

std::string plyHead(std::size_t points, std::size_t triangles, const std::string& comment, PlyEncoding encoding)
{
  requireComment(comment);
  return std::string("ply\nformat ") + (encoding == PlyEncoding::Binary ? "binary_little_endian" : "ascii") + " 1.0\ncomment " +
         comment + "\nelement vertex " + std::to_string(points) +
         "\nproperty float x\nproperty float y\nproperty float z\nelement face " + std::to_string(triangles) +
         "\nproperty list uchar int vertex_indices\nend_header\n";
}

void appendPlyVertices(std::string& text, const TriangleMesh& mesh, PlyEncoding encoding)
{
  const bool isBinary = encoding == PlyEncoding::Binary;
  text.reserve(text.size() + (isBinary ? 12 : 48) * mesh.points.size());
  char number[longestNumber];
  for (const Eigen::Vector3d& point : mesh.points)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      if (isBinary)
      {
        appendLittleEndian(text, static_cast<float>(point[axis]));
        continue;
      }
      text.append(number, writeCoordinate(number, point[axis]));
      text += axis < 2 ? ' ' : '\n';
    }
  }
}

void appendPlyFaces(std::string& text, const TriangleMesh& mesh, PlyEncoding encoding, std::size_t before)
{
  const bool isBinary = encoding == PlyEncoding::Binary;
  text.reserve(text.size() + (isBinary ? 13 : 26) * mesh.triangles.size());
  char number[longestNumber];
  for (const auto& triangle : mesh.triangles)
  {
    text += isBinary ? '\x03' : '3';
    for (const std::int32_t corner : triangle)
    {
      const auto place = static_cast<std::int32_t>(static_cast<std::int64_t>(before) + corner);
      if (isBinary)
      {
        appendLittleEndian(text, place);
        continue;
      }
      text += ' ';
      text.append(number, std::to_chars(number, number + sizeof(number), place).ptr);
    }
    text += isBinary ? "" : "\n";
  }
}

std::string plyText(const TriangleMesh& mesh, const std::string& comment, PlyEncoding encoding)
{
  std::string text = plyHead(mesh.points.size(), mesh.triangles.size(), comment, encoding);
  appendPlyVertices(text, mesh, encoding);
  appendPlyFaces(text, mesh, encoding);
  return text;
}

TriangleMesh asWritten(TriangleMesh mesh, PlyEncoding encoding)
{
  if (encoding == PlyEncoding::Binary)
  {
    return inSinglePrecision(std::move(mesh));
  }
  char number[longestNumber];
  for (Eigen::Vector3d& point : mesh.points)
  {
    for (double& coordinate : point)
    {
      std::from_chars(number, writeCoordinate(number, coordinate), coordinate);
    }
  }
  return mesh;
}

} // namespace cactus
