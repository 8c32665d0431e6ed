// SPDX-License-Identifier: BSD-3-Clause
// Guarantees: a production writes the same files as growth, surfaces and writer one after the other, bit for bit; one that is
// killed at any place continues there, and writes them too; it touches no work of another one, reports damage, and leaves nothing
// behind.
#include "stages/SubstrateProduction.h"

#include "../ChildProcess.h"
#include "../ThreadTeam.h"
#include "../surface/MeetingFibres.h"
#include "../surface/VanishingFibre.h"
#include "base/Error.h"
#include "base/PartialName.h"
#include "growth/GrowthTarget.h"
#include "growth/TargetRadii.h"
#include "io/SubstrateFolder.h"
#include "surface/MyelinSurface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <unistd.h>
#include <vector>

namespace
{

namespace fs = std::filesystem;
using namespace cactus;

std::map<std::string, std::string> filesIn(const fs::path& folder)
{
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
  {
    if (entry.is_regular_file())
    {
      std::ifstream file(entry.path(), std::ios::binary);
      files[fs::relative(entry.path(), folder).string()] = { std::istreambuf_iterator<char>(file), {} };
    }
  }
  return files;
}

FibreSurfaces surfacesOf(const std::vector<FibreSurfacePair>& pairs, TriangleMesh FibreSurfacePair::*mesh, double gap)
{
  FibreSurfaces surfaces;
  std::vector<TriangleMesh> meshes;
  for (const FibreSurfacePair& pair : pairs)
  {
    if (!(pair.*mesh).triangles.empty())
    {
      surfaces.fibreIds.push_back(pair.fibreId);
      surfaces.bundleIds.push_back(pair.bundleId);
      meshes.push_back(pair.*mesh);
    }
  }
  surfaces.mesh = [meshes](std::size_t i) { return meshes[i]; };
  surfaces.isGiven = true;
  surfaces.promisedGap = gap;
  return surfaces;
}

class Production : public ::testing::Test
{
protected:
  void SetUp() override
  {
    this->Scratch = fs::path(::testing::TempDir()) / ("production-test-" + std::to_string(::getpid()));
    fs::remove_all(this->Scratch);
    fs::create_directories(this->Scratch);
    this->Order.growth.targetFibreVolumeFraction = 0.45;
    this->Order.growth.surfaceTolerance = 0.005; // so that outer surfaces come near each other, and are moved
  }
  void TearDown() override { fs::remove_all(this->Scratch); }

  std::string folder(const std::string& name) const { return (this->Scratch / name).string(); }

  ProducedSubstrate produce(const std::string& name, const Context& context = {}) const
  {
    return produceSubstrate(this->Fibres_, this->Order, this->folder(name), context);
  }

  /// Returns a context under which memory runs out in this part of the work.
  static Context failingAt(const std::string& part)
  {
    Context context;
    context.threads = 1; // with two, the other one may do the whole part while the first reports nothing
    context.progress = [part](double, const std::string& message)
    {
      if (message.find(part) == 0)
      {
        throw std::bad_alloc();
      }
    };
    return context;
  }

  /// Returns the message of its exception, of that kind; empty if it throws nothing.
  template <typename Expected = InvalidInput>
  std::string refusal(const std::string& name, const Context& context = {}) const
  {
    try
    {
      this->produce(name, context);
    }
    catch (const Expected& error)
    {
      return error.what();
    }
    return "";
  }

  /// Runs it in so many processes; each returns what it has found of an earlier run, or why it has ended.
  std::vector<std::string> produceInTeam(
    int size, const std::string& name, const std::function<Context(int place)>& contextOf = [](int) { return Context(); }) const
  {
    return cactus_testing::inTeam(size,
      [&](Team& team)
      {
        Context context = contextOf(team.place());
        context.threads = 1 + team.place() % 2;
        const auto made = produceSubstrate(this->Fibres_, this->Order, this->folder(name), context, &team);
        return std::to_string(made.found) + " found, " + std::to_string(made.written.files.size()) + " files, " +
               made.written.certificate.verdict();
      });
  }

