// SPDX-License-Identifier: BSD-3-Clause
// Guarantee: a user's files in a folder survive writing it again, and a kill at any moment.
#include "io/FolderReplacement.h"

#include "ChildProcess.h"
#include "ScratchPath.h"
#include "base/Error.h"
#include "io/SubstrateFolder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <sstream>
#include <sys/resource.h>
#include <thread>

namespace fs = std::filesystem;

namespace
{

using cactus_testing::contentOf;

void put(const fs::path& path, const std::string& text)
{
  std::ofstream(path, std::ios::binary) << text;
}

/// Returns every file with its content, every folder and link.
std::map<std::string, std::string> snapshot(const fs::path& folder)
{
  std::map<std::string, std::string> found;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
  {
    const fs::path path = entry.path();
    found[path.lexically_relative(folder).string()] = entry.is_symlink()     ? "link to " + fs::read_symlink(path).string()
                                                      : entry.is_directory() ? "folder"
                                                                             : contentOf(path);
  }
  return found;
}

/// Returns the error message, or nothing.
std::string write(const fs::path& folder, double size = 1.0, int threads = 1)
{
  cactus::TriangleMesh mesh;
  mesh.points = { { 0, 0, 0 }, { size, 0, 0 }, { 0, size, 0 }, { 0, 0, size } };
  mesh.triangles = { { { 0, 2, 1 } }, { { 0, 1, 3 } }, { { 0, 3, 2 } }, { { 1, 2, 3 } } };
  cactus::SubstrateFolderContents contents;
  contents.domain = cactus::Domain::cube(200.0); // from which no walker leaves, so that none has to walk
  contents.outer.fibreIds = { 2, 7 };
  contents.outer.bundleIds = { 1, 1 };
  contents.outer.mesh = [mesh](std::size_t) { return mesh; };
  contents.inner.fibreIds = { 2 };
  contents.inner.bundleIds = { 1 };
  contents.inner.mesh = contents.outer.mesh;
  cactus::Context context;
  context.threads = threads;
  try
  {
    cactus::writeSubstrateFolder(contents, folder.string(), context);
    return "";
  }
  catch (const cactus::Error& error)
  {
    return error.what();
  }
}

bool contains(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}

class FolderReplacement : public ::testing::Test
{
protected:
  void SetUp() override
  {
    // In memory if possible, since some tests write hundreds of folders.
    const fs::path memory = "/dev/shm";
    std::error_code error;
    this->Scratch =
      (fs::is_directory(memory, error) && ::access(memory.c_str(), W_OK) == 0 ? memory : fs::path(::testing::TempDir())) /
      ("folder-replacement-test-" + std::to_string(::getpid()));
    fs::remove_all(this->Scratch);
    fs::create_directories(this->Scratch);
    this->Folder = this->Scratch / "s";
  }
  void TearDown() override { fs::remove_all(this->Scratch); }

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
  /// Expects that writing again is refused with these words, and leaves everything unchanged.
  void expectRefused(const std::vector<std::string>& words)
  {
    const auto before = snapshot(this->Scratch);
    const std::string message = write(this->Folder, 2.0);
    for (const std::string& word : words)
    {
      EXPECT_TRUE(contains(message, word)) << message;
    }
    EXPECT_EQ(snapshot(this->Scratch), before);
  }

  using Names = std::vector<std::string>;
  fs::path Scratch;
  fs::path Folder;
};

} // namespace

TEST_F(FolderReplacement, KeepsWhatTheUserChanged)
{
  for (const char* path : { "mcdc/intra.conf", "mcdc/extra.conf", "mcdc/pgse.scheme", "README.txt", "certificate.csv",
         "outer/fibre_00002.ply", "manifest.json" })
  {
    ASSERT_EQ(write(this->Folder), "");
    std::ofstream(this->Folder / path, std::ios::app) << "\n";
    this->expectRefused({ "changed after they were written", path, "choose another FolderName" });
    fs::remove_all(this->Folder);
  }
  // The same length, and the times as they were.
  ASSERT_EQ(write(this->Folder), "");
  const fs::path conf = this->Folder / "mcdc/intra.conf";
  const auto time = fs::last_write_time(conf);
  std::string text = contentOf(conf);
  text.replace(text.find("N 1000"), 6, "N 9000");
  put(conf, text);
  fs::last_write_time(conf, time);
  this->expectRefused({ "mcdc/intra.conf" });
}

