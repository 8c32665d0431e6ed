// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/ByteOrder.h"

#include <cstdint>
#include <istream>
#include <string>

namespace cactus
{

/// Reads numbers of either byte order from a stream whose end is known, so that no count in it is believed before its bytes are
/// seen to be there. Throws FileError, "NAME is truncated: ...", where they are not.
class BinaryReader
{
public:
  /// `name` is what messages call the stream, which has to be one that can be sought in.
  BinaryReader(std::istream& stream, std::string name);

  std::uint64_t size() const { return this->Size; }
  std::uint64_t position() const { return this->Position; }
  std::uint64_t left() const { return this->Size - this->Position; }
  /// `position` has to lie within the stream.
  void seek(std::uint64_t position);

  /// Whether numbers have their bytes in the other order than this machine's.
  void setSwapped(bool swapped) { this->Swapped = swapped; }

  /// Throws unless `count` things of `bytes` each are still to come; `what` says what they are.
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

  /// The next line without its end, of at most `longest` characters; throws for a longer one.
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
