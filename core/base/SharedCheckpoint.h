// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Checkpoint.h"
#include "base/Sharing.h"

#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

namespace cactus
{

/// Writes one checkpoint of data that are distributed over several processes: the same file that one process with all the data
/// would write (see CheckpointWriter). The first process writes and holds only a small part of the others' data at a time. Calls
/// are collective: all processes make them in the same order.
class SharedCheckpointWriter
{
public:
  SharedCheckpointWriter(const std::string& path, const CheckpointHeader& header, const Sharing& sharing);

  /// Writes values that are the same in all processes.
  template <typename Value>
  void put(const Value& value)
  {
    this->inFirst([&] { this->File->put(value); });
  }

  /// Writes the values of all processes as one array, in the order of their ranks.
  template <typename Value>
  void putAll(const std::vector<Value>& part)
  {
    this->putParts(part.size(), sizeof(Value),
      [&](std::size_t begin, std::size_t end, const Take& take) { take(part.data() + begin, (end - begin) * sizeof(Value)); });
  }

  /// Receives bytes.
  using Take = std::function<void(const void*, std::size_t)>;
  /// Does the same piece by piece: piece(begin, end, take) passes the bytes of this process's values begin … end − 1 to `take`.
  void putParts(std::size_t count, std::size_t bytes, const std::function<void(std::size_t, std::size_t, const Take&)>& piece);

  /// Throws, in the first process, what CheckpointWriter throws now or threw before.
  void commit();

private:
  template <typename Work>
  void inFirst(Work&& work)
  {
    if (!this->Processes.isFirst() || this->Failure)
    {
      return;
    }
    // The others will still call the collective exchanges, so the error is thrown in commit().
    try
    {
      work();
    }
    catch (...)
    {
      this->Failure = std::current_exception();
    }
  }

  const Sharing& Processes;
  std::optional<CheckpointWriter> File;
  std::exception_ptr Failure;
};

/// Reads what a SharedCheckpointWriter wrote, also on another number of processes. The first process reads the file and throws
/// what CheckpointReader throws.
class SharedCheckpointReader
{
public:
  SharedCheckpointReader(const std::string& path, std::uint64_t fingerprint, const Sharing& sharing);

  /// Returns to all processes the bytes that the first one reads by read(file, put).
  std::string fromFile(const std::function<void(CheckpointReader&, ByteWriter&)>& read);

  /// Reads an array: `count` values for each process, in the order of their ranks. Throws FileError, in the first process, unless
  /// these are all its values.
  template <typename Value>
  void getAll(std::vector<Value>& part, std::size_t count)
  {
    const std::vector<std::uint64_t> counts = this->countsOfAll(count, sizeof(Value));
    part.resize(count);
    this->getParts(counts, sizeof(Value), reinterpret_cast<char*>(part.data()));
  }

  /// Throws FileError, in the first process, unless `good` holds in all processes.
  void require(bool good) const;
  void finish() const;

private:
  std::vector<std::uint64_t> countsOfAll(std::size_t count, std::size_t bytes);
  void getParts(const std::vector<std::uint64_t>& counts, std::size_t bytes, char* values);

  const Sharing& Processes;
  std::optional<CheckpointReader> File;
};

} // namespace cactus
