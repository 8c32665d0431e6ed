// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace cactus
{

/// A file of numbers in a .trx, as its name says: `FOLDER/NAME.COMPONENTS.TYPE`, or `NAME.TYPE` for one component.
struct TrxPart
{
  std::string path;
  std::string name;
  std::size_t components = 1;
  std::string type;     ///< float32, uint8, …
  std::size_t size = 0; ///< bytes of a number

  bool isFloating() const { return this->type.compare(0, 5, "float") == 0; }
};

/// Nothing where a name is not of that form, or its type is none that a .trx has (float16 to 64, int8 to 64, uint8 to 64, bit).
std::optional<TrxPart> trxPart(const std::string& path);

/// The numbers that bytes (little-endian) stand for; as many as there are whole ones.
std::vector<double> trxNumbers(const std::vector<char>& bytes, const TrxPart& part);

} // namespace cactus
