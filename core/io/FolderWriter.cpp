// SPDX-License-Identifier: BSD-3-Clause
#include "io/FolderWriter.h"

#include "base/Error.h"
#include "base/PosixFile.h"
#include "base/Sha256.h"
#include "io/FolderPlace.h"

#include <cerrno>
#include <fcntl.h>
#include <sys/stat.h>
#include <utility>

namespace cactus
{

namespace fs = std::filesystem;

namespace
{

/// Opens a file, writes all of a text to it and closes it. Returns 0 or the error number.
int writeText(const fs::path& path, int flags, const std::string& text)
{
  Descriptor file(::open(path.c_str(), O_WRONLY | O_NOFOLLOW | O_CLOEXEC | flags, 0666));
  if (!file)
  {
    return errno;
  }
  const int error = writeAll(file.get(), text.data(), text.size());
  const int late = file.close();
  return error != 0 ? error : late;
}

} // namespace

FolderWriter::FolderWriter(fs::path place, fs::path container)
  : Place(std::move(place))
  , Container(std::move(container))
  , Folder(this->Container / substrateName)
{
}

void FolderWriter::fail(const std::string& why) const
{
  cannotWriteFolder(this->Place.string(), why);
}

void FolderWriter::makeFolder(const std::string& path)
{
  this->list({ path });
  if (::mkdir((this->Folder / path).c_str(), 0777) != 0)
  {
    this->fail(path + ": " + systemMessage(errno));
  }
  this->Written.folders.insert(path);
}

void FolderWriter::write(const std::string& path, const std::string& text)
{
  this->list({ path });
  this->remember(path, this->put(path, text));
}

void FolderWriter::writeBy(const std::string& path, const std::function<void(const std::string&)>& how)
{
  this->list({ path });
  this->remember(path, this->putBy(path, how));
}

void FolderWriter::list(const std::vector<std::string>& paths) const
{
  std::string lines;
  for (const std::string& path : paths)
  {
    lines += path + '\n';
  }
  const int error = writeText(this->Container / listName, O_APPEND, lines);
  if (error != 0)
  {
    this->fail(systemMessage(error));
  }
}

std::string FolderWriter::put(const std::string& path, const std::string& text) const
{
  const int error = writeText(this->Folder / path, O_CREAT | O_EXCL, text);
  if (error != 0)
  {
    this->fail(path + ": " + systemMessage(error));
  }
  return sha256(text);
}

std::string FolderWriter::putBy(const std::string& path, const std::function<void(const std::string&)>& how) const
{
  const fs::path file = this->Folder / path;
  try
  {
    how(file.string());
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

} // namespace cactus
