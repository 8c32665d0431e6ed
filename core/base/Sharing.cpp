// SPDX-License-Identifier: BSD-3-Clause
#include "base/Sharing.h"

#include "base/EvenParts.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <memory>
#include <new>
#include <numeric>
#include <utility>

namespace cactus
{

namespace
{

/// First byte of every message of an exchange: success, or the kind of the exception.
enum class Fate : char
{
  Well = '.',
  Invalid = 'i',
  Unfeasible = 'u',
  NoMemory = 'm',
  NoFile = 'f',
  Unknown = 'x',
  Stopped = 's'
};

/// The least number of batches that each process has in a loop, so that all end at about the same time, and the longest batch.
constexpr std::size_t batchesOfEach = 16;
constexpr std::size_t longestBatch = 256;

constexpr auto timeBetweenLooks = std::chrono::milliseconds(500);

std::string textOf(Fate fate, const char* message)
{
  return static_cast<char>(fate) + std::string(message);
}

/// Returns the exception that is being handled as a message for the others.
std::string currentFailure()
{
  try
  {
    throw;
  }
  catch (const ReportedElsewhere& error)
  {
    return textOf(Fate::Stopped, error.what());
  }
  catch (const Cancelled& error)
  {
    return textOf(Fate::Stopped, error.what());
  }
  catch (const InvalidInput& error)
  {
    return textOf(Fate::Invalid, error.what());
  }
  catch (const Infeasible& error)
  {
    return textOf(Fate::Unfeasible, error.what());
  }
  catch (const OutOfMemory& error)
  {
    return textOf(Fate::NoMemory, error.what());
  }
  catch (const std::bad_alloc&)
  {
    return textOf(Fate::NoMemory, "out of memory: give each process fewer threads, or the job fewer processes on a machine");
  }
  catch (const FileError& error)
  {
    return textOf(Fate::NoFile, error.what());
  }
  catch (const std::exception& error)
  {
    return textOf(Fate::Unknown, error.what());
  }
  catch (...)
  {
    return textOf(Fate::Unknown, "for a reason that is not known");
  }
}

/// Returns the process that ends the work of all: the first that has failed, else the first that was stopped; their number if
/// none has. An empty message means success.
std::size_t placeOfFailure(const std::vector<std::string>& given)
{
  std::size_t found = given.size();
  for (std::size_t place = 0; place < given.size(); ++place)
  {
    const Fate fate = given[place].empty() ? Fate::Well : static_cast<Fate>(given[place].front());
    if (fate != Fate::Well && fate != Fate::Stopped)
    {
      return place;
    }
    found = fate == Fate::Stopped ? std::min(found, place) : found;
  }
  return found;
}

} // namespace

/// Thrown in all processes once one has failed.
struct Sharing::Ended
{
  int place;
  std::string failure;
};

Sharing::Sharing(Team* team, std::string stopFile)
  : Members(team != nullptr && team->size() > 1 ? team : nullptr)
  , StopFile(std::move(stopFile))
{
}

/// Returns the messages without their first byte. Throws Ended if one process has failed.
std::vector<std::string> Sharing::whereWell(std::vector<std::string> all)
{
  const std::size_t failed = placeOfFailure(all);
  if (failed < all.size())
  {
    throw Ended{ static_cast<int>(failed), all[failed] };
  }
  for (std::string& given : all)
  {
    given.erase(0, 1);
  }
  return all;
}

std::vector<std::string> Sharing::exchange(const std::string& bytes) const
{
  if (this->Members == nullptr)
  {
    return { bytes };
  }
  return this->whereWell(this->Members->exchange(static_cast<char>(Fate::Well) + bytes));
}

std::vector<std::string> Sharing::deal(std::vector<std::string> toEach) const
{
  if (this->Members == nullptr)
  {
    return toEach;
  }
  for (std::string& bytes : toEach)
  {
    if (!bytes.empty())
    {
      bytes.insert(0, 1, static_cast<char>(Fate::Well));
    }
  }
  return this->whereWell(this->Members->deal(toEach));
}

std::string Sharing::fromFirst(const std::string& bytes) const
{
  return this->exchange(this->isFirst() ? bytes : "").front();
}

bool Sharing::isEverywhere(bool isHere) const
{
  return this->areAlike(isHere ? "1" : "0") && isHere;
}

bool Sharing::areAlike(const std::string& given) const
{
  bool areAlike = true;
  this->together(
    [&]
    {
      for (const std::string& told : this->exchange(given))
      {
        areAlike = areAlike && told == given;
      }
    });
  return areAlike;
}

void Sharing::addUp(std::vector<std::uint64_t>& counts) const
{
  if (this->Members == nullptr)
  {
    return;
  }
  const std::vector<std::string> all = this->exchange(bytesOf(counts));
  std::fill(counts.begin(), counts.end(), 0);
  for (const std::string& bytes : all)
  {
    std::vector<std::uint64_t> more;
    getAll(bytes, more);
    for (std::size_t i = 0; i < counts.size(); ++i)
    {
      counts[i] += more.at(i);
    }
  }
}

void Sharing::together(const std::function<void()>& work) const
{
  if (this->Members == nullptr)
  {
    work();
    return;
  }
  // Within an outer together(), a process that failed on its way here ends all of them.
  this->exchange();
  try
  {
    std::string failure;
    try
    {
      work();
      this->exchange();
      return;
    }
    catch (const Ended&)
    {
      throw;
    }
    catch (...)
    {
      failure = currentFailure();
    }
    this->tell(failure);
  }
  catch (const Ended& ended)
  {
    this->rethrow(ended);
  }
}

/// Reports a failure in the exchange that the others are waiting in.
void Sharing::tell(const std::string& failure) const
{
  if (!this->StopFile.empty())
  {
    std::ofstream(this->StopFile).flush(); // if it cannot be written, the others go on to the exchange
  }
  const std::vector<std::string> all = this->Members->exchange(failure);
  const std::size_t failed = placeOfFailure(all);
  throw Ended{ static_cast<int>(failed), all[failed] };
}

void Sharing::rethrow(const Ended& ended) const
{
  const std::string where = ended.place > 0 ? "on rank " + std::to_string(ended.place) + ": " : "";
  const std::string message = where + ended.failure.substr(1);
  if (!this->isFirst())
  {
    throw ReportedElsewhere(message);
  }
  std::error_code ignored; // the next run removes what is left
  std::filesystem::remove(this->StopFile, ignored);
  switch (static_cast<Fate>(ended.failure.front()))
  {
  case Fate::Invalid:
    throw InvalidInput(message);
  case Fate::Unfeasible:
    throw Infeasible(message);
  case Fate::NoMemory:
    throw OutOfMemory(message);
  case Fate::NoFile:
    throw FileError(message);
  case Fate::Stopped:
    throw Cancelled(message);
  default:
    throw Error(message);
  }
}

Context Sharing::watching(const Context& context) const
{
  if (this->Members == nullptr || this->StopFile.empty())
  {
    return context;
  }
  Context watched = context;
  using Clock = std::chrono::steady_clock;
  watched.cancelled = [before = context.cancelled, file = this->StopFile, next = std::make_shared<Clock::time_point>()]
  {
    if (before && before())
    {
      return true;
    }
    if (Clock::now() < *next)
    {
      return false;
    }
    *next = Clock::now() + timeBetweenLooks;
    std::error_code error;
    return std::filesystem::exists(file, error);
  };
  return watched;
}

/// Assigns batches round-robin.
std::vector<std::size_t> Sharing::batchesOf(int process, std::size_t count) const
{
  const auto processes = static_cast<std::size_t>(this->size());
  const std::size_t batch = std::clamp<std::size_t>(count / (batchesOfEach * processes), 1, longestBatch);
  std::vector<std::size_t> part;
  for (std::size_t first = batch * static_cast<std::size_t>(process); first < count; first += batch * processes)
  {
    for (std::size_t i = first; i < std::min(count, first + batch); ++i)
    {
      part.push_back(i);
    }
  }
  return part;
}

std::vector<std::size_t> Sharing::stretchOf(int process, const std::vector<double>& weights) const
{
  const std::vector<std::size_t> begins = evenParts(weights, static_cast<std::size_t>(this->size()));
  const auto place = static_cast<std::size_t>(process);
  std::vector<std::size_t> part(begins[place + 1] - begins[place]);
  std::iota(part.begin(), part.end(), begins[place]);
  return part;
}

} // namespace cactus
