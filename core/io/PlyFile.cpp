// SPDX-License-Identifier: BSD-3-Clause
#include "io/PlyFile.h"

#include "base/Error.h"

#include <charconv>
#include <cstddef>
#include <sstream>

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

} // namespace

std::string plyText(const TriangleMesh& mesh, const std::string& comment)
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
  std::string text = "ply\nformat ascii 1.0\ncomment " + comment + "\nelement vertex " + std::to_string(mesh.points.size()) +
                     "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
                     std::to_string(mesh.triangles.size()) + "\nproperty list uchar int vertex_indices\nend_header\n";
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
  return text;
}

TriangleMesh asWritten(TriangleMesh mesh)
{
  char number[longestNumber];
  for (Eigen::Vector3d& point : mesh.points)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      std::from_chars(number, writeCoordinate(number, point[axis]), point[axis]);
    }
  }
  return mesh;
}

} // namespace cactus
