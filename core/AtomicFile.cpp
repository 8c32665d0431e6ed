// SPDX-License-Identifier: BSD-3-Clause
#include "AtomicFile.h"

#include "Error.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <unistd.h>

namespace cactus
{

AtomicFile::AtomicFile(const std::string& path)
  : Path(path)
  , Temporary(path + ".partial-" + std::to_string(::getpid()))
  , Stream(this->Temporary)
{
  if (!this->Stream)
  {
    throw FileError("cannot write " + path + ": " + std::strerror(errno));
  }
}

AtomicFile::~AtomicFile()
{
  if (!this->Committed)
  {
    this->Stream.close();
    std::remove(this->Temporary.c_str());
  }
}

void AtomicFile::commit()
{
  this->Stream.close();
  if (!this->Stream || std::rename(this->Temporary.c_str(), this->Path.c_str()) != 0)
  {
    throw FileError("cannot write " + this->Path + ": " + std::strerror(errno));
  }
  this->Committed = true;
}

} // namespace cactus
