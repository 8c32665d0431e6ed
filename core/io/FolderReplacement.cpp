// SPDX-License-Identifier: BSD-3-Clause
#include "io/FolderReplacement.h"

#include "base/Error.h"
#include "base/PartialName.h"
#include "base/Sha256.h"
#include "io/RunningPrograms.h"

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <fcntl.h>
#include <fstream>
#include <iterator>
#include <memory>
#include <sys/syscall.h>
#include <unistd.h>
#include <utility>

namespace cactus
{

namespace fs = std::filesystem;

namespace
{

constexpr char lockName[] = "lock";
constexpr char stagingName[] = "substrate";
constexpr char formerName[] = "former";
constexpr int attempts = 100;
constexpr mode_t permissionBits = 07777;
constexpr unsigned exchangeFlag = 2; // RENAME_EXCHANGE of <linux/fs.h>

[[noreturn]] void cannotWrite(const std::string& folder, const std::string& why)
{
  throw FileError("cannot write folder " + folder + ": " + why);
}

/// The path without links and dots, or nothing, with errno saying why.
std::string realPath(const fs::path& path)
{
  const std::unique_ptr<char, void (*)(void*)> real(::realpath(path.c_str(), nullptr), std::free);
  return real ? real.get() : "";
}

/// The place that a FolderName names: whole, without links and dots. Throws FileError where there cannot be a folder.
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
    cannotWrite(folder, systemMessage(errno));
  }
  if (folder.front() != '/' && realPath(".").empty())
  {
    cannotWrite(folder, "the folder that this program runs in is no more: give the whole path, from / on");
  }
  const fs::path place = followLinks(folder.substr(0, folder.find_last_not_of('/') + 1));
  const std::string name = place.filename().string();
  const std::string parent = realPath(folderOf(place));
  if (parent.empty() || name.empty() || name == "." || name == "..")
  {
    cannotWrite(folder, "the folder that it is to be in, " + folderOf(place).string() + ", is not there (" +
                          systemMessage(parent.empty() ? errno : ENOENT) + "): make it first");
  }
  return fs::path(parent) / name;
}

/// Throws for a folder that this process runs in, or that holds it: exchanged for another, it would be gone under its feet.
void requireElsewhere(const fs::path& place)
{
  const std::string here = realPath(".");
  const std::string within = place == "/" ? "/" : place.string() + "/";
  if (!here.empty() && (here + "/").compare(0, within.size(), within) == 0)
  {
    throw FileError("FolderName " + place.string() + " is " + (here == place ? "" : "above ") +
                    "the folder that this program runs in, and cannot be replaced: name a folder inside it");
  }
}

/// Throws where a program runs in the folder, such as a simulation that has yet to write its results into it.
void requireNobodyIn(const fs::path& place)
{
  const std::string program = programIn(place);
  if (!program.empty())
  {
    throw FileError("folder " + place.string() + " is there already and " + program +
                    " runs in it, whose results would be lost: end it (or leave the folder), or choose another FolderName");
  }
}

std::string lockText(const fs::path& place)
{
  return "CACTUS is writing a substrate folder here. Its name:\n" + place.filename().string();
}

/// What tells one file or folder of the disk from another; zeros for none.
std::pair<dev_t, ino_t> identityOf(const fs::path& path)
{
  struct stat status;
  return ::lstat(path.c_str(), &status) == 0 ? std::make_pair(status.st_dev, status.st_ino) : std::pair<dev_t, ino_t>();
}

bool isThere(const fs::path& path)
{
  struct stat status;
  return ::lstat(path.c_str(), &status) == 0;
}

/// Everything in an inspected folder, for a person who has to decide on it.
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

} // namespace

FolderReplacement::FolderReplacement(const std::string& folder, const Context& context)
{
  try
  {
    this->Place = placeOf(folder);
    this->recover();
    requireElsewhere(this->Place);
    context.report(0.0, "Comparing the folder that is there with its manifest");
    this->inspectPlace(context);
    this->makeContainer();
  }
  catch (const fs::filesystem_error& error)
  {
    cannotWrite(folder, error.what());
  }
}

FolderReplacement::~FolderReplacement()
{
  try
  {
    this->clean(this->Container, {});
  }
  catch (...)
  {
    // It is looked for at the next write.
  }
}

void FolderReplacement::fail(const std::string& why) const
{
  cannotWrite(this->Place.string(), why);
}

