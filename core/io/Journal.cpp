// SPDX-License-Identifier: BSD-3-Clause
#include "io/Journal.h"

#include "base/Bytes.h"
#include "base/Error.h"
#include "base/Hash64.h"
#include "base/PartialName.h"
#include "io/NumberedName.h"

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <fcntl.h>
#include <fstream>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace cactus
{

namespace
{

[[noreturn]] void failToUse(const std::filesystem::path& path, const std::string& why)
{
  throw FileError("cannot use " + path.string() + ": " + why);
}

std::string contentOfJournal(const std::filesystem::path& path)
{
  std::ifstream file(path, std::ios::binary);
  std::string content;
  std::vector<char> piece(std::size_t(1) << 20);
  while (file.read(piece.data(), static_cast<std::streamsize>(piece.size())) || file.gcount() > 0)
  {
    content.append(piece.data(), static_cast<std::size_t>(file.gcount()));
  }
  if (!file.is_open() || file.bad())
  {
    failToUse(path, systemMessage(errno));
  }
  return content;
}

/// Returns a record as it is in a file, with its length and checksum.
std::string entryOf(const std::string& record)
{
  const std::string entry = bytesOf(record);
  return entry + bytesOf(hash64(entry.data(), entry.size()));
}

} // namespace

Journal::Journal(std::filesystem::path folder, std::string identity, const Sharing& sharing)
  : Folder(std::move(folder))
  , Identity(std::move(identity))
{
  // The first one's file is locked before any other process reads the folder, and nobody adds before all have read.
  if (sharing.isFirst())
  {
    this->open("journal");
  }
  sharing.exchange();
  if (!sharing.isFirst())
  {
    this->open("journal-" + numbered(std::size_t(sharing.place()), std::size_t(sharing.size())));
  }
  sharing.exchange();
  this->readAll([this](const std::string& name, const std::string& bytes) { this->Known[name] = bytes; });
  this->FoundSome = !this->Known.empty();
  sharing.exchange();
}

/// Opens the file of this process, or creates it.
void Journal::open(const std::string& name)
{
  this->Path = this->Folder / name;
  this->File = Descriptor(::open(this->Path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666));
  if (!this->File)
  {
    failToUse(this->Path, systemMessage(errno));
  }
  if (!lockForWriting(this->File.get()))
  {
    failToUse(this->Path, errno == EWOULDBLOCK ? "another process is at work with it"
                                               : "its file system knows no locks (" + systemMessage(errno) +
                                                   "): choose a folder on another one, or mount it with them (Lustre: -o flock)");
  }
  const std::size_t end = this->read(this->Path, [](const std::string&, const std::string&) {});
  if (::ftruncate(this->File.get(), static_cast<off_t>(end)) != 0 ||
      ::lseek(this->File.get(), static_cast<off_t>(end), SEEK_SET) < 0)
  {
    failToUse(this->Path, systemMessage(errno));
  }
  if (end == 0)
  {
    this->add(this->Identity);
  }
}

/// Calls visit() for the findings of a file, and returns the end of its last complete record. The first record is the identity.
std::size_t Journal::read(const std::filesystem::path& path, const Visit& visit) const
{
  const std::string content = contentOfJournal(path);
  std::size_t end = 0;
  try
  {
    for (ByteReader get(content); !get.isAtEnd(); end = get.at())
    {
      const auto record = get.get<std::string>();
      const std::uint64_t checksum = hash64(content.data() + end, get.at() - end);
      if (get.get<std::uint64_t>() != checksum)
      {
        break;
      }
      if (end == 0 && record != this->Identity)
      {
        throw InvalidInput(path.string() + " belongs to other fibres, parameters or another version of this program");
      }
      if (end > 0)
      {
        std::string name;
        std::string bytes;
        getAll(record, name, bytes);
        visit(name, bytes);
      }
    }
  }
  catch (const FileError&)
  {
    // The last record is half-written.
  }
  if (end == 0 && !content.empty())
  {
    failToUse(path, "it is no record of this version of the program, or damaged");
  }
  return end;
}

void Journal::readAll(const Visit& visit) const
{
  for (const std::filesystem::path& file : this->files())
  {
    this->read(file, visit);
  }
}

/// Returns the files of all processes that have ever worked here, sorted. Other files may lie beside them.
std::vector<std::filesystem::path> Journal::files() const
{
  std::vector<std::filesystem::path> found;
  std::error_code error;
  for (std::filesystem::directory_iterator entry(this->Folder, error), end; !error && entry != end; entry.increment(error))
  {
    const std::string name = entry->path().filename().string();
    const std::string prefix = "journal-";
    const bool isOfAnother = name.compare(0, prefix.size(), prefix) == 0 && name.size() > prefix.size() &&
                             name.find_first_not_of("0123456789", prefix.size()) == std::string::npos;
    if (name == "journal" || isOfAnother)
    {
      found.push_back(entry->path());
    }
  }
  if (error)
  {
    throw FileError("cannot read the folder " + this->Folder.string() + ": " + error.message());
  }
  std::sort(found.begin(), found.end());
  return found;
}

/// Appends a record. Thread-safe.
void Journal::add(const std::string& record)
{
  const std::string entry = entryOf(record);
  const std::lock_guard<std::mutex> lock(this->Mutex);
  if (const int error = writeAll(this->File.get(), entry.data(), entry.size()))
  {
    failToUse(this->Path, systemMessage(error));
  }
}

std::optional<std::string> Journal::take(const std::string& name)
{
  const auto found = this->Known.find(name);
  if (found == this->Known.end())
  {
    return std::nullopt;
  }
  std::string bytes = std::move(found->second);
  this->Known.erase(found);
  return bytes;
}

const std::string* Journal::find(const std::string& name) const
{
  const auto found = this->Known.find(name);
  return found != this->Known.end() ? &found->second : nullptr;
}

void Journal::keep(const std::string& name, const std::string& bytes)
{
  this->add(bytesOf(name, bytes));
}

bool Journal::holds(const std::string& beginning) const
{
  bool isHeld = false;
  this->readAll(
    [&](const std::string& name, const std::string&) { isHeld = isHeld || name.compare(0, beginning.size(), beginning) == 0; });
  return isHeld;
}

void Journal::clear()
{
  std::error_code ignored; // later readers report leftovers
  for (const std::filesystem::path& file : this->files())
  {
    if (file != this->Path)
    {
      std::filesystem::remove(file, ignored);
    }
  }
  std::filesystem::resize_file(this->Path, entryOf(this->Identity).size(), ignored);
}

void Journal::remove()
{
  this->clear();
  this->File = Descriptor();
  std::error_code ignored;
  std::filesystem::remove(this->Path, ignored);
}

} // namespace cactus
