// SPDX-License-Identifier: BSD-3-Clause
// The state of a work in a file. Processes that share the work write one file, the same as one process would, and any number of
// them can go on from it. The first one has the file and throws its errors: FileError, and InvalidInput for the checkpoint of
// another work. It holds one array of all processes while it writes, and the whole file while it reads. All calls are collective.
//
// Layout, in the byte order of this machine: a title with the number of the format, a mark for the byte order, the fingerprint of
// the work and its options, the values, and the Hash64 of all of these.
#pragma once

#include "base/AtomicFile.h"
#include "base/Bytes.h"
#include "base/Error.h"
#include "base/Hash64.h"
#include "base/Sharing.h"

#include <cstdint>
#include <exception>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace cactus
{

/// Writes a checkpoint, whole or not at all (see AtomicFile).
class CheckpointWriter
{
public:
  CheckpointWriter(const std::string& path, std::uint64_t fingerprint, const Sharing& sharing);

  /// Writes values that are the same in all processes.
  template <typename... Values>
  void operator()(const Values&... values)
  {
    this->write(bytesOf(values...));
  }
  /// Writes the values of all processes as one array, in the order of their ranks. They consist of numbers only, without padding.
  template <typename Value>
  void parts(const std::vector<Value>& own)
  {
    ByteWriter put;
    put.addAll(own.data(), own.size());
    this->writeParts(std::move(put.bytes()));
  }
  /// Throws if something could not be written, or if meanwhile another work's checkpoint, or something else, is at the path.
  void commit();

private:
  void write(const std::string& bytes);
  void writeParts(std::string own);

  std::string Path;
  std::string Front;
  const Sharing& Processes;
  std::optional<AtomicFile> File; ///< in the first process
  std::exception_ptr Failure;     ///< why there is none; thrown by commit(), since the others still make their exchanges
  Hash64 Sum;
};

/// Reads what a CheckpointWriter wrote, in the same order.
class CheckpointReader
{
public:
  /// Reads and checks the whole file. Throws if it cannot be read, is no checkpoint, of another format or another work, or
  /// damaged: such a file does not belong to this work and must not be replaced.
  CheckpointReader(const std::string& path, std::uint64_t fingerprint, const Sharing& sharing);
  CheckpointReader(const CheckpointReader&) = delete;
  CheckpointReader& operator=(const CheckpointReader&) = delete;

  /// Tells whether there is a file.
  bool found() const { return this->Found; }

  template <typename... Values>
  void operator()(Values&... values)
  {
    if (this->Processes.isFirst())
    {
      (this->Get(values), ...);
    }
    getAll(this->Processes.fromFirst(bytesOf(values...)), values...);
  }
  /// Fills this process's part of an array.
  template <typename Value>
  void parts(std::vector<Value>& own)
  {
    const std::string bytes = this->ownPart(own.size() * sizeof(Value));
    ByteReader(bytes).getAll(own.data(), own.size());
  }
  /// Throws FileError unless `good`: such values cannot have been written.
  void require(bool good) const;
  /// Throws FileError unless everything has been read.
  void finish() const { this->require(this->Get.isAtEnd()); }

private:
  std::string ownPart(std::uint64_t size);

  std::string Path;
  const Sharing& Processes;
  std::string Content; ///< what follows the front, in the first process
  ByteReader Get;
  bool Found;
};

} // namespace cactus
