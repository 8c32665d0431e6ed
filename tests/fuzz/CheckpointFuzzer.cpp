// SPDX-License-Identifier: BSD-3-Clause
// Any bytes as a checkpoint: unchanged, only the program's own output is accepted; with corrected title, fingerprint and
// checksum, a run that continues from it ends with finite fibres, or with one error of ours.
#include "Fuzzing.h"
#include "base/Checkpoint.h"
#include "base/Error.h"
#include "optimiser/CapsuleOptimizer.h"

#include <iterator>

namespace
{

using namespace cactus;

/// Title, mark for the order of bytes, and fingerprint.
constexpr std::size_t frontBytes = 36;
constexpr std::size_t checksumBytes = 8;

Fibres crossing()
{
  Fibres fibres;
  fibres.domain = Domain::cube(4.0);
  for (int f = 0; f < 2; ++f)
  {
    fibres.addFibre(f + 1, 1, 0.5);
    for (int i = 0; i < 3; ++i)
    {
      fibres.addPoint({ 0.3 * f, (2 * f - 1) * 0.4 * (i - 1), i - 1.0 }, 0.5);
    }
  }
  return fibres;
}

/// Both methods, each with a checkpoint of its own.
struct Method
{
  CapsuleOptimizerOptions options;
  std::string whole;
};

std::string path()
{
  return scratchFolder() + "/checkpoint";
}

Method methods[2];

void run(const CapsuleOptimizerOptions& options, Fibres& fibres)
{
  Context context;
  context.threads = 1;
  optimise(fibres, options, context);
}

} // namespace

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv)
{
  std::vector<std::string> seeds;
  for (int m = 0; m < 2; ++m)
  {
    CapsuleOptimizerOptions& options = methods[m].options;
    options.method = m == 0 ? DescentMethod::Momentum : DescentMethod::Adagrad;
    options.stepSize = 0.02;
    options.radiusTolerance = 0.02;
    options.overlapTolerance = 1e-9;
    options.checkpointFile = path();
    options.maximumIterations = 2;
    std::remove(path().c_str());
    Fibres fibres = crossing();
    run(options, fibres);
    std::ifstream file(path(), std::ios::binary);
    std::string& whole = methods[m].whole;
    whole.assign(std::istreambuf_iterator<char>(file), {});
    options.maximumIterations = 4;
    options.resume = true;
    seeds.push_back(std::string(1, static_cast<char>(m)) + whole);
    seeds.push_back(
      std::string(1, static_cast<char>(m + 2)) + whole.substr(frontBytes, whole.size() - frontBytes - checksumBytes));
  }
  writeSeeds(*argc, *argv, seeds);
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  if (size == 0)
  {
    return 0;
  }
  const Method& method = methods[data[0] & 1];
  const bool asIs = (data[0] & 2) == 0;
  std::string content(reinterpret_cast<const char*>(data) + 1, size - 1);
  if (!asIs)
  {
    content.insert(0, method.whole.substr(0, frontBytes));
    const std::uint64_t checksum = hash64(content.data(), content.size());
    content.append(reinterpret_cast<const char*>(&checksum), sizeof(checksum));
  }
  std::ofstream(path(), std::ios::binary).write(content.data(), static_cast<std::streamsize>(content.size()));
  Fibres fibres = crossing();
  try
  {
    run(method.options, fibres);
    promise(!asIs || content == method.whole, "no run goes on from a damaged checkpoint");
    for (const Eigen::Vector3d& point : fibres.points)
    {
      promise(point.allFinite(), "fibres are finite");
    }
  }
  catch (const Error& error)
  {
    promise(std::string(error.what()).find("CheckpointFile " + path()) == 0, "a message names the checkpoint");
    promise(content != method.whole, "an undamaged checkpoint is gone on from");
  }
  return 0;
}
