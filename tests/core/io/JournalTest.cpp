// SPDX-License-Identifier: BSD-3-Clause
// Guarantees: what any process has kept is given to the next run, with any number of processes, once each, up to a cut or damage;
// other work gets none of it, and its files and others' stay.
#include "io/Journal.h"

#include "../ScratchPath.h"
#include "../ThreadTeam.h"
#include "base/Error.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

namespace
{

namespace fs = std::filesystem;
using cactus::Journal;
using cactus::Sharing;
using cactus::Team;
using Findings = std::map<std::string, std::string>;

class JournalTest : public ::testing::Test
{
protected:
  void SetUp() override { fs::create_directories(this->folder); }
  void TearDown() override { fs::remove_all(this->folder); }

  /// Returns what the next run is given of these.
  Findings given(const Findings& asked) const
  {
    Journal journal(this->folder, "mine", Sharing());
    Findings found;
    for (const auto& entry : asked)
    {
      if (const auto bytes = journal.take(entry.first))
      {
        found[entry.first] = *bytes;
      }
    }
    return found;
  }

  const fs::path folder = cactus_testing::scratchPath("journal");
};

TEST_F(JournalTest, HoldsWhatAnyProcessHasKept)
{
  cactus_testing::inTeam(3,
    [&](Team& team)
    {
      Journal journal(this->folder, "mine", Sharing(&team));
      EXPECT_FALSE(journal.foundSome());
      journal.keep("first", "of somebody");
      journal.keep("of " + std::to_string(team.place()), std::string("a\0b", 3) + std::to_string(team.place()));
      return std::string();
    });
  {
    Journal journal(this->folder, "mine", Sharing());
    EXPECT_TRUE(journal.foundSome());
    ASSERT_NE(journal.find("of 1"), nullptr);
    EXPECT_EQ(*journal.find("of 1"), std::string("a\0b1", 4));
    EXPECT_EQ(journal.take("of 1").value_or(""), std::string("a\0b1", 4));
    EXPECT_FALSE(journal.take("of 1")) << "is given once";
    EXPECT_EQ(journal.find("of 1"), nullptr);
    EXPECT_FALSE(journal.take("of 3"));
    journal.keep("of 1", "changed");
    EXPECT_FALSE(journal.take("of 1")) << "is for the next run";
    EXPECT_TRUE(journal.holds("of 2")) << "which another process has kept";
    EXPECT_FALSE(journal.holds("of 3"));
    EXPECT_THROW(Journal(this->folder, "mine", Sharing()), cactus::FileError) << "another one is at work";
  }
  EXPECT_THROW(Journal(this->folder, "yours", Sharing()), cactus::InvalidInput);
  const auto told = cactus_testing::inTeam(2,
    [&](Team& team)
    {
      Journal journal(this->folder, "mine", Sharing(&team));
      return journal.take("of 2").value_or("").substr(3) + journal.take("first").value_or("");
    });
  EXPECT_EQ(told, std::vector<std::string>(2, "2of somebody"));
  std::ofstream(this->folder / "journal-notes") << "of a user";
  Journal journal(this->folder, "mine", Sharing());
  EXPECT_EQ(journal.take("of 0").value_or(""), std::string("a\0b0", 4));
  journal.clear();
  EXPECT_FALSE(journal.holds(""));
  EXPECT_THROW(Journal(this->folder, "mine", Sharing()), cactus::FileError) << "it is still at work";
  journal.remove();
  EXPECT_TRUE(fs::remove(this->folder / "journal-notes"));
  EXPECT_TRUE(fs::is_empty(this->folder));
}

TEST_F(JournalTest, HoldsAllThatWasKeptBeforeAnyCut)
{
  const std::vector<std::pair<std::string, std::string>> wanted = { { "one", "1" }, { "none", "" },
    { std::string("\0two", 4), std::string("\0", 1) }, { "long", std::string(5000, 'x') }, { "one", "changed" } };
  const fs::path path = this->folder / "journal";
  std::vector<std::uintmax_t> ends;
  {
    Journal journal(this->folder, "mine", Sharing());
    EXPECT_FALSE(journal.holds(""));
    ends.push_back(fs::file_size(path));
    for (const auto& [name, bytes] : wanted)
    {
      journal.keep(name, bytes);
      ends.push_back(fs::file_size(path));
    }
    EXPECT_TRUE(journal.holds(""));
  }
  const fs::path whole = this->folder / "whole";
  fs::rename(path, whole);
  Findings asked(wanted.begin(), wanted.end());
  asked["more"] = "";
  for (std::uintmax_t length = ends.front(); length <= ends.back(); length += length < 200 || length > 5200 ? 1 : 97)
  {
    fs::copy_file(whole, path, fs::copy_options::overwrite_existing);
    fs::resize_file(path, length);
    Findings left;
    for (std::size_t i = 0; i < wanted.size() && ends[i + 1] <= length; ++i)
    {
      left[wanted[i].first] = wanted[i].second;
    }
    EXPECT_EQ(this->given(asked), left) << length;
    Journal(this->folder, "mine", Sharing()).keep("more", "after it");
    left["more"] = "after it";
    EXPECT_EQ(this->given(asked), left) << length;
  }
  // Damage ends it, too.
  fs::copy_file(whole, path, fs::copy_options::overwrite_existing);
  {
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(std::streamoff(ends[3]) + 1000);
    file.put('y');
  }
  EXPECT_EQ(this->given(asked).size(), 3u);
  std::ofstream(path) << "a file of somebody's that is long enough";
  EXPECT_THROW(Journal(this->folder, "mine", Sharing()), cactus::FileError);
  EXPECT_EQ(fs::file_size(path), 40u);
}

} // namespace
