// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>

#include <optional>
#include <string>

namespace cactus
{

/// Names keep their order.
using Json = nlohmann::ordered_json;

/// The deepest nesting of values that is accepted. A record is nested two levels for each foreign filter between two stages, of
/// which a hundred are followed.
constexpr int deepestJson = 256;

/// Parses a JSON text; nothing if it is no JSON or nested more deeply.
std::optional<Json> parsedJson(const std::string& text);

/// Writes a value on one line, with a blank after each comma and colon. Bytes that are not UTF-8 (a file name may hold any) are
/// replaced by U+FFFD.
std::string singleLine(const Json& value);

} // namespace cactus
