// SPDX-License-Identifier: BSD-3-Clause
// The record of a fibre's surfaces as bytes, in the byte order of the machine that wrote them.
#pragma once

#include "surface/FibreSurfacePair.h"

#include <string>

namespace cactus
{

/// Returns all numbers of a pair, without its meshes.
std::string bytesOf(const FibreSurfacePair& pair);

/// Reads them back. Throws FileError for other bytes.
FibreSurfacePair pairFrom(const std::string& bytes);

} // namespace cactus
