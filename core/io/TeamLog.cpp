// SPDX-License-Identifier: BSD-3-Clause
#include "io/TeamLog.h"

#include "base/Error.h"
#include "io/NumberedName.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <system_error>
#include <utility>

namespace cactus
{

TeamLog::TeamLog(std::filesystem::path folder, std::string name, std::string identity, const Sharing& sharing)
  : Folder(std::move(folder))
  , Name(std::move(name))
  , Identity(std::move(identity))
{
  // The first one's file is locked before any other process reads the folder, and nobody adds before all have read.
  const std::filesystem::path own =
    this->Folder /
    (this->Name + (sharing.isFirst() ? "" : '-' + numbered(std::size_t(sharing.place()), std::size_t(sharing.size()))));
  if (sharing.isFirst())
  {
    this->Own.emplace(own.string(), this->Identity);
  }
  sharing.exchange();
  if (!sharing.isFirst())
  {
    this->Own.emplace(own.string(), this->Identity);
  }
  sharing.exchange();
  for (const std::filesystem::path& file : this->files())
  {
    std::vector<std::string> records =
      file == own ? this->Own->takeRecords() : RecordLog::recordsOf(file.string(), this->Identity);
    this->Found.insert(this->Found.end(), std::make_move_iterator(records.begin()), std::make_move_iterator(records.end()));
  }
  sharing.exchange();
}

std::vector<std::string> TeamLog::takeRecords()
{
  return std::exchange(this->Found, {});
}

/// Returns the files of all processes that have ever worked here, sorted. Other files may lie beside them.
std::vector<std::filesystem::path> TeamLog::files() const
{
  std::vector<std::filesystem::path> found;
  std::error_code error;
  for (std::filesystem::directory_iterator entry(this->Folder, error), end; !error && entry != end; entry.increment(error))
  {
    const std::string name = entry->path().filename().string();
    const std::string prefix = this->Name + '-';
    const bool isOfAnother = name.compare(0, prefix.size(), prefix) == 0 && name.size() > prefix.size() &&
                             name.find_first_not_of("0123456789", prefix.size()) == std::string::npos;
    if (name == this->Name || isOfAnother)
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

bool TeamLog::isEmpty() const
{
  const std::vector<std::filesystem::path> all = this->files();
  return std::all_of(all.begin(), all.end(),
    [this](const std::filesystem::path& file) { return RecordLog::recordsOf(file.string(), this->Identity).empty(); });
}

void TeamLog::remove()
{
  this->Own.reset();
  std::error_code ignored; // later readers report leftovers
  for (const std::filesystem::path& file : this->files())
  {
    std::filesystem::remove(file, ignored);
  }
}

} // namespace cactus
