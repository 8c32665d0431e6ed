// SPDX-License-Identifier: BSD-3-Clause
#include "recipe/RecipeRun.h"

#include "base/Provenance.h"
#include "bundle/CurvedBundles.h"
#include "bundle/TractFibres.h"
#include "fibres/JoinFibres.h"
#include "growth/FibreRadialGrowth.h"
#include "growth/GrowthTarget.h"
#include "growth/TargetRadii.h"
#include "io/FolderReplacement.h"
#include "io/MadeSurfaces.h"
#include "io/SubstrateFolder.h"
#include "recipe/DataChecksum.h"
#include "stages/StageWork.h"
#include "stages/SubstrateProduction.h"
#include "stages/TractRecords.h"
#include "surface/SurfaceMaker.h"
#include "surface/SurfaceRemarks.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace cactus
{

namespace
{

/// The fibres of a stage.
struct MadeFibres
{
  Fibres fibres;
  bool isParted = false; ///< whether one optimiser has parted them
};

/// The label image, and its facts for the surfaces.
struct GrownImage
{
  LabelImage image;
  LabelImageFacts facts;
  double gap = 0.0;
  Fibres fibres; ///< those from which it was grown
};

struct MadeSurfaces
{
  explicit MadeSurfaces(std::size_t count)
    : outer(count)
    , inner(count)
  {
  }

  std::vector<FibreSurfacePair> fibres;
  SurfacesInMemory outer;
  SurfacesInMemory inner;
  LabelImageFacts facts;
  Fibres grownFrom;
};

/// Runs the stages one by one.
class RecipeRun
{
public:
  RecipeRun(const Recipe& recipe, const std::string& folder, const Context& context,
    const std::function<void(const std::string&)>& remark)
    : All(recipe)
    , Folder(folder)
    , Caller(context)
    , Remark(remark)
  {
  }

  WrittenSubstrate run()
  {
    for (std::size_t i = 0; i < this->All.stages.size(); ++i)
    {
      this->Caller.checkpoint();
      this->Now = i;
      std::visit([this](const auto& stage) { this->work(stage); }, this->All.stages[i].options);
    }
    return std::move(this->Written);
  }

private:
  const RecipeStage& stage() const { return this->All.stages[this->Now]; }

  void say(const std::string& what) const
  {
    if (!what.empty() && this->Remark)
    {
      this->Remark(what);
    }
  }

  Context contextFor(int threads) const
  {
    Context context = this->Caller;
    context.threads = this->Caller.threads > 0 ? this->Caller.threads : threads;
    const std::string title =
      std::to_string(this->Now + 1) + '/' + std::to_string(this->All.stages.size()) + ' ' + this->stage().name;
    context.progress = [this, title](double fraction, const std::string& message)
    { this->Caller.report(fraction, message.empty() ? title : title + ": " + message); };
    return context;
  }

  // Inputs.

  Fibres fibresFrom(const RecipeSource& source) const
  {
    if (source.blocks.empty())
    {
      return this->FibresOf.at(source.stage).fibres;
    }
    return this->fibresFrom(source.blocks);
  }

  Fibres fibresFrom(const std::vector<RecipeSource>& sources) const
  {
    std::vector<Fibres> inputs;
    inputs.reserve(sources.size());
    for (const RecipeSource& source : sources)
    {
      inputs.push_back(this->fibresFrom(source));
    }
    return joinFibres(std::move(inputs));
  }

  void collectTracts(const std::vector<RecipeSource>& sources, std::vector<const Tractogram*>& tracts) const
  {
    for (const RecipeSource& source : sources)
    {
      if (source.blocks.empty())
      {
        tracts.push_back(&this->TractsOf.at(source.stage));
      }
      this->collectTracts(source.blocks, tracts);
    }
  }

  bool isParted(const RecipeSource& source) const { return source.blocks.empty() && this->FibresOf.at(source.stage).isParted; }

  DataOrigin originOf(const RecipeSource& source) const
  {
    DataOrigin origin;
    for (const RecipeSource& block : source.blocks)
    {
      origin.parts.push_back(this->originOf(block));
    }
    if (source.blocks.empty())
    {
      origin.records = this->RecordsOf.at({ source.stage, source.port });
    }
    return origin;
  }

  template <typename Options>
  Provenance record(const Options& options, std::vector<std::pair<std::string, PropertyValue>> reached = {}) const
  {
    return this->withInputs({ this->stage().name, Options::properties().states(options), std::move(reached), {}, {} });
  }

  InputOrigins originsOfInputs() const
  {
    InputOrigins origins;
    for (const auto& [name, sources] : this->stage().inputs)
    {
      origins.emplace_back(name, std::vector<DataOrigin>());
      for (const RecipeSource& source : sources)
      {
        origins.back().second.push_back(this->originOf(source));
      }
    }
    return origins;
  }

  Provenance withInputs(StageRecord record) const
  {
    record.inputs = this->originsOfInputs();
    return provenanceOf(record);
  }

  // Outputs.

  void giveFibres(Fibres fibres, const Provenance& records, bool isParted)
  {
    this->RecordsOf[{ this->Now, 0 }] = provenanceOfOutput(records, 0, dataChecksum(fibres));
    this->FibresOf[this->Now] = { std::move(fibres), isParted };
  }

  // Stages.

  void work(const BundleInitializerStage& stage)
  {
    const BundleInitializerOptions options = bundleOptions(stage);
    BundleInitializerReport report;
    Fibres fibres = initialiseBundles(options, this->contextFor(0), &report);
    const std::string remarks = remarksOnBundle(options, report);
    this->say(remarks.empty() ? "" : "BundleInitializer: " + remarks);
    const Provenance records = provenanceOf(bundleRecord(stage, options, fibres.size(), report));
    this->giveFibres(std::move(fibres), records, false);
  }

  void work(const CurvedBundlesStage& stage)
  {
    const CurvedBundlesOptions options = curvedOptions(stage);
    double filled = 0.0;
    Fibres fibres = layCurvedBundles(options, this->contextFor(0), &filled);
    const Provenance records = provenanceOf(curvedRecord(stage, options, fibres.size(), filled));
    this->giveFibres(std::move(fibres), records, false);
  }

  void work(const TractogramReaderStage& stage)
  {
    Tractogram tractogram = tractogramOf(stage, this->contextFor(0));
    for (const std::string& remark : tractogram.remarks)
    {
      this->say("TractogramReader: " + stage.fileName + ": " + remark);
    }
    this->RecordsOf[{ this->Now, 0 }] = provenanceOfOutput(provenanceOf(tractogramRecord(stage)), 0, dataChecksum(tractogram));
    this->TractsOf[this->Now] = std::move(tractogram);
  }

  void work(const TractFibresStage& given)
  {
    const TractFibresStage stage = askedOfTract(given, this->originsOfInputs());
    const TractFibresOptions options = tractOptions(stage);
    std::vector<const Tractogram*> tracts;
    this->collectTracts(this->stage().input("Input"), tracts);
    TractFibresReport report;
    Fibres fibres = layTractFibres(streamlinesOf(tracts), options, this->contextFor(0), &report);
    const std::string remarks = remarksOnTract(report);
    this->say(remarks.empty() ? "" : "TractFibres: " + remarks);
    const Provenance records = this->withInputs(tractRecord(stage, options, fibres.size(), report));
    this->giveFibres(std::move(fibres), records, false);
    const auto followsTract = [](const RecipeStage& one) { return std::holds_alternative<TractFibresStage>(one.options); };
    const auto next = this->All.stages.begin() + static_cast<std::ptrdiff_t>(this->Now) + 1;
    if (std::none_of(next, this->All.stages.end(), followsTract))
    {
      this->TractsOf.clear(); // may be gigabytes
    }
  }

  void work(const StrandReaderStage& stage)
  {
    FibresOfFile read = strandsOf(stage);
    for (const std::string& remark : read.remarks)
    {
      this->say("StrandReader: " + stage.fileName + ": " + remark);
    }
    this->giveFibres(std::move(read.fibres), provenanceOf(strandRecord(stage)), false);
  }

  void work(const CapsuleOptimizerStage& stage)
  {
    Fibres fibres = this->fibresFrom(this->stage().input("Input"));
    validate(fibres);
    const OptimisationResult result = optimise(fibres, stage.options, this->contextFor(stage.threads));
    if (this->Caller.stopRequested())
    {
      const std::string remark = remarkOnCheckpoint(result);
      this->say(remark.empty() ? "" : "CapsuleOptimizer: " + remark);
      throw Cancelled(); // its best state is kept, but is no result here
    }
    std::vector<std::size_t> kept;
    fibres = trimmedFibres(stage, std::move(fibres), kept);
    for (const std::string& remark : remarksOnOptimisation(result, stage.options))
    {
      this->say("CapsuleOptimizer: " + remark);
    }
    const int iterations = result.convergence.back().iteration;
    this->giveFibres(
      std::move(fibres), this->record(stage, optimiserReached(iterations, result.maximumPenetration, result.reason, true)), true);
  }

  /// Returns the fibres to grow, and reports remarks on them.
  Fibres growingFibres(const FibreRadialGrowthOptions& options, const Context& context) const
  {
    const RecipeSource& source = this->stage().input("Input").front();
    Fibres fibres = this->fibresFrom(source);
    if (!this->isParted(source))
    {
      this->say(remarkOnOverlaps(fibres, context.threadCount()));
    }
    this->say(remarkOnTarget(fibres, options));
    return fibres;
  }

  void work(const FibreRadialGrowthStage& stage)
  {
    const Context context = this->contextFor(stage.threads);
    Fibres fibres = this->growingFibres(stage.options, context);
    const FibreRadialGrowthOptions options = forFibres(fibres, stage.options);
    const Fibres aimed = aimAtTargetRadii(fibres, options, context);
    const SolvedGrowth growth = growthFor(aimed, options, context);
    this->say(remarkOnGrowth(fibres, options, growth));
    const VoxelGrid grid = growthGrid(fibres.domain, options);
    LabelImage image = growFibres(aimed, options, growth.growth, grid, context);
    this->RecordsOf[{ this->Now, 0 }] =
      provenanceOfOutput(this->record(stage, growthReached(grid.spacing, growth)), 0, dataChecksum(image));
    GrownImage grown{ std::move(image), grownImageFacts(fibres, options), options.gap(), {} };
    grown.fibres = std::move(fibres);
    this->Grown = std::move(grown);
  }

  void work(const MyelinSurfaceStage& stage)
  {
    GrownImage grown = std::move(*this->Grown);
    this->Grown.reset();
    grown.facts.centreLines = stage.options.followsLines() ? std::make_shared<const Fibres>(grown.fibres) : nullptr;
    const LabelImageView view{ grown.image.grid, grown.image.fibreId.data(), grown.image.depth.data(), grown.gap };
    SurfaceMaker maker(std::make_shared<LabelImageInMemory>(view), grown.facts, stage.options, this->contextFor(stage.threads));
    auto made = std::make_unique<MadeSurfaces>(maker.fibres().size());
    maker.makeOuter(made->outer, made->inner);
    maker.makeInner(made->outer, made->inner);
    this->say(notAsAsked(maker.fibres(), view.grid.spacing, grown.facts));
    this->say(remarkOnSwellings(maker.fibres(), grown.facts, stage.options));
    made->fibres = maker.fibres();
    made->facts = std::move(grown.facts);
    made->grownFrom = std::move(grown.fibres);
    const Provenance records = this->record(stage);
    for (const int port : { 0, 1 })
    {
      const SurfacesInMemory& surfaces = port == 0 ? made->outer : made->inner;
      this->RecordsOf[{ this->Now, port }] = provenanceOfOutput(records, port, dataChecksum(made->fibres, surfaces, port));
    }
    this->Surfaces = std::move(made);
  }

  void work(const SubstrateWriterStage& stage)
  {
    const MadeSurfaces& made = *this->Surfaces;
    const std::vector<RecipeSource>& centreLines = this->stage().input("Fibres");
    const Fibres fibres = centreLines.empty() ? made.grownFrom : this->fibresFrom(centreLines);
    SubstrateFolderContents contents;
    contents.domain = made.facts.domain;
    addMadeSurfaces(made.fibres, made.outer, made.inner, made.facts.minimumGap, contents);
    contents.fibres = &fibres;
    contents.provenance = this->record(stage);
    setWriterOptions(stage, contents);
    this->Written = writeSubstrateFolder(contents, this->Folder, this->contextFor(stage.threads));
    this->sayOfFolder(this->Written);
  }

  void work(const SubstrateProductionStage& stage)
  {
    const Context context = this->contextFor(stage.threads);
    const ProductionOrder order = productionOrder(
      stage, [&](double spacing, const SolvedGrowth& growth) { return this->record(stage, growthReached(spacing, growth)); });
    const Fibres fibres = this->growingFibres(order.growth, context);
    ProducedSubstrate produced = produceSubstrate(fibres, order, this->Folder, context);
    this->say(produced.remarks);
    this->Written = std::move(produced.written);
    this->sayOfFolder(this->Written);
  }

  void sayOfFolder(const WrittenSubstrate& written) const
  {
    for (const std::string& sentence : written.remarks)
    {
      this->say(sentence);
    }
  }

  const Recipe& All;
  const std::string& Folder;
  const Context& Caller;
  const std::function<void(const std::string&)>& Remark;
  std::size_t Now = 0; ///< the running stage
  std::map<std::size_t, Tractogram> TractsOf;
  std::map<std::size_t, MadeFibres> FibresOf;
  std::map<std::pair<std::size_t, int>, Provenance> RecordsOf; ///< of each stage's output
  std::optional<GrownImage> Grown;
  std::unique_ptr<MadeSurfaces> Surfaces;
  WrittenSubstrate Written;
};

} // namespace

WrittenSubstrate runRecipe(
  const Recipe& recipe, const std::string& folder, const Context& context, const std::function<void(const std::string&)>& remark)
{
  {
    const FolderReplacement refuses(folder, context); // fails now, rather than at the end, if it cannot be written
  }
  return RecipeRun(recipe, folder, context, remark).run();
}

} // namespace cactus
