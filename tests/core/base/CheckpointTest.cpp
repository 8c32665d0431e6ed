// SPDX-License-Identifier: BSD-3-Clause
#include "base/Checkpoint.h"
#include "ScratchPath.h"

#include "RandomBundle.h"
#include "Sanitized.h"
#include "base/Error.h"
#include "optimiser/CapsuleOptimizer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <random>
#include <string>
#include <unistd.h>
#include <vector>

namespace
{

using cactus_testing::contentOf;

using namespace cactus;

void replaceContent(const std::string& path, const std::string& content)
{
  std::ofstream(path, std::ios::binary).write(content.data(), static_cast<std::streamsize>(content.size()));
}

/// Returns the content with its checksum.
std::string sealed(std::string content)
{
  content.resize(content.size() - 8);
  const std::uint64_t checksum = hash64(content.data(), content.size());
  return content.append(reinterpret_cast<const char*>(&checksum), sizeof(checksum));
}

/// A small interrupted run with its checkpoint file.
class CheckpointFiles : public testing::TestWithParam<DescentMethod>
{
protected:
  void SetUp() override
  {
    std::filesystem::remove_all(this->folder);
    std::filesystem::create_directories(this->folder);
    this->start = randomBundle(5, 4, 6, 3.0, 0.1);
    this->options.method = this->GetParam();
    this->options.stepSize = 0.02;
    this->options.radiusTolerance = 0.02;
    this->options.overlapTolerance = 1e-9;
    this->options.maximumIterations = 4;
    this->options.checkpointFile = this->path;
    this->options.checkpointInterval = 0.0;
    ASSERT_EQ(this->message(), "");
    this->whole = contentOf(this->path);
    this->reached = this->result;
    this->options.maximumIterations = 6;
    this->options.resume = true;
  }

  void TearDown() override { std::filesystem::remove_all(this->folder); }

  /// Returns the error of a run that continues from the present file (or does not, by `options`); empty on success. Its fibres
  /// are then in `result`.
  std::string message()
  {
    Fibres fibres = this->start;
    Context context;
    context.threads = 1;
    try
    {
      optimise(fibres, this->options, context);
    }
    catch (const Error& error)
    {
      EXPECT_EQ(fibres.points, this->start.points);
      return error.what();
    }
    this->result = fibres;
    return "";
  }

  /// Expects the file, with this content, to be refused by name and left alone, whether a run is to continue from it or not.
  void expectRefused(const std::string& content, const std::string& how)
  {
    replaceContent(this->path, content);
    for (const bool resume : { true, false })
    {
      this->options.resume = resume;
      const std::string said = this->message();
      ASSERT_EQ(said.find("CheckpointFile " + this->path), 0u) << how << ": " << said;
      ASSERT_NE(said.find("remove it"), std::string::npos) << how << ": " << said;
    }
    this->options.resume = true;
    ASSERT_EQ(contentOf(this->path), content) << how;
  }

  const std::string folder = testing::TempDir() + "cactus-checkpoints-" + std::to_string(::getpid());
  const std::string path = folder + "/run.checkpoint";
  CapsuleOptimizerOptions options;
  Fibres start;
  Fibres result;
  Fibres reached; ///< state at the interruption
  std::string whole;
};

} // namespace

// The known answer of XXH3_64bits (`xxhsum -H3`): checkpoints have the same checksums with any version of the library.
TEST(Checkpoint, ChecksumIsXxh3)
{
  const std::string text = "synthetic white matter, made of fibres that keep apart";
  EXPECT_EQ(hash64(text.data(), text.size()), 0x07d9a92399ef92c6u);
  Hash64 bytewise;
  for (const char& c : text)
  {
    bytewise.add(&c, 1);
  }
  EXPECT_EQ(bytewise.value(), 0x07d9a92399ef92c6u);
  EXPECT_EQ(bytewise.text(), "xxh3-7d9a92399ef92c6");
}

// Guarantee: a file with any damage is refused by name, and no run continues from it: one to three flipped bits anywhere...
TEST_P(CheckpointFiles, RefuseFlippedBits)
{
  std::mt19937 engine(7);
  std::uniform_int_distribution<std::size_t> bits(0, 8 * this->whole.size() - 1);
  for (int i = 0; i < fewerWhereSanitized(1500); ++i)
  {
    std::string damaged = this->whole;
    for (int flips = 0; flips <= i % 3; ++flips)
    {
      const std::size_t bit = bits(engine);
      damaged[bit / 8] = static_cast<char>(damaged[bit / 8] ^ (1 << bit % 8));
    }
    if (damaged != this->whole)
    {
      this->expectRefused(damaged, "flip " + std::to_string(i));
    }
  }
}

