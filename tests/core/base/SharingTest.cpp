// SPDX-License-Identifier: BSD-3-Clause
// Guarantees: shared work is done once, and all processes get all of it, whatever their number; an error in one ends the work in
// all of them, soon, and the first one reports it.
#include "base/Sharing.h"

#include "../ThreadTeam.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <numeric>
#include <string>
#include <thread>
#include <unistd.h>
#include <utility>
#include <vector>

namespace
{

using namespace cactus;
using cactus_testing::inTeam;

TEST(Sharing, DoesEachThingOnceOnAnyNumberOfProcessesAndThreads)
{
  for (const int size : { 1, 2, 3, 4 })
  {
    for (const std::size_t count : { 0, 1, 2, 7, 1000, 20000 })
    {
      std::vector<std::atomic<int>> times(count);
      const auto told = inTeam(size,
        [&](Team& team)
        {
          const Sharing sharing(&team);
          Context context;
          context.threads = 2;
          std::vector<std::string> results(count);
          sharing.together(
            [&]
            {
              sharing.loop(
                count, context,
                [&](std::size_t i)
                {
                  ++times[i];
                  results[i] = std::to_string(i * i);
                },
                [&](std::size_t i) { return results[i]; }, [&](std::size_t i, const std::string& bytes) { results[i] = bytes; });
            });
          for (std::size_t i = 0; i < count; ++i)
          {
            if (results[i] != std::to_string(i * i))
            {
              return "wrong at " + std::to_string(i);
            }
          }
          return std::string("right");
        });
      EXPECT_EQ(told, std::vector<std::string>(std::size_t(size), "right"));
      for (const auto& number : times)
      {
        ASSERT_EQ(number, 1);
      }
    }
  }
}

// Guarantee: each element is processed once, each process has a contiguous range, and about as much to do as the others.
TEST(Sharing, SharesOutAlongAnOrder)
{
  // Few processes: where 300 threads start OpenMP's own at once, LLVM's library 14 now and then ends by SIGSEGV in one of its
  // threads.
  for (const auto& [size, count] : { std::pair{ 1, 200 }, { 2, 200 }, { 3, 200 }, { 4, 200 }, { 7, 5 } })
  {
    std::vector<double> weights;
    for (int i = 0; i < count; ++i)
    {
      weights.push_back(1.0 + double(i % 7) + (i < 50 ? 20.0 : 0.0));
    }
    const double all = std::accumulate(weights.begin(), weights.end(), 0.0);
    std::vector<std::atomic<int>> ownerOf(weights.size());
    std::atomic<int> times{ 0 };
    inTeam(size,
      [&](Team& team)
      {
        const Sharing sharing(&team);
        std::vector<std::string> results(weights.size());
        const auto body = [&](std::size_t i)
        {
          ++times;
          ownerOf[i] = team.place();
          results[i] = std::to_string(i);
        };
        const auto take = [&](std::size_t i, const std::string& bytes) { results[i] = bytes; };
        sharing.together(
          [&]
          {
            sharing.loopAlong(
              weights, {}, body, [&](std::size_t i) { return results[i]; }, take);
          });
        for (std::size_t i = 0; i < results.size(); ++i)
        {
          EXPECT_EQ(results[i], std::to_string(i));
        }
        return std::string();
      });
    EXPECT_EQ(times, int(weights.size())) << size;
    EXPECT_TRUE(std::is_sorted(ownerOf.begin(), ownerOf.end())) << size;
    std::vector<double> loads(std::size_t(size), 0.0);
    for (std::size_t i = 0; i < weights.size(); ++i)
    {
      loads[std::size_t(ownerOf[i].load())] += weights[i];
    }
    for (const double load : loads)
    {
      EXPECT_NEAR(load, all / size, 28.0) << size;
    }
  }
}

TEST(Sharing, AddsUp)
{
  const auto told = inTeam(3,
    [](Team& team)
    {
      const Sharing sharing(&team);
      std::vector<std::uint64_t> counts{ std::uint64_t(team.place()), std::uint64_t(1) << 40 };
      sharing.together([&] { sharing.addUp(counts); });
      return std::to_string(counts[0]) + ' ' + std::to_string(counts[1]);
    });
  EXPECT_EQ(told, std::vector<std::string>(3, "3 3298534883328"));
}

TEST(Sharing, DealsWhatEachHasForEach)
{
  for (const int size : { 1, 2, 3, 4 })
  {
    const auto told = inTeam(size,
      [&](Team& team)
      {
        const Sharing sharing(&team);
        std::vector<std::string> toEach(static_cast<std::size_t>(size));
        std::string wanted;
        for (int other = 0; other < size; ++other)
        {
          // An empty message for the next process.
          toEach[std::size_t(other)] =
            other == team.place() + 1 ? "" : std::to_string(team.place()) + std::string(3, char('a' + other));
          wanted += other == team.place() - 1 ? "" : std::to_string(other) + std::string(3, char('a' + team.place()));
        }
        std::string found;
        sharing.together(
          [&]
          {
            for (const std::string& bytes : sharing.deal(toEach))
            {
              found += bytes;
            }
          });
        return found == wanted ? "right" : "wrong: " + found;
      });
    EXPECT_EQ(told, std::vector<std::string>(std::size_t(size), "right"));
  }
}

/// Returns the message of each of three members after work(place) between two exchanges.
std::vector<std::string> endOf(const std::function<void(int)>& work)
{
  return inTeam(3,
    [&](Team& team)
    {
      const Sharing sharing(&team);
      try
      {
        // In two layers, as when a folder is written within a production.
        sharing.together(
          [&]
          {
            sharing.together(
              [&]
              {
                sharing.exchange();
                work(team.place());
                sharing.exchange();
              });
          });
      }
      catch (const ReportedElsewhere&)
      {
        return std::string("reported elsewhere");
      }
      catch (const FileError& error)
      {
        return std::string("file error ") + error.what();
      }
      catch (const InvalidInput& error)
      {
        return std::string("invalid input ") + error.what();
      }
      catch (const Cancelled& error)
      {
        return std::string("stopped ") + error.what();
      }
      return std::string("well");
    });
}

TEST(Sharing, EndsAllAlikeAndTheFirstSaysWhy)
{
  const std::string other = "reported elsewhere";
  using Texts = std::vector<std::string>;
  EXPECT_EQ(endOf([](int) {}), (Texts{ "well", "well", "well" }));
  const auto fullDisk = [](int place)
  {
    if (place == 2)
    {
      throw FileError("no space");
    }
  };
  EXPECT_EQ(endOf(fullDisk), (Texts{ "file error on rank 2: no space", other, other }));
  EXPECT_EQ(endOf([](int) { throw InvalidInput("bad"); }), (Texts{ "invalid input bad", other, other }));
  // A reason is reported in preference to a stop.
  const auto stoppedToo = [](int place) { place == 1 ? throw FileError("no space") : throw Cancelled("stopped"); };
  EXPECT_EQ(endOf(stoppedToo), (Texts{ "file error on rank 1: no space", other, other }));
  EXPECT_EQ(endOf([](int) { throw Cancelled("by the user"); }), (Texts{ "stopped by the user", other, other }));
}

// Ends all, even if the failed one cannot know that the others are in a deal with empty messages.
TEST(Sharing, EndsADealToo)
{
  const auto told = inTeam(3,
    [](Team& team)
    {
      const Sharing sharing(&team);
      try
      {
        sharing.together(
          [&]
          {
            if (team.place() == 1)
            {
              throw FileError("no space");
            }
            sharing.deal(std::vector<std::string>(3));
            sharing.deal(std::vector<std::string>(3, "not for long"));
          });
      }
      catch (const ReportedElsewhere&)
      {
        return std::string("reported elsewhere");
      }
      return std::string("well");
    });
  EXPECT_EQ(told, (std::vector<std::string>{ "on rank 1: no space", "reported elsewhere", "reported elsewhere" }));
}

// For example, data that only one process cannot read, before the work on them begins.
TEST(Sharing, EndsAllWhereOneFailsBeforeAnInnerLayer)
{
  const auto told = inTeam(3,
    [](Team& team)
    {
      const Sharing outer(&team);
      const Sharing inner(&team);
      try
      {
        outer.together(
          [&]
          {
            if (team.place() == 1)
            {
              throw FileError("no space");
            }
            inner.together([&] { inner.exchange(); });
          });
      }
      catch (const ReportedElsewhere&)
      {
        return std::string("reported elsewhere");
      }
      return std::string("well");
    });
  EXPECT_EQ(told, (std::vector<std::string>{ "on rank 1: no space", "reported elsewhere", "reported elsewhere" }));
}

TEST(Sharing, TellsOthersAmidTheirWork)
{
  const std::string file = ::testing::TempDir() + "cactus-stop-" + std::to_string(::getpid());
  std::atomic<int> done{ 0 };
  const auto begin = std::chrono::steady_clock::now();
  const auto told = inTeam(2,
    [&](Team& team)
    {
      const Sharing sharing(&team, file);
      sharing.together(
        [&]
        {
          sharing.loop(
            100000, sharing.watching({}),
            [&](std::size_t)
            {
              if (team.place() == 1)
              {
                throw FileError("no space");
              }
              ++done;
              std::this_thread::sleep_for(std::chrono::milliseconds(1));
            },
            [](std::size_t) { return std::string(); }, [](std::size_t, const std::string&) {});
        });
      return std::string("well");
    });
  EXPECT_EQ(told[0], "on rank 1: no space");
  EXPECT_LT(done, 49999) << "the other one's half of the work";
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(20));
  EXPECT_FALSE(std::filesystem::exists(file));
}

} // namespace
