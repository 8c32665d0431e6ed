// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace cactus
{

/// A file of numbers in a .trx, as described by its name: `FOLDER/NAME.COMPONENTS.TYPE`, or `NAME.TYPE` for one component.
struct TrxPart
{
  std::string path;
  std::string name;
  std::size_t components = 1;
  std::string type;     ///< float32, uint8, …
  std::size_t size = 0; ///< bytes of a number

  bool isFloating() const { return this->type.compare(0, 5, "float") == 0; }
};

/// Parses a file name; nothing for a name of another form, or a type that .trx does not have (float16 to 64, int8 to 64, uint8 to
/// 64, bit).
std::optional<TrxPart> trxPart(const std::string& path);

/// Converts bytes (little-endian) to numbers, as many as are complete.
std::vector<double> trxNumbers(const std::vector<char>& bytes, const TrxPart& part);

} // namespace cactus
