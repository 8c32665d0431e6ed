// SPDX-License-Identifier: BSD-3-Clause
#include "base/PartialName.h"

#include "base/Error.h"

#include <cerrno>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace cactus
{

namespace
{

constexpr char marker[] = ".cactus-partial";

} // namespace

std::string partialName(const std::string& name)
{
  return name + marker;
}

std::string wholeName(const std::string& candidate)
{
  return candidate.substr(0, candidate.rfind(marker));
}

bool lockForWriting(int descriptor)
{
  return ::flock(descriptor, LOCK_EX | LOCK_NB) == 0;
}

Descriptor takePartial(const std::filesystem::path& path, mode_t mode, const std::string& what)
{
  const std::string inUse =
    what + ": another process is writing it at this moment: wait until it has ended, or choose another name";
  const std::string notOurs =
    what + ": " + path.string() + ", in which it would be written, is there already, and not ours: rename it";
  constexpr int flags = O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC;
  Descriptor file(::open(path.c_str(), flags | O_CREAT | O_EXCL, mode));
  const bool isNew = bool(file);
  if (!isNew && errno == EEXIST)
  {
    file = Descriptor(::open(path.c_str(), flags));
    if (!file)
    {
      throw FileError(errno == ENOENT ? inUse : notOurs);
    }
  }
  if (!file && errno == ENOENT)
  {
    return file;
  }
  if (!file)
  {
    throw FileError(what + ": " + systemMessage(errno));
  }
  const bool isLocked = lockForWriting(file.get());
  if (!isLocked && errno != EWOULDBLOCK && !isNew)
  {
    throw FileError(what + ": another process may be writing it, as " + path.string() +
                    " is there and its file system knows no locks: remove that if none is");
  }
  struct stat held;
  struct stat there;
  // A writer that has just finished has renamed or removed the file.
  if ((!isLocked && errno == EWOULDBLOCK) || ::fstat(file.get(), &held) != 0 || ::lstat(path.c_str(), &there) != 0 ||
      held.st_ino != there.st_ino || held.st_dev != there.st_dev)
  {
    throw FileError(inUse);
  }
  if (!isNew && (!S_ISREG(held.st_mode) || held.st_uid != ::geteuid() || held.st_nlink != 1))
  {
    throw FileError(notOurs);
  }
  return file;
}

} // namespace cactus