TEST_F(FolderReplacement, KeepsWhatTheUserAdded)
{
  const fs::path outside = this->Scratch / "outside";
  fs::create_directory(outside);
  put(outside / "data", "precious");
  for (const char* path :
    { "notes.txt", ".hidden", "outer/mine.ply", "inner/fibre_00099.ply", "mcdc/long.conf", "outer/notes\nof two lines" })
  {
    ASSERT_EQ(write(this->Folder), "");
    put(this->Folder / path, "precious");
    this->expectRefused({ "other data", path });
    fs::remove_all(this->Folder);
  }
  ASSERT_EQ(write(this->Folder), "");
  put(this->Folder / "mcdc/output/intra_DWI.txt", "precious");
  this->expectRefused({ "results of simulations (mcdc/output/intra_DWI.txt)" });
  fs::remove(this->Folder / "mcdc/output/intra_DWI.txt");
  fs::create_directory(this->Folder / "empty");
  this->expectRefused({ "other data (empty/)" });
  fs::remove(this->Folder / "empty");
  fs::create_directory_symlink(outside, this->Folder / "link");
  this->expectRefused({ "other data (link)" });
  fs::remove(this->Folder / "link");
  fs::rename(this->Folder / "outer", this->Scratch / "outer");
  fs::create_directory_symlink("../outer", this->Folder / "outer");
  this->expectRefused({ "other data (outer)" });
  fs::remove(this->Folder / "outer");
  fs::remove_all(this->Scratch / "outer");
  for (int i = 0; i < 20; ++i)
  {
    put(this->Folder / ("note" + std::to_string(100 + i)), "precious");
  }
  this->expectRefused({ "(note100, note101, note102, note103, note104 and 15 more)" });
  for (int i = 0; i < 20; ++i)
  {
    fs::remove(this->Folder / ("note" + std::to_string(100 + i)));
  }
  EXPECT_EQ(write(this->Folder), "") << "what is missing is no loss";
  EXPECT_EQ(contentOf(outside / "data"), "precious");
}

TEST_F(FolderReplacement, KeepsWhatItDoesNotKnow)
{
  fs::create_directory(this->Folder);
  put(this->Folder / "thesis.tex", "precious");
  this->expectRefused({ "not a substrate folder" });
  put(this->Folder / "manifest.json", "{\"format\": \"something else\"}");
  this->expectRefused({ "not a substrate folder" });
  fs::remove(this->Folder / "thesis.tex");
  put(this->Folder / "manifest.json", "{\"format\": \"CACTUS substrate folder\", \"version\": \"0.1.0\", \"files\": []}");
  this->expectRefused({ "early version", "does not tell", "remove the folder" });
  fs::remove_all(this->Folder);
  put(this->Folder, "precious");
  this->expectRefused({ "not a folder" });
}

// The user changes something while the new folder is being written.
TEST_F(FolderReplacement, KeepsWhatTheUserChangesMeanwhile)
{
  ASSERT_EQ(write(this->Folder), "");
  cactus::FolderReplacement replacement(this->Folder.string());
  cactus::FolderWriter(this->Folder, replacement.container()).write("README.txt", "new");
  put(this->Folder / "mcdc/intra.conf", "precious");
  EXPECT_THROW(replacement.commit(), cactus::FileError);
  EXPECT_EQ(contentOf(this->Folder / "mcdc/intra.conf"), "precious");
}

TEST_F(FolderReplacement, KeepsWhatIsWriteProtected)
{
  fs::permissions(this->Scratch, fs::perms::all);
  const auto asUser = [](const std::function<std::string()>& work) {
    return cactus_testing::inChild([&] { return cactus_testing::becomeOrdinaryUser() ? work() : std::string("no other user"); });
  };
  const auto refusal = [&](const std::string& path)
  {
    return asUser(
      [&]
      {
        const auto before = write(this->Folder);
        fs::permissions(this->Folder / path, fs::perms::owner_write, fs::perm_options::remove);
        const auto kept = snapshot(this->Folder);
        const std::string message = before + write(this->Folder, 2.0);
        const bool same = snapshot(this->Folder) == kept;
        fs::permissions(this->Folder / path, fs::perms::owner_write, fs::perm_options::add);
        return same ? message : message + " and changed it";
      });
  };
  for (const char* path : { "", "outer", "mcdc/intra.conf" })
  {
    const std::string message = refusal(path);
    EXPECT_TRUE(contains(message, std::string("write-protected (") + (*path == '\0' ? "." : path) + ")")) << message;
    EXPECT_FALSE(contains(message, "and changed it"));
  }
  fs::permissions(this->Scratch, fs::perms::owner_all | fs::perms::others_read | fs::perms::others_exec);
  EXPECT_TRUE(contains(asUser([this] { return write(this->Scratch / "t"); }), "Permission denied"));
  EXPECT_EQ(this->entries(), Names{ "s" });
}

