// SPDX-License-Identifier: BSD-3-Clause
#include "base/AtomicFile.h"

#include "ChildProcess.h"
#include "ScratchPath.h"
#include "base/Error.h"
#include "base/PartialName.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>
#include <vector>

namespace fs = std::filesystem;

namespace
{

using cactus_testing::contentOf;

void put(const fs::path& path, const std::string& text)
{
  std::ofstream(path) << text;
}

mode_t modeOf(const fs::path& path)
{
  struct stat status;
  return ::stat(path.c_str(), &status) == 0 ? status.st_mode & 07777 : 0;
}

/// Writes, and returns the error message.
std::string write(const fs::path& path, const std::string& text)
{
  try
  {
    cactus::AtomicFile file(path.string());
    file.stream() << text;
    file.commit();
  }
  catch (const cactus::FileError& error)
  {
    return error.what();
  }
  return "";
}

class AtomicFile : public ::testing::Test
{
protected:
  void SetUp() override
  {
    this->Scratch = fs::path(::testing::TempDir()) / ("atomic-file-test-" + std::to_string(::getpid()));
    fs::remove_all(this->Scratch);
    fs::create_directories(this->Scratch);
    this->File = this->Scratch / "a.strands";
  }
  void TearDown() override
  {
    fs::permissions(this->Scratch, fs::perms::owner_all);
    fs::remove_all(this->Scratch);
  }
  std::vector<std::string> entries() const
  {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(this->Scratch))
    {
      names.push_back(entry.path().filename().string());
    }
    std::sort(names.begin(), names.end());
    return names;
  }

  using Names = std::vector<std::string>;
  fs::path Scratch;
  fs::path File;
};

} // namespace

TEST_F(AtomicFile, IsThereOnceCommitted)
{
  {
    cactus::AtomicFile file(this->File.string());
    file.stream() << std::string(1 << 20, 'x') << 1234.5;
    EXPECT_FALSE(fs::exists(this->File));
    EXPECT_TRUE(cactus::isPartialName(this->entries().at(0), "a.strands")) << this->entries().at(0);
    EXPECT_EQ(cactus::wholeName(this->entries().at(0)), "a.strands");
    EXPECT_EQ(cactus::wholeName("a.strands.partial-mine"), "a.strands.partial-mine");
    file.commit();
  }
  EXPECT_EQ(fs::file_size(this->File), (1u << 20) + 6);
  {
    cactus::AtomicFile file(this->File.string());
    file.stream() << "given up";
  }
  EXPECT_EQ(fs::file_size(this->File), (1u << 20) + 6);
  EXPECT_EQ(this->entries(), Names{ "a.strands" });
}

TEST_F(AtomicFile, WritesThroughLinks)
{
  fs::create_directory(this->Scratch / "data");
  put(this->Scratch / "data/real", "former");
  fs::create_symlink("data/real", this->Scratch / "second");
  fs::create_symlink("second", this->File);
  EXPECT_EQ(write(this->File, "new"), "");
  EXPECT_TRUE(fs::is_symlink(this->File));
  EXPECT_TRUE(fs::is_symlink(this->Scratch / "second"));
  EXPECT_EQ(contentOf(this->Scratch / "data/real"), "new");

  fs::create_symlink("data/not yet there", this->Scratch / "dangling");
  EXPECT_EQ(write(this->Scratch / "dangling", "new"), "");
  EXPECT_EQ(contentOf(this->Scratch / "data/not yet there"), "new");
  fs::create_symlink("round", this->Scratch / "round");
  EXPECT_NE(write(this->Scratch / "round", "new").find("cannot follow the link"), std::string::npos);
  EXPECT_EQ(this->entries(), (Names{ "a.strands", "dangling", "data", "round", "second" }));
}

TEST_F(AtomicFile, RefusesWhatIsNoFile)
{
  EXPECT_NE(write(this->Scratch, "new").find("it is a folder"), std::string::npos);
  EXPECT_NE(write(this->Scratch / "", "new").find("folder"), std::string::npos);
  EXPECT_NE(write("", "new").find("no name"), std::string::npos);
  EXPECT_NE(write("/dev/null", "new").find("device"), std::string::npos);
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  EXPECT_NE(write(this->Scratch / "no/such", "new").find("No such file"), std::string::npos);
  EXPECT_NE(write(this->Scratch / std::string(300, 'x'), "new").find("too long"), std::string::npos);
  EXPECT_EQ(write(this->Scratch / std::string(255, 'x'), "new"), "") << "the longest name that there is";
  EXPECT_EQ(this->entries().size(), 1u);
}

