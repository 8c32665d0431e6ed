// SPDX-License-Identifier: BSD-3-Clause
#include "io/FolderPlace.h"

#include "base/Error.h"
#include "base/PosixFile.h"

#include <fcntl.h>
#include <sys/stat.h>

namespace cactus
{

namespace fs = std::filesystem;

void cannotWriteFolder(const std::string& folder, const std::string& why)
{
  throw FileError("cannot write folder " + folder + ": " + why);
}

fs::path placeOf(const std::string& folder)
{
  if (folder == "~" || folder.compare(0, 2, "~/") == 0)
  {
    throw FileError("FolderName " + folder + " begins with ~, which only a shell understands: write the whole path");
  }
  std::error_code error;
  fs::path place = fs::canonical(folder, error);
  if (!error)
  {
    return place;
  }
  if (error != std::errc::no_such_file_or_directory)
  {
    cannotWriteFolder(folder, error.message());
  }
  if (fs::path(folder).is_relative() && fs::current_path(error).empty())
  {
    cannotWriteFolder(folder, "the folder that this program runs in is no more: give the whole path, from / on");
  }
  place = followLinks(folder.substr(0, folder.find_last_not_of('/') + 1));
  const fs::path name = place.filename();
  const fs::path parent = fs::canonical(folderOf(place), error);
  if (error || name.empty() || name == "." || name == "..")
  {
    cannotWriteFolder(folder, "the folder that it is to be in, " + folderOf(place).string() + ", is not there" +
                                (error ? " (" + error.message() + ")" : "") + ": make it first");
  }
  return parent / name;
}

void requireMovable(const fs::path& place)
{
  std::error_code error;
  const fs::path within = fs::current_path(error).lexically_relative(place); // empty if there is no current folder
  if (!within.empty() && *within.begin() != "..")
  {
    throw FileError("FolderName " + place.string() + " is " + (within == "." ? "" : "above ") +
                    "the folder that this program runs in, and cannot be replaced: name a folder inside it");
  }
  struct statx status;
  if (::statx(AT_FDCWD, place.c_str(), AT_SYMLINK_NOFOLLOW | AT_NO_AUTOMOUNT, STATX_BASIC_STATS, &status) == 0 &&
      (status.stx_attributes & STATX_ATTR_MOUNT_ROOT) != 0)
  {
    throw FileError(
      "FolderName " + place.string() + " is where a file system is mounted, and cannot be replaced: name a folder inside it");
  }
}

} // namespace cactus
