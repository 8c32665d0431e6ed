// SPDX-License-Identifier: BSD-3-Clause
#include "io/TrxNumbers.h"

#include "base/ByteOrder.h"

#include <Eigen/Core>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstring>

namespace cactus
{

namespace
{

template <typename Number>
std::vector<double> converted(const std::vector<char>& bytes)
{
  std::vector<double> numbers(bytes.size() / sizeof(Number));
  for (std::size_t i = 0; i < numbers.size(); ++i)
  {
    Number number;
    std::memcpy(static_cast<void*>(&number), bytes.data() + i * sizeof(Number), sizeof(Number));
    if (!isLittleEndian())
    {
      swapBytes(&number, 1);
    }
    numbers[i] = static_cast<double>(number);
  }
  return numbers;
}

struct TrxType
{
  const char* name;
  std::size_t size;
  std::vector<double> (*convert)(const std::vector<char>&);
};

/// The types and their sizes; a bit takes a byte.
constexpr TrxType types[] = { { "float32", 4, converted<float> }, { "float16", 2, converted<Eigen::half> },
  { "float64", 8, converted<double> }, { "uint8", 1, converted<std::uint8_t> }, { "uint16", 2, converted<std::uint16_t> },
  { "uint32", 4, converted<std::uint32_t> }, { "uint64", 8, converted<std::uint64_t> }, { "int8", 1, converted<std::int8_t> },
  { "int16", 2, converted<std::int16_t> }, { "int32", 4, converted<std::int32_t> }, { "int64", 8, converted<std::int64_t> },
  { "bit", 1, converted<std::uint8_t> } };

const TrxType* typeOf(const std::string& name)
{
  const auto* found = std::find_if(std::begin(types), std::end(types), [&](const TrxType& type) { return type.name == name; });
  return found != std::end(types) ? found : nullptr;
}

} // namespace

std::optional<TrxPart> trxPart(const std::string& path)
{
  TrxPart part;
  part.path = path;
  part.name = path.substr(path.rfind('/') + 1); // the whole path without a slash
  const std::size_t dot = part.name.rfind('.');
  const TrxType* type = dot != std::string::npos ? typeOf(part.name.substr(dot + 1)) : nullptr;
  if (type == nullptr)
  {
    return std::nullopt;
  }
  part.type = type->name;
  part.size = type->size;
  part.name.resize(dot);
  const std::size_t before = part.name.rfind('.');
  if (before != std::string::npos)
  {
    constexpr std::size_t most = 65536;
    const char* end = part.name.data() + part.name.size();
    const auto found = std::from_chars(part.name.data() + before + 1, end, part.components);
    if (found.ec != std::errc() || found.ptr != end || part.components < 1 || part.components > most)
    {
      return std::nullopt;
    }
    part.name.resize(before);
  }
  return part.name.empty() ? std::nullopt : std::optional<TrxPart>(part);
}

std::vector<double> trxNumbers(const std::vector<char>& bytes, const TrxPart& part)
{
  return typeOf(part.type)->convert(bytes);
}

} // namespace cactus