  /// Returns the files of the stages one after the other, with the label image in memory.
  std::map<std::string, std::string> filesOfStages() const
  {
    const FibreRadialGrowthOptions& growth = this->Order.growth;
    const Fibres aimed = aimAtTargetRadii(this->Fibres_, growth);
    const LabelImage image = growFibres(aimed, growth, growthFor(aimed, growth).growth, growthGrid(aimed.domain, growth));
    const LabelImageFacts facts = labelImageFacts(aimed, growth);
    const auto pairs =
      myelinSurfaces({ image.grid, image.fibreId.data(), image.depth.data(), growth.gap() }, facts, this->Order.surfaces);
    SubstrateFolderContents contents;
    contents.domain = aimed.domain;
    contents.outer = surfacesOf(pairs, &FibreSurfacePair::outer, growth.minimumGap);
    contents.outer.wantedIds = aimed.fibreIds;
    contents.inner = surfacesOf(pairs, &FibreSurfacePair::inner, growth.minimumGap);
    contents.fibres = &this->Fibres_;
    contents.certificate.minimumGap = growth.minimumGap;
    writeSubstrateFolder(contents, this->folder("stages"));
    return filesIn(this->folder("stages"));
  }

  /// Runs it in a process, with so many members, that is killed at this progress. Late in the work there are few fibres left that
  /// a second thread could do alone, while the first reports nothing.
  void killAt(const std::string& name, double part, int members = 1, int threads = 2) const
  {
    const std::string told = cactus_testing::inChild(
      [&]
      {
        Context context;
        context.threads = part > 0.9 ? 1 : threads;
        context.progress = [part](double fraction, const std::string&)
        {
          if (fraction >= part)
          {
            ::raise(SIGKILL);
          }
        };
        members > 1 ? static_cast<void>(this->produceInTeam(members, name, [&](int) { return context; }))
                    : static_cast<void>(this->produce(name, context));
        return std::string("was not killed");
      });
    ASSERT_EQ(told, " (the child ended with status 9)");
  }

