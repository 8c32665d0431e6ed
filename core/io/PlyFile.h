// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/TriangleMesh.h"

#include <cstddef>
#include <string>

namespace cactus
{

/// How numbers stand in a PLY file.
enum class PlyEncoding
{
  Ascii = 0, ///< coordinates with nine significant digits
  Binary = 1 ///< the lowest byte first: 12 bytes a vertex, in single precision, and 13 a triangle
};

// What is in a PLY file (µm): vertices exactly `x y z`, faces `3 i j k`, no normals and no colours.

/// What it begins with; `comment` goes into it as one line.
///
/// Simulators read the header word by word, so that the comment must hold neither of the words vertex, face, nx and end_header;
/// throws InvalidInput where it does, or has a line break.
std::string plyHead(std::size_t points, std::size_t triangles, const std::string& comment, PlyEncoding encoding);

/// Append the vertices of a mesh, and its faces, whose file has so many points before it: of all at most what 31 bits count.
void appendPlyVertices(std::string& text, const TriangleMesh& mesh, PlyEncoding encoding);
void appendPlyFaces(std::string& text, const TriangleMesh& mesh, PlyEncoding encoding, std::size_t before = 0);

/// The file of one mesh. Throws as plyHead() does.
std::string plyText(const TriangleMesh& mesh, const std::string& comment, PlyEncoding encoding = PlyEncoding::Ascii);

/// The surface that a reader of plyText() gets: with coordinates as rounded as they are there.
TriangleMesh asWritten(TriangleMesh mesh, PlyEncoding encoding = PlyEncoding::Ascii);

} // namespace cactus
