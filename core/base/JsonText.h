// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>

#include <optional>
#include <string>

namespace cactus
{

/// Names keep their order.
using Json = nlohmann::ordered_json;

/// How deeply values may be nested. A record says twice as much as there are filters of others between two stages, of which a
/// hundred are followed.
constexpr int deepestJson = 256;

/// The value that a text holds; nothing where it holds none, or one that is nested more
/// deeply.
std::optional<Json> parsedJson(const std::string& text);

/// A value on one line, with a blank after each comma and colon. Text that is not UTF-8 (a file's name may be anything) is marked
/// where it is not.
///
/// VTK's reader of legacy image files, by which a ParaView server hands images to its client, looks for words such as "spacing"
/// and "origin" in all of a file, field data included, after any white space and every 255 characters. Here such words stand
/// behind a quotation mark and near to white space, or are written with an escape, which JSON readers turn back.
std::string singleLine(const Json& value);

} // namespace cactus
