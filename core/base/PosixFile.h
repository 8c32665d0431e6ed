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

/// A file descriptor that is closed at the end of its life.
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
  /// Returns 0 or the error number: a network file system may report a failed write only here.
  int close();

private:
  int Number;
};

/// Returns the system's message for an error number (errno).
std::string systemMessage(int error);

/// Writes all bytes, and returns 0 or the error number.
int writeAll(int descriptor, const char* data, std::size_t size);

/// Flushes a file, or a folder's list of entries, to the disk. Returns 0 or the error number; also 0 on a file system that cannot
/// do so.
int synchronise(int descriptor);
int synchroniseFolder(const std::filesystem::path& folder);

/// Returns the path with the links at its end followed, whether or not something is there. Throws FileError if links form a
/// circle.
std::filesystem::path followLinks(const std::filesystem::path& path);

/// Returns the folder of a path; "." for a name alone.
std::filesystem::path folderOf(const std::filesystem::path& path);

/// Throws FileError for a pipe, on which a reader would wait for ever for a writer; the message begins with `name`.
void requireNoPipe(const std::string& name, const std::filesystem::path& path);

/// The SHA-256 checksum of a file, read piece by piece. Throws FileError.
std::string sha256OfFile(const std::filesystem::path& path);

/// A stream buffer that writes to a descriptor; it keeps the first error number.
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
