// SPDX-License-Identifier: BSD-3-Clause
#include "io/StrandFile.h"
#include "ScratchPath.h"

#include "base/Error.h"
#include "fibres/JoinFibres.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <sys/stat.h>

namespace
{

std::string scratch(const std::string& name)
{
  return cactus_testing::scratchPath(name);
}

std::string messageOf(const std::string& text)
{
  const std::string path = scratch("bad.strands");
  std::ofstream(path) << text;
  std::string message;
  try
  {
    cactus::readStrandFile(path);
  }
  catch (const cactus::Error& error)
  {
    message = error.what();
  }
  std::filesystem::remove(path);
  return message;
}

} // namespace

// Guarantee: fibres are read back to nine significant digits.
TEST(StrandFile, RoundTrip)
{
  cactus::Fibres fibres;
  fibres.domain = cactus::Domain::cube(12.5);
  fibres.addFibre(1, 1, 0.5);
  fibres.addPoint({ 1.23456789e-3, -2.0 / 3.0, -6.25 }, 0.5);
  fibres.addPoint({ 0.1, 123.456789, 6.25 }, 0.5);
  const std::string path = scratch("round.strands");
  cactus::writeStrandFile(fibres, path);
  const cactus::Fibres back = cactus::readStrandFile(path);
  std::filesystem::remove(path);
  ASSERT_EQ(back.size(), 1u);
  ASSERT_EQ(back.points.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i)
  {
    EXPECT_LT((back.points[i] - fibres.points[i]).norm(), 1e-6);
  }
  EXPECT_DOUBLE_EQ(back.targetRadii[0], 0.5);
  EXPECT_DOUBLE_EQ(back.domain.upper[2], 6.25);
}

TEST(StrandFile, HoldsABoxByItsThreeSides)
{
  cactus::Fibres fibres;
  fibres.domain.upper = Eigen::Vector3d(2.0, 2.5, 9.0);
  fibres.domain.lower = -fibres.domain.upper;
  fibres.addFibre(1, 1, 0.5);
  fibres.addPoint({ 0.0, 0.0, -9.0 }, 0.5);
  fibres.addPoint({ 0.0, 0.0, 9.0 }, 0.5);
  const std::string path = scratch("box.strands");
  cactus::writeStrandFile(fibres, path);
  std::ifstream file(path);
  std::string first;
  std::getline(file, first);
  EXPECT_EQ(first, "4 5 18");
  EXPECT_TRUE(cactus::isSame(cactus::readStrandFile(path).domain, fibres.domain));
  std::filesystem::remove(path);
  fibres.domain.upper[0] = 3.0;
  EXPECT_THROW(cactus::writeStrandFile(fibres, path), cactus::InvalidInput);
  for (const char* wrong : { "4 5\n", "4 5 0\n", "4 5 6 7\n", "4 -5 6\n" })
  {
    std::istringstream text(std::string(wrong) + "1\n2\n0 0 0 1\n0 0 1 1\n");
    EXPECT_THROW(cactus::readStrandFile(text, "box"), cactus::FileError) << wrong;
  }
}

// Guarantee: a folder or a pipe is refused, and never waited for.
TEST(StrandFile, ReadsNoFolderAndNoPipe)
{
  const std::string pipe = scratch("pipe.strands");
  std::filesystem::remove(pipe);
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  for (const std::string& path : { pipe, ::testing::TempDir() })
  {
    try
    {
      cactus::readStrandFile(path);
      ADD_FAILURE() << path << " was read";
    }
    catch (const cactus::FileError& error)
    {
      EXPECT_NE(std::string(error.what()).find(path), std::string::npos) << error.what();
      EXPECT_EQ(std::string(error.what()).find("filebuf"), std::string::npos) << error.what();
    }
  }
  std::filesystem::remove(pipe);
}

// Guarantee: bad input gets one clear error that names the place.
TEST(StrandFile, NamesWhatIsWrongAndWhere)
{
  EXPECT_NE(messageOf("30\n1\n2\n0 0 0 1\n").find("truncated"), std::string::npos);
  EXPECT_NE(messageOf("30\n1\n2\n0 0 zero 1\n0 0 1 1\n").find("line 4"), std::string::npos);
  EXPECT_NE(messageOf("30\n1\n2\n0 0 0 1\n0 0 nan 1\n").find("line 5"), std::string::npos);
  EXPECT_NE(messageOf("30\n1\n2\n0 0 0 1\n0 0 1 -1\n").find("fibre 1"), std::string::npos);
  EXPECT_NE(messageOf("30\n1\n1\n0 0 0 1\n").find("at least two"), std::string::npos);
  EXPECT_NE(messageOf("30\n1\n2\n0 0 0 1\n0 0 0 1\n").find("zero-length"), std::string::npos);
  EXPECT_NE(messageOf("-3\n1\n").find("side"), std::string::npos);
  EXPECT_NE(messageOf("").find("truncated"), std::string::npos);
  EXPECT_THROW(cactus::readStrandFile(scratch("missing.strands")), cactus::FileError);
}

