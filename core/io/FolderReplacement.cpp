// SPDX-License-Identifier: BSD-3-Clause
#include "io/FolderReplacement.h"

#include "base/Error.h"
#include "base/PartialName.h"
#include "base/PosixFile.h"
#include "io/FolderPlace.h"

#include <cerrno>
#include <cstdio>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>
#include <utility>

namespace cactus
{

namespace fs = std::filesystem;

namespace
{

constexpr int attempts = 100;
constexpr mode_t permissionBits = 07777;
constexpr unsigned exchangeFlag = 2; // RENAME_EXCHANGE of <linux/fs.h>

/// Returns the identity of a file or folder on the disk; zeros if there is none.
std::pair<dev_t, ino_t> identityOf(const fs::path& path)
{
  struct stat status;
  return ::lstat(path.c_str(), &status) == 0 ? std::make_pair(status.st_dev, status.st_ino) : std::pair<dev_t, ino_t>();
}

/// Gives a folder the owners and permissions of the one that it replaces, as far as possible. If the group cannot be kept,
/// permissions are only removed.
void makeAlike(const FolderInspection& former, const fs::path& folder)
{
  const struct stat& whole = former.folders.at("");
  const auto adapt = [&](const std::string& path)
  {
    const fs::path place = folder / path;
    struct stat status;
    if (::lstat(place.c_str(), &status) != 0)
    {
      return;
    }
    bool sameGroup = status.st_gid == whole.st_gid;
    if (!sameGroup || status.st_uid != whole.st_uid)
    {
      sameGroup = ::lchown(place.c_str(), whole.st_uid, whole.st_gid) == 0 ||
                  ::lchown(place.c_str(), static_cast<uid_t>(-1), whole.st_gid) == 0;
    }
    const auto& same = S_ISDIR(status.st_mode) ? former.folders : former.files;
    const auto before = same.find(path);
    if (before != same.end())
    {
      ::chmod(place.c_str(), before->second.st_mode & permissionBits & (sameGroup ? permissionBits : status.st_mode));
    }
  };
  for (const auto& entry : fs::recursive_directory_iterator(folder))
  {
    adapt(entry.path().lexically_relative(folder).string());
  }
  adapt("");
}

} // namespace

FolderReplacement::FolderReplacement(const std::string& folder, const Context& context)
{
  try
  {
    this->Place = placeOf(folder);
    recoverStaging(this->Place, this->Leftovers);
    requireMovable(this->Place);
    context.report(0.0, "Comparing the folder that is there with its manifest");
    this->inspectPlace(context);
    this->Staging.emplace(this->Place);
  }
  catch (const fs::filesystem_error& error)
  {
    cannotWriteFolder(folder, error.what());
  }
}

FolderReplacement::~FolderReplacement()
{
  try
  {
    if (this->Staging)
    {
      cleanStaging(this->Staging->container(), {}, this->Leftovers);
    }
  }
  catch (...)
  {
    // The next write finds it.
  }
}

void FolderReplacement::fail(const std::string& why) const
{
  cannotWriteFolder(this->Place.string(), why);
}

void FolderReplacement::inspectPlace(const Context& context)
{
  for (int attempt = 0; attempt < attempts; ++attempt)
  {
    const auto before = identityOf(this->Place);
    try
    {
      const FolderInspection found = inspectFolder(this->Place, context, this->Former);
      requireReplaceable(this->Place, found);
      this->Former = found;
      break;
    }
    catch (const FileError&)
    {
      // Meanwhile another writer may have put a new one there.
      if (before == identityOf(this->Place) || attempt + 1 == attempts)
      {
        throw;
      }
    }
  }
  if (this->Former.exists)
  {
    requireNobodyIn(this->Place);
  }
}

/// Exchanges the staged folder with the one in the place; the latter goes where the staged one was, or to former() if that takes
/// two steps. Returns whether there was one.
bool FolderReplacement::exchange() const
{
  const fs::path staged = this->Staging->substrate();
  const fs::path former = this->Staging->former();
  if (::syscall(SYS_renameat2, AT_FDCWD, staged.c_str(), AT_FDCWD, this->Place.c_str(), exchangeFlag) == 0)
  {
    return true;
  }
  if (errno != EINVAL && errno != ENOSYS && errno != ENOTSUP && errno != ENOENT)
  {
    this->fail(systemMessage(errno));
  }
  const bool replaces = std::rename(this->Place.c_str(), former.c_str()) == 0;
  int error = replaces || errno == ENOENT ? 0 : errno;
  if (error == 0 && std::rename(staged.c_str(), this->Place.c_str()) != 0)
  {
    error = errno;
    if (replaces)
    {
      std::rename(former.c_str(), this->Place.c_str());
    }
  }
  if (error != 0)
  {
    this->fail(systemMessage(error));
  }
  return replaces;
}

void FolderReplacement::replace(const Context& context)
{
  const fs::path staged = this->Staging->substrate();
  const fs::path former = this->Staging->former();
  const bool replaces = this->exchange();
  const bool inTwoSteps = replaces && !isThere(staged);
  if (!replaces)
  {
    return;
  }
  try
  {
    const FolderInspection found = inspectFolder(inTwoSteps ? former : staged, context, this->Former);
    requireReplaceable(this->Place, found);
    this->Former = found;
  }
  catch (...)
  {
    // It was changed at the last moment: undo the exchange.
    if (inTwoSteps)
    {
      std::rename(this->Place.c_str(), staged.c_str());
      std::rename(former.c_str(), this->Place.c_str());
    }
    else
    {
      this->exchange();
    }
    throw;
  }
}

void FolderReplacement::commit(const Context& context)
{
  try
  {
    this->Staging->synchronise();
    this->inspectPlace(context);
    if (this->Former.exists)
    {
      makeAlike(this->Former, this->Staging->substrate());
    }
    // The rest is quick and cannot be stopped.
    Context unstoppable;
    unstoppable.threads = context.threads;
    this->replace(unstoppable);
    synchroniseFolder(this->Staging->container());
    synchroniseFolder(folderOf(this->Place));
    cleanStaging(this->Staging->container(), this->Former, this->Leftovers);
    this->Staging.reset();
  }
  catch (const fs::filesystem_error& error)
  {
    this->fail(error.what());
  }
}

} // namespace cactus
