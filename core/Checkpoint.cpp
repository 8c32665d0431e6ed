// SPDX-License-Identifier: BSD-3-Clause
#include "Checkpoint.h"

#include "Error.h"

#include <cerrno>

namespace cactus
{

namespace
{

constexpr char title[] = "CACTUS checkpoint 2\n";
constexpr std::uint64_t ending = 0x656e642e656e642eu;

} // namespace

CheckpointWriter::CheckpointWriter(const std::string& path, std::uint64_t fingerprint)
  : File(path)
{
  this->write(title, sizeof(title));
  this->put(fingerprint);
}

void CheckpointWriter::write(const void* data, std::size_t bytes)
{
  this->File.stream().write(static_cast<const char*>(data), static_cast<std::streamsize>(bytes));
}

void CheckpointWriter::commit()
{
  this->put(ending);
  this->File.commit();
}

CheckpointReader::CheckpointReader(const std::string& path, std::uint64_t fingerprint)
  : Path(path)
  , File(path, std::ios::binary)
{
  if (!this->File)
  {
    throw FileError("cannot read CheckpointFile " + path + ": " + std::strerror(errno));
  }
  this->File.seekg(0, std::ios::end);
  this->Bytes = static_cast<std::uint64_t>(this->File.tellg());
  this->File.seekg(0);
  char found[sizeof(title)];
  this->read(found, sizeof(found));
  if (std::memcmp(found, title, sizeof(title)) != 0)
  {
    this->damaged();
  }
  std::uint64_t of = 0;
  this->get(of);
  if (of != fingerprint)
  {
    throw InvalidInput(
      "CheckpointFile " + path +
      " was written for other fibres or other parameters: restore those, name another file, or switch Resume off");
  }
}

void CheckpointReader::read(void* data, std::size_t bytes)
{
  this->File.read(static_cast<char*>(data), static_cast<std::streamsize>(bytes));
  if (!this->File)
  {
    this->damaged();
  }
}

void CheckpointReader::finish()
{
  std::uint64_t end = 0;
  this->get(end);
  if (end != ending)
  {
    this->damaged();
  }
}

void CheckpointReader::damaged() const
{
  throw FileError("CheckpointFile " + this->Path + " is not a checkpoint of this program, or is damaged: remove it");
}

} // namespace cactus
