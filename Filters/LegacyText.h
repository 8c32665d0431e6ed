// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace cactus
{

/// Returns a JSON text of one line, in which VTK's reader of legacy image files finds none of its keywords, for field data.
///
/// A ParaView server sends images to its client as such files. The reader looks for words such as "spacing" and "origin" in the
/// whole file, field data included, after any white space and every 255 characters. Their first letters are replaced by escapes,
/// which JSON readers turn back. White space stands only between values and within texts, as singleLine() writes it.
std::string withoutKeywords(const std::string& json);

} // namespace cactus
