// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/SubstrateContents.h"

#include <string>

namespace cactus
{

/// Returns the README.txt of a substrate folder: its content, its certificate, and how to simulate with it.
std::string readmeText(const SubstrateFolderContents& contents, const WrittenSubstrate& substrate);

} // namespace cactus
