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

/// Writes a checkpoint of what several processes have, each a part: the file that one process would write (see CheckpointWriter)
/// that had all of it. The first process writes, and holds a little of the others' parts at a time. Every process comes to each
/// call, in the same order.
class SharedCheckpointWriter
{
public:
  SharedCheckpointWriter(const std::string& path, const CheckpointHeader& header, const Sharing& sharing);

  /// What is the same in all processes.
  template <typename Value>
  void put(const Value& value)
  {
    this->inFirst([&] { this->File->put(value); });
  }

  /// The values of all processes as one, by their places.
  template <typename Value>
  void putAll(const std::vector<Value>& part)
  {
    this->putParts(part.size(), sizeof(Value),
      [&](std::size_t begin, std::size_t end, const Take& take) { take(part.data() + begin, (end - begin) * sizeof(Value)); });
  }

  /// Takes bytes.
  using Take = std::function<void(const void*, std::size_t)>;
  /// The same, made piece by piece: piece(begin, end, take) gives the bytes of the values begin … end − 1 of this process.
  void putParts(std::size_t count, std::size_t bytes, const std::function<void(std::size_t, std::size_t, const Take&)>& piece);

  /// Throws, in the first process, what CheckpointWriter threw meanwhile, or throws now.
  void commit();

private:
  template <typename Work>
  void inFirst(Work&& work)
  {
    if (!this->Processes.isFirst() || this->Failure)
    {
      return;
    }
    // The others are on their way to the exchanges to come.
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

/// Reads what a SharedCheckpointWriter wrote, on another number of processes, too. The first process reads the file, and throws
/// what CheckpointReader throws.
class SharedCheckpointReader
{
public:
  SharedCheckpointReader(const std::string& path, std::uint64_t fingerprint, const Sharing& sharing);

  /// What the first process reads by read(file, put), as it is then in all.
  std::string fromFile(const std::function<void(CheckpointReader&, ByteWriter&)>& read);

  /// As many values as each process wants, by their places. Throws FileError, in the first process, unless they are all there
  /// are.
  template <typename Value>
  void getAll(std::vector<Value>& part, std::size_t count)
  {
    const std::vector<std::uint64_t> counts = this->countsOfAll(count, sizeof(Value));
    part.resize(count);
    this->getParts(counts, sizeof(Value), reinterpret_cast<char*>(part.data()));
  }

  /// Throws FileError, in the first process, unless it holds in all of them.
  void require(bool good) const;
  void finish() const;

private:
  std::vector<std::uint64_t> countsOfAll(std::size_t count, std::size_t bytes);
  void getParts(const std::vector<std::uint64_t>& counts, std::size_t bytes, char* values);

  const Sharing& Processes;
  std::optional<CheckpointReader> File;
};

} // namespace cactus
