// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace cactus
{

/// A program, other than this one, whose current folder is `folder` (whole, without links) or inside it, as "name (process 123)";
/// nothing if there is none. Of other users' programs only an administrator learns.
std::string programIn(const std::filesystem::path& folder);

} // namespace cactus