TEST_F(AtomicFile, KeepsPermissions)
{
  const mode_t before = ::umask(027);
  EXPECT_EQ(write(this->File, "new"), "");
  ::umask(before);
  EXPECT_EQ(modeOf(this->File), 0640u);
  ::chmod(this->File.c_str(), 0604);
  EXPECT_EQ(write(this->File, "newer"), "");
  EXPECT_EQ(modeOf(this->File), 0604u);
}

TEST_F(AtomicFile, RefusesWhatIsProtected)
{
  put(this->File, "precious");
  fs::permissions(this->File, fs::perms::owner_read | fs::perms::others_read);
  fs::permissions(this->Scratch, fs::perms::all);
  const auto writeAsUser = [this]
  {
    return cactus_testing::inChild(
      [this] { return cactus_testing::becomeOrdinaryUser() ? write(this->File, "new") : std::string("no other user"); });
  };
  EXPECT_NE(writeAsUser().find("write-protected"), std::string::npos);
  EXPECT_EQ(contentOf(this->File), "precious");
  fs::remove(this->File);
  fs::permissions(this->Scratch, fs::perms::owner_read | fs::perms::owner_exec | fs::perms::others_read | fs::perms::others_exec);
  EXPECT_NE(writeAsUser().find("Permission denied"), std::string::npos);
  EXPECT_TRUE(this->entries().empty());
}

TEST_F(AtomicFile, LosesNothingWhereTheDiskIsFull)
{
  put(this->File, "precious");
  const std::string limited = cactus_testing::inChild(
    [this]
    {
      ::signal(SIGXFSZ, SIG_IGN);
      const rlimit limit{ 100000, 100000 };
      ::setrlimit(RLIMIT_FSIZE, &limit);
      return write(this->File, std::string(1 << 20, 'x'));
    });
  EXPECT_NE(limited.find("File too large"), std::string::npos) << limited;
  EXPECT_EQ(contentOf(this->File), "precious");
  EXPECT_EQ(this->entries(), Names{ "a.strands" });

  const std::string full = cactus_testing::inChild(
    [this]
    {
      if (!cactus_testing::mountSmallDisk(this->Scratch, 65536))
      {
        return std::string("no mount");
      }
      put(this->File, "precious");
      const std::string message = write(this->File, std::string(1 << 20, 'x'));
      return contentOf(this->File) + " " + std::to_string(this->entries().size()) + " " + message;
    });
  if (full == "no mount")
  {
    GTEST_SKIP() << "a small disk cannot be mounted here";
  }
  EXPECT_EQ(full.substr(0, 11), "precious 1 ");
  EXPECT_NE(full.find("No space left"), std::string::npos) << full;
}

// Whenever a process is killed, the file is the former or the new one, and the next write removes the leftovers.
TEST_F(AtomicFile, OutlivesAKillAtAnyCall)
{
  int kills = 0;
  for (int call = 1;; ++call)
  {
    put(this->File, "former");
    const auto fate = cactus_testing::killedAtCall(call, [this] { write(this->File, "the new one"); });
    if (fate == cactus_testing::Fate::untraceable)
    {
      GTEST_SKIP() << "processes may not be traced here";
    }
    const std::string text = contentOf(this->File);
    EXPECT_TRUE(text == "former" || text == "the new one") << text << " after call " << call;
    EXPECT_EQ(write(this->File, "next"), "");
    EXPECT_EQ(contentOf(this->File), "next");
    EXPECT_EQ(this->entries(), Names{ "a.strands" }) << "after call " << call;
    if (fate == cactus_testing::Fate::finished)
    {
      break;
    }
    ++kills;
  }
  EXPECT_GE(kills, 6);
}

TEST_F(AtomicFile, LeavesAloneWhatMayBeAnothers)
{
  put(this->Scratch / "a.strands.partial-1234", "precious");
  put(this->Scratch / "a.strands.partial-zzzzzzzz00000000", "precious");
  cactus::AtomicFile living(this->File.string());
  living.stream() << "still being written";
  EXPECT_EQ(write(this->File, "new"), "");
  EXPECT_EQ(this->entries().size(), 4u);
  living.commit();
  EXPECT_EQ(contentOf(this->File), "still being written");
  EXPECT_EQ(this->entries().size(), 3u);
}
