// SPDX-License-Identifier: BSD-3-Clause
#include "stages/SubstrateProduction.h"

#include "base/Error.h"
#include "base/Limits.h"
#include "base/Pace.h"
#include "base/PartialName.h"
#include "base/Random.h"
#include "base/Sha256.h"
#include "fibres/SelectFibres.h"
#include "growth/FibreRadialGrowth.h"
#include "growth/GrownTiles.h"
#include "growth/GrowthTarget.h"
#include "growth/TargetRadii.h"
#include "io/FolderFormat.h"
#include "io/FolderReplacement.h"
#include "io/MadeSurfaces.h"
#include "io/OpenSurfaces.h"
#include "io/SubstrateFolder.h"
#include "io/SurfaceSpool.h"
#include "surface/SurfaceMaker.h"
#include "surface/SurfaceRemarks.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <new>
#include <tuple>
#include <utility>
#include <vector>

namespace cactus
{

namespace
{

/// Shares of the total progress.
constexpr double growthSolved = 0.025;
constexpr double surfacesMade = 0.92;

/// Tiles of the label image that are kept: 1 GB in all processes together, but 128 MB for each thread at least.
constexpr std::size_t tilesTogether = 32768;
constexpr std::size_t tilesPerThread = 4096;

template <typename Value>
void add(Sha256& sum, const std::vector<Value>& values)
{
  const std::uint64_t count = values.size();
  sum.add(&count, sizeof(count));
  sum.add(values.data(), values.size() * sizeof(Value));
}

template <typename Options>
std::string valuesOf(const Options& options)
{
  std::string values;
  for (const PropertyState& state : Options::properties().states(options))
  {
    values += std::string(state.facts->name) + ' ' + valueText(*state.facts, state.value) + '\n';
  }
  return values;
}

/// Returns the identity of everything that surfaces depend on.
std::string identityOf(const Fibres& fibres, const ProductionOrder& order)
{
  Sha256 sum;
  add(sum, fibres.points);
  add(sum, fibres.radii);
  add(sum, fibres.offsets);
  add(sum, fibres.fibreIds);
  add(sum, fibres.bundleIds);
  add(sum, fibres.targetRadii);
  if (!fibres.myelinFractions.empty())
  {
    add(sum, fibres.myelinFractions);
  }
  for (const auto& [name, values] : fibres.columns.all())
  {
    sum.add(name.data(), name.size());
    add(sum, values);
  }
  sum.add(&fibres.grownFraction, sizeof(double));
  sum.add(fibres.domain.lower.data(), 3 * sizeof(double));
  sum.add(fibres.domain.upper.data(), 3 * sizeof(double));
  if (fibres.domain.isPeriodic())
  {
    sum.add(fibres.domain.periodic.data(), sizeof(fibres.domain.periodic));
  }
  const std::string values = "CACTUS " CACTUS_VERSION ", journal 16\n" + valuesOf(order.growth) + valuesOf(order.surfaces);
  sum.add(values.data(), values.size());
  if (order.sampledFraction < 1.0)
  {
    sum.add(&order.sampledFraction, sizeof(double));
  }
  return sum.digest();
}

/// Throws if axons are to fill more than the fibres leave for them beside myelin.
void requireRoomForMyelin(const Fibres& fibres, const ProductionOrder& order)
{
  const double filled = targetFraction(fibres, order.growth);
  if (order.surfaces.model == GRatioModel::TargetAxonVolumeFraction && filled > 0.0 &&
      order.surfaces.targetAxonVolumeFraction >= filled)
  {
    throw InvalidInput(
      text("TargetAxonVolumeFraction ", order.surfaces.targetAxonVolumeFraction, " cannot be reached: fibres are to fill ",
        filled, " of the domain, with their myelin. Ask for less, or raise TargetFibreVolumeFraction"));
  }
}

/// Returns the fibres whose surfaces are made: at least one.
Fibres madeOf(const Fibres& fibres, const ProductionOrder& order)
{
  std::vector<double> numbers;
  for (const int id : fibres.fibreIds)
  {
    RandomEngine engine = randomStream(order.surfaces.seed, RandomStage::Sample, static_cast<std::uint64_t>(id));
    numbers.push_back(uniform(engine));
  }
  const double most = std::max(order.sampledFraction, *std::min_element(numbers.begin(), numbers.end()));
  std::vector<std::size_t> drawn;
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    if (numbers[f] <= most)
    {
      drawn.push_back(f);
    }
  }
  return selectFibres(fibres, drawn);
}

std::unique_ptr<SurfaceSpool> openSpool(
  const std::string& folder, const std::string& identity, std::size_t count, const Sharing& sharing)
{
  try
  {
    return std::make_unique<SurfaceSpool>(folder, identity, count, sharing);
  }
  catch (const InvalidInput&)
  {
    throw InvalidInput("the folder " + folder +
                       " holds what was made of other fibres, with other parameters or by another version, and is kept: restore "
                       "those and run again to go on there, remove it, or choose another FolderName");
  }
}

/// Returns a context whose progress also reports the speed.
Context paced(const Context& context)
{
  Context whole = context;
  whole.progress = [&context, pace = std::make_shared<Pace>()](double fraction, const std::string& message)
  {
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
    const std::string words = pace->at(seconds, fraction, message);
    context.report(fraction, words.empty() ? message : message + ": " + words);
  };
  return whole;
}

/// Returns how many tiles a process keeps: its part of the image with some of its surroundings, less for a large image.
std::size_t keptTiles(const VoxelGrid& image, int processes, int threads)
{
  std::size_t tiles = 1;
  for (const int count : image.count)
  {
    tiles *= std::size_t(count) / GrownTiles::edge + 1;
  }
  const std::size_t together = std::min(tilesTogether, tiles + tiles / 8);
  return std::max(together / std::size_t(processes), tilesPerThread * std::size_t(threads));
}

/// The quantities that are solved for before any surface is made.
struct SolvedFibres
{
  std::vector<double> factors; ///< on the radii of control points, see factorsForTargetRadii()
  SolvedGrowth growth;
};

auto membersOf(SolvedFibres& solved)
{
  return std::tie(solved.factors, solved.growth.growth, solved.growth.fraction);
}

SolvedFibres solveGrowth(
  const Fibres& fibres, const FibreRadialGrowthOptions& options, const Context& context, const Sharing& sharing)
{
  SolvedFibres solved;
  solved.factors = factorsForTargetRadii(fibres, options, context, sharing);
  solved.growth = growthFor(scaledBy(solved.factors, fibres), options, context, sharing);
  return solved;
}

/// Makes the surfaces of `made`, the fibres or a sample of them, into the spool, and returns the contents to be written.
SubstrateFolderContents makeInto(SurfaceSpool& spool, const Fibres& fibres, const Fibres& made, const ProductionOrder& order,
  ProducedSubstrate& result, const Context& context, const Sharing& sharing)
{
  const Context solving = context.part(0.0, growthSolved);
  SolvedFibres solved =
    spool.findings().part("growth").once(sharing, [&] { return solveGrowth(fibres, order.growth, solving, sharing); });
  auto tiles = std::make_shared<GrownTiles>(scaledBy(solved.factors, fibres), order.growth, solved.growth.growth,
    keptTiles(growthGrid(fibres.domain, order.growth), sharing.size(), context.threadCount()), context.threadCount());
  solved.factors = {};
  const double spacing = tiles->grid().spacing;
  LabelImageFacts facts = grownImageFacts(made, order.growth);
  facts.isSample = made.size() < fibres.size();
  facts.centreLines =
    order.surfaces.followsLines() || !made.myelinFractions.empty() ? std::make_shared<const Fibres>(fibres) : nullptr;
  const Context making = context.part(growthSolved, surfacesMade);
  SurfaceMaker maker(tiles, facts, order.surfaces, making, nullptr, sharing, spool.findings());
  maker.makeOuter(spool.outer(), spool.inner());
  maker.makeInner(spool.outer(), spool.inner());
  result.fibres = maker.fibres();
  for (const std::string& remark : { remarkOnGrowth(fibres, order.growth, solved.growth),
         notAsAsked(maker.fibres(), spacing, facts), remarkOnSwellings(maker.fibres(), facts, order.surfaces) })
  {
    result.remarks += result.remarks.empty() || remark.empty() ? remark : ". " + remark;
  }

  SubstrateFolderContents contents;
  addMadeSurfaces(maker.fibres(), spool.outer(), spool.inner(), order.growth.minimumGap, contents);
  if (contents.outer.size() + contents.inner.size() == 0)
  {
    throw InvalidInput("there are no surfaces to write: " + result.remarks);
  }
  contents.domain = fibres.domain;
  contents.fibres = &made;
  if (facts.isSample)
  {
    contents.sample = SubstrateSample{ fibres.size(), capsuleVolumeInDomain(made) / capsuleVolumeInDomain(fibres) };
  }
  contents.provenance = order.provenance ? order.provenance(spacing, solved.growth) : Provenance();
  contents.format = order.format;
  contents.encoding = order.encoding;
  contents.periodicFaces = facesFor(order.periodicFaces, order.format, fibres.domain, order.allowOpenSurfaces);
  contents.voxelSize = spacing;
  contents.allowOpenSurfaces = order.allowOpenSurfaces;
  contents.certificate.minimumGap = order.growth.minimumGap;
  return contents;
}

/// Returns the message with advice on how to continue with surfaces that could not be written.
std::string withWaysOn(const std::string& message, const std::string& folder)
{
  const std::string work = workFolderOf(folder);
  if (message.find(work) != std::string::npos)
  {
    return message; // it is about the work folder itself, and gives advice
  }
  return message + ". The surfaces are made, and kept in " + work +
         ": this FolderName goes on with them once that is mended. For another one, rename " + work + " to its name with .work";
}

/// Throws the errors of writeSubstrateFolder(); if the surfaces, which stay, cannot be written, the message says how to continue
/// with them.
WrittenSubstrate writeMade(const SubstrateFolderContents& contents, const std::string& folder, const Context& context,
  const Sharing& sharing, const Recollection& known)
{
  try
  {
    return writeSubstrateFolder(contents, folder, context, sharing, known);
  }
  catch (const InvalidInput& error)
  {
    throw InvalidInput(
      std::string(error.what()) + ". The surfaces are made, and kept in " + workFolderOf(folder) +
      ": another Format, Encoding, PeriodicFaces or AllowOpenSurfaces writes them; remove it if you do not want them");
  }
  catch (const FileError& error)
  {
    throw FileError(withWaysOn(error.what(), folder));
  }
  catch (const OutOfMemory& error)
  {
    throw OutOfMemory(withWaysOn(error.what(), folder));
  }
  catch (const std::bad_alloc&)
  {
    throw OutOfMemory(withWaysOn("out of memory: let other programs end, or use fewer threads", folder));
  }
}

} // namespace

