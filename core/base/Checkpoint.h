// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/AtomicFile.h"
#include "base/Hash64.h"

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

namespace cactus
{

/// The front of a checkpoint.
struct CheckpointHeader
{
  std::uint64_t fingerprint = 0; ///< identifies the work and its options
  std::int64_t iteration = 0;    ///< the next one
};

/// Returns the header of the checkpoint at `path`, with the whole file checked; nothing if there is no file. Throws InvalidInput
/// if the fingerprint differs, and FileError if the file is something else, of another version, damaged or unreadable: such a
/// file does not belong to this run and must not be replaced.
std::optional<CheckpointHeader> findCheckpoint(const std::string& path, std::uint64_t fingerprint);

/// Writes a checkpoint: binary, in the byte order of this machine, whole or not at all (see AtomicFile).
///
/// Layout: title with the format number, a mark for the byte order, header, values, and the Hash64 of all of these. Throws
/// FileError.
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
  /// Writes numbers, or elements that consist of numbers only, without padding.
  template <typename Value>
  void putAll(const std::vector<Value>& values)
  {
    this->put(static_cast<std::uint64_t>(values.size()));
    this->write(values.data(), values.size() * sizeof(Value));
  }
  /// Writes bytes of an array whose count has been written.
  void putPart(const void* data, std::size_t bytes) { this->write(data, bytes); }
  /// Also throws InvalidInput or FileError if meanwhile another run's checkpoint, or something else, is at `path`.
  void commit();

private:
  void write(const void* data, std::size_t bytes);

  std::string Path;
  CheckpointHeader Header;
  AtomicFile File;
  Hash64 Sum;
};

/// Reads what a CheckpointWriter wrote, in the same order.
class CheckpointReader
{
public:
  /// Reads and checks the whole file first. Throws FileError if it cannot be read, is no checkpoint, is of another version or
  /// damaged, and InvalidInput if its fingerprint differs.
  CheckpointReader(const std::string& path, std::uint64_t fingerprint);

  const CheckpointHeader& header() const { return this->Header; }

  template <typename Value>
  void get(Value& value)
  {
    static_assert(std::is_arithmetic<Value>::value && !std::is_same<Value, bool>::value, "numbers only");
    this->read(&value, sizeof(value));
  }
  /// Reads a count of elements of `bytes` each; throws if the file is too short for them, so that no more is allocated.
  std::size_t getCount(std::size_t bytes)
  {
    std::uint64_t count = 0;
    this->get(count);
    this->require(count <= this->Left / bytes);
    return static_cast<std::size_t>(count);
  }
  /// Reads bytes of an array whose count has been read.
  void getPart(void* data, std::size_t bytes) { this->read(data, bytes); }
  /// Reads an array. `expected`: its length; −1 for any length.
  template <typename Value>
  void getAll(std::vector<Value>& values, std::int64_t expected = -1)
  {
    const std::size_t count = this->getCount(sizeof(Value));
    this->require(expected < 0 || count == static_cast<std::uint64_t>(expected));
    values.resize(count);
    this->read(values.data(), count * sizeof(Value));
  }
  /// Throws FileError unless `good`: such values cannot have been written.
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