void FolderReplacement::inspectPlace(const Context& context)
{
  for (int attempt = 0; attempt < attempts; ++attempt)
  {
    const auto before = identityOf(this->Place);
    try
    {
      const FolderInspection found = inspectFolder(this->Place, context, this->Former);
      this->requireReplaceable(found);
      this->Former = found;
      break;
    }
    catch (const FileError&)
    {
      // While it was looked at, another writer may have put a new one there.
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

void FolderReplacement::requireReplaceable(const FolderInspection& found) const
{
  const auto refuse = [this](const std::string& why, const std::string& what)
  { throw FileError("folder " + this->Place.string() + " is there already and " + why + ": " + what); };
  const std::string another = "choose another FolderName";
  if (!found.exists && isThere(this->Place))
  {
    throw FileError("FolderName " + this->Place.string() + " is there already and not a folder: choose another one");
  }
  if (!found.exists || (found.empty && found.asWritten()))
  {
    return;
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
}

void FolderReplacement::makeContainer()
{
  for (int attempt = 0; attempt < attempts; ++attempt)
  {
    const fs::path container = folderOf(this->Place) / partialName(this->Place.filename().string());
    if (::mkdir(container.c_str(), 0700) != 0)
    {
      if (errno != EEXIST)
      {
        this->fail(systemMessage(errno));
      }
      continue;
    }
    this->Lock = Descriptor(::open((container / lockName).c_str(), O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0600));
    int error = this->Lock ? 0 : errno;
    if (error == ENOENT || (error == 0 && !lockForWriting(this->Lock.get()) && errno == EWOULDBLOCK))
    {
      continue; // another process has taken it for one that was left, and clears it away
    }
    const std::string text = lockText(this->Place);
    error = error == 0 ? writeAll(this->Lock.get(), text.data(), text.size()) : error;
    if (error == 0 && ::mkdir((container / stagingName).c_str(), 0777) != 0)
    {
      error = errno;
    }
    if (error == ENOENT)
    {
      continue;
    }
    this->Container = container;
    this->Staging = container / stagingName;
    if (error != 0)
    {
      this->clean(container, {});
      this->fail(systemMessage(error));
    }
    return;
  }
  this->fail("no temporary name is free");
}

void FolderReplacement::recover()
{
  for (const fs::path& container : partialsOf(folderOf(this->Place), this->Place.filename().string()))
  {
    struct stat status;
    if (::lstat(container.c_str(), &status) != 0 || !S_ISDIR(status.st_mode) || status.st_uid != ::geteuid())
    {
      continue;
    }
    const Descriptor lock(::open((container / lockName).c_str(), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
    if (!lock)
    {
      ::rmdir(container.c_str()); // succeeds for one that is empty: no more than a name
      continue;
    }
    if (!lockForWriting(lock.get()))
    {
      continue;
    }
    std::ifstream file(container / lockName, std::ios::binary);
    const std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    if (text == lockText(this->Place) && !isThere(this->Place) && isThere(container / formerName) &&
        std::rename((container / formerName).c_str(), this->Place.c_str()) == 0)
    {
      synchroniseFolder(folderOf(this->Place));
    }
    if (isStale(container, lock.get()))
    {
      this->clean(container, {});
    }
  }
}

void FolderReplacement::clean(const fs::path& container, const FolderInspection& earlier)
{
  if (container.empty())
  {
    return;
  }
  bool removed = true;
  for (const char* name : { stagingName, formerName })
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
      this->Leftovers.push_back("an earlier write has left " + folder.string() +
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

void FolderReplacement::makeFolder(const std::string& path)
{
  if (::mkdir((this->Staging / path).c_str(), 0777) != 0)
  {
    this->fail(path + ": " + systemMessage(errno));
  }
}

std::string FolderReplacement::write(const std::string& path, const std::string& text) const
{
  Descriptor file(::open((this->Staging / path).c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666));
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

std::string FolderReplacement::writeBy(const std::string& path, const std::function<void(const std::string&)>& writer) const
{
  const fs::path file = this->Staging / path;
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

void FolderReplacement::synchroniseAll() const
{
  // All of the file system in one go: a request for each of thousands of files takes longer.
  const Descriptor folder(::open(this->Staging.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (!folder || (::syncfs(folder.get()) != 0 && errno != ENOSYS))
  {
    this->fail(systemMessage(errno));
  }
}

/// As far as may be, what was there before gives its owner and its permissions to what takes its place. Where the group cannot be
/// kept, permissions are only taken away.
void FolderReplacement::makeAlike(const FolderInspection& former) const
{
  const struct stat& whole = former.folders.at("");
  const auto adapt = [&](const std::string& path)
  {
    const fs::path place = this->Staging / path;
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
  for (const auto& entry : fs::recursive_directory_iterator(this->Staging))
  {
    adapt(entry.path().lexically_relative(this->Staging).string());
  }
  adapt("");
}

/// Changes the staged folder for the one in the place; the latter goes to the container, to `former` where it takes two steps.
/// Whether there was one.
bool FolderReplacement::exchange(const fs::path& former) const
{
  if (::syscall(SYS_renameat2, AT_FDCWD, this->Staging.c_str(), AT_FDCWD, this->Place.c_str(), exchangeFlag) == 0)
  {
    return true;
  }
  if (errno != EINVAL && errno != ENOSYS && errno != ENOTSUP && errno != ENOENT)
  {
    this->fail(systemMessage(errno));
  }
  const bool replaces = std::rename(this->Place.c_str(), former.c_str()) == 0;
  int error = replaces || errno == ENOENT ? 0 : errno;
  if (error == 0 && std::rename(this->Staging.c_str(), this->Place.c_str()) != 0)
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
  const fs::path former = this->Container / formerName;
  const bool replaces = this->exchange(former);
  const bool inTwoSteps = replaces && !isThere(this->Staging);
  if (!replaces)
  {
    return;
  }
  try
  {
    const FolderInspection found = inspectFolder(inTwoSteps ? former : this->Staging, context, this->Former);
    this->requireReplaceable(found);
    this->Former = found;
  }
  catch (...)
  {
    // Somebody has changed it in the last moment: back with it.
    if (inTwoSteps)
    {
      std::rename(this->Place.c_str(), this->Staging.c_str());
      std::rename(former.c_str(), this->Place.c_str());
    }
    else
    {
      this->exchange(former);
    }
    throw;
  }
}

void FolderReplacement::commit(const Context& context)
{
  try
  {
    this->synchroniseAll();
    this->inspectPlace(context);
    if (this->Former.exists)
    {
      this->makeAlike(this->Former);
    }
    // From here to the end it takes no time, and it is too late to stop.
    Context unstoppable;
    unstoppable.threads = context.threads;
    this->replace(unstoppable);
    synchroniseFolder(this->Container);
    synchroniseFolder(folderOf(this->Place));
    this->clean(this->Container, this->Former);
    this->Container.clear();
  }
  catch (const fs::filesystem_error& error)
  {
    this->fail(error.what());
  }
}

} // namespace cactus
