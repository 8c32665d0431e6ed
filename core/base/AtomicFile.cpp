// SPDX-License-Identifier: BSD-3-Clause
#include "base/AtomicFile.h"

#include "base/Error.h"
#include "base/PartialName.h"

#include <cerrno>
#include <cstdio>
#include <fcntl.h>
#include <locale>
#include <sys/stat.h>
#include <unistd.h>

namespace cactus
{

namespace fs = std::filesystem;

namespace
{

constexpr mode_t permissionBits = 07777;
constexpr int attempts = 100;

/// Removes leftovers of dead processes for the same file.
void removeStale(const fs::path& place)
{
  for (const fs::path& partial : partialsOf(folderOf(place), place.filename().string()))
  {
    const Descriptor file(::open(partial.c_str(), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
    struct stat status;
    if (file && ::fstat(file.get(), &status) == 0 && S_ISREG(status.st_mode) && status.st_uid == ::geteuid() &&
        status.st_nlink == 1 && lockForWriting(file.get()))
    {
      ::unlink(partial.c_str());
    }
  }
}

/// Gives a file the owner, if permitted, and the permissions of another. If the group cannot be kept, it gets no more permissions
/// than everybody has.
void makeAlike(int file, const struct stat& other)
{
  const bool sameGroup =
    ::fchown(file, other.st_uid, other.st_gid) == 0 || ::fchown(file, static_cast<uid_t>(-1), other.st_gid) == 0;
  const mode_t mode = other.st_mode & permissionBits;
  ::fchmod(file, sameGroup ? mode : (mode & ~mode_t(070)) | (mode & 07) << 3);
}

} // namespace

AtomicFile::AtomicFile(const std::string& path)
  : Path(path)
  , Place(followLinks(path))
{
  if (!this->Place.has_filename())
  {
    this->fail(path.empty() ? "it has no name" : "this is the name of a folder");
  }
  removeStale(this->Place);
  this->open();
  this->Buffer = std::make_unique<DescriptorBuffer>(this->File.get());
  this->Stream = std::make_unique<std::ostream>(this->Buffer.get());
  this->Stream->imbue(std::locale::classic());
}

void AtomicFile::open()
{
  struct stat former;
  const bool replaces = ::stat(this->Place.c_str(), &former) == 0;
  if (replaces && !S_ISREG(former.st_mode))
  {
    this->fail(S_ISDIR(former.st_mode) ? "it is a folder" : "it is a device or a pipe, and not a file");
  }
  if (replaces && ::faccessat(AT_FDCWD, this->Place.c_str(), W_OK, AT_EACCESS) != 0)
  {
    this->fail("it is write-protected (" + systemMessage(errno) + "): permit writing, or name another file");
  }
  // The replacement of a private file is private from the start.
  const mode_t mode = replaces ? 0600 : 0666;
  for (int attempt = 0; attempt < attempts; ++attempt)
  {
    this->Temporary = folderOf(this->Place) / partialName(this->Place.filename().string());
    this->File = Descriptor(::open(this->Temporary.c_str(), O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, mode));
    if (!this->File && errno != EEXIST)
    {
      this->fail(systemMessage(errno));
    }
    struct stat status;
    // Another process may have taken the file for a leftover before it was locked.
    if (this->File && (lockForWriting(this->File.get()) || errno != EWOULDBLOCK) && ::fstat(this->File.get(), &status) == 0 &&
        status.st_nlink == 1)
    {
      if (replaces)
      {
        makeAlike(this->File.get(), former);
      }
      return;
    }
  }
  this->fail("no temporary name is free");
}

AtomicFile::~AtomicFile()
{
  if (!this->Committed)
  {
    ::unlink(this->Temporary.c_str());
  }
}

void AtomicFile::commit()
{
  this->Stream->flush();
  int error = this->Buffer->error();
  if (error == 0)
  {
    error = this->Stream->good() ? synchronise(this->File.get()) : EIO;
  }
  if (error == 0 && std::rename(this->Temporary.c_str(), this->Place.c_str()) != 0)
  {
    error = errno;
  }
  if (error != 0)
  {
    this->fail(systemMessage(error));
  }
  this->Committed = true;
  error = this->File.close();
  if (error == 0)
  {
    error = synchroniseFolder(folderOf(this->Place));
  }
  if (error != 0)
  {
    this->fail(systemMessage(error));
  }
}

void AtomicFile::fail(const std::string& why) const
{
  throw FileError("cannot write " + this->Path + ": " + why);
}

} // namespace cactus
