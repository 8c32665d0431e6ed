// SPDX-License-Identifier: BSD-3-Clause
#include "base/SharedCheckpoint.h"

#include <algorithm>

namespace cactus
{

namespace
{

/// The largest message from one process to another, in bytes.
constexpr std::size_t bytesAtOnce = std::size_t(1) << 26;

/// Returns `count` of each process.
std::vector<std::uint64_t> gatheredCounts(std::size_t count, const Sharing& sharing)
{
  std::vector<std::uint64_t> counts;
  for (const std::string& bytes : sharing.exchange(bytesOf(std::vector<std::uint64_t>{ count })))
  {
    ByteReader get(bytes);
    get.get<std::uint64_t>(); // the length of the vector
    counts.push_back(get.get<std::uint64_t>());
  }
  return counts;
}

std::uint64_t sumOf(const std::vector<std::uint64_t>& counts)
{
  std::uint64_t sum = 0;
  for (const std::uint64_t count : counts)
  {
    sum += count;
  }
  return sum;
}

/// Sends bytes from one process to one other.
std::string pass(std::string bytes, std::size_t from, std::size_t to, const Sharing& sharing)
{
  std::vector<std::string> toEach(static_cast<std::size_t>(sharing.size()));
  if (static_cast<std::size_t>(sharing.place()) == from)
  {
    toEach[to] = std::move(bytes);
  }
  return sharing.deal(std::move(toEach))[from];
}

} // namespace

SharedCheckpointWriter::SharedCheckpointWriter(const std::string& path, const CheckpointHeader& header, const Sharing& sharing)
  : Processes(sharing)
{
  this->inFirst([&] { this->File.emplace(path, header); });
}

void SharedCheckpointWriter::putParts(
  std::size_t count, std::size_t bytes, const std::function<void(std::size_t, std::size_t, const Take&)>& piece)
{
  const std::vector<std::uint64_t> counts = gatheredCounts(count, this->Processes);
  this->put(sumOf(counts));
  const auto self = static_cast<std::size_t>(this->Processes.place());
  const std::size_t most = bytesAtOnce / bytes;
  for (std::size_t process = 0; process < counts.size(); ++process)
  {
    for (std::size_t begin = 0; begin < counts[process]; begin += most)
    {
      const std::size_t end = std::min<std::size_t>(begin + most, counts[process]);
      if (process == 0)
      {
        this->inFirst([&] { piece(begin, end, [&](const void* data, std::size_t size) { this->File->putPart(data, size); }); });
        continue;
      }
      std::string made;
      if (process == self)
      {
        piece(begin, end, [&](const void* data, std::size_t size) { made.assign(static_cast<const char*>(data), size); });
      }
      const std::string given = pass(std::move(made), process, 0, this->Processes);
      this->inFirst([&] { this->File->putPart(given.data(), given.size()); });
    }
  }
}

void SharedCheckpointWriter::commit()
{
  this->inFirst([&] { this->File->commit(); });
  this->File.reset();
  if (this->Failure)
  {
    std::rethrow_exception(this->Failure);
  }
}

SharedCheckpointReader::SharedCheckpointReader(const std::string& path, std::uint64_t fingerprint, const Sharing& sharing)
  : Processes(sharing)
{
  if (sharing.isFirst())
  {
    this->File.emplace(path, fingerprint);
  }
}

std::string SharedCheckpointReader::fromFile(const std::function<void(CheckpointReader&, ByteWriter&)>& read)
{
  ByteWriter put;
  if (this->File)
  {
    read(*this->File, put);
  }
  return this->Processes.fromFirst(put.bytes());
}

/// Gathers the counts of all processes, after a check that the file has that many values, so that no more is allocated.
std::vector<std::uint64_t> SharedCheckpointReader::countsOfAll(std::size_t count, std::size_t bytes)
{
  std::vector<std::uint64_t> counts = gatheredCounts(count, this->Processes);
  if (this->File)
  {
    this->File->require(this->File->getCount(bytes) == sumOf(counts));
  }
  this->Processes.exchange();
  return counts;
}

void SharedCheckpointReader::getParts(const std::vector<std::uint64_t>& counts, std::size_t bytes, char* values)
{
  const auto self = static_cast<std::size_t>(this->Processes.place());
  const std::size_t most = bytesAtOnce / bytes;
  for (std::size_t process = 0; process < counts.size(); ++process)
  {
    for (std::size_t begin = 0; begin < counts[process]; begin += most)
    {
      const std::size_t size = (std::min<std::size_t>(begin + most, counts[process]) - begin) * bytes;
      if (process == 0)
      {
        if (this->File)
        {
          this->File->getPart(values + begin * bytes, size);
        }
        continue;
      }
      std::string read;
      if (this->File)
      {
        read.resize(size);
        this->File->getPart(&read[0], size);
      }
      const std::string given = pass(std::move(read), 0, process, this->Processes);
      if (process == self)
      {
        std::copy(given.begin(), given.end(), values + begin * bytes);
      }
    }
  }
}

void SharedCheckpointReader::require(bool good) const
{
  for (const std::string& told : this->Processes.exchange(good ? "1" : "0"))
  {
    good = good && told == "1";
  }
  if (this->File)
  {
    this->File->require(good);
  }
}

void SharedCheckpointReader::finish() const
{
  if (this->File)
  {
    this->File->finish();
  }
}

} // namespace cactus