// Guarantee: missing, surplus and misplaced content of a file is an error that names the line, never fewer fibres.
TEST(StrandFile, TakesAllOfAFileOrRefusesIt)
{
  const auto strands = [](const std::string& header, int count)
  {
    std::string text = header;
    for (int s = 0; s < count; ++s)
    {
      const std::string x = std::to_string(s);
      text += "3\n" + x + " 0 0 0.5\n" + x + " 0 1 0.5\n" + x + " 0 2 0.5\n";
    }
    return text;
  };
  const auto expectAt = [](const std::string& line, const std::string& text)
  { EXPECT_NE(messageOf(text).find("line " + line + ":"), std::string::npos) << messageOf(text); };
  EXPECT_EQ(messageOf(strands("30\n23\n", 23)), "");
  // Counts below, or above, the real number.
  expectAt("23", strands("30\n5\n", 23));
  EXPECT_NE(messageOf(strands("30\n24\n", 23)).find("after line 94"), std::string::npos);
  // The first two lines exchanged, with sides below and above the number.
  expectAt("15", strands("23\n3\n", 23));
  EXPECT_NE(messageOf(strands("23\n30\n", 23)).find("after line 94"), std::string::npos);
  expectAt("2", strands("23\n30.5\n", 23));
  // Text after the end.
  expectAt("95", strands("30\n23\n", 23) + "and so on\n");
  expectAt("97", strands("30\n23\n", 23) + "\n \t\r\n3\n");
  EXPECT_EQ(messageOf(strands("30\n23\n", 23) + "\n \t\r\n\n"), "");
  // Counts that are no whole numbers, or unreasonable: all are refused.
  for (const std::string count : { "2.5", "-1", "0", "nan", "inf", "1e300", "99999999999", "two", "2 2", "2x" })
  {
    expectAt("2", "30\n" + count + "\n2\n0 0 0 1\n0 0 1 1\n");
    expectAt("3", "30\n1\n" + count + "\n0 0 0 1\n0 0 1 1\n");
  }
  expectAt("3", "30\n1\n1\n0 0 0 1\n");
  EXPECT_NE(messageOf("30\n2000000000\n2\n0 0 0 1\n0 0 1 1\n").find("after line 5"), std::string::npos);
  EXPECT_NE(messageOf("30\n1\n2000000000\n0 0 0 1\n0 0 1 1\n").find("after line 5"), std::string::npos);
  // A value missing, or one too many: the line where it is, not where the numbers run out.
  expectAt("4", "30\n1\n2\n0 0 0\n0 0 1 1\n1");
  expectAt("5", "30\n1\n2\n0 0 0 1\n0 0 1 1 1\n");
  expectAt("1", "30 1\n2\n0 0 0 1\n0 0 1 1\n");
  for (const char* bad : { "0 0 1.2.3 1", "0 0 1-2 1", "0 0 1 1mm", "0 0 0,5 1", "0 0 1 0x", "0;0;1;1", "0 0 1e400 1" })
  {
    expectAt("5", std::string("30\n1\n2\n0 0 0 1\n") + bad + "\n");
  }
  expectAt("1", "0\n1\n2\n0 0 0 1\n0 0 1 1\n");
}

// Guarantee: a file is read whatever its line ends, with tabs, a byte order mark, and numbers in every usual form.
TEST(StrandFile, ReadsWhatEditorsMakeOfIt)
{
  const std::string path = scratch("edited.strands");
  for (const std::string end : { "\n", "\r\n", "\r", "  \n\n" })
  {
    for (const bool last : { true, false })
    {
      std::ofstream(path, std::ios::binary) << "\xef\xbb\xbf+30." << end << "1.0" << end << "\t2" << end << "1e-3\t+1.5 -.5\t1."
                                            << end << "  .25 2E0 0x1p0 5e-1" << (last ? end : "");
      const cactus::Fibres fibres = cactus::readStrandFile(path);
      ASSERT_EQ(fibres.points.size(), 2u);
      EXPECT_EQ(fibres.points[0], Eigen::Vector3d(1e-3, 1.5, -0.5));
      EXPECT_EQ(fibres.points[1], Eigen::Vector3d(0.25, 2.0, 1.0));
      EXPECT_EQ(fibres.radii, (std::vector<double>{ 1.0, 0.5 }));
      EXPECT_EQ(fibres.domain.size()[0], 30.0);
    }
  }
  std::filesystem::remove(path);
}

// Guarantee: a file that is no text ends soon, with an error.
TEST(StrandFile, RefusesWhatIsNoTextFile)
{
  const auto message = [](const std::string& path)
  {
    try
    {
      cactus::readStrandFile(path);
    }
    catch (const cactus::FileError& error)
    {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(message(::testing::TempDir()).find("cannot read"), std::string::npos) << message(::testing::TempDir());
  if (std::filesystem::exists("/dev/zero"))
  {
    EXPECT_NE(message("/dev/zero").find("line 1"), std::string::npos);
  }
}

// Guarantee: nothing half-written is left behind.
TEST(StrandFile, LeavesNothingBehindWhereItCannotWrite)
{
  cactus::Fibres fibres;
  fibres.addFibre(1, 1, 0.5);
  fibres.addPoint({ 0, 0, 0 }, 0.5);
  fibres.addPoint({ 0, 0, 1 }, 0.5);
  EXPECT_THROW(cactus::writeStrandFile(fibres, scratch("no/such/folder/x.strands")), cactus::FileError);
  const std::string folder = scratch("taken.strands");
  std::filesystem::create_directories(folder + "/occupied");
  EXPECT_THROW(cactus::writeStrandFile(fibres, folder), cactus::FileError);
  for (const auto& entry : std::filesystem::directory_iterator(::testing::TempDir()))
  {
    const std::string path = entry.path().string();
    EXPECT_TRUE(path.find(folder) != 0 || path.find(".partial-") == std::string::npos) << path;
  }
  std::filesystem::remove_all(folder);
}
