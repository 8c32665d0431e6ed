// SPDX-License-Identifier: BSD-3-Clause
#include "io/FolderInspection.h"

#include "base/Error.h"
#include "base/Parallel.h"
#include "base/PosixFile.h"

#include <algorithm>
#include <cerrno>
#include <ctime>
#include <fcntl.h>
#include <fstream>
#include <iterator>
#include <string>
#include <unistd.h>

namespace cactus
{

namespace fs = std::filesystem;

namespace
{

constexpr std::uintmax_t largestManifest = std::uintmax_t(1) << 29; ///< bytes; about 110 for a file

bool sameTime(const timespec& a, const timespec& b)
{
  return a.tv_sec == b.tv_sec && a.tv_nsec == b.tv_nsec;
}

/// Tells whether a file on the disk is unchanged.
bool untouched(const struct stat& a, const struct stat& b)
{
  return a.st_dev == b.st_dev && a.st_ino == b.st_ino && a.st_size == b.st_size && sameTime(a.st_mtim, b.st_mtim) &&
         sameTime(a.st_ctim, b.st_ctim);
}

std::size_t entryCount(const fs::path& folder)
{
  std::size_t count = 0;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
  {
    ++count;
  }
  return count;
}

class Inspector
{
public:
  Inspector(const fs::path& folder, const FolderInspection& earlier)
    : Folder(folder)
    , Earlier(earlier)
  {
    this->Found.started = std::time(nullptr);
  }

  FolderInspection inspect(const Context& context)
  {
    struct stat status;
    if (::lstat(this->Folder.c_str(), &status) != 0 || !S_ISDIR(status.st_mode))
    {
      return this->Found;
    }
    this->Found.exists = true;
    this->Found.folders[""] = status;
    this->noteProtection("");
    this->readManifestOfFolder();
    if (this->Found.isSubstrate && !this->Found.isFinished)
    {
      return this->Found; // an early version's, of which it is unknown what is ours
    }
    this->walk("");
    this->compare(context);
    this->Found.empty = this->Found.folders.size() == 1 && this->Found.added.empty() && this->Found.files.empty();
    for (auto* names : { &this->Found.added, &this->Found.changed, &this->Found.writeProtected })
    {
      std::sort(names->begin(), names->end());
    }
    return this->Found;
  }

private:
  [[noreturn]] void fail(const std::string& path, const std::string& why) const
  {
    throw FileError("cannot read " + (this->Folder / path).string() + ": " + why);
  }

  void noteProtection(const std::string& path)
  {
    if (::faccessat(AT_FDCWD, (this->Folder / path).c_str(), W_OK, AT_EACCESS) != 0 && errno == EACCES)
    {
      this->Found.writeProtected.push_back(path.empty() ? "." : path);
    }
  }

  void readManifestOfFolder()
  {
    const fs::path path = this->Folder / manifestName;
    std::error_code error;
    if (!fs::is_regular_file(fs::symlink_status(path, error)) || fs::file_size(path, error) > largestManifest)
    {
      return;
    }
    std::ifstream file(path, std::ios::binary);
    const std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    if (!file)
    {
      this->fail(manifestName, systemMessage(errno));
    }
    if (const auto manifest = readManifest(text))
    {
      this->Manifest = *manifest;
      this->Found.isSubstrate = true;
      this->Found.isFinished = manifest->hasChecksums;
    }
  }

  void walk(const std::string& under)
  {
    std::error_code error;
    fs::directory_iterator entry(this->Folder / under, error);
    for (; !error && entry != fs::directory_iterator(); entry.increment(error))
    {
      const std::string name = entry->path().filename().string();
      this->visit(under.empty() ? name : under + "/" + name);
    }
    if (error)
    {
      this->fail(under, error.message());
    }
  }

  void visit(const std::string& path)
  {
    struct stat status;
    if (::lstat((this->Folder / path).c_str(), &status) != 0)
    {
      this->fail(path, systemMessage(errno));
    }
    if (S_ISDIR(status.st_mode))
    {
      if (this->Manifest.written.folders.count(path) == 0)
      {
        this->Found.added.push_back(path + "/");
        return;
      }
      this->Found.folders[path] = status;
      this->noteProtection(path);
      this->walk(path);
      return;
    }
    const bool ours = path == manifestName || this->Manifest.written.checksums.count(path) > 0;
    if (!S_ISREG(status.st_mode) || !ours)
    {
      this->Found.added.push_back(path);
      return;
    }
    this->noteProtection(path);
    this->Found.files[path] = status;
  }

  /// Reads the files that the manifest lists, and moves changed ones to `changed`.
  void compare(const Context& context)
  {
    if (!this->Found.isFinished)
    {
      return;
    }
    std::vector<std::string> paths;
    for (const auto& file : this->Found.files)
    {
      const auto former = this->Earlier.files.find(file.first);
      // A change within the clock tick in which a file was read would not be detected.
      const bool known = former != this->Earlier.files.end() && untouched(former->second, file.second) &&
                         file.second.st_ctim.tv_sec + 2 < this->Earlier.started;
      if (!known && file.first != manifestName)
      {
        paths.push_back(file.first);
      }
    }
    std::vector<char> same(paths.size(), 0);
    parallelFor(paths.size(), context,
      [&](std::size_t i) { same[i] = sha256OfFile(this->Folder / paths[i]) == this->Manifest.written.checksums.at(paths[i]); });
    for (std::size_t i = 0; i < paths.size(); ++i)
    {
      if (same[i] == 0)
      {
        this->markChanged(paths[i]);
      }
    }
    if (!this->Manifest.asWritten)
    {
      this->markChanged(manifestName);
    }
  }

  void markChanged(const std::string& path)
  {
    this->Found.changed.push_back(path);
    this->Found.files.erase(path);
  }

  const fs::path Folder;
  const FolderInspection& Earlier;
  SubstrateManifest Manifest;
  FolderInspection Found;
};

} // namespace

FolderInspection inspectFolder(const fs::path& folder, const Context& context, const FolderInspection& earlier)
{
  return Inspector(folder, earlier).inspect(context);
}

bool removeInspected(const fs::path& folder, const FolderInspection& inspection)
{
  const auto remove = [&](const std::string& path, const struct stat& as)
  {
    struct stat now;
    const fs::path file = folder / path;
    if (::lstat(file.c_str(), &now) == 0 && untouched(now, as))
    {
      ::unlink(file.c_str());
    }
  };
  for (const auto& file : inspection.files)
  {
    if (file.first != manifestName)
    {
      remove(file.first, file.second);
    }
  }
  // In reverse order a folder comes after its content; the outermost, "", is the last.
  for (auto inner = inspection.folders.rbegin(); inner != inspection.folders.rend(); ++inner)
  {
    const auto manifest = inspection.files.find(manifestName);
    if (inner->first.empty() && manifest != inspection.files.end() && entryCount(folder) == 1)
    {
      remove(manifestName, manifest->second);
    }
    ::rmdir((folder / inner->first).c_str());
  }
  struct stat left;
  return ::lstat(folder.c_str(), &left) != 0 && errno == ENOENT;
}

std::string listed(const std::vector<std::string>& names)
{
  constexpr std::size_t shown = 5;
  std::string text;
  for (std::size_t i = 0; i < std::min(shown, names.size()); ++i)
  {
    text += (i > 0 ? ", " : "") + names[i];
  }
  return names.size() > shown ? text + " and " + std::to_string(names.size() - shown) + " more" : text;
}

} // namespace cactus
