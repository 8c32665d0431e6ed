// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/ByteOrder.h"

#include <cstdint>
#include <istream>
#include <string>

namespace cactus
{

/// Reads numbers of either byte order from a stream of known length. A count in the stream is accepted only if its bytes exist;
/// throws FileError, "NAME is truncated: ...", if they do not.
class BinaryReader
{
public:
  /// `name` is the stream's name in messages; the stream has to be seekable.
  BinaryReader(std::istream& stream, std::string name);

  std::uint64_t size() const { return this->Size; }
  std::uint64_t position() const { return this->Position; }
  std::uint64_t left() const { return this->Size - this->Position; }
  /// Moves to `position`, which has to lie within the stream.
  void seek(std::uint64_t position);

  /// Sets whether numbers have the opposite byte order of this machine.
  void setSwapped(bool swapped) { this->Swapped = swapped; }

  /// Throws unless `count` elements of `bytes` each remain; `what` names them.
  void require(std::uint64_t count, std::uint64_t bytes, const std::string& what) const;

  template <typename Number>
  void numbers(Number* to, std::size_t count, const std::string& what)
  {
    this->bytes(reinterpret_cast<char*>(to), count, sizeof(Number), what);
    if (this->Swapped)
    {
      swapBytes(to, count);
    }
  }

  /// Reads the next line without its end, of at most `longest` characters; throws for a longer one.
  std::string line(std::size_t longest);

  [[noreturn]] void fail(const std::string& what) const;
  const std::string& name() const { return this->Name; }

private:
  void bytes(char* to, std::uint64_t count, std::uint64_t size, const std::string& what);

  std::istream& Stream;
  std::string Name;
  std::uint64_t Size = 0;
  std::uint64_t Position = 0;
  bool Swapped = false;
};

} // namespace cactus
