// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <ostream>
#include <streambuf>
#include <string>
#include <utility>
#include <vector>

namespace cactus
{

/// A file or folder that the system holds open for us; closed at the end of its life.
class Descriptor
{
public:
  explicit Descriptor(int number = -1)
    : Number(number)
  {
  }
  Descriptor(Descriptor&& other) noexcept
    : Number(std::exchange(other.Number, -1))
  {
  }
  Descriptor& operator=(Descriptor&& other) noexcept
  {
    std::swap(this->Number, other.Number);
    return *this;
  }
  ~Descriptor() { this->close(); }

  int get() const { return this->Number; }
  explicit operator bool() const { return this->Number >= 0; }
  /// Returns 0 or the error number: a network's file system may say only here that a write has failed.
  int close();

private:
  int Number;
};

/// What the system says of an error number (errno).
std::string systemMessage(int error);

/// Writes all of it, and returns 0 or the error number.
int writeAll(int descriptor, const char* data, std::size_t size);

/// Has the disk keep a file, or a folder's list of what is in it. Returns 0 or the error number; 0, too, on a file system that
/// knows no such thing.
int synchronise(int descriptor);
int synchroniseFolder(const std::filesystem::path& folder);

/// Where a path leads to once the links at its end are followed, whether or not something is there. Throws FileError where links
/// go round in circles.
std::filesystem::path followLinks(const std::filesystem::path& path);

/// The folder that a path is in; "." for a name alone.
std::filesystem::path folderOf(const std::filesystem::path& path);

/// Throws FileError for a pipe, which would have its reader wait for ever for somebody who writes; the message begins with
/// `name`.
void requireNoPipe(const std::string& name, const std::filesystem::path& path);

/// The SHA-256 checksum of a file, read piece by piece. Throws FileError.
std::string sha256OfFile(const std::filesystem::path& path);

/// What is written to a stream goes to a descriptor; the first error number is kept.
class DescriptorBuffer : public std::streambuf
{
public:
  explicit DescriptorBuffer(int descriptor);
  int error() const { return this->Error; }

protected:
  int_type overflow(int_type character) override;
  std::streamsize xsputn(const char* text, std::streamsize size) override;
  int sync() override;

private:
  bool flush();
  bool send(const char* data, std::size_t size);

  int Number;
  int Error = 0;
  std::vector<char> Buffer;
};

} // namespace cactus