TEST_F(FolderReplacement, KeepsPermissions)
{
  const mode_t before = ::umask(022);
  ASSERT_EQ(write(this->Folder), "");
  ::umask(before);
  const auto modeOf = [](const fs::path& path)
  {
    struct stat status;
    return ::stat(path.c_str(), &status) == 0 ? status.st_mode & 07777 : 0;
  };
  EXPECT_EQ(modeOf(this->Folder), 0755u);
  EXPECT_EQ(modeOf(this->Folder / "outer"), 0755u);
  EXPECT_EQ(modeOf(this->Folder / "manifest.json"), 0644u);
  EXPECT_EQ(modeOf(this->Folder / "outer/fibre_00002.ply"), 0644u);
  ::chmod(this->Folder.c_str(), 0700);
  ::chmod((this->Folder / "mcdc").c_str(), 0770);
  ::chmod((this->Folder / "README.txt").c_str(), 0660);
  ASSERT_EQ(write(this->Folder), "");
  EXPECT_EQ(modeOf(this->Folder), 0700u);
  EXPECT_EQ(modeOf(this->Folder / "mcdc"), 0770u);
  EXPECT_EQ(modeOf(this->Folder / "README.txt"), 0660u);
}

TEST_F(FolderReplacement, FindsItsPlace)
{
  fs::create_directories(this->Scratch / "a/b");
  EXPECT_EQ(write(this->Scratch / "a/b/../c"), "");
  EXPECT_EQ(write(this->Scratch / "a/d///"), "");
  EXPECT_EQ(write(this->Scratch / "a/d/."), "");
  fs::create_directory_symlink("a/d", this->Scratch / "link");
  EXPECT_EQ(write(this->Scratch / "link"), "");
  EXPECT_EQ(write(this->Scratch / "link/"), "");
  EXPECT_TRUE(fs::is_symlink(this->Scratch / "link"));
  fs::create_directory_symlink("a/e", this->Scratch / "dangling");
  EXPECT_EQ(write(this->Scratch / "dangling"), "");
  EXPECT_TRUE(fs::is_symlink(this->Scratch / "dangling"));
  EXPECT_TRUE(fs::is_directory(this->Scratch / "a/e/outer"));
  fs::create_directory_symlink("round", this->Scratch / "round");
  EXPECT_TRUE(contains(write(this->Scratch / "round"), "Too many levels"));
  EXPECT_EQ(write(this->Scratch / "a/not UTF-8 \xff"), "");
  EXPECT_EQ(write(this->Scratch / "a/not UTF-8 \xff"), "");
  const std::string longest(255 - std::string(".partial").size(), 'x');
  EXPECT_EQ(write(this->Scratch / longest), "") << "the longest name that .partial can be added to";
  EXPECT_EQ(write(this->Scratch / longest), "");
  EXPECT_TRUE(contains(write(this->Scratch / (longest + "x")), "too long"));
  EXPECT_TRUE(contains(write(std::string(5000, 'x')), "too long"));
  EXPECT_TRUE(contains(write(this->Scratch / "no/such"), "make it first"));
  EXPECT_TRUE(contains(write(this->Scratch / "no/.."), "make it first"));
  EXPECT_TRUE(contains(write("~"), "only a shell"));
  EXPECT_TRUE(contains(write("~/s"), "only a shell"));
  EXPECT_TRUE(contains(write("/"), "the folder that this program runs in"));
  EXPECT_TRUE(contains(write("/usr"), ::geteuid() == 0 ? "not a substrate folder" : "Permission denied"));
  EXPECT_TRUE(contains(write("/proc"), "is where a file system is mounted"));
  EXPECT_TRUE(contains(write("/proc/s"), "cannot write folder"));
  put(this->Scratch / "file", "precious");
  EXPECT_TRUE(contains(write(this->Scratch / "file"), "not a folder"));
  EXPECT_TRUE(contains(write(this->Scratch / "file/s"), "Not a directory"));
  EXPECT_EQ(this->entries(), (Names{ "a", "dangling", "file", "link", "round", longest }));
}

