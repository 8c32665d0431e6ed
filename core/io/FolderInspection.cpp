// SPDX-License-Identifier: BSD-3-Clause
#include "io/FolderInspection.h"

#include "base/Error.h"
#include "base/Parallel.h"
#include "base/PosixFile.h"
#include "io/SubstrateManifest.h"

#include <algorithm>
#include <cerrno>
#include <fcntl.h>
#include <fstream>
#include <iterator>
#include <optional>
#include <unistd.h>
#include <utility>

namespace cactus
{

namespace fs = std::filesystem;

namespace
{

/// Reads the manifest of a folder; returns nothing if there is none of ours.
std::optional<SubstrateManifest> manifestIn(const fs::path& folder)
{
  const fs::path path = folder / manifestName;
  if (!fs::is_regular_file(fs::symlink_status(path)))
  {
    return std::nullopt;
  }
  std::ifstream file(path, std::ios::binary);
  const std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  if (!file)
  {
    throw FileError("cannot read " + path.string() + ": " + systemMessage(errno));
  }
  return readManifest(text);
}

/// Sorts the entries of a folder into ours by their names, whose content is not compared yet, and others.
FolderInspection sortedEntries(const fs::path& folder, const std::optional<SubstrateManifest>& manifest)
{
  FolderInspection found;
  found.isSubstrate = manifest.has_value();
  WrittenFiles written = manifest ? manifest->written : WrittenFiles();
  if (manifest)
  {
    written.checksums[manifestName] = "";
  }
  const auto noteProtection = [&](const std::string& path)
  {
    if (::faccessat(AT_FDCWD, (folder / path).c_str(), W_OK, AT_EACCESS) != 0 && errno == EACCES)
    {
      found.writeProtected.push_back(path);
    }
  };
  noteProtection(".");
  for (fs::recursive_directory_iterator entry(folder), end; entry != end; ++entry)
  {
    const std::string path = entry->path().lexically_relative(folder).string();
    const fs::file_type type = entry->symlink_status().type();
    const bool isFolder = type == fs::file_type::directory;
    if (isFolder ? written.folders.count(path) > 0 : type == fs::file_type::regular && written.checksums.count(path) > 0)
    {
      (isFolder ? found.folders : found.files).push_back(path);
      noteProtection(path);
      continue;
    }
    found.added.push_back(isFolder ? path + '/' : path);
    entry.disable_recursion_pending();
  }
  for (auto* names : { &found.added, &found.writeProtected, &found.files, &found.folders })
  {
    std::sort(names->begin(), names->end());
  }
  return found;
}

/// Returns up to five names, and how many more there are.
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

} // namespace

FolderInspection inspectFolder(const fs::path& folder, const Context& context)
{
  try
  {
    const std::optional<SubstrateManifest> manifest = manifestIn(folder);
    FolderInspection found = sortedEntries(folder, manifest);
    const std::vector<std::string> ours = std::exchange(found.files, {});
    std::vector<char> isSame(ours.size(), 0);
    parallelFor(ours.size(), context,
      [&](std::size_t i)
      {
        isSame[i] = ours[i] == manifestName ? manifest->asWritten
                                            : sha256OfFile(folder / ours[i]) == manifest->written.checksums.at(ours[i]);
      });
    for (std::size_t i = 0; i < ours.size(); ++i)
    {
      (isSame[i] != 0 ? found.files : found.changed).push_back(ours[i]);
    }
    return found;
  }
  catch (const fs::filesystem_error& error)
  {
    throw FileError("cannot read " + error.path1().string() + ": " + error.code().message());
  }
}

FolderInspection inspectReplaceable(const fs::path& place, const fs::path& where, const Context& context)
{
  std::error_code error;
  const fs::file_type type = fs::symlink_status(where, error).type();
  if (type == fs::file_type::not_found)
  {
    return {};
  }
  if (type != fs::file_type::directory)
  {
    throw FileError("FolderName " + place.string() + " is there already and not a folder: choose another one");
  }
  FolderInspection found = inspectFolder(where, context);
  const std::string there = "folder " + place.string() + " is there already and ";
  if (!found.isSubstrate && !found.added.empty())
  {
    throw FileError(
      there + "is not a substrate folder (it has no manifest.json of ours with checksums): choose another FolderName");
  }
  if (!found.asWritten())
  {
    throw FileError(there + "holds " + contentsOf(found) +
                    ": choose another FolderName, or move these out of it or remove them if they are not needed");
  }
  return found;
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

bool removeInspected(const fs::path& folder, const FolderInspection& inspection)
{
  for (const std::string& file : inspection.files)
  {
    if (file != manifestName)
    {
      ::unlink((folder / file).c_str());
    }
  }
  // A folder comes after those in it.
  for (auto inner = inspection.folders.rbegin(); inner != inspection.folders.rend(); ++inner)
  {
    ::rmdir((folder / *inner).c_str());
  }
  ::unlink((folder / manifestName).c_str());
  return ::rmdir(folder.c_str()) == 0;
}

} // namespace cactus
