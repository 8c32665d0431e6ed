// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fibres/Fibres.h"

#include <string>
#include <vector>

namespace cactus
{

/// Fibres as a file holds them.
struct FibresOfFile
{
  Fibres fibres;
  std::vector<std::string> remarks; ///< what of the file was left out or assumed, in sentences
};

} // namespace cactus