// "." in an empty folder, and then "rel": without the check, the folder in which the program runs was replaced, and the next
// write removed it.
TEST_F(FolderReplacement, LeavesTheFolderItRunsIn)
{
  const fs::path here = this->Scratch / "here";
  fs::create_directories(here / "deeper");
  const std::string messages = cactus_testing::inChild(
    [&]
    {
      std::string text;
      fs::current_path(here / "deeper");
      for (const char* folder : { ".", "./", "..", "rel", "./rel", "rel/" })
      {
        text += write(folder) + "|";
      }
      fs::current_path("rel/mcdc");
      text += write("..") + "|";
      fs::current_path(here / "deeper");
      fs::remove_all(here / "deeper");
      for (const char* folder : { ".", "..", "rel" })
      {
        text += write(folder) + "|";
      }
      return text + write(here / "absolute");
    });
  std::vector<std::string> found;
  std::istringstream parts(messages);
  for (std::string part; std::getline(parts, part, '|');)
  {
    found.push_back(part);
  }
  ASSERT_EQ(found.size(), 10u) << messages;
  for (const std::size_t i : { 0u, 1u, 2u, 6u })
  {
    EXPECT_TRUE(contains(found[i], "the folder that this program runs in")) << found[i];
  }
  for (const std::size_t i : { 3u, 4u, 5u })
  {
    EXPECT_EQ(found[i], "");
  }
  for (const std::size_t i : { 7u, 8u, 9u })
  {
    EXPECT_TRUE(contains(found[i], "cannot write folder")) << found[i];
  }
  EXPECT_EQ(snapshot(here).count("absolute/manifest.json"), 1u);
}

TEST_F(FolderReplacement, IsWrittenByOneProcessAtATime)
{
  ASSERT_EQ(write(this->Folder), "");
  std::vector<std::thread> writers;
  std::vector<std::string> messages(4);
  const std::string refusal = "cannot write folder " + this->Folder.string() + ": another process is writing it at this moment";
  for (std::size_t i = 0; i < messages.size(); ++i)
  {
    writers.emplace_back(
      [this, i, &messages, &refusal]
      {
        for (int round = 0; round < 25; ++round)
        {
          const std::string message = write(this->Folder, 1.0 + static_cast<double>(i));
          messages[i] += contains(message, refusal) ? "" : message;
        }
      });
  }
  for (auto& writer : writers)
  {
    writer.join();
  }
  EXPECT_EQ(messages, std::vector<std::string>(4));
  EXPECT_EQ(this->entries(), Names{ "s" });
  EXPECT_EQ(write(this->Folder), "") << "it is whole";
}

TEST_F(FolderReplacement, LosesNothingWhereTheDiskIsFull)
{
  ASSERT_EQ(write(this->Folder), "");
  const auto before = snapshot(this->Scratch);
  const std::string limited = cactus_testing::inChild(
    [this]
    {
      ::signal(SIGXFSZ, SIG_IGN);
      const rlimit limit{ 1000, 1000 };
      ::setrlimit(RLIMIT_FSIZE, &limit);
      return write(this->Folder, 2.0);
    });
  EXPECT_TRUE(contains(limited, "File too large")) << limited;
  EXPECT_EQ(snapshot(this->Scratch), before);

  // A tmpfs has room in pages: every number of them, until it is enough.
  fs::create_directory(this->Scratch / "disk");
  int refused = 0;
  for (std::size_t pages = 18;; ++pages)
  {
    const std::string outcome = cactus_testing::inChild(
      [&]
      {
        const fs::path disk = this->Scratch / "disk";
        if (!cactus_testing::mountSmallDisk(disk, pages * 4096))
        {
          return std::string("no mount");
        }
        const std::string first = write(disk / "s");
        if (!first.empty())
        {
          return snapshot(disk).empty() ? first : "left something: " + first;
        }
        const auto former = snapshot(disk);
        const std::string second = write(disk / "s", 2.0);
        return second.empty() || snapshot(disk) == former ? second : "changed something: " + second;
      });
    if (outcome == "no mount")
    {
      GTEST_SKIP() << "a small disk cannot be mounted here";
    }
    if (outcome.empty())
    {
      break;
    }
    ++refused;
    EXPECT_EQ(outcome.substr(0, 20), "cannot write folder ") << outcome;
    EXPECT_TRUE(contains(outcome, "No space left")) << outcome;
    ASSERT_LT(pages, 100u);
  }
  EXPECT_GE(refused, 5);
}

