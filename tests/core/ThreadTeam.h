// SPDX-License-Identifier: BSD-3-Clause
// A team whose processes are threads.
#pragma once

#include "base/Team.h"

#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace cactus_testing
{

/// The place where the members of a team meet.
class MeetingPoint
{
public:
  explicit MeetingPoint(int size)
    : Given(static_cast<std::size_t>(size))
  {
  }

  std::size_t size() const { return this->Given.size(); }
  /// Returns the messages of all to the member at this place.
  std::vector<std::string> deal(std::size_t place, const std::vector<std::string>& toEach)
  {
    std::unique_lock<std::mutex> lock(this->Mutex);
    this->Given[place] = toEach;
    const unsigned long round = this->Round;
    if (++this->Arrived == this->size())
    {
      this->Arrived = 0;
      this->Result = this->Given; // stays until all are here again
      ++this->Round;
      this->Changed.notify_all();
    }
    this->Changed.wait(lock, [&] { return this->Round != round; });
    std::vector<std::string> found;
    for (const std::vector<std::string>& given : this->Result)
    {
      found.push_back(given.at(place));
    }
    return found;
  }

private:
  std::mutex Mutex;
  std::condition_variable Changed;
  std::vector<std::vector<std::string>> Given;
  std::vector<std::vector<std::string>> Result;
  std::size_t Arrived = 0;
  unsigned long Round = 0;
};

class TeamThread : public cactus::Team
{
public:
  TeamThread(MeetingPoint& point, int place)
    : Point(point)
    , Place(place)
  {
  }

  int size() const override { return static_cast<int>(this->Point.size()); }
  int place() const override { return this->Place; }
  std::vector<std::string> exchange(const std::string& bytes) override
  {
    return this->deal(std::vector<std::string>(this->Point.size(), bytes));
  }
  std::vector<std::string> deal(const std::vector<std::string>& toEach) override
  {
    return this->Point.deal(static_cast<std::size_t>(this->Place), toEach);
  }

private:
  MeetingPoint& Point;
  int Place;
};

/// Runs work in each member of a team, and returns its results, or the messages of its exceptions, by rank.
inline std::vector<std::string> inTeam(int size, const std::function<std::string(cactus::Team&)>& work)
{
  MeetingPoint point(size);
  std::vector<std::string> results(static_cast<std::size_t>(size));
  std::vector<std::thread> threads;
  for (int place = 0; place < size; ++place)
  {
    threads.emplace_back(
      [&, place]
      {
        TeamThread member(point, place);
        try
        {
          results[std::size_t(place)] = work(member);
        }
        catch (const std::exception& error)
        {
          results[std::size_t(place)] = error.what();
        }
      });
  }
  for (std::thread& thread : threads)
  {
    thread.join();
  }
  return results;
}

} // namespace cactus_testing
