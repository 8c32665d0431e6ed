// SPDX-License-Identifier: BSD-3-Clause
#include "io/FolderReplacement.h"

#include "base/Error.h"
#include "base/PartialName.h"
#include "io/FolderInspection.h"
#include "io/FolderPlace.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <fcntl.h>
#include <fstream>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>
#include <vector>

namespace cactus
{

namespace fs = std::filesystem;

namespace
{

constexpr char formerName[] = "former";

bool isThere(const fs::path& path)
{
  std::error_code error;
  return fs::exists(fs::symlink_status(path, error));
}

/// Gives everything in a folder the owner and permissions of what it replaces, as far as possible; what is new gets the folder's
/// owner.
void makeFolderAlike(const fs::path& former, const fs::path& folder)
{
  struct stat whole;
  if (::lstat(former.c_str(), &whole) != 0)
  {
    return;
  }
  const auto adapt = [&](const fs::path& path)
  {
    const Descriptor file(::open((folder / path).c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC));
    struct stat status;
    struct stat before;
    if (!file || ::fstat(file.get(), &status) != 0)
    {
      return;
    }
    if (::lstat((former / path).c_str(), &before) != 0 || (before.st_mode & S_IFMT) != (status.st_mode & S_IFMT))
    {
      before = whole;
      before.st_mode = status.st_mode;
    }
    makeAlike(file.get(), before);
  };
  std::error_code error;
  for (fs::recursive_directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
  {
    adapt(entry->path().lexically_relative(folder));
  }
  adapt(".");
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
  inspectReplaceable(this->Place, this->Place, context);
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
  if (::mkdir(this->Container.c_str(), 0700) != 0 && errno != EEXIST)
  {
    this->fail(systemMessage(errno));
  }
  const auto refuse = [&](const std::string& why) { this->fail(this->Container.string() + why); };
  const auto isList = [](const fs::directory_entry& entry) { return entry.path().filename() == FolderWriter::listName; };
  std::error_code error;
  const fs::directory_iterator first(this->Container, error);
  const bool isOurs = !error && (first == fs::directory_iterator() || std::any_of(first, fs::directory_iterator(), isList));
  if (!isOurs && error != std::errc::no_such_file_or_directory)
  {
    refuse(", in which it would be written, is there already, and not ours: rename it, or choose another FolderName");
  }
  this->List = takePartial(this->Container / FolderWriter::listName, 0600, "cannot write folder " + this->Place.string());
  if (!this->List) // its writer has just finished
  {
    this->fail("another process is writing it at this moment: wait until it has ended, or choose another FolderName");
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
  std::vector<std::string> listed{ "" };
  std::ifstream list(this->Container / FolderWriter::listName, std::ios::binary);
  for (std::string path; std::getline(list, path);)
  {
    listed.push_back(path);
  }
  // What is in a folder is listed after it.
  for (auto path = listed.rbegin(); path != listed.rend(); ++path)
  {
    const fs::path place = this->Container / FolderWriter::substrateName / *path;
    std::remove(place.c_str());
    std::remove(partialName(place.string()).c_str());
  }
  const fs::path former = this->Container / formerName;
  if (isThere(former))
  {
    const FolderInspection found = inspectFolder(former);
    if (!found.asWritten())
    {
      return contentsOf(found);
    }
    removeInspected(former, found);
  }
  FolderInspection kept;
  std::error_code error;
  for (fs::recursive_directory_iterator entry(this->Container, error), end; !error && entry != end; entry.increment(error))
  {
    const std::string path = entry->path().lexically_relative(this->Container).string();
    const bool isOuter = entry->symlink_status().type() == fs::file_type::directory && !fs::is_empty(entry->path());
    if (path != FolderWriter::listName && !isOuter)
    {
      kept.added.push_back(path);
    }
  }
  return contentsOf(kept);
}

void FolderReplacement::commit(const Context& context)
{
  // The whole file system at once: requests for thousands of single files take longer.
  if (::syncfs(this->List.get()) != 0 && errno != ENOSYS)
  {
    this->fail(systemMessage(errno));
  }
  const fs::path substrate = this->Container / FolderWriter::substrateName;
  const fs::path former = this->Container / formerName;
  makeFolderAlike(this->Place, substrate);
  const bool replaces = std::rename(this->Place.c_str(), former.c_str()) == 0;
  if (!replaces && errno != ENOENT)
  {
    this->fail(systemMessage(errno));
  }
  if (std::rename(substrate.c_str(), this->Place.c_str()) != 0)
  {
    const int error = errno;
    std::rename(former.c_str(), this->Place.c_str());
    this->fail(systemMessage(error));
  }
  synchroniseFolder(this->Container);
  synchroniseFolder(folderOf(this->Place));
  FolderInspection found;
  if (replaces)
  {
    try
    {
      found = inspectReplaceable(this->Place, former, context.part(1.0, 1.0));
    }
    catch (...)
    {
      // It has been changed meanwhile, or the user has asked to stop.
      std::rename(this->Place.c_str(), substrate.c_str());
      std::rename(former.c_str(), this->Place.c_str());
      throw;
    }
  }
  if (!replaces || removeInspected(former, found))
  {
    this->release();
  }
  this->List.close();
}

/// Removes the folder beside the place, which is empty but for the list.
void FolderReplacement::release()
{
  ::unlink((this->Container / FolderWriter::listName).c_str());
  ::rmdir(this->Container.c_str());
}

} // namespace cactus
