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
  if (replaces)
  {
    makeAlike(this->File.get(), former);
  }
  if (::ftruncate(this->File.get(), 0) != 0)
  {
    this->fail(systemMessage(errno));
  }
  this->Buffer = std::make_unique<DescriptorBuffer>(this->File.get());
  this->Stream = std::make_unique<std::ostream>(this->Buffer.get());
  this->Stream->imbue(std::locale::classic());
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