// ... a file that is too short or too long; parts exchanged, left out, written twice; another byte order; other content.
TEST_P(CheckpointFiles, RefuseWhatIsCutExchangedOrSomethingElse)
{
  for (std::size_t length = 0; length < this->whole.size(); length += 1 + length / 40)
  {
    this->expectRefused(this->whole.substr(0, length), "cut to " + std::to_string(length));
  }
  this->expectRefused(this->whole.substr(0, this->whole.size() - 1), "without its last byte");
  this->expectRefused(this->whole + '\0', "with a byte more");
  this->expectRefused(this->whole + this->whole, "twice");
  std::mt19937 engine(8);
  std::uniform_int_distribution<std::size_t> places(0, this->whole.size() / 8 - 2);
  for (int i = 0; i < 300; ++i)
  {
    std::string damaged = this->whole;
    const std::size_t a = 8 * places(engine);
    const std::size_t b = 8 * places(engine);
    if (i % 3 == 0)
    {
      std::swap_ranges(damaged.begin() + static_cast<std::ptrdiff_t>(a), damaged.begin() + static_cast<std::ptrdiff_t>(a + 8),
        damaged.begin() + static_cast<std::ptrdiff_t>(b));
    }
    else if (i % 3 == 1)
    {
      damaged.erase(a, 8);
    }
    else
    {
      damaged.insert(a, damaged.substr(b, 8));
    }
    if (damaged != this->whole)
    {
      this->expectRefused(damaged, "parts " + std::to_string(a) + " and " + std::to_string(b));
    }
  }
  std::string other = this->whole;
  std::reverse(other.begin() + 20, other.begin() + 28);
  this->expectRefused(sealed(other), "another byte order");
  this->expectRefused("CACTUS checkpoint 6\n" + this->whole.substr(20), "an older format");
  EXPECT_NE(this->message().find("was written by another version of this program"), std::string::npos) << this->message();
  this->expectRefused("my thesis\n" + this->whole, "something else");
  this->expectRefused("my thesis\n", "something else");
  this->expectRefused("", "an empty file");
}

// Guarantee: even with a correct checksum, no content of a checkpoint leads out of an array, to NaN, or to an endless loop.
TEST_P(CheckpointFiles, ChecksumsAreNotTheOnlyCheck)
{
  std::mt19937 engine(9);
  std::uniform_int_distribution<std::size_t> places(28, this->whole.size() - 16);
  std::uniform_int_distribution<int> kinds(0, 5);
  constexpr int samples = fewerWhereSanitized(1200);
  int refused = 0;
  for (int i = 0; i < samples; ++i)
  {
    std::string damaged = this->whole;
    const std::size_t at = places(engine) / 4 * 4;
    const std::uint64_t values[] = { engine(), ~std::uint64_t(0), 0, std::uint64_t(1) << 62, 0x7ff8000000000000u,
      0x7fefffffffffffffu };
    const std::uint64_t value = values[kinds(engine)];
    std::copy_n(reinterpret_cast<const char*>(&value), i % 2 == 0 ? 4 : 8, damaged.begin() + static_cast<std::ptrdiff_t>(at));
    replaceContent(this->path, sealed(damaged));
    this->result = this->start;
    if (!this->message().empty())
    {
      ++refused;
    }
    for (const Eigen::Vector3d& point : this->result.points)
    {
      ASSERT_TRUE(point.allFinite()) << i;
    }
  }
  EXPECT_GT(refused, samples / 6);
}

// Guarantee: if no two points of a checkpoint are the same, but some are so near each other that a run from them gives NaN, the
// run ends with an error that names the file, which is kept.
TEST_P(CheckpointFiles, LeadToNumbersOrAnError)
{
  const Eigen::Vector3d places[2] = { Eigen::Vector3d::Zero(), Eigen::Vector3d(1e-155, 0.0, 0.0) };
  std::string damaged = this->whole;
  int replaced = 0;
  for (int i = 0; i < 2; ++i)
  {
    const std::string point(reinterpret_cast<const char*>(&this->reached.points[static_cast<std::size_t>(i)]), sizeof(places[i]));
    for (std::size_t at = damaged.find(point); at != std::string::npos; at = damaged.find(point, at))
    {
      damaged.replace(at, point.size(), reinterpret_cast<const char*>(&places[i]), sizeof(places[i]));
      ++replaced;
    }
  }
  ASSERT_GE(replaced, 2);
  replaceContent(this->path, sealed(damaged));
  EXPECT_EQ(this->message().find("CheckpointFile " + this->path + " holds a state from which fibres leave all bounds"), 0u)
    << this->message();
  EXPECT_EQ(contentOf(this->path), sealed(damaged));
}

