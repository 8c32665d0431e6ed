// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace cactus
{

/// Returns a program, other than this one, whose working directory is `folder` (absolute, without links) or inside it, as "name
/// (process 123)"; nothing if there is none. Only an administrator sees other users' programs.
std::string programIn(const std::filesystem::path& folder);

} // namespace cactus
