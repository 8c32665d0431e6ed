// SPDX-License-Identifier: BSD-3-Clause
#include "io/RecordLog.h"

#include "base/Error.h"
#include "base/Hash64.h"
#include "base/PartialName.h"

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fcntl.h>
#include <unistd.h>
#include <utility>

namespace cactus
{

namespace
{

constexpr std::size_t lengthBytes = sizeof(std::uint64_t);
constexpr std::size_t checksumBytes = sizeof(std::uint64_t);

std::uint64_t numberAt(const char* bytes)
{
  std::uint64_t number = 0;
  std::memcpy(&number, bytes, sizeof(number));
  return number;
}

std::string bytesOf(std::uint64_t number)
{
  std::string bytes(sizeof(number), '\0');
  std::memcpy(&bytes[0], &number, sizeof(number));
  return bytes;
}

} // namespace

RecordLog::RecordLog(const std::string& path, Descriptor file)
  : Path(path)
  , File(std::move(file))
{
}

RecordLog::RecordLog(const std::string& path, const std::string& identity)
  : RecordLog(path, Descriptor(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666)))
{
  if (!this->File)
  {
    this->fail(systemMessage(errno));
  }
  if (!lockForWriting(this->File.get()))
  {
    this->fail(errno == EWOULDBLOCK ? "another process is at work with it"
                                    : "its file system knows no locks (" + systemMessage(errno) +
                                        "): choose a folder on another one, or mount it with them (Lustre: -o flock)");
  }
  const std::size_t good = this->read();
  if (::ftruncate(this->File.get(), static_cast<off_t>(good)) != 0 ||
      ::lseek(this->File.get(), static_cast<off_t>(good), SEEK_SET) < 0)
  {
    this->fail(systemMessage(errno));
  }
  if (!this->takeIdentity(identity))
  {
    this->add(identity);
  }
}

std::vector<std::string> RecordLog::recordsOf(const std::string& path, const std::string& identity)
{
  RecordLog log(path, Descriptor(::open(path.c_str(), O_RDONLY | O_CLOEXEC)));
  if (!log.File && errno == ENOENT)
  {
    return {};
  }
  if (!log.File)
  {
    log.fail(systemMessage(errno));
  }
  log.read();
  log.takeIdentity(identity);
  return std::move(log.Records);
}

/// Removes the first record, which says what the file belongs to; returns whether there was one.
bool RecordLog::takeIdentity(const std::string& identity)
{
  if (this->Records.empty())
  {
    return false;
  }
  if (this->Records.front() != identity)
  {
    throw InvalidInput(this->Path + " belongs to other fibres, parameters or another version of this program");
  }
  this->Records.erase(this->Records.begin());
  return true;
}

/// Reads all complete records; returns their end.
std::size_t RecordLog::read()
{
  std::string all;
  std::vector<char> part(1 << 20);
  for (;;)
  {
    const ssize_t count = ::read(this->File.get(), part.data(), part.size());
    if (count < 0 && errno != EINTR)
    {
      this->fail(systemMessage(errno));
    }
    if (count == 0)
    {
      break;
    }
    all.append(part.data(), count > 0 ? static_cast<std::size_t>(count) : 0);
  }
  std::size_t good = 0;
  while (all.size() - good >= lengthBytes + checksumBytes)
  {
    const char* here = all.data() + good;
    const std::uint64_t length = numberAt(here);
    if (length > all.size() - good - lengthBytes - checksumBytes ||
        hash64(here, lengthBytes + length) != numberAt(here + lengthBytes + length))
    {
      break;
    }
    this->Records.emplace_back(here + lengthBytes, length);
    good += lengthBytes + length + checksumBytes;
  }
  if (good == 0 && !all.empty())
  {
    this->fail("it is no record of this version of the program, or damaged");
  }
  return good;
}

void RecordLog::add(const std::string& record)
{
  std::string entry = bytesOf(record.size()) + record;
  entry += bytesOf(hash64(entry.data(), entry.size()));
  const std::lock_guard<std::mutex> lock(this->Mutex);
  if (const int error = writeAll(this->File.get(), entry.data(), entry.size()))
  {
    this->fail(systemMessage(error));
  }
}

void RecordLog::fail(const std::string& why) const
{
  throw FileError("cannot use " + this->Path + ": " + why);
}

} // namespace cactus
