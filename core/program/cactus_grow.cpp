// SPDX-License-Identifier: BSD-3-Clause
// cactus-grow RECIPE: makes a substrate without ParaView, see docs/cactus-grow.md.
#include "base/Context.h"
#include "base/Error.h"
#include "program/CommandLine.h"
#include "program/Terminal.h"
#include "recipe/RecipeReader.h"
#include "recipe/RecipeRun.h"
#include "stages/SubstrateProduction.h"

#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <new>
#include <string>
#include <system_error>

namespace
{

namespace fs = std::filesystem;

enum Status
{
  certified = 0,
  failed = 1,
  refused = 2,
  faulty = 3,
  stopped = 128 ///< plus the number of the signal
};

volatile std::sig_atomic_t caughtSignal = 0;

extern "C" void noteSignal(int number)
{
  caughtSignal = number;
}

/// Handles signals: the first lets the work end in good order, the second ends it at once.
void watchSignals()
{
  struct sigaction action = {};
  action.sa_handler = noteSignal;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  for (const int number : { SIGINT, SIGTERM, SIGHUP })
  {
    struct sigaction before = {};
    ::sigaction(number, nullptr, &before);
    if (before.sa_handler != SIG_IGN) // as with nohup
    {
      ::sigaction(number, &action, nullptr);
    }
  }
}

/// Returns the recipe's file: for a folder, its manifest.
fs::path recipePath(const std::string& name)
{
  std::error_code isUnknown;
  return fs::is_directory(name, isUnknown) ? fs::path(name) / "manifest.json" : fs::path(name);
}

std::string contentOf(const fs::path& path)
{
  std::ifstream file(path, std::ios::binary);
  const std::string content{ std::istreambuf_iterator<char>(file), {} };
  if (!file.is_open() || file.bad())
  {
    throw cactus::FileError("cannot read " + path.string() + ": name a recipe, or the folder of a substrate");
  }
  return content;
}

/// Returns the output folder if neither the command nor the recipe names one.
std::string folderBeside(const fs::path& recipe)
{
  if (recipe.filename() == "manifest.json")
  {
    return fs::absolute(recipe).lexically_normal().parent_path().string() + "-rerun";
  }
  if (recipe.extension() != ".json")
  {
    throw cactus::InvalidInput("name the folder to write with --output: the recipe's name does not end in .json");
  }
  return fs::path(recipe).replace_extension().string();
}

/// A recipe with its output folder and number of threads.
struct Job
{
  cactus::Recipe recipe;
  std::string folder;
  int threads = 0;
};

Job jobFrom(const CommandLine& command)
{
  const fs::path path = recipePath(command.recipe);
  const std::string content = contentOf(path);
  Job job;
  try
  {
    job.recipe = cactus::readRecipe(content, path.parent_path().string());
  }
  catch (const cactus::InvalidInput& error)
  {
    throw cactus::InvalidInput(path.string() + ": " + error.what());
  }
  job.folder = !command.output.empty() ? command.output : job.recipe.folderName();
  if (job.folder.empty())
  {
    job.folder = folderBeside(path);
  }
  job.threads = command.threads;
  return job;
}

int reported(const cactus::WrittenSubstrate& substrate, const std::string& folder, Terminal& terminal)
{
  std::size_t outer = 0;
  std::size_t triangles = 0;
  for (const cactus::SubstrateFile& file : substrate.files)
  {
    outer += file.surface == "outer" ? 1 : 0;
    triangles += file.triangles;
  }
  const bool isCertified = substrate.certificate.certified();
  if (!isCertified)
  {
    terminal.say("the substrate in " + folder + " is not certified: " + substrate.certificate.verdict());
  }
  std::printf("%s: %s, %zu outer and %zu inner surfaces of %zu triangles\n", folder.c_str(),
    isCertified ? "certified" : "NOT certified", outer, substrate.files.size() - outer, triangles);
  return isCertified ? certified : faulty;
}

int run(const Job& job, Terminal& terminal)
{
  if (!job.recipe.version.empty() && job.recipe.version != CACTUS_VERSION)
  {
    terminal.say(
      "the recipe is of CACTUS " + cactus::excerpt(job.recipe.version) + ", this is " CACTUS_VERSION ": results may differ");
  }
  cactus::Context context;
  context.threads = job.threads;
  context.cancelled = [] { return caughtSignal != 0; };
  context.progress = [&](double fraction, const std::string& message) { terminal.progress(fraction, message); };
  watchSignals();
  try
  {
    const auto substrate =
      cactus::runRecipe(job.recipe, job.folder, context, [&](const std::string& remark) { terminal.say("warning: " + remark); });
    return reported(substrate, job.folder, terminal);
  }
  catch (const cactus::WorkKept& kept)
  {
    terminal.say("stopped: " + job.folder + " is as it was, what is finished is kept in " + kept.folder() +
                 ", and the same command goes on with it");
    return stopped + caughtSignal;
  }
  catch (const cactus::Cancelled&)
  {
    terminal.say("stopped: " + job.folder + " is as it was");
    return stopped + caughtSignal;
  }
  catch (const std::bad_alloc&)
  {
    terminal.say("out of memory: choose a smaller Side or a larger VoxelSize, or SubstrateProduction in the recipe");
  }
  catch (const std::exception& error)
  {
    terminal.say(error.what());
  }
  return failed;
}

} // namespace

int main(int count, char** arguments)
{
  Terminal terminal;
  try
  {
    const CommandLine command = parseCommandLine(count, arguments);
    if (command.wantsHelp || command.wantsVersion)
    {
      std::fputs(command.wantsHelp ? commandHelp : "cactus-grow " CACTUS_VERSION "\n", stdout);
      return certified;
    }
    terminal.setPause(std::chrono::seconds(command.progress));
    return run(jobFrom(command), terminal);
  }
  catch (const std::exception& error)
  {
    terminal.say(error.what());
    return refused;
  }
}
