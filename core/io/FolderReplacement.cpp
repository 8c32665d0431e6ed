// SPDX-License-Identifier: BSD-3-Clause
#include "io/FolderReplacement.h"

#include "base/Error.h"
#include "base/PartialName.h"
#include "io/FolderPlace.h"

#include <cerrno>
#include <cstdio>
#include <fcntl.h>
#include <fstream>
#include <set>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace cactus
{

namespace fs = std::filesystem;

namespace
{

constexpr char formerName[] = "former";
constexpr int attempts = 100;
constexpr mode_t permissionBits = 07777;

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

/// Removes the files and folders in `under`, a folder in `folder`, that are listed, and adds the others to `kept`.
void removeListed(
  const fs::path& folder, const std::string& under, const std::set<std::string>& listed, std::vector<std::string>& kept)
{
  std::error_code error;
  for (fs::directory_iterator entry(folder / under, error), end; !error && entry != end; entry.increment(error))
  {
    const std::string path = under + entry->path().filename().string();
    const bool isFolder = entry->symlink_status().type() == fs::file_type::directory;
    if (listed.count(wholeName(path)) == 0)
    {
      kept.push_back(path);
    }
    else if (isFolder)
    {
      removeListed(folder, path + "/", listed, kept);
    }
    else
    {
      ::unlink(entry->path().c_str());
    }
  }
  ::rmdir((folder / under).c_str()); // succeeds if it is empty
}

} // namespace

FolderReplacement::FolderReplacement(fs::path place)
  : Place(std::move(place))
  , Container(this->Place.string() + ".partial")
{
  requireMovable(this->Place);
  this->hold();
}

FolderReplacement::FolderReplacement(const std::string& folder, const Context& context)
  : FolderReplacement(placeOf(folder))
{
  context.report(0.0, "Comparing the folder that is there with its manifest");
  this->Former = inspectReplaceable(this->Place, this->Place, context);
  if (::mkdir((this->Container / FolderWriter::substrateName).c_str(), 0777) != 0)
  {
    this->fail(systemMessage(errno));
  }
}

FolderReplacement::~FolderReplacement()
{
  try
  {
    if (this->List && !isThere(this->Container / formerName) && this->clean().empty())
    {
      this->release();
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

/// Makes the folder beside the place, or takes and empties one that a killed process has left.
void FolderReplacement::hold()
{
  for (int attempt = 0; attempt < attempts && !this->List; ++attempt)
  {
    const bool isNew = ::mkdir(this->Container.c_str(), 0700) == 0;
    if (!isNew && errno != EEXIST)
    {
      this->fail(systemMessage(errno));
    }
    const int flags = O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC | (isNew ? O_CREAT | O_EXCL : 0);
    Descriptor list(::open((this->Container / FolderWriter::listName).c_str(), flags, 0600));
    if (!list)
    {
      const int error = errno;
      ::rmdir(this->Container.c_str()); // succeeds if it is empty: its writer was killed, or has just finished
      if (isNew && error != ENOENT && error != EEXIST)
      {
        this->fail(systemMessage(error));
      }
      continue;
    }
    if (!lockForWriting(list.get()) && (!isNew || errno == EWOULDBLOCK))
    {
      this->fail(errno == EWOULDBLOCK
                   ? "another process is writing it at this moment: wait until it has ended, or choose another FolderName"
                   : "another process may be writing it, as " + this->Container.string() +
                       " is there and its file system knows no locks: remove that if none is");
    }
    struct stat status;
    if (::fstat(list.get(), &status) == 0 && status.st_nlink > 0) // otherwise its writer has just finished
    {
      this->List = std::move(list);
    }
  }
  const auto refuse = [&](const std::string& why) { this->fail(this->Container.string() + why); };
  if (!this->List)
  {
    refuse(", in which it would be written, is there already, and not ours: rename it, or choose another FolderName");
  }
  const fs::path former = this->Container / formerName;
  if (isThere(former) && !isThere(this->Place) && std::rename(former.c_str(), this->Place.c_str()) != 0)
  {
    refuse(" holds what was in its place, which cannot be put back: " + systemMessage(errno));
  }
  const std::string kept = this->clean();
  if (!kept.empty())
  {
    refuse(", which an earlier write has left, holds " + kept + ": move what is needed, and remove it");
  }
}

/// Removes the new and the former folder. Returns a list of what is kept because it is the user's.
std::string FolderReplacement::clean()
{
  std::set<std::string> listed;
  std::ifstream list(this->Container / FolderWriter::listName, std::ios::binary);
  for (std::string path; std::getline(list, path);)
  {
    listed.insert(path);
  }
  FolderInspection kept;
  removeListed(this->Container / FolderWriter::substrateName, "", listed, kept.added);
  const fs::path former = this->Container / formerName;
  const FolderInspection found = inspectFolder(former);
  if (!found.asWritten())
  {
    return contentsOf(found);
  }
  removeInspected(former, found);
  std::error_code error;
  for (fs::directory_iterator entry(this->Container, error), end; !error && entry != end; entry.increment(error))
  {
    const std::string name = entry->path().filename().string();
    if (name != FolderWriter::listName && (name != FolderWriter::substrateName || kept.added.empty()))
    {
      kept.added.push_back(name);
    }
  }
  return contentsOf(kept);
}

/// Moves the former folder out of its place, and the new one in; changes nothing if it throws.
void FolderReplacement::putInPlace(const Context& context)
{
  const fs::path former = this->Container / formerName;
  const bool replaces = std::rename(this->Place.c_str(), former.c_str()) == 0;
  if (!replaces && errno != ENOENT)
  {
    this->fail(systemMessage(errno));
  }
  try
  {
    this->Former = inspectReplaceable(this->Place, former, context, this->Former); // it may have been changed at the last moment
    if (std::rename((this->Container / FolderWriter::substrateName).c_str(), this->Place.c_str()) != 0)
    {
      this->fail(systemMessage(errno));
    }
  }
  catch (...)
  {
    if (replaces)
    {
      std::rename(former.c_str(), this->Place.c_str());
    }
    throw;
  }
}

void FolderReplacement::commit(const Context& context)
{
  try
  {
    // The whole file system at once: requests for thousands of single files take longer.
    if (::syncfs(this->List.get()) != 0 && errno != ENOSYS)
    {
      this->fail(systemMessage(errno));
    }
    this->Former = inspectReplaceable(this->Place, this->Place, context, this->Former);
    if (this->Former.exists)
    {
      makeAlike(this->Former, this->Container / FolderWriter::substrateName);
    }
    // The rest is quick and cannot be stopped.
    Context unstoppable;
    unstoppable.threads = context.threads;
    this->putInPlace(unstoppable);
    synchroniseFolder(this->Container);
    synchroniseFolder(folderOf(this->Place));
    if (!this->Former.exists || removeInspected(this->Container / formerName, this->Former))
    {
      this->release();
    }
    this->List.close();
  }
  catch (const fs::filesystem_error& error)
  {
    this->fail(error.what());
  }
}

/// Removes the folder beside the place, which is empty but for the list.
void FolderReplacement::release()
{
  ::unlink((this->Container / FolderWriter::listName).c_str());
  ::rmdir(this->Container.c_str());
  this->List.close();
}

} // namespace cactus
