// SPDX-License-Identifier: BSD-3-Clause
#include "PlyFile.h"

#include "Error.h"

#include <charconv>
#include <sstream>

namespace cactus
{

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
  char number[32];
  for (const Eigen::Vector3d& point : mesh.points)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      const auto end = std::to_chars(number, number + sizeof(number), point[axis], std::chars_format::general, 9).ptr;
      text.append(number, end);
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

} // namespace cactus
