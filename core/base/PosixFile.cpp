// SPDX-License-Identifier: BSD-3-Clause
#include "base/PosixFile.h"

#include "base/Error.h"
#include "base/Sha256.h"

#include <cerrno>
#include <fcntl.h>
#include <system_error>
#include <unistd.h>

namespace cactus
{

namespace fs = std::filesystem;

int Descriptor::close()
{
  const int number = std::exchange(this->Number, -1);
  // Linux closes the descriptor even if it was interrupted.
  return number < 0 || ::close(number) == 0 || errno == EINTR ? 0 : errno;
}

std::string systemMessage(int error)
{
  return std::generic_category().message(error);
}

int writeAll(int descriptor, const char* data, std::size_t size)
{
  while (size > 0)
  {
    const ssize_t written = ::write(descriptor, data, size);
    if (written < 0 && errno != EINTR)
    {
      return errno;
    }
    if (written > 0)
    {
      data += written;
      size -= static_cast<std::size_t>(written);
    }
  }
  return 0;
}

int synchronise(int descriptor)
{
  int failed = ::fsync(descriptor);
  while (failed != 0 && errno == EINTR)
  {
    failed = ::fsync(descriptor);
  }
  return failed == 0 || errno == EINVAL || errno == ENOTSUP || errno == ENOSYS ? 0 : errno;
}

int synchroniseFolder(const fs::path& folder)
{
  const Descriptor descriptor(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  // A folder that may be written but not listed cannot be opened; the content of its files is safe all the same.
  return descriptor ? synchronise(descriptor.get()) : 0;
}

fs::path followLinks(const fs::path& path)
{
  fs::path place = path;
  std::error_code error;
  for (int links = 0; fs::is_symlink(fs::symlink_status(place, error)); ++links)
  {
    const fs::path target = fs::read_symlink(place, error);
    if (error || links == 40)
    {
      throw FileError("cannot follow the link " + path.string() + ": " + (error ? error.message() : systemMessage(ELOOP)));
    }
    place = target.is_absolute() ? target : place.parent_path() / target;
  }
  return place;
}

fs::path folderOf(const fs::path& path)
{
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

void requireNoPipe(const std::string& name, const std::filesystem::path& path)
{
  std::error_code unknown;
  if (std::filesystem::is_fifo(path, unknown))
  {
    throw FileError(name + " is a pipe, and not a file");
  }
}

std::string sha256OfFile(const fs::path& path)
{
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
  Sha256 hash;
  std::vector<char> piece(std::size_t(1) << 18);
  ssize_t size = file ? 1 : -1;
  while (size > 0 || (size < 0 && file && errno == EINTR))
  {
    size = ::read(file.get(), piece.data(), piece.size());
    if (size > 0)
    {
      hash.add(piece.data(), static_cast<std::size_t>(size));
    }
  }
  if (size < 0)
  {
    throw FileError("cannot read " + path.string() + ": " + systemMessage(errno));
  }
  return hash.digest();
}

DescriptorBuffer::DescriptorBuffer(int descriptor)
  : Number(descriptor)
  , Buffer(std::size_t(1) << 16)
{
  this->setp(this->Buffer.data(), this->Buffer.data() + this->Buffer.size());
}

bool DescriptorBuffer::send(const char* data, std::size_t size)
{
  if (this->Error == 0)
  {
    this->Error = writeAll(this->Number, data, size);
  }
  return this->Error == 0;
}

bool DescriptorBuffer::flush()
{
  const bool sent = this->send(this->pbase(), static_cast<std::size_t>(this->pptr() - this->pbase()));
  this->setp(this->Buffer.data(), this->Buffer.data() + this->Buffer.size());
  return sent;
}

DescriptorBuffer::int_type DescriptorBuffer::overflow(int_type character)
{
  if (!this->flush())
  {
    return traits_type::eof();
  }
  if (!traits_type::eq_int_type(character, traits_type::eof()))
  {
    this->sputc(traits_type::to_char_type(character));
  }
  return traits_type::not_eof(character);
}

std::streamsize DescriptorBuffer::xsputn(const char* text, std::streamsize size)
{
  if (size < this->epptr() - this->pptr())
  {
    traits_type::copy(this->pptr(), text, static_cast<std::size_t>(size));
    this->pbump(static_cast<int>(size));
    return size;
  }
  return this->flush() && this->send(text, static_cast<std::size_t>(size)) ? size : 0;
}

int DescriptorBuffer::sync()
{
  return this->flush() ? 0 : -1;
}

} // namespace cactus