  fs::path Scratch;
  Fibres Fibres_ = example::fibresThatMeet();
  ProductionOrder Order;
};

TEST_F(Production, WritesTheFilesOfTheStagesOnSeveralThreads)
{
  for (const auto model : { GRatioModel::Constant, GRatioModel::LogLinear, GRatioModel::TargetAxonVolumeFraction })
  {
    this->Order.surfaces.model = model;
    this->Order.surfaces.targetAxonVolumeFraction = 0.2;
    const auto wanted = this->filesOfStages();
    ASSERT_EQ(wanted.count("outer/fibre_00003.ply") + wanted.count("inner/fibre_00003.ply"), 2u);
    for (const int threads : { 1, 2 })
    {
      Context context;
      context.threads = threads;
      const ProducedSubstrate produced = this->produce("produced", context);
      EXPECT_TRUE(produced.written.certificate.certified());
      EXPECT_EQ(produced.found, 0u);
      EXPECT_EQ(filesIn(this->folder("produced")), wanted);
      EXPECT_FALSE(fs::exists(this->folder("produced.work")));
    }
  }
}

TEST_F(Production, MakesASampleAmongAllFibres)
{
  this->Order.format = SubstrateFormat::Surfaces;
  const auto surfacesIn = [&](const std::string& name)
  {
    auto files = filesIn(this->folder(name));
    for (auto file = files.begin(); file != files.end();)
    {
      file = file->first.find(".ply") != std::string::npos ? std::next(file) : files.erase(file);
    }
    return files;
  };
  this->Order.growth.surfaceTolerance = 0.02; // so that none has to be moved away from another
  this->produce("whole");
  const auto whole = surfacesIn("whole");
  ASSERT_EQ(whole.size(), 6u);
  std::map<std::string, std::string> before;
  bool isPart = false;
  for (const double part : { 1e-4, 0.3, 0.6, 0.9999 })
  {
    this->Order.sampledFraction = part;
    const ProducedSubstrate produced = this->produce("sample");
    EXPECT_TRUE(produced.written.certificate.certified());
    const auto sample = surfacesIn("sample");
    EXPECT_EQ(sample.size(), 2 * produced.fibres.size());
    EXPECT_TRUE(std::includes(whole.begin(), whole.end(), sample.begin(), sample.end())) << "as they are in the whole";
    EXPECT_TRUE(std::includes(sample.begin(), sample.end(), before.begin(), before.end())) << "more hold fewer";
    const std::string readme = filesIn(this->folder("sample")).at("README.txt");
    EXPECT_EQ(readme.find("A sample, " + std::to_string(produced.fibres.size()) + " of the 3 fibres") == 0, sample.size() < 6);
    isPart = isPart || sample.size() < 6;
    before = sample;
  }
  EXPECT_TRUE(isPart);

  this->Order.sampledFraction = 0.5;
  this->Order.surfaces.model = GRatioModel::TargetAxonVolumeFraction;
  EXPECT_THROW(this->produce("refused"), InvalidInput);
  this->Order.surfaces.model = GRatioModel::Constant;
  this->Order.format = SubstrateFormat::Mcdc;
  EXPECT_THROW(this->produce("refused"), InvalidInput);
  this->Order.sampledFraction = 0.0;
  EXPECT_THROW(this->produce("refused"), InvalidInput);
  EXPECT_FALSE(fs::exists(this->folder("refused")));
  EXPECT_FALSE(fs::exists(this->folder("refused.work")));
}

TEST_F(Production, GoesOnWhereItWasKilled)
{
  for (const auto model : { GRatioModel::Constant, GRatioModel::TargetAxonVolumeFraction })
  {
    this->Order.surfaces.model = model;
    this->Order.surfaces.targetAxonVolumeFraction = 0.2;
    const auto wanted = this->filesOfStages();
    std::size_t found = 0;
    for (const double part : { 0.02, 0.1, 0.2, 0.35, 0.45, 0.5, 0.6, 0.75, 0.82, 0.93, 0.95 })
    {
      this->killAt("killed", part);
      EXPECT_TRUE(fs::exists(this->folder("killed.work/journal"))) << part;
      EXPECT_FALSE(fs::exists(this->folder("killed"))) << part;
      // Surfaces in the journal are not made again: their time of change stays. By then all outer surfaces are, in the first case
      // with inner ones.
      const fs::path first = this->folder("killed.work/outer/00000/00000.surface");
      const bool isThere = part >= (model == GRatioModel::Constant ? 0.7 : 0.45);
      const auto time = isThere ? fs::last_write_time(first) : fs::file_time_type();
      this->killAt("killed", part + 0.01);
      EXPECT_TRUE(!isThere || fs::last_write_time(first) == time) << part;
      const ProducedSubstrate produced = this->produce("killed");
      found += produced.found;
      EXPECT_TRUE(part < 0.45 || produced.found > 0) << part;
      EXPECT_EQ(filesIn(this->folder("killed")), wanted) << part;
      EXPECT_FALSE(fs::exists(this->folder("killed.work"))) << part;
      fs::remove_all(this->folder("killed"));
    }
    EXPECT_GT(found, 0u);
  }
}

TEST_F(Production, SolvesForNothingAgain)
{
  for (const int members : { 1, 2 })
  {
    this->killAt("killed", 0.1, members, 1); // a second thread might make all surfaces before the first one is told
    std::set<std::string> messages;
    Context context;
    context.threads = 1; // so that all parts are reported
    context.progress = [&](double, const std::string& message) { messages.insert(message.substr(0, message.find(':'))); };
    const ProducedSubstrate again = this->produce("killed", context);
    // Processes may have made all surfaces before one of them is told.
    EXPECT_TRUE(messages.count("making surfaces") == 1u || (members > 1 && again.found >= again.fibres.size()));
    for (const char* solving :
      { "aiming at the target radii", "finding the growth that reaches the target", "looking for fibres" })
    {
      EXPECT_EQ(messages.count(solving), 0u) << solving;
    }
    EXPECT_EQ(filesIn(this->folder("killed")), this->filesOfStages());
    messages.clear();
    this->produce("again", context);
    EXPECT_EQ(messages.count("aiming at the target radii") + messages.count("looking for fibres"), 2u)
      << "where nothing is known";
    for (const char* name : { "killed", "again", "stages" })
    {
      fs::remove_all(this->folder(name));
    }
  }
}

// The solved growth is kept, too, even if no surface has been made yet; and a later run that fails leaves it.
// The fraction that is filled instead is known to a run that goes on.
TEST_F(Production, FillsWhatItCanAndSaysSoHoweverOftenItIsKilled)
{
  this->Order.growth.targetFibreVolumeFraction = 0.99;
  double recorded = 0.0;
  this->Order.provenance = [&](double, const SolvedGrowth& growth)
  {
    recorded = growth.fraction;
    return Provenance();
  };
  const ProducedSubstrate whole = this->produce("whole");
  const std::string words = text("TargetFibreVolumeFraction 0.99 cannot be reached: the fibres fill ", recorded);
  EXPECT_GT(recorded, 0.8);
  EXPECT_NE(whole.remarks.find(words), std::string::npos) << whole.remarks;
  this->killAt("killed", 0.5);
  const ProducedSubstrate resumed = this->produce("killed");
  EXPECT_GT(resumed.found, 0u);
  EXPECT_EQ(resumed.remarks, whole.remarks);
  EXPECT_EQ(filesIn(this->folder("killed")), filesIn(this->folder("whole")));
}

TEST_F(Production, GoesOnWhereItWasStoppedBeforeAnySurface)
{
  Context context;
  context.threads = 1; // with two, the other one may do all the searching while the first reports nothing
  bool isSolved = false;
  context.progress = [&](double, const std::string& message) { isSolved = isSolved || message.find("looking for fibres") == 0; };
  context.cancelled = [&] { return isSolved; };
  EXPECT_THROW(this->produce("stopped", context), WorkKept);
  EXPECT_THROW(this->produce("stopped", this->failingAt("looking for fibres")), std::bad_alloc);
  bool isSolving = false;
  context = {};
  context.threads = 1;
  context.progress = [&](double, const std::string& message) { isSolving = isSolving || message.find("aiming") == 0; };
  EXPECT_EQ(this->produce("stopped", context).found, 0u);
  EXPECT_FALSE(isSolving);
  EXPECT_EQ(filesIn(this->folder("stopped")), this->filesOfStages());
}

TEST_F(Production, JudgesNothingAgainWhileItWrites)
{
  constexpr double judged = 0.96;
  for (const int members : { 1, 2 })
  {
    this->killAt("killed", judged + 0.01, members);
    double least = 1.0;
    Context context;
    context.progress = [&](double fraction, const std::string& message)
    {
      if (message.find("Looking at surfaces") == 0 || message.find("Measuring gaps") == 0)
      {
        least = std::min(least, fraction);
      }
    };
    this->produce("killed", context);
    EXPECT_GT(least, judged - 0.02) << "where fibres have been looked at by themselves";
    EXPECT_EQ(filesIn(this->folder("killed")), this->filesOfStages());
    fs::remove_all(this->folder("killed"));
    fs::remove_all(this->folder("stages"));
  }
}

TEST_F(Production, WritesTheSameFilesOnSeveralProcessesAndThreads)
{
  for (const auto model : { GRatioModel::Constant, GRatioModel::TargetAxonVolumeFraction })
  {
    this->Order.surfaces.model = model;
    this->Order.surfaces.targetAxonVolumeFraction = 0.2;
    const auto wanted = this->filesOfStages();
    for (const int size : { 2, 3, 4 })
    {
      const auto told = this->produceInTeam(size, "shared");
      const std::string all = "0 found, " + std::to_string(2 * this->Fibres_.size()) + " files, certified";
      EXPECT_EQ(told, std::vector<std::string>(std::size_t(size), all));
      EXPECT_EQ(filesIn(this->folder("shared")), wanted) << size;
      EXPECT_FALSE(fs::exists(this->folder("shared.work")));
      fs::remove_all(this->folder("shared"));
    }
  }
}

TEST_F(Production, GoesOnWithAnotherNumberOfProcesses)
{
  const auto wanted = this->filesOfStages();
  for (const double part : { 0.2, 0.5, 0.75, 0.9 })
  {
    this->killAt("killed", part, 3);
    EXPECT_TRUE(fs::exists(this->folder("killed.work/journal-00002")));
    this->killAt("killed", part + 0.01, 2);
    EXPECT_FALSE(fs::exists(this->folder("killed")));
    if (part < 0.6)
    {
      const auto told = this->produceInTeam(4, "killed");
      EXPECT_EQ(std::count(told.begin(), told.end(), told.front()), 4);
      EXPECT_NE(told.front().substr(0, 2), "0 ") << part;
    }
    else
    {
      EXPECT_GT(this->produce("killed").found, 0u) << part;
    }
    EXPECT_EQ(filesIn(this->folder("killed")), wanted) << part;
    EXPECT_FALSE(fs::exists(this->folder("killed.work"))) << part;
    fs::remove_all(this->folder("killed"));
  }
}

TEST_F(Production, EndsInAllProcessesWhereOneFails)
{
  std::string found = "3 ";
  for (const double part : { 0.05, 0.3, 0.6, 0.88 })
  {
    std::atomic<bool> hasFailed{ false };
    const auto fails = [part, &hasFailed](int place)
    {
      Context context;
      context.progress = [place, part, &hasFailed](double fraction, const std::string&)
      {
        if (place == 1 && fraction >= part)
        {
          hasFailed = true;
          throw FileError("no space left");
        }
      };
      return context;
    };
    const auto told = this->produceInTeam(3, "failed", fails);
    if (part > 0.6 && !hasFailed)
    {
      fs::remove_all(this->folder("failed")); // the others were so quick that nothing was left for rank 1
      found = "0 ";
      continue;
    }
    EXPECT_EQ(told, std::vector<std::string>(3, "on rank 1: no space left")) << part;
    for (const auto& entry : fs::directory_iterator(this->Scratch))
    {
      EXPECT_EQ(entry.path().filename(), "failed.work") << "nothing half-written stays";
    }
  }
  EXPECT_EQ(this->produceInTeam(2, "failed").front().substr(0, 2), found);
  EXPECT_EQ(filesIn(this->folder("failed")), this->filesOfStages());
  // A request that all of them refuse is reported once, by the first.
  this->Order.surfaces.decimationError = 1.0;
  const auto refused = this->produceInTeam(2, "refused");
  EXPECT_NE(refused.front().find("DecimationError"), std::string::npos);
  EXPECT_FALSE(fs::exists(this->folder("refused.work")));
  const auto apart = cactus_testing::inTeam(2,
    [&](Team& team)
    {
      Fibres fibres = example::fibresThatMeet();
      fibres.radii[0] += 0.001 * team.place();
      produceSubstrate(fibres, ProductionOrder(), this->folder("apart"), {}, &team);
      return std::string();
    });
  EXPECT_NE(apart.front().find("the ranks were given different fibres"), std::string::npos) << apart.front();
}

TEST_F(Production, LeavesNothingWhereItMadeNothing)
{
  Context context;
  context.progress = [](double, const std::string&) { throw std::bad_alloc(); };
  EXPECT_THROW(this->produce("early", context), std::bad_alloc);
  EXPECT_FALSE(fs::exists(this->folder("early.work")));
  context = {};
  context.cancelled = [] { return true; };
  EXPECT_THROW(this->produce("early", context), Cancelled);
  EXPECT_FALSE(fs::exists(this->folder("early.work")));
  // Nor if growth has been solved for, and an error requires other parameters.
  EXPECT_THROW(this->produce("early", this->failingAt("looking for fibres")), std::bad_alloc);
  EXPECT_FALSE(fs::exists(this->folder("early.work")));
}

TEST_F(Production, StopsAndGoesOn)
{
  Context context;
  std::atomic<bool> isHalfDone{ false };
  context.progress = [&](double part, const std::string&) { isHalfDone = part > 0.5; };
  context.cancelled = [&] { return isHalfDone.load(); };
  EXPECT_THROW(this->produce("stopped", context), Cancelled);
  EXPECT_TRUE(fs::exists(this->folder("stopped.work/journal")));
  this->produce("stopped");
  EXPECT_EQ(filesIn(this->folder("stopped")), this->filesOfStages());
}

TEST_F(Production, KeepsSurfacesThatCannotBeWrittenAsAsked)
{
  this->Order.format = SubstrateFormat::Surfaces;
  const auto refuses = [](double part)
  {
    Context context;
    context.threads = 1; // so that all parts are reported
    context.progress = [part](double fraction, const std::string&)
    {
      if (fraction >= part)
      {
        throw InvalidInput("a surface is open");
      }
    };
    return context;
  };
  EXPECT_THROW(this->produce("early", refuses(0.5)), InvalidInput);
  EXPECT_FALSE(fs::exists(this->folder("early.work"))) << "what cannot be made is of use to nobody";
  this->killAt("resumed", 0.6);
  const std::string resumed = this->refusal("resumed", refuses(0.5));
  EXPECT_NE(resumed.find("earlier run has made is kept in " + this->folder("resumed.work")), std::string::npos) << resumed;
  EXPECT_GT(this->produce("resumed").found, 0u) << "but what an earlier run has left is";

  for (const int members : { 1, 3 })
  {
    const std::string told = members > 1 ? this->produceInTeam(members, "kept", [&](int) { return refuses(0.95); }).front()
                                         : this->refusal("kept", refuses(0.95));
    EXPECT_NE(told.find("a surface is open. The surfaces are made, and kept in " + this->folder("kept.work")), std::string::npos)
      << told;
    EXPECT_FALSE(fs::exists(this->folder("kept")));
    this->Order.format = SubstrateFormat::Mcdc;
    EXPECT_EQ(this->produce("kept").found, this->Fibres_.size()) << "nothing is made again";
    EXPECT_EQ(filesIn(this->folder("kept")), this->filesOfStages());
    EXPECT_FALSE(fs::exists(this->folder("kept.work")));
    fs::remove_all(this->folder("kept"));
    fs::remove_all(this->folder("stages"));
    this->Order.format = SubstrateFormat::Surfaces;
  }
}

TEST_F(Production, SaysAtOnceWhatCannotBeMadeOrWritten)
{
  Context context;
  context.progress = [](double, const std::string& message) { ADD_FAILURE() << message; };
  const auto refused = [&] { return this->refusal("refused", context); };
  const ProductionOrder good = this->Order;
  this->Order.encoding = PlyEncoding::Binary; // MC/DC does not read it
  EXPECT_NE(refused().find("Encoding Binary"), std::string::npos);
  this->Order = good;
  this->Order.surfaces.decimationError = 0.006;
  EXPECT_NE(refused().find("DecimationError 0.006"), std::string::npos);
  this->Order = good;
  this->Order.surfaces.model = GRatioModel::TargetAxonVolumeFraction;
  this->Order.surfaces.targetAxonVolumeFraction = 0.45;
  EXPECT_NE(refused().find("TargetAxonVolumeFraction 0.45 cannot be reached"), std::string::npos);
  this->Order = good;
  this->Order.format = SubstrateFormat::Reference;
  this->Fibres_.domain.upper += Eigen::Vector3d(0.0, 0.0, 1.0);
  EXPECT_NE(refused().find("Format Reference program"), std::string::npos);
  EXPECT_FALSE(fs::exists(this->folder("refused.work")));
}

TEST_F(Production, SaysWhatIsKeptWhereTheDiskOrTheFolderIsTheTrouble)
{
  fs::create_directories(this->folder("taken"));
  Context context;
  context.progress = [&](double fraction, const std::string&)
  {
    if (fraction > 0.5) // meanwhile
    {
      std::ofstream(this->folder("taken/notes.txt")) << "mine";
    }
  };
  const std::string told = this->refusal<FileError>("taken", context);
  EXPECT_NE(told.find("kept in " + this->folder("taken.work")), std::string::npos) << told;
  fs::rename(this->folder("taken.work"), this->folder("another.work"));
  EXPECT_EQ(this->produce("another").found, this->Fibres_.size());
  EXPECT_EQ(filesIn(this->folder("another")), this->filesOfStages());
  EXPECT_EQ(filesIn(this->folder("taken")).size(), 1u);
}

// There is no inner surface yet if all g-ratios depend on all outer surfaces.
TEST_F(Production, AFibreMayGoBeforeAnyHasItsAxon)
{
  this->Fibres_ = example::fibresOfWhichOneGoes();
  this->Order.growth = example::growthInWhichOneGoes();
  this->Order.surfaces.decimationError = 0.00374472;
  this->Order.surfaces.seed = this->Order.growth.seed;
  this->Order.surfaces.model = GRatioModel::TargetAxonVolumeFraction;
  this->Order.surfaces.targetAxonVolumeFraction = 0.04;
  this->Order.allowOpenSurfaces = true;
  const ProducedSubstrate produced = this->produce("gone");
  const auto isGone = [](const FibreSurfacePair& pair)
  { return pair.state == MyelinState::NoFibre && !std::isnan(pair.volumeAsMade); };
  EXPECT_TRUE(std::any_of(produced.fibres.begin(), produced.fibres.end(), isGone));
}

TEST_F(Production, MindsNoStopOfAnEarlierRun)
{
  this->killAt("stopped", 0.5, 3);
  for (const std::string& name : { std::string("stop"), partialName("stop") })
  {
    std::ofstream(this->folder("stopped.work/" + name)).flush();
  }
  // Nor a file that a process on another machine was writing.
  std::ofstream(this->folder("stopped.work/outer/00000/" + partialName("00001.surface"))) << "half";
  const auto told = this->produceInTeam(3, "stopped");
  EXPECT_NE(told.front().find("certified"), std::string::npos) << told.front();
  EXPECT_FALSE(fs::exists(this->folder("stopped.work")));
}

TEST_F(Production, WorksBesideAFolderHoweverItIsNamed)
{
  fs::create_directories(this->folder("named"));
  for (const char* name : { "named/.", "named/", "./named" })
  {
    this->killAt(name, 0.6);
    EXPECT_TRUE(fs::exists(this->folder("named.work"))) << name;
    this->produce(name);
    EXPECT_EQ(filesIn(this->folder("named")), this->filesOfStages()) << name;
  }
}

TEST_F(Production, SaysWhyThereAreNoSurfaces)
{
  this->Fibres_.radii.assign(this->Fibres_.radii.size(), 0.001);
  this->Order.growth.targetFibreVolumeFraction = 0.0;
  this->Order.growth.growthIterations = 0;
  const std::string told = this->refusal("none");
  EXPECT_NE(told.find("there are no surfaces to write: 3 of 3 fibres are not as asked"), std::string::npos) << told;
  EXPECT_FALSE(fs::exists(this->folder("none")));
  EXPECT_FALSE(fs::exists(this->folder("none.work")));
}

TEST_F(Production, LeavesTheWorkOfAnotherOneAlone)
{
  this->killAt("work", 0.6);
  const auto before = filesIn(this->folder("work.work"));
  ASSERT_GT(before.size(), 3u);
  const auto refused = [&] { return this->refusal("work").find("work.work") != std::string::npos; };
  this->Order.surfaces.smoothingIterations = 3;
  EXPECT_TRUE(refused());
  this->Order.surfaces.smoothingIterations = 2;
  this->Fibres_.radii[0] *= 1.0 + 1e-15;
  EXPECT_TRUE(refused());
  this->Fibres_ = example::fibresThatMeet();
  this->Fibres_.grownFraction = 0.5; // the growth target if none is given
  EXPECT_TRUE(refused());
  EXPECT_EQ(filesIn(this->folder("work.work")), before);
}

TEST_F(Production, LeavesAUsersFilesAmongItsOwn)
{
  this->killAt("noted", 0.6);
  const fs::path notes = this->folder("noted.work/journal-notes.txt");
  std::ofstream(notes) << "of mine";
  this->produce("noted");
  EXPECT_EQ(filesIn(this->folder("noted")), this->filesOfStages());
  EXPECT_TRUE(fs::exists(notes));
  fs::remove_all(this->folder("noted.work"));
}

// The journal is cleared first, and then the surfaces are removed.
TEST_F(Production, MindsNothingThatAKilledRemovalHasLeft)
{
  this->killAt("removed", 0.93);
  fs::resize_file(this->folder("removed.work/journal"), 80); // its identity
  ASSERT_TRUE(fs::remove(this->folder("removed.work/outer/00000/00000.surface")));
  EXPECT_EQ(this->produce("removed").found, 0u);
  EXPECT_EQ(filesIn(this->folder("removed")), this->filesOfStages());
  EXPECT_FALSE(fs::exists(this->folder("removed.work")));
}

TEST_F(Production, SaysWhatIsDamaged)
{
  const auto damageAll = [&](const std::string& name)
  {
    for (const auto& entry : fs::recursive_directory_iterator(this->folder(name)))
    {
      if (entry.path().extension() == ".surface")
      {
        std::fstream file(entry.path(), std::ios::in | std::ios::out | std::ios::binary);
        file.seekp(200);
        file.put('x');
      }
    }
  };
  this->killAt("damaged", 0.84);
  damageAll("damaged.work");
  // The end of a journal may have been cut off.
  const fs::path journal = this->folder("damaged.work/journal");
  fs::resize_file(journal, fs::file_size(journal) - 3);
  std::string told = this->refusal<FileError>("damaged");
  for (int removed = 0; removed < 6 && !told.empty(); ++removed)
  {
    EXPECT_NE(told.find(".surface is damaged, or cannot be read: remove it and run again"), std::string::npos) << told;
    const std::size_t begin = told.find('/');
    ASSERT_TRUE(fs::remove(told.substr(begin, told.find(" is damaged") - begin))) << told;
    told = this->refusal<FileError>("damaged");
  }
  EXPECT_EQ(told, "");
  EXPECT_EQ(filesIn(this->folder("damaged")), this->filesOfStages());
  // With surfaces kept apart, a single one is not made again.
  this->killAt("final", 0.93);
  damageAll("final.work");
  told = this->refusal<FileError>("final");
  EXPECT_NE(told.find("remove the folder " + this->folder("final.work") + " and make all of it again"), std::string::npos)
    << told;
}

TEST_F(Production, RefusesAFolderThatCannotBeWrittenAtOnce)
{
  fs::create_directories(this->folder("mine"));
  std::ofstream(this->folder("mine/notes.txt")) << "mine";
  EXPECT_THROW(this->produce("mine"), FileError);
  EXPECT_FALSE(fs::exists(this->folder("mine.work")));
  EXPECT_THROW(produceSubstrate(this->Fibres_, this->Order, ""), InvalidInput);
}

} // namespace