void validate(const ProductionOrder& order)
{
  validate(order.growth);
  validate(order.surfaces);
  requireDecimationRoom(order.surfaces, order.growth.surfaceTolerance);
  requireEncoding(order.format, order.encoding);
  requireOpenable(order.periodicFaces, order.format, order.allowOpenSurfaces);
  requireWithin("SampledFraction", order.sampledFraction, limits::sampledFraction);
  const bool isSample = order.sampledFraction < 1.0;
  require(!isSample || formatOf(order.format).mayBeSample(),
    "Format is a simulator's, which would take the space of the fibres that SampledFraction leaves out for extra-axonal: choose "
    "Surfaces alone or Surfaces by bundle, or make all surfaces (SampledFraction 1)");
  require(!isSample || order.surfaces.model != GRatioModel::TargetAxonVolumeFraction,
    "the g-ratio for TargetAxonVolumeFraction depends on all fibres, of which SampledFraction leaves some out: choose another "
    "GRatioModel, or make all surfaces (SampledFraction 1)");
}

std::string workFolderOf(const std::string& folder)
{
  const std::string place = std::filesystem::path(folder).lexically_normal().string();
  return place.substr(0, place.find_last_not_of('/') + 1) + ".work";
}

ProducedSubstrate produceSubstrate(
  const Fibres& fibres, const ProductionOrder& given, const std::string& folder, const Context& context, Team* team)
{
  ProductionOrder order = given;
  const std::string work = workFolderOf(folder);
  // For this run only: another run that fails, because this one has the folder, must not end it.
  const Sharing sharing(team, work + '/' + Sharing(team).fromFirst(partialName(SurfaceSpool::stopName)));
  ProducedSubstrate result;
  std::unique_ptr<SurfaceSpool> spool;
  bool isMade = false; // whether all surfaces are made
  const auto produce = [&]
  {
    validate(fibres);
    validate(order);
    order.growth = forFibres(fibres, order.growth);
    requirePeriodic(order.periodicFaces, fibres.domain);
    requireRoom(order.format, fibres.domain, growthGrid(fibres.domain, order.growth).spacing);
    requireRoomForMyelin(fibres, order);
    requireKnownGRatio(fibres, order.surfaces);
    require(!folder.empty(), "FolderName is empty: name the folder to write");
    const std::string identity = identityOf(fibres, order);
    require(sharing.areAlike(identity + folder), // otherwise they would mix results in one folder
      "the ranks were given different fibres, properties or folders, and cannot share the work: give all of them the same");
    if (sharing.isFirst())
    {
      const FolderReplacement refuses(folder, context); // fails now, rather than at the end, if it cannot be written
    }
    const Fibres sample = order.sampledFraction < 1.0 ? madeOf(fibres, order) : Fibres();
    const Fibres& made = order.sampledFraction < 1.0 ? sample : fibres;
    spool = openSpool(work, identity, made.size(), sharing);
    result.found = spool->found();
    const Context watching = sharing.watching(context);
    const Context whole = paced(watching);
    const SubstrateFolderContents contents = makeInto(*spool, fibres, made, order, result, whole, sharing);
    isMade = true;
    result.written = writeMade(contents, folder, whole.part(surfacesMade, 1.0), sharing, spool->findings().part("judged"));
    if (sharing.isFirst())
    {
      spool->remove();
    }
  };
  // Keeps the work of an earlier run, and surfaces that another order may write.
  const auto removeUseless = [&]
  {
    if (spool != nullptr && sharing.isFirst() && !isMade && result.found == 0)
    {
      spool->remove();
    }
  };
  const auto whereKept = [&]
  {
    return !isMade && result.found > 0 ? ". What an earlier run has made is kept in " + work + ": remove it if it is of no use"
                                       : "";
  };
  try
  {
    sharing.together(produce);
  }
  catch (const InvalidInput& error)
  {
    removeUseless(); // nobody can continue a request that cannot be met
    throw InvalidInput(error.what() + whereKept());
  }
  catch (const Infeasible& error)
  {
    removeUseless();
    throw Infeasible(error.what() + whereKept());
  }
  catch (const Cancelled&)
  {
    if (spool != nullptr && sharing.isFirst() && !spool->isEmpty())
    {
      throw WorkKept(work);
    }
    removeUseless();
    throw;
  }
  catch (...)
  {
    if (spool != nullptr && sharing.isFirst() && !spool->holdsSurfaces() && !spool->foundSome())
    {
      removeUseless(); // the solved growth would only conflict with other parameters
    }
    throw;
  }
  return result;
}

} // namespace cactus
