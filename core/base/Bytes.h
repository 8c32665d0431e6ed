// SPDX-License-Identifier: BSD-3-Clause
// Values as bytes, in the byte order of the machine that wrote them: numbers; strings, vectors and maps with their counts;
// arrays; and types for which membersOf(value), declared beside the type, returns std::tie() of what is kept of them.
#pragma once

#include "base/Error.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace cactus
{

template <typename Value>
constexpr bool isNumber = std::is_arithmetic_v<Value> || std::is_enum_v<Value>;

template <typename Value, typename = void>
constexpr bool hasMembers = false;
template <typename Value>
constexpr bool hasMembers<Value, std::void_t<decltype(membersOf(std::declval<Value&>()))>> = true;

/// Appends values one after the other.
class ByteWriter
{
public:
  template <typename Value>
  void operator()(const Value& value)
  {
    if constexpr (isNumber<Value>)
    {
      this->Bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
    }
    else if constexpr (hasMembers<Value>)
    {
      std::apply(
        [this](const auto&... member) { ((*this)(member), ...); }, membersOf(const_cast<Value&>(value))); // which are only read
    }
    else
    {
      for (const auto& element : value)
      {
        (*this)(element);
      }
    }
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
  template <typename Key, typename Value>
  void operator()(const std::map<Key, Value>& values)
  {
    (*this)(static_cast<std::uint64_t>(values.size()));
    for (const auto& [key, value] : values)
    {
      (*this)(key);
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

/// Reads the values in the same order. Throws FileError if bytes are missing.
class ByteReader
{
public:
  /// `bytes` have to outlive the object. `failure`: the error's message.
  explicit ByteReader(const std::string& bytes, std::string failure = "what is known of the surfaces is damaged")
    : Bytes(bytes)
    , Failure(std::move(failure))
  {
  }

  template <typename Value>
  void operator()(Value& value)
  {
    if constexpr (isNumber<Value>)
    {
      this->requireLeft(sizeof(value));
      std::memcpy(&value, this->Bytes.data() + this->At, sizeof(value));
      this->At += sizeof(value);
    }
    else if constexpr (hasMembers<Value>)
    {
      std::apply([this](auto&... member) { ((*this)(member), ...); }, membersOf(value));
    }
    else
    {
      for (auto& element : value)
      {
        (*this)(element);
      }
    }
  }
  template <typename Value>
  void operator()(std::vector<Value>& values)
  {
    values.resize(this->count(isNumber<Value> ? sizeof(Value) : 1));
    for (Value& value : values)
    {
      (*this)(value);
    }
  }
  template <typename Key, typename Value>
  void operator()(std::map<Key, Value>& values)
  {
    values.clear();
    for (std::uint64_t left = this->count(1); left > 0; --left)
    {
      const auto key = this->get<Key>();
      (*this)(values[key]);
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
  /// Returns how many bytes were read.
  std::size_t at() const { return this->At; }
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
      throw FileError(this->Failure);
    }
  }

  const std::string& Bytes;
  std::string Failure;
  std::size_t At = 0;
};

template <typename... Values>
std::string bytesOf(const Values&... values)
{
  ByteWriter put;
  (put(values), ...);
  return std::move(put.bytes());
}

template <typename... Values>
void getAll(const std::string& bytes, Values&... values)
{
  ByteReader get(bytes);
  (get(values), ...);
}

} // namespace cactus
