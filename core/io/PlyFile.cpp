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

/// Throws for what a reader would take for something else.
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

void appendAsText(std::string& text, const TriangleMesh& mesh)
{
  text.reserve(text.size() + 48 * mesh.points.size() + 26 * mesh.triangles.size());
  char number[longestNumber];
  for (const Eigen::Vector3d& point : mesh.points)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      text.append(number, writeCoordinate(number, point[axis]));
      text += axis < 2 ? ' ' : '\n';
    }
  }
  for (const auto& triangle : mesh.triangles)
  {
    text += '3';
    for (const std::int32_t corner : triangle)
    {
      text += ' ';
      text.append(number, std::to_chars(number, number + sizeof(number), corner).ptr);
    }
    text += '\n';
  }
}

void appendAsBytes(std::string& bytes, const TriangleMesh& mesh)
{
  bytes.reserve(bytes.size() + 12 * mesh.points.size() + 13 * mesh.triangles.size());
  for (const Eigen::Vector3d& point : mesh.points)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      appendLittleEndian(bytes, static_cast<float>(point[axis]));
    }
  }
  for (const auto& triangle : mesh.triangles)
  {
    bytes += '\x03';
    for (const std::int32_t corner : triangle)
    {
      appendLittleEndian(bytes, corner);
    }
  }
}

} // namespace

std::string plyText(const TriangleMesh& mesh, const std::string& comment, PlyEncoding encoding)
{
  requireComment(comment);
  const bool isBinary = encoding == PlyEncoding::Binary;
  std::string text = std::string("ply\nformat ") + (isBinary ? "binary_little_endian" : "ascii") + " 1.0\ncomment " + comment +
                     "\nelement vertex " + std::to_string(mesh.points.size()) +
                     "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
                     std::to_string(mesh.triangles.size()) + "\nproperty list uchar int vertex_indices\nend_header\n";
  isBinary ? appendAsBytes(text, mesh) : appendAsText(text, mesh);
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
