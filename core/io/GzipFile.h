// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Context.h"

#include <cstddef>
#include <ostream>
#include <string>

namespace cactus
{

/// Returns the first bytes of a file, at most `count` of them; of a file packed by gzip, those of its content. Empty for what is
/// no regular file or cannot be read.
std::string beginningOfFile(const std::string& path, std::size_t count);

/// Writes the content of a file packed by gzip to the stream. Throws FileError (no such file, truncated, damaged), OutOfMemory
/// and Cancelled.
void unpackGzip(const std::string& path, std::ostream& to, const Context& context = {});

} // namespace cactus
