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

AtomicFile::AtomicFile(const std::string& path)
  : Path(path)
  , Place(followLinks(path))
{
  if (!this->Place.has_filename())
  {
    this->fail(path.empty() ? "it has no name" : "this is the name of a folder");
  }
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
  this->Temporary = folderOf(this->Place) / partialName(this->Place.filename().string());
  // The replacement of a private file is private from the start.
  this->File = takePartial(this->Temporary, replaces ? 0600 : 0666, "cannot write " + path);
  if (!this->File)
  {
    this->fail(systemMessage(ENOENT));
  }
  this->Stream.imbue(std::locale::classic());
  this->Stream.open(this->Temporary, std::ios::binary);
  if (!this->Stream)
  {
    this->fail(systemMessage(errno));
  }
  if (replaces)
  {
    makeAlike(this->File.get(), former);
  }
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
  this->Stream.close();
  const bool isWhole = this->Stream.good();
  int error = 0;
  if (!isWhole && ::lseek(this->File.get(), 0, SEEK_END) >= 0)
  {
    error = writeAll(this->File.get(), "\n", 1); // for the reason, which a stream does not keep
  }
  if (error == 0)
  {
    error = synchronise(this->File.get());
  }
  if (error == 0 && !isWhole)
  {
    error = EIO;
  }
  if (error == 0 && std::rename(this->Temporary.c_str(), this->Place.c_str()) != 0)
  {
    error = errno;
  }
  this->Committed = error == 0;
  if (error == 0)
  {
    error = this->File.close();
  }
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