INSTANTIATE_TEST_SUITE_P(Methods, CheckpointFiles, testing::Values(DescentMethod::Momentum, DescentMethod::Adagrad),
  [](const auto& info) { return info.param == DescentMethod::Momentum ? "Momentum" : "Adagrad"; });

// Guarantee: without Resume, a checkpoint of another run is kept and refused before any work, and one of the same run is replaced
// only by one that has come as far.
TEST(Checkpoint, OfARunIsNotLostToAnother)
{
  const std::string path = cactus_testing::scratchPath("checkpoint-kept");
  std::remove(path.c_str());
  const Fibres start = randomBundle(5, 4, 6, 3.0, 0.1);
  CapsuleOptimizerOptions options;
  options.checkpointFile = path;
  options.checkpointInterval = 0.0;
  options.overlapTolerance = 1e-9;
  int iterations = 0;
  const auto message = [&](const CapsuleOptimizerOptions& with, int until)
  {
    Fibres fibres = start;
    CapsuleOptimizerOptions now = with;
    now.maximumIterations = until;
    iterations = 0;
    try
    {
      return optimise(fibres, now, {}, [&](const ConvergenceRow&, const Fibres&) { ++iterations; }).checkpointFailure;
    }
    catch (const Error& error)
    {
      return std::string(error.what());
    }
  };
  ASSERT_EQ(message(options, 8), "");
  ASSERT_EQ(iterations, 9);
  const std::string eight = contentOf(path);
  CapsuleOptimizerOptions other = options;
  other.stepSize *= 0.9;
  EXPECT_NE(message(other, 20).find("other fibres or other parameters, and is kept"), std::string::npos);
  EXPECT_EQ(iterations, 0);
  EXPECT_EQ(contentOf(path), eight);
  // The same run from the beginning: less far, it leaves the file alone.
  EXPECT_EQ(message(options, 5), "");
  EXPECT_EQ(iterations, 6);
  EXPECT_EQ(contentOf(path), eight);
  EXPECT_EQ(message(options, 12), "");
  EXPECT_EQ(iterations, 13);
  options.resume = true;
  EXPECT_EQ(message(options, 14), "");
  EXPECT_EQ(iterations, 3);
  // Another run's file that appears meanwhile is not replaced either, and the run reports it.
  options.resume = false;
  std::remove(path.c_str());
  Fibres fibres = start;
  options.maximumIterations = 12;
  Context context;
  std::string told;
  context.progress = [&](double, const std::string& message) { told = message; };
  const std::string failure = optimise(fibres, options, context,
    [&](const ConvergenceRow& row, const Fibres&)
    {
      if (row.iteration == 2)
      {
        replaceContent(path, "my thesis, until now safe here\n");
      }
    }).checkpointFailure;
  EXPECT_NE(failure.find("not a checkpoint of this program, and is kept"), std::string::npos) << failure;
  EXPECT_NE(told.find("; cannot be written down: "), std::string::npos) << "and says so meanwhile: " << told;
  EXPECT_EQ(contentOf(path), "my thesis, until now safe here\n");
  std::remove(path.c_str());
}

// Guarantee: a folder or a device is refused at once, and nothing is left beside it.
TEST(Checkpoint, IsAFile)
{
  const std::string folder = cactus_testing::scratchPath("checkpoint-folder");
  std::filesystem::create_directories(folder + "/occupied");
  for (const bool resume : { true, false })
  {
    for (const std::string& path : { folder, std::string("/dev/zero") })
    {
      CapsuleOptimizerOptions options;
      options.checkpointFile = path;
      options.resume = resume;
      Fibres fibres = randomBundle(5, 4, 6, 3.0, 0.1);
      EXPECT_THROW(optimise(fibres, options, {}), FileError) << path;
    }
  }
  std::filesystem::remove_all(folder);
}
