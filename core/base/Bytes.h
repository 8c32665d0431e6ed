// SPDX-License-Identifier: BSD-3-Clause
// Numbers as bytes, in the byte order of the machine that wrote them.
#pragma once

#include "base/Error.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

namespace cactus
{

/// Appends numbers one after the other.
class ByteWriter
{
public:
  template <typename Value>
  void operator()(const Value& value)
  {
    static_assert(std::is_arithmetic_v<Value> || std::is_enum_v<Value>);
    this->Bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
  }
  template <typename Value>
  void operator()(const std::vector<Value>& values)
  {
    (*this)(static_cast<std::uint64_t>(values.size()));
    for (const Value& value : values)
    {
      (*this)(value);
    }
  }
  void operator()(const std::string& text)
  {
    (*this)(static_cast<std::uint64_t>(text.size()));
    this->Bytes += text;
  }
  /// Appends elements that consist of numbers only, without padding. The caller keeps their count.
  template <typename Value>
  void addAll(const Value* values, std::size_t count)
  {
    this->Bytes.append(reinterpret_cast<const char*>(values), count * sizeof(Value));
  }

  std::string& bytes() { return this->Bytes; }

private:
  std::string Bytes;
};

/// Reads the numbers in the same order. Throws FileError if bytes are missing.
class ByteReader
{
public:
  /// `bytes` have to outlive the object.
  explicit ByteReader(const std::string& bytes)
    : Bytes(bytes)
  {
  }

  template <typename Value>
  void operator()(Value& value)
  {
    static_assert(std::is_arithmetic_v<Value> || std::is_enum_v<Value>);
    this->requireLeft(sizeof(value));
    std::memcpy(&value, this->Bytes.data() + this->At, sizeof(value));
    this->At += sizeof(value);
  }
  template <typename Value>
  void operator()(std::vector<Value>& values)
  {
    values.resize(this->count(sizeof(Value)));
    for (Value& value : values)
    {
      (*this)(value);
    }
  }
  void operator()(std::string& text)
  {
    const std::uint64_t size = this->count(1);
    text.assign(this->Bytes, this->At, size);
    this->At += size;
  }
  /// Reads what addAll() wrote.
  template <typename Value>
  void getAll(Value* values, std::size_t count)
  {
    this->requireLeft(count, sizeof(Value));
    // With nothing to copy, `values` may be null.
    if (count > 0)
    {
      std::memcpy(static_cast<void*>(values), this->Bytes.data() + this->At, count * sizeof(Value));
    }
    this->At += count * sizeof(Value);
  }
  template <typename Value>
  Value get()
  {
    Value value{};
    (*this)(value);
    return value;
  }
  bool isAtEnd() const { return this->At == this->Bytes.size(); }

private:
  std::uint64_t count(std::size_t bytesOfEach)
  {
    const auto count = this->get<std::uint64_t>();
    this->requireLeft(count, bytesOfEach);
    return count;
  }
  void requireLeft(std::uint64_t count, std::size_t bytesOfEach = 1) const
  {
    if (count > (this->Bytes.size() - this->At) / bytesOfEach)
    {
      throw FileError("what is known of the surfaces is damaged");
    }
  }

  const std::string& Bytes;
  std::size_t At = 0;
};

template <typename Value>
std::string bytesOf(const std::vector<Value>& values)
{
  ByteWriter put;
  put(values);
  return put.bytes();
}

template <typename Value>
void getAll(const std::string& bytes, std::vector<Value>& values)
{
  ByteReader get(bytes);
  get(values);
}

} // namespace cactus
