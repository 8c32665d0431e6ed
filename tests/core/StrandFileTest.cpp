// SPDX-License-Identifier: BSD-3-Clause
#include "StrandFile.h"

#include "Error.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace
{

std::string scratch(const std::string& name)
{
  return (std::filesystem::path(::testing::TempDir()) / name).string();
}

std::string messageOf(const std::string& text)
{
  const std::string path = scratch("bad.strands");
  std::ofstream(path) << text;
  try
  {
    cactus::readStrandFile(path);
  }
  catch (const cactus::Error& error)
  {
    return error.what();
  }
  return "";
}

} // namespace

// Guarantee: what is written is read back to nine significant digits.
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
  ASSERT_EQ(back.size(), 1u);
  ASSERT_EQ(back.points.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i)
  {
    EXPECT_LT((back.points[i] - fibres.points[i]).norm(), 1e-6);
  }
  EXPECT_DOUBLE_EQ(back.targetRadii[0], 0.5);
  EXPECT_DOUBLE_EQ(back.domain.upper[2], 6.25);
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
    EXPECT_EQ(entry.path().string().find(".partial-"), std::string::npos) << entry.path();
  }
  std::filesystem::remove_all(folder);
}
