// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/AtomicFile.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <optional>
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

/// CRC-64/XZ (the polynomial of ECMA-182, reflected) of some bytes; `before` is that of what comes before them. It differs
/// wherever an odd number of bits do, or any within 64 in a row; of other damage it misses one in 2⁶⁴.
std::uint64_t crc64(const void* data, std::size_t bytes, std::uint64_t before = 0);

/// What stands at the front of a checkpoint.
struct CheckpointHeader
{
  std::uint64_t fingerprint = 0; ///< of what it was written for
  std::int64_t iteration = 0;    ///< the next one
};

/// The checkpoint at `path`, checked from end to end; nothing where there is no file. Throws InvalidInput where it has another
/// fingerprint, and FileError where there is something else, of another version, damaged, or not to be read: whatever it is, it
/// is not this run's to replace.
std::optional<CheckpointHeader> findCheckpoint(const std::string& path, std::uint64_t fingerprint);

/// Writes a checkpoint: binary, for the kind of machine that wrote it, and whole or not at all (see AtomicFile).
///
/// Title with the number of the format, a mark for the order of bytes, header, values, and the CRC-64 of all of these.
/// Throws FileError.
class CheckpointWriter
{
public:
  CheckpointWriter(const std::string& path, const CheckpointHeader& header);

  template <typename Value>
  void put(const Value& value)
  {
    static_assert(std::is_arithmetic<Value>::value && !std::is_same<Value, bool>::value, "numbers only");
    this->write(&value, sizeof(value));
  }
  /// Numbers, or things that consist of nothing but numbers, without gaps.
  template <typename Value>
  void putAll(const std::vector<Value>& values)
  {
    this->put(static_cast<std::uint64_t>(values.size()));
    this->write(values.data(), values.size() * sizeof(Value));
  }
  /// Bytes of an array whose count has been put.
  void putPart(const void* data, std::size_t bytes) { this->write(data, bytes); }
  /// Throws, besides, InvalidInput or FileError where meanwhile another run's checkpoint, or something else, is at `path`.
  void commit();

private:
  void write(const void* data, std::size_t bytes);

  std::string Path;
  CheckpointHeader Header;
  AtomicFile File;
  std::uint64_t Checksum = 0;
};

/// Reads what a CheckpointWriter wrote, in the same order.
class CheckpointReader
{
public:
  /// Reads all of the file once before anything is taken from it. Throws FileError where it cannot be read, is no checkpoint, one
  /// of another version, or damaged, and InvalidInput where it has another fingerprint.
  CheckpointReader(const std::string& path, std::uint64_t fingerprint);

  const CheckpointHeader& header() const { return this->Header; }

  template <typename Value>
  void get(Value& value)
  {
    static_assert(std::is_arithmetic<Value>::value && !std::is_same<Value, bool>::value, "numbers only");
    this->read(&value, sizeof(value));
  }
  /// How many of `bytes` each follow; nothing is to be set aside for more than the file holds.
  std::size_t getCount(std::size_t bytes)
  {
    std::uint64_t count = 0;
    this->get(count);
    this->require(count <= this->Left / bytes);
    return static_cast<std::size_t>(count);
  }
  /// Bytes of an array whose count has been got.
  void getPart(void* data, std::size_t bytes) { this->read(data, bytes); }
  /// `expected`: how many there must be; −1 for any number.
  template <typename Value>
  void getAll(std::vector<Value>& values, std::int64_t expected = -1)
  {
    const std::size_t count = this->getCount(sizeof(Value));
    this->require(expected < 0 || count == static_cast<std::uint64_t>(expected));
    values.resize(count);
    this->read(values.data(), count * sizeof(Value));
  }
  /// Throws FileError where what was read cannot have been written so.
  void require(bool good) const
  {
    if (!good)
    {
      this->damaged();
    }
  }
  /// Throws FileError unless everything has been read.
  void finish() const { this->require(this->Left == 0); }

private:
  void verify();
  void read(void* data, std::size_t bytes);
  [[noreturn]] void damaged() const;

  std::string Path;
  std::ifstream File;
  std::uint64_t Left = 0; ///< bytes of values
  CheckpointHeader Header;
};

} // namespace cactus
