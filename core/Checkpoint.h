// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "AtomicFile.h"

#include <cstdint>
#include <cstring>
#include <fstream>
#include <string>
#include <type_traits>
#include <vector>

namespace cactus
{

/// A number that tells one sequence of values from another (64-bit FNV-1a, by words); not a protection against malice.
class Fingerprint
{
public:
  template <typename Value>
  void add(const Value& value)
  {
    static_assert(std::is_arithmetic<Value>::value, "add numbers one by one");
    std::uint64_t word = 0;
    static_assert(sizeof(value) <= sizeof(word), "too long for a word");
    std::memcpy(&word, &value, sizeof(value));
    this->Hash = (this->Hash ^ word) * 0x100000001b3u;
    this->Hash ^= this->Hash >> 32;
  }
  std::uint64_t value() const { return this->Hash; }

private:
  std::uint64_t Hash = 0xcbf29ce484222325u;
};

/// Writes a checkpoint: binary, for the kind of machine that wrote it, and whole or not at all (see AtomicFile). `fingerprint`
/// says of what. Throws FileError.
class CheckpointWriter
{
public:
  CheckpointWriter(const std::string& path, std::uint64_t fingerprint);

  template <typename Value>
  void put(const Value& value)
  {
    static_assert(std::is_arithmetic<Value>::value, "numbers only");
    this->write(&value, sizeof(value));
  }
  /// Numbers, or things that consist of nothing but numbers.
  template <typename Value>
  void putAll(const std::vector<Value>& values)
  {
    this->put(static_cast<std::uint64_t>(values.size()));
    this->write(values.data(), values.size() * sizeof(Value));
  }
  void commit();

private:
  void write(const void* data, std::size_t bytes);

  AtomicFile File;
};

/// Reads what a CheckpointWriter wrote, in the same order.
class CheckpointReader
{
public:
  /// Throws FileError where the file cannot be read or is no checkpoint, and InvalidInput where it has another fingerprint.
  CheckpointReader(const std::string& path, std::uint64_t fingerprint);

  template <typename Value>
  void get(Value& value)
  {
    this->read(&value, sizeof(value));
  }
  /// `expected`: how many there must be; −1 for any number.
  template <typename Value>
  void getAll(std::vector<Value>& values, std::int64_t expected = -1)
  {
    std::uint64_t count = 0;
    this->get(count);
    if ((expected >= 0 && count != static_cast<std::uint64_t>(expected)) || count > this->Bytes / sizeof(Value))
    {
      this->damaged();
    }
    values.resize(count);
    this->read(values.data(), count * sizeof(Value));
  }
  /// Throws FileError unless everything has been read.
  void finish();

private:
  void read(void* data, std::size_t bytes);
  [[noreturn]] void damaged() const;

  std::string Path;
  std::ifstream File;
  std::uint64_t Bytes = 0;
};

} // namespace cactus
