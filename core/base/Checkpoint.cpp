// SPDX-License-Identifier: BSD-3-Clause
#include "base/Checkpoint.h"

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <system_error>

namespace cactus
{

namespace
{

/// Every format starts with this; its number and a line feed follow.
const std::string title = "CACTUS checkpoint ";
const std::string version = "7\n"; // the next number whenever other values are kept
/// Reads as another number if the byte order differs.
constexpr std::uint64_t byteOrder = 0x0102030405060708u;

const std::string damage = "is damaged: remove it, or name another file";

std::string refusal(const std::string& path, const std::string& why)
{
  return "CheckpointFile " + path + " " + why;
}

std::string frontOf(std::uint64_t fingerprint)
{
  return title + version + bytesOf(byteOrder, fingerprint);
}

/// Opens a file and reads its front; returns nothing if there is no file. Throws unless it is this front.
std::optional<std::ifstream> openCheckpoint(const std::string& path, const std::string& front)
{
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found)
  {
    return std::nullopt;
  }
  if (error)
  {
    throw FileError(refusal(path, "cannot be read: " + error.message()));
  }
  if (!std::filesystem::is_regular_file(status))
  {
    throw FileError(refusal(path, "is there already and not a file: name another one"));
  }
  std::ifstream file(path, std::ios::binary);
  if (!file)
  {
    throw FileError(refusal(path, "cannot be read: " + systemMessage(errno)));
  }
  std::string found(front.size(), '\0');
  file.read(&found[0], static_cast<std::streamsize>(found.size()));
  if (found.compare(0, title.size(), title) != 0)
  {
    throw FileError(refusal(path, "is not a checkpoint of this program, and is kept: name another file, or remove it"));
  }
  const std::size_t format = front.size() - sizeof(std::uint64_t);
  if (found.compare(0, format, front, 0, format) != 0)
  {
    throw FileError(refusal(path,
      "was written by another version of this program or on another kind of machine, and is kept: go on with that, name "
      "another file, or remove it"));
  }
  if (!file)
  {
    throw FileError(refusal(path, damage));
  }
  if (found != front)
  {
    throw InvalidInput(refusal(path, "was written for other fibres or other parameters, and is kept: restore those and switch "
                                     "Resume on, name another file, or remove it"));
  }
  return file;
}

/// Returns the values of a checkpoint, which has at least one; nothing if there is no file.
std::string valuesOf(const std::string& path, const std::string& front)
{
  std::optional<std::ifstream> file = openCheckpoint(path, front);
  if (!file)
  {
    return "";
  }
  file->seekg(0, std::ios::end);
  const std::streamoff size = file->tellg();
  std::string content(static_cast<std::size_t>(std::max<std::streamoff>(size, 0)), '\0');
  file->seekg(0);
  file->read(&content[0], static_cast<std::streamsize>(content.size()));
  const std::size_t end = content.size() - std::min(content.size(), sizeof(std::uint64_t));
  if (!*file || end <= front.size() || content.substr(end) != bytesOf(hash64(content.data(), end)))
  {
    throw FileError(refusal(path, damage));
  }
  content.resize(end);
  content.erase(0, front.size());
  return content;
}

} // namespace

CheckpointWriter::CheckpointWriter(const std::string& path, std::uint64_t fingerprint, const Sharing& sharing)
  : Path(path)
  , Front(frontOf(fingerprint))
  , Processes(sharing)
{
  try
  {
    if (sharing.isFirst())
    {
      this->File.emplace(path);
    }
  }
  catch (...)
  {
    this->Failure = std::current_exception();
  }
  this->write(this->Front);
}

void CheckpointWriter::write(const std::string& bytes)
{
  if (this->File)
  {
    this->Sum.add(bytes.data(), bytes.size());
    this->File->stream().write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  }
}

void CheckpointWriter::writeParts(std::string own)
{
  std::vector<std::string> toEach(static_cast<std::size_t>(this->Processes.size()));
  toEach.front() = std::move(own);
  for (const std::string& part : this->Processes.deal(std::move(toEach)))
  {
    this->write(part);
  }
}

void CheckpointWriter::commit()
{
  if (this->Failure)
  {
    std::rethrow_exception(this->Failure);
  }
  if (this->File)
  {
    this->write(bytesOf(this->Sum.value()));
    openCheckpoint(this->Path, this->Front);
    this->File->commit();
  }
}

CheckpointReader::CheckpointReader(const std::string& path, std::uint64_t fingerprint, const Sharing& sharing)
  : Path(path)
  , Processes(sharing)
  , Content(sharing.isFirst() ? valuesOf(path, frontOf(fingerprint)) : "")
  , Get(this->Content, refusal(path, damage))
  , Found(!sharing.fromFirst(this->Content.substr(0, 1)).empty())
{
}

/// Returns this process's bytes of an array; `size`: how many these are.
std::string CheckpointReader::ownPart(std::uint64_t size)
{
  const std::vector<std::string> sizes = this->Processes.exchange(bytesOf(size));
  std::vector<std::string> toEach(sizes.size());
  for (std::size_t process = 0; this->Processes.isFirst() && process < sizes.size(); ++process)
  {
    toEach[process].resize(ByteReader(sizes[process]).get<std::uint64_t>());
    this->Get.getAll(&toEach[process][0], toEach[process].size());
  }
  return std::move(this->Processes.deal(std::move(toEach)).front());
}

void CheckpointReader::require(bool good) const
{
  if (!good)
  {
    throw FileError(refusal(this->Path, damage));
  }
}

} // namespace cactus
