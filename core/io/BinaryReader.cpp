// SPDX-License-Identifier: BSD-3-Clause
#include "io/BinaryReader.h"

#include "base/Error.h"

#include <utility>

namespace cactus
{

BinaryReader::BinaryReader(std::istream& stream, std::string name)
  : Stream(stream)
  , Name(std::move(name))
{
  stream.seekg(0, std::ios::end);
  const std::streamoff end = stream.tellg();
  stream.seekg(0, std::ios::beg);
  if (!stream || end < 0)
  {
    throw FileError("cannot read " + this->Name + ": it is a folder, or not a file that can be read from any place");
  }
  this->Size = static_cast<std::uint64_t>(end);
}

void BinaryReader::seek(std::uint64_t position)
{
  this->Stream.clear();
  this->Stream.seekg(static_cast<std::streamoff>(position), std::ios::beg);
  this->Position = position;
}

void BinaryReader::require(std::uint64_t count, std::uint64_t bytes, const std::string& what) const
{
  if (count > this->left() / bytes)
  {
    throw FileError(this->Name + " is truncated, or says wrongly how much it holds: " + what + " would take " +
                    std::to_string(count) + " times " + std::to_string(bytes) + " bytes from byte " +
                    std::to_string(this->Position) + " on, and " + std::to_string(this->left()) + " are left");
  }
}

void BinaryReader::bytes(char* to, std::uint64_t count, std::uint64_t size, const std::string& what)
{
  this->require(count, size, what);
  this->Stream.read(to, static_cast<std::streamsize>(count * size));
  if (!this->Stream)
  {
    throw FileError("cannot read " + this->Name + " after byte " + std::to_string(this->Position));
  }
  this->Position += count * size;
}

std::string BinaryReader::line(std::size_t longest)
{
  std::string text;
  while (true)
  {
    char c = 0;
    this->bytes(&c, 1, 1, "the header");
    if (c == '\n')
    {
      break;
    }
    if (text.size() == longest)
    {
      this->fail("its header has a line of more than " + std::to_string(longest) + " characters");
    }
    text += c;
  }
  if (!text.empty() && text.back() == '\r')
  {
    text.pop_back();
  }
  return text;
}

void BinaryReader::fail(const std::string& what) const
{
  throw FileError(this->Name + ": " + what);
}

} // namespace cactus
