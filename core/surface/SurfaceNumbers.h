// SPDX-License-Identifier: BSD-3-Clause
// What is known of a fibre's surfaces as bytes, for the kind of machine that wrote them.
#pragma once

#include "surface/FibreSurfacePair.h"

#include <string>

namespace cactus
{

/// All numbers of a pair, without its meshes.
std::string bytesOf(const FibreSurfacePair& pair);

/// The reverse. Throws FileError for bytes that are something else.
FibreSurfacePair pairFrom(const std::string& bytes);

} // namespace cactus