// The writer is killed at every system call that changes files. The name refers to the former or the new folder, whole, or,
// between the two, to none, and the next write first puts the former one back.
TEST_F(FolderReplacement, LeavesAWholeFolderWhereverItIsKilled)
{
  ASSERT_EQ(write(this->Folder, 2.0), "");
  const auto newer = snapshot(this->Folder);
  fs::remove_all(this->Folder);
  ASSERT_EQ(write(this->Folder, 1.0), "");
  const auto former = snapshot(this->Folder);
  int missing = 0;
  int kills = 0;
  for (int call = 1;; ++call)
  {
    const auto fate = cactus_testing::killedAtCall(call, [this] { write(this->Folder, 2.0); });
    if (fate == cactus_testing::Fate::untraceable)
    {
      GTEST_SKIP() << "processes may not be traced here";
    }
    if (!fs::exists(this->Folder))
    {
      ++missing;
      // A write that is refused for another reason puts it back, too.
      put(this->Scratch / "file", "");
      EXPECT_NE(write(this->Folder, std::numeric_limits<double>::quiet_NaN()), "");
    }
    const auto found = snapshot(this->Folder);
    EXPECT_TRUE(found == former || found == newer) << "after call " << call;
    ASSERT_EQ(write(this->Folder, 1.0), "") << "after call " << call;
    EXPECT_EQ(snapshot(this->Folder), former);
    fs::remove(this->Scratch / "file");
    ASSERT_EQ(this->entries(), Names{ "s" }) << "after call " << call;
    if (fate == cactus_testing::Fate::finished)
    {
      break;
    }
    ++kills;
  }
  EXPECT_EQ(missing, 1);
  EXPECT_GE(kills, 60);
}

TEST_F(FolderReplacement, LeavesNothingOfAFirstWriteThatWasKilled)
{
  for (int call = 1;; ++call)
  {
    const auto fate = cactus_testing::killedAtCall(call, [this] { write(this->Folder); });
    if (fate == cactus_testing::Fate::untraceable)
    {
      GTEST_SKIP() << "processes may not be traced here";
    }
    EXPECT_TRUE(!fs::exists(this->Folder) || fs::exists(this->Folder / "manifest.json")) << "after call " << call;
    ASSERT_EQ(write(this->Folder), "") << "after call " << call;
    ASSERT_EQ(this->entries(), Names{ "s" }) << "after call " << call;
    fs::remove_all(this->Folder);
    if (fate == cactus_testing::Fate::finished)
    {
      break;
    }
  }
}

TEST_F(FolderReplacement, LeavesAloneWhatMayBeAnothers)
{
  const fs::path beside = this->Scratch / "s.partial";
  put(beside, "precious");
  this->expectRefused({ "s.partial, in which it would be written, is there already, and not ours" });
  fs::remove(beside);
  fs::create_directory(beside);
  put(beside / "notes", "precious");
  this->expectRefused({ "s.partial, in which it would be written, is there already, and not ours" });
  fs::remove(beside / "notes");
  {
    const cactus::FolderReplacement living(this->Folder.string());
    cactus::FolderWriter(this->Folder, living.container()).write("README.txt", "still being written");
    this->expectRefused({ "another process is writing it at this moment" });
  }
  EXPECT_EQ(this->entries(), Names());
}

// A process was killed while it wrote, or before it had removed the former folder, and then its user worked in what it left.
TEST_F(FolderReplacement, NamesWhatItKeeps)
{
  const fs::path beside = this->Scratch / "s.partial";
  const auto killedWith = [&](const std::string& place)
  {
    fs::remove_all(beside);
    EXPECT_EQ(write(this->Folder), "");
    auto fate = cactus_testing::Fate::killed;
    for (int call = 1; fate == cactus_testing::Fate::killed && !(fs::exists(this->Folder) && fs::exists(beside / place)); ++call)
    {
      EXPECT_EQ(write(this->Folder), "");
      fate = cactus_testing::killedAtCall(call, [this] { write(this->Folder, 2.0); });
    }
    return fate == cactus_testing::Fate::killed;
  };
  if (!killedWith("substrate/mcdc/intra.conf"))
  {
    GTEST_SKIP() << "processes may not be traced here";
  }
  put(beside / "substrate/mcdc/mine.conf", "precious");
  EXPECT_TRUE(contains(write(this->Folder), "s.partial, which an earlier write has left, holds other data (mcdc/mine.conf)"));
  EXPECT_EQ(contentOf(beside / "substrate/mcdc/mine.conf"), "precious");
  ASSERT_TRUE(killedWith("former/mcdc/intra.conf"));
  put(beside / "former/mcdc/intra.conf", "precious");
  const auto before = snapshot(beside);
  EXPECT_TRUE(contains(write(this->Folder), "s.partial, which an earlier write has left, holds files that were changed"));
  EXPECT_EQ(snapshot(beside), before);
  fs::remove_all(beside);
  EXPECT_EQ(write(this->Folder), "");
}
