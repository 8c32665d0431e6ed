// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/TriangleMesh.h"

#include <string>

namespace cactus
{

/// The text of an ASCII PLY file (µm): vertices exactly `x y z` with nine significant digits, faces `3 i j k`, no normals and no
/// colours. `comment` goes into the header as one line.
///
/// Simulators read the header word by word, so that the comment must hold neither of the words vertex, face, nx and end_header;
/// throws InvalidInput where it does, or has a line break.
std::string plyText(const TriangleMesh& mesh, const std::string& comment);

/// The surface that a reader of plyText() gets: with coordinates rounded to nine significant digits.
TriangleMesh asWritten(TriangleMesh mesh);

} // namespace cactus
