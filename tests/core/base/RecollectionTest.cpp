// SPDX-License-Identifier: BSD-3-Clause
// Guarantee: known results, of a loop or of a single task, are not computed again, whichever process computed them, and all
// processes get all of them.
#include "base/Recollection.h"

#include "../FindingsInMemory.h"
#include "../ThreadTeam.h"

#include <gtest/gtest.h>

#include <map>
#include <mutex>
#include <set>
#include <string>
#include <vector>

namespace
{

using namespace cactus;
using cactus_testing::FindingsInMemory;

/// Returns the cubes of the first eight numbers; `done` receives those that were computed.
std::string cubes(const Recollection& known, std::multiset<std::size_t>& done, Team* team = nullptr)
{
  std::vector<std::string> values(8);
  std::mutex mutex;
  Context context;
  context.threads = 2;
  known.loop(
    Sharing(team), values.size(), context,
    [&](std::size_t i)
    {
      values[i] = std::to_string(i * i * i);
      const std::lock_guard<std::mutex> lock(mutex);
      done.insert(i);
    },
    [&](std::size_t i) { return values[i]; }, [&](std::size_t i, const std::string& bytes) { values[i] = bytes; }, "", 0.0, 1.0);
  std::string all;
  for (const std::string& value : values)
  {
    all += value + ' ';
  }
  return all;
}

const std::string wanted = "0 1 8 27 64 125 216 343 ";

TEST(Recollection, OfNothingDoesAll)
{
  std::multiset<std::size_t> done;
  EXPECT_EQ(cubes({}, done), wanted);
  EXPECT_EQ(done.size(), 8u);
  Recollection().note("lost");
  EXPECT_FALSE(Recollection().recall());
}

TEST(Recollection, DoesWhatIsNotKnown)
{
  FindingsInMemory findings;
  std::multiset<std::size_t> done;
  const Recollection known = Recollection(findings).part("cubes");
  EXPECT_EQ(cubes(known, done), wanted);
  EXPECT_EQ(done.size(), 8u);
  findings.beginAgain([](const std::string& name) { return name != "cubes/3" && name != "cubes/6"; });
  done.clear();
  EXPECT_EQ(cubes(known, done), wanted);
  EXPECT_EQ(done, (std::multiset<std::size_t>{ 3, 6 }));
  EXPECT_EQ(findings.kept.size(), 2u);
  // Results of another part are not confused with its own.
  findings.beginAgain();
  done.clear();
  EXPECT_EQ(cubes(Recollection(findings).part("others"), done), wanted);
  EXPECT_EQ(done.size(), 8u);
}

TEST(Recollection, WorksOutOnce)
{
  const auto square = [](const Recollection& known, Team* team, int& times)
  {
    return known.once(Sharing(team),
      [&]
      {
        ++times;
        return 49;
      });
  };
  int times = 0;
  EXPECT_EQ(square({}, nullptr, times), 49);
  EXPECT_EQ(square({}, nullptr, times), 49);
  EXPECT_EQ(times, 2) << "where nothing is kept";
  std::string kept;
  std::mutex mutex;
  for (const bool isKnown : { false, true })
  {
    // Results kept by the first process are for all, whether or not they received them before.
    const auto found = cactus_testing::inTeam(3,
      [&](Team& team)
      {
        FindingsInMemory findings;
        if (isKnown && team.place() == 0)
        {
          findings.kept["square"] = kept;
        }
        findings.beginAgain();
        int own = 0;
        const int value = square(Recollection(findings).part("square"), &team, own);
        const std::lock_guard<std::mutex> lock(mutex);
        kept = team.place() == 0 && !isKnown ? findings.kept.at("square") : kept;
        return std::to_string(value) + ' ' + std::to_string(own) + ' ' + std::to_string(findings.kept.size());
      });
    const std::vector<std::string> before{ "49 1 1", "49 1 0", "49 1 0" };
    EXPECT_EQ(found, isKnown ? std::vector<std::string>(3, "49 0 0") : before);
  }
}

TEST(Recollection, OfAnyProcessIsForAll)
{
  for (const int before : { 1, 3 })
  {
    for (const int after : { 1, 2, 4 })
    {
      // Each process keeps its own results, and receives all that were kept.
      std::map<std::string, std::string> kept;
      std::mutex mutex;
      const auto run = [&](Team& team)
      {
        FindingsInMemory findings;
        findings.kept = kept;
        findings.beginAgain();
        std::multiset<std::size_t> done;
        const std::string found = cubes(Recollection(findings), done, &team);
        Sharing(&team).exchange();
        const std::lock_guard<std::mutex> lock(mutex);
        kept.insert(findings.kept.begin(), findings.kept.end());
        return found + std::to_string(done.size());
      };
      cactus_testing::inTeam(before, run);
      EXPECT_EQ(kept.size(), 8u);
      kept.erase("5");
      const std::vector<std::string> found = cactus_testing::inTeam(after, run);
      int again = 0;
      for (const std::string& one : found)
      {
        EXPECT_EQ(one.substr(0, wanted.size()), wanted);
        again += std::stoi(one.substr(wanted.size()));
      }
      EXPECT_EQ(again, 1) << before << " and then " << after;
    }
  }
}

} // namespace
