// SPDX-License-Identifier: BSD-3-Clause
// Guarantee: records added to a log are in it when it is opened again, up to a cut or damage, and only for their own work.
#include "io/RecordLog.h"

#include "base/Error.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <unistd.h>
#include <vector>

namespace
{

namespace fs = std::filesystem;
using cactus::RecordLog;
using Records = std::vector<std::string>;

TEST(RecordLog, HoldsAllThatWasAddedBeforeAnyCut)
{
  const std::string path = (fs::path(::testing::TempDir()) / ("record-log-" + std::to_string(::getpid()))).string();
  fs::remove(path);
  const Records wanted = { "one", "", std::string("\0two", 4), std::string(5000, 'x') };
  std::vector<std::uintmax_t> ends;
  {
    RecordLog log(path, "mine");
    EXPECT_TRUE(log.takeRecords().empty());
    EXPECT_THROW(RecordLog(path, "mine"), cactus::FileError); // it is in use
    ends.push_back(fs::file_size(path));
    for (const std::string& record : wanted)
    {
      log.add(record);
      ends.push_back(fs::file_size(path));
    }
  }
  EXPECT_THROW(RecordLog(path, "yours"), cactus::InvalidInput);
  EXPECT_EQ(RecordLog(path, "mine").takeRecords(), wanted);
  const std::string copy = path + "-cut";
  for (std::uintmax_t length = ends.front(); length <= ends.back(); length += length < 100 ? 1 : 97)
  {
    fs::copy_file(path, copy, fs::copy_options::overwrite_existing);
    fs::resize_file(copy, length);
    Records whole;
    while (whole.size() < wanted.size() && ends[whole.size() + 1] <= length)
    {
      whole.push_back(wanted[whole.size()]);
    }
    {
      RecordLog log(copy, "mine");
      EXPECT_EQ(log.takeRecords(), whole) << length;
      log.add("more");
    }
    whole.emplace_back("more");
    EXPECT_EQ(RecordLog(copy, "mine").takeRecords(), whole) << length;
  }
  std::ofstream(copy) << "a file of somebody's that is long enough";
  EXPECT_THROW(RecordLog(copy, "mine"), cactus::FileError);
  EXPECT_EQ(fs::file_size(copy), 40u);
  fs::remove(copy);
  fs::remove(path);
}

} // namespace
