// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/TriangleMesh.h"

#include <cstddef>
#include <string>

namespace cactus
{

/// The encoding of numbers in a PLY file.
enum class PlyEncoding
{
  Ascii = 0, ///< coordinates with nine significant digits
  Binary = 1 ///< little-endian: 12 bytes per vertex, in single precision, and 13 per triangle
};

// The content of a PLY file (µm): vertices exactly `x y z`, faces `3 i j k`, no normals and no colours.

/// Returns the header; `comment` is one line of it.
///
/// Simulators read the header word by word, so that the comment must not contain the words vertex, face, nx and end_header;
/// throws InvalidInput if it does, or has a line break.
std::string plyHead(std::size_t points, std::size_t triangles, const std::string& comment, PlyEncoding encoding);

/// Append the vertices of a mesh, or its faces, which refer to vertices after the first `before` of the file: at most 2³¹ in
/// total.
void appendPlyVertices(std::string& text, const TriangleMesh& mesh, PlyEncoding encoding);
void appendPlyFaces(std::string& text, const TriangleMesh& mesh, PlyEncoding encoding, std::size_t before = 0);

/// Returns the file of one mesh. Throws as plyHead() does.
std::string plyText(const TriangleMesh& mesh, const std::string& comment, PlyEncoding encoding = PlyEncoding::Ascii);

/// Returns the surface that a reader of plyText() gets, with coordinates rounded as in the file.
TriangleMesh asWritten(TriangleMesh mesh, PlyEncoding encoding = PlyEncoding::Ascii);

} // namespace cactus
