// SPDX-License-Identifier: BSD-3-Clause
#include "base/Checkpoint.h"

#include "base/Error.h"

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <system_error>

namespace cactus
{

namespace
{

/// Every format starts with this; its number and a line feed follow.
const std::string title = "CACTUS checkpoint ";
const std::string version = "6\n";
/// Reads as another number if the byte order differs.
constexpr std::uint64_t byteOrder = 0x0102030405060708u;
constexpr std::size_t headerBytes = 24;
constexpr std::size_t checksumBytes = 8;

[[noreturn]] void refuse(const std::string& path, const std::string& why)
{
  throw FileError("CheckpointFile " + path + " " + why);
}

/// Tells whether there is a file. Throws FileError if there is something that is no file, or if it cannot be accessed.
bool isThere(const std::string& path)
{
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found)
  {
    return false;
  }
  if (error)
  {
    refuse(path, "cannot be read: " + error.message());
  }
  if (!std::filesystem::is_regular_file(status))
  {
    refuse(path, "is there already and not a file: name another one");
  }
  return true;
}

/// Reads title and header. Throws FileError.
CheckpointHeader readHeader(std::ifstream& file, const std::string& path)
{
  std::string found(title.size() + version.size(), '\0');
  std::uint64_t order = 0;
  CheckpointHeader header;
  file.read(&found[0], static_cast<std::streamsize>(found.size()));
  if (!file || found.compare(0, title.size(), title) != 0)
  {
    refuse(path, "is not a checkpoint of this program, and is kept: name another file, or remove it");
  }
  file.read(reinterpret_cast<char*>(&order), sizeof(order));
  if (found.substr(title.size()) != version || (file && order != byteOrder))
  {
    refuse(path,
      "was written by another version of this program or on another kind of machine, and is kept: go on with that, name "
      "another file, or remove it");
  }
  file.read(reinterpret_cast<char*>(&header.fingerprint), sizeof(header.fingerprint));
  file.read(reinterpret_cast<char*>(&header.iteration), sizeof(header.iteration));
  if (!file)
  {
    refuse(path, "is damaged: remove it, or name another file");
  }
  return header;
}

void requireSame(const CheckpointHeader& header, std::uint64_t fingerprint, const std::string& path)
{
  if (header.fingerprint != fingerprint)
  {
    throw InvalidInput("CheckpointFile " + path +
                       " was written for other fibres or other parameters, and is kept: restore those and switch Resume on, name "
                       "another file, or remove it");
  }
}

} // namespace

std::optional<CheckpointHeader> findCheckpoint(const std::string& path, std::uint64_t fingerprint)
{
  if (!isThere(path))
  {
    return std::nullopt;
  }
  return CheckpointReader(path, fingerprint).header();
}

CheckpointWriter::CheckpointWriter(const std::string& path, const CheckpointHeader& header)
  : Path(path)
  , Header(header)
  , File(path)
{
  this->write(title.data(), title.size());
  this->write(version.data(), version.size());
  this->put(byteOrder);
  this->put(header.fingerprint);
  this->put(header.iteration);
}

void CheckpointWriter::write(const void* data, std::size_t bytes)
{
  this->Sum.add(data, bytes);
  this->File.stream().write(static_cast<const char*>(data), static_cast<std::streamsize>(bytes));
}

void CheckpointWriter::commit()
{
  this->put(this->Sum.value());
  if (isThere(this->Path))
  {
    std::ifstream there(this->Path, std::ios::binary);
    requireSame(readHeader(there, this->Path), this->Header.fingerprint, this->Path);
  }
  this->File.commit();
}

CheckpointReader::CheckpointReader(const std::string& path, std::uint64_t fingerprint)
  : Path(path)
{
  if (!isThere(path))
  {
    refuse(path, "is not there");
  }
  this->File.open(path, std::ios::binary);
  if (!this->File)
  {
    refuse(path, "cannot be read: " + systemMessage(errno));
  }
  this->Header = readHeader(this->File, path);
  this->verify();
  requireSame(this->Header, fingerprint, path);
}

/// Compares the checksum and returns to the first value.
void CheckpointReader::verify()
{
  this->File.seekg(0, std::ios::end);
  const auto bytes = static_cast<std::uint64_t>(this->File.tellg());
  const std::uint64_t before = title.size() + version.size() + headerBytes;
  this->require(this->File && bytes >= before + checksumBytes);
  this->File.seekg(0);
  Hash64 sum;
  std::vector<char> part(static_cast<std::size_t>(std::min<std::uint64_t>(bytes, 1 << 20)));
  for (std::uint64_t left = bytes - checksumBytes; left > 0;)
  {
    const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(left, part.size()));
    this->File.read(part.data(), static_cast<std::streamsize>(count));
    this->require(this->File.good());
    sum.add(part.data(), count);
    left -= count;
  }
  std::uint64_t expected = 0;
  this->File.read(reinterpret_cast<char*>(&expected), sizeof(expected));
  this->require(this->File.good() && sum.value() == expected);
  this->Left = bytes - before - checksumBytes;
  this->File.seekg(static_cast<std::streamoff>(before));
}

void CheckpointReader::read(void* data, std::size_t bytes)
{
  this->require(bytes <= this->Left);
  this->Left -= bytes;
  this->File.read(static_cast<char*>(data), static_cast<std::streamsize>(bytes));
  this->require(this->File.good());
}

void CheckpointReader::damaged() const
{
  refuse(this->Path, "is damaged: remove it, or name another file");
}

} // namespace cactus
