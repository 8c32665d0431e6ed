// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/SubstrateContents.h"

#include <string>

namespace cactus
{

/// The README.txt of a substrate folder: what is in it, how good it is, and how to simulate with it.
std::string readmeText(const SubstrateFolderContents& contents, const WrittenSubstrate& substrate);

} // namespace cactus
