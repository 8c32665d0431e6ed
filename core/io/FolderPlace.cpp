// SPDX-License-Identifier: BSD-3-Clause
#include "io/FolderPlace.h"

#include "base/Error.h"
#include "base/PosixFile.h"

#include <cerrno>
#include <cstdlib>
#include <fcntl.h>
#include <memory>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <vector>

namespace cactus
{

namespace fs = std::filesystem;

namespace
{

/// Returns the path without links and dots, or an empty one with the reason in errno.
std::string realPath(const fs::path& path)
{
  const std::unique_ptr<char, void (*)(void*)> real(::realpath(path.c_str(), nullptr), std::free);
  return real ? real.get() : "";
}

/// Tells whether the place is a mount point, of a file system or of a part into which files cannot be renamed.
bool isMountPoint(const fs::path& place)
{
  struct statx folder;
  struct stat parent;
  return ::statx(AT_FDCWD, place.c_str(), AT_SYMLINK_NOFOLLOW | AT_NO_AUTOMOUNT, STATX_BASIC_STATS, &folder) == 0 &&
         ((folder.stx_attributes & STATX_ATTR_MOUNT_ROOT) != 0 ||
           (::stat(folderOf(place).c_str(), &parent) == 0 &&
             parent.st_dev != ::makedev(folder.stx_dev_major, folder.stx_dev_minor)));
}

} // namespace

void cannotWriteFolder(const std::string& folder, const std::string& why)
{
  throw FileError("cannot write folder " + folder + ": " + why);
}

bool isThere(const fs::path& path)
{
  struct stat status;
  return ::lstat(path.c_str(), &status) == 0;
}

fs::path placeOf(const std::string& folder)
{
  if (folder == "~" || folder.compare(0, 2, "~/") == 0)
  {
    throw FileError("FolderName " + folder + " begins with ~, which only a shell understands: write the whole path");
  }
  const std::string real = realPath(folder);
  if (!real.empty())
  {
    return real;
  }
  if (errno != ENOENT)
  {
    cannotWriteFolder(folder, systemMessage(errno));
  }
  if (folder.front() != '/' && realPath(".").empty())
  {
    cannotWriteFolder(folder, "the folder that this program runs in is no more: give the whole path, from / on");
  }
  const fs::path place = followLinks(folder.substr(0, folder.find_last_not_of('/') + 1));
  const std::string name = place.filename().string();
  const std::string parent = realPath(folderOf(place));
  if (parent.empty() || name.empty() || name == "." || name == "..")
  {
    cannotWriteFolder(folder, "the folder that it is to be in, " + folderOf(place).string() + ", is not there (" +
                                systemMessage(parent.empty() ? errno : ENOENT) + "): make it first");
  }
  return fs::path(parent) / name;
}

void requireMovable(const fs::path& place)
{
  const std::string here = realPath(".");
  const std::string within = place == "/" ? "/" : place.string() + "/";
  if (!here.empty() && (here + "/").compare(0, within.size(), within) == 0)
  {
    throw FileError("FolderName " + place.string() + " is " + (here == place ? "" : "above ") +
                    "the folder that this program runs in, and cannot be replaced: name a folder inside it");
  }
  if (isMountPoint(place))
  {
    throw FileError(
      "FolderName " + place.string() + " is where a file system is mounted, and cannot be replaced: name a folder inside it");
  }
}

std::string contentsOf(const FolderInspection& found)
{
  std::vector<std::string> results;
  std::vector<std::string> added;
  for (const std::string& path : found.added)
  {
    (path.compare(0, 12, "mcdc/output/") == 0 ? results : added).push_back(path);
  }
  std::string text;
  const auto say = [&](const char* what, const std::vector<std::string>& names)
  {
    if (!names.empty())
    {
      text += (text.empty() ? "" : "; ") + std::string(what) + " (" + listed(names) + ")";
    }
  };
  say("results of simulations", results);
  say("other data", added);
  say("files that were changed after they were written", found.changed);
  say("what is write-protected", found.writeProtected);
  return text;
}

FolderInspection inspectReplaceable(
  const fs::path& place, const fs::path& where, const Context& context, const FolderInspection& earlier)
{
  FolderInspection found = inspectFolder(where, context, earlier);
  const auto refuse = [&place](const std::string& why, const std::string& what)
  { throw FileError("folder " + place.string() + " is there already and " + why + ": " + what); };
  const std::string another = "choose another FolderName";
  if (!found.exists && isThere(where))
  {
    throw FileError("FolderName " + place.string() + " is there already and not a folder: choose another one");
  }
  if (!found.exists || (found.empty && found.asWritten()))
  {
    return found;
  }
  if (!found.empty && !found.isSubstrate)
  {
    refuse("is not a substrate folder (it has no manifest.json of ours)", another);
  }
  if (!found.empty && !found.isFinished)
  {
    refuse("was written by an early version of CACTUS, whose manifest does not tell what may have been changed or added since",
      another + ", or remove the folder if nothing in it is needed");
  }
  if (!found.asWritten())
  {
    refuse("holds " + contentsOf(found), another + ", or move these out of it or remove them if they are not needed");
  }
  return found;
}

} // namespace cactus
