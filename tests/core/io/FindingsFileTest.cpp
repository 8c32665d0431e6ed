// SPDX-License-Identifier: BSD-3-Clause
// Guarantee: the next run, with any number of processes, gets findings once each, and other work gets none.
#include "io/FindingsFile.h"

#include "../ScratchPath.h"
#include "../ThreadTeam.h"
#include "base/Error.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace
{

namespace fs = std::filesystem;
using cactus::FindingsFile;
using cactus::Sharing;
using cactus::Team;

TEST(FindingsFile, HoldsWhatAnyProcessHasKept)
{
  const fs::path folder = cactus_testing::scratchPath("findings");
  fs::create_directories(folder);
  cactus_testing::inTeam(3,
    [&](Team& team)
    {
      FindingsFile findings(folder, "mine", Sharing(&team));
      findings.keep("first", "of somebody");
      findings.keep("of " + std::to_string(team.place()), std::string("a\0b", 3) + std::to_string(team.place()));
      return std::string();
    });
  {
    FindingsFile findings(folder, "mine", Sharing());
    EXPECT_EQ(findings.take("of 1").value_or(""), std::string("a\0b1", 4));
    EXPECT_FALSE(findings.take("of 1")) << "is given once";
    EXPECT_FALSE(findings.take("of 3"));
    findings.keep("of 1", "changed");
    EXPECT_FALSE(findings.take("of 1")) << "is for the next run";
    EXPECT_THROW(FindingsFile(folder, "mine", Sharing()), cactus::FileError) << "another one is at work";
  }
  EXPECT_THROW(FindingsFile(folder, "yours", Sharing()), cactus::InvalidInput);
  const auto told = cactus_testing::inTeam(2,
    [&](Team& team)
    {
      FindingsFile findings(folder, "mine", Sharing(&team));
      return findings.take("of 2").value_or("").substr(3) + findings.take("first").value_or("");
    });
  EXPECT_EQ(told, std::vector<std::string>(2, "2of somebody"));
  FindingsFile findings(folder, "mine", Sharing());
  findings.remove();
  EXPECT_TRUE(fs::is_empty(folder));
  fs::remove(folder);
}

} // namespace
