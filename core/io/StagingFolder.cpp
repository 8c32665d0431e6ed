// SPDX-License-Identifier: BSD-3-Clause
#include "io/StagingFolder.h"

#include "base/Error.h"
#include "base/PartialName.h"
#include "base/Sha256.h"
#include "io/FolderPlace.h"

#include <cerrno>
#include <cstdio>
#include <fcntl.h>
#include <fstream>
#include <iterator>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace cactus
{

namespace fs = std::filesystem;

namespace
{

constexpr char lockName[] = "lock";
constexpr char substrateName[] = "substrate";
constexpr char formerName[] = "former";
constexpr int namesToTry = 100;

std::string lockText(const fs::path& place)
{
  return "CACTUS is writing a substrate folder here. Its name:\n" + place.filename().string();
}

} // namespace

StagingFolder::StagingFolder(const fs::path& place)
  : Place(place)
{
  for (int attempt = 0; attempt < namesToTry; ++attempt)
  {
    if (this->make())
    {
      return;
    }
  }
  this->fail("no temporary name is free");
}

StagingFolder::StagingFolder(fs::path place, fs::path container)
  : Place(std::move(place))
  , Container(std::move(container))
{
}

/// Returns whether it succeeded; if not, another name may. Throws FileError if none will.
bool StagingFolder::make()
{
  const fs::path container = folderOf(this->Place) / partialName(this->Place.filename().string());
  if (::mkdir(container.c_str(), 0700) != 0)
  {
    if (errno != EEXIST)
    {
      this->fail(systemMessage(errno));
    }
    return false;
  }
  this->Lock = Descriptor(::open((container / lockName).c_str(), O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0600));
  int error = this->Lock ? 0 : errno;
  if (error == ENOENT || (error == 0 && !lockForWriting(this->Lock.get()) && errno == EWOULDBLOCK))
  {
    return false; // another process has taken it for a leftover, and removes it
  }
  const std::string text = lockText(this->Place);
  error = error == 0 ? writeAll(this->Lock.get(), text.data(), text.size()) : error;
  if (error == 0 && ::mkdir((container / substrateName).c_str(), 0777) != 0)
  {
    error = errno;
  }
  if (error == ENOENT)
  {
    return false;
  }
  if (error != 0)
  {
    std::vector<std::string> leftovers;
    cleanStaging(container, {}, leftovers);
    this->fail(systemMessage(error));
  }
  this->Container = container;
  return true;
}

fs::path StagingFolder::substrate() const
{
  return this->Container / substrateName;
}

fs::path StagingFolder::former() const
{
  return this->Container / formerName;
}

void StagingFolder::fail(const std::string& why) const
{
  cannotWriteFolder(this->Place.string(), why);
}

void StagingFolder::makeFolder(const std::string& path) const
{
  if (::mkdir((this->substrate() / path).c_str(), 0777) != 0)
  {
    this->fail(path + ": " + systemMessage(errno));
  }
}

std::string StagingFolder::write(const std::string& path, const std::string& text) const
{
  Descriptor file(::open((this->substrate() / path).c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666));
  int error = file ? writeAll(file.get(), text.data(), text.size()) : errno;
  if (error == 0)
  {
    error = file.close();
  }
  if (error != 0)
  {
    this->fail(path + ": " + systemMessage(error));
  }
  return sha256(text);
}

std::string StagingFolder::writeBy(const std::string& path, const std::function<void(const std::string&)>& writer) const
{
  const fs::path file = this->substrate() / path;
  try
  {
    writer(file.string());
    return sha256OfFile(file);
  }
  catch (const FileError& error)
  {
    // The temporary folder means nothing to a user.
    std::string why = error.what();
    const std::size_t place = why.find(file.string());
    this->fail(place == std::string::npos ? why : why.replace(place, file.string().size(), path));
  }
}

void StagingFolder::synchronise() const
{
  // The whole file system at once: requests for thousands of single files take longer.
  const Descriptor folder(::open(this->substrate().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (!folder || (::syncfs(folder.get()) != 0 && errno != ENOSYS))
  {
    this->fail(systemMessage(errno));
  }
}

void cleanStaging(const fs::path& container, const FolderInspection& earlier, std::vector<std::string>& leftovers)
{
  bool removed = true;
  for (const char* name : { substrateName, formerName })
  {
    const fs::path folder = container / name;
    if (!isThere(folder))
    {
      continue;
    }
    const FolderInspection found = inspectFolder(folder, {}, earlier);
    if (!found.exists || !found.asWritten() || (found.isSubstrate && !found.isFinished) || !removeInspected(folder, found))
    {
      removed = false;
      const std::string held = contentsOf(found);
      leftovers.push_back("an earlier write has left " + folder.string() +
                          (held.empty() ? ", which cannot be removed" : ", which is kept, as it holds " + held) +
                          ": move what is needed, and remove " + container.string());
    }
  }
  if (removed)
  {
    ::unlink((container / lockName).c_str());
    ::rmdir(container.c_str());
  }
}

void recoverStaging(const fs::path& place, std::vector<std::string>& leftovers)
{
  for (const fs::path& container : partialsOf(folderOf(place), place.filename().string()))
  {
    struct stat status;
    if (::lstat(container.c_str(), &status) != 0 || !S_ISDIR(status.st_mode) || status.st_uid != ::geteuid())
    {
      continue;
    }
    const Descriptor lock(::open((container / lockName).c_str(), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
    if (!lock)
    {
      ::rmdir(container.c_str()); // succeeds if it is empty
      continue;
    }
    if (!lockForWriting(lock.get()))
    {
      continue;
    }
    std::ifstream file(container / lockName, std::ios::binary);
    const std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    if (text == lockText(place) && !isThere(place) && isThere(container / formerName) &&
        std::rename((container / formerName).c_str(), place.c_str()) == 0)
    {
      synchroniseFolder(folderOf(place));
    }
    if (isStale(container, lock.get()))
    {
      cleanStaging(container, {}, leftovers);
    }
  }
}

} // namespace cactus
