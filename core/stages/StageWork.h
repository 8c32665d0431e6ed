// SPDX-License-Identifier: BSD-3-Clause
// The work of a stage around its method, shared by ParaView and cactus-grow.
//
// Properties become options, and a run gets its record and remarks.
#pragma once

#include "base/Context.h"
#include "base/Provenance.h"
#include "bundle/BundleInitializer.h"
#include "bundle/CurvedBundles.h"
#include "bundle/Streamlines.h"
#include "bundle/TractFibres.h"
#include "fibres/Fibres.h"
#include "growth/GrowthTarget.h"
#include "io/FibreFile.h"
#include "io/SubstrateContents.h"
#include "io/Tractogram.h"
#include "optimiser/CapsuleOptimizer.h"
#include "stages/Stages.h"
#include "stages/SubstrateProduction.h"

#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace cactus
{

/// Returns the options, with the radii of a table given as text or as a file. Throws InvalidInput if both are given, FileError,
/// and as the readers of such tables do.
BundleInitializerOptions bundleOptions(const BundleInitializerStage& stage);

/// Returns the record of a bundle's request and result. A table of radii is kept as numbers, a file of them by its name and
/// checksum.
StageRecord bundleRecord(const BundleInitializerStage& stage, const BundleInitializerOptions& options, std::size_t fibres,
  const BundleInitializerReport& report);

/// Returns a remark on the density or the undulation that the fibres do not have as asked for; empty if they have both.
std::string remarksOnBundle(const BundleInitializerOptions& options, const BundleInitializerReport& report);

/// Do the same as the first two for curved bundles, which fill `fibreVolumeFraction` of the domain.
CurvedBundlesOptions curvedOptions(const CurvedBundlesStage& stage);
StageRecord curvedRecord(
  const CurvedBundlesStage& stage, const CurvedBundlesOptions& options, std::size_t fibres, double fibreVolumeFraction);

/// Do the same as the first two for fibres along a tract. What is asked for has its LengthUnit, see askedOfTract().
TractFibresOptions tractOptions(const TractFibresStage& stage);
StageRecord tractRecord(
  const TractFibresStage& stage, const TractFibresOptions& options, std::size_t fibres, const TractFibresReport& report);

/// Reads the tractogram of the file, with its lengths in the requested unit. Throws InvalidInput if no file is named, and as
/// readTractogram() does.
Tractogram tractogramOf(const TractogramReaderStage& stage, const Context& context = {});
/// Returns the record; if a .trx is a folder, it lists all files in it.
StageRecord tractogramRecord(const TractogramReaderStage& stage);
/// Joins the streamlines of several tractograms, validated, with bundles if all of them have any.
Streamlines streamlinesOf(const std::vector<const Tractogram*>& tractograms);

/// Returns a remark on the streamlines that the fibres do not follow; empty if they follow all.
std::string remarksOnTract(const TractFibresReport& report);

/// The fibres of the file. Throws InvalidInput where none is named, and as readFibreFile() does.
FibresOfFile strandsOf(const StrandReaderStage& stage);
StageRecord strandRecord(const StrandReaderStage& stage);

/// Returns the record of an image that was read.
StageRecord niftiRecord(const NiftiReaderStage& stage);

/// Returns the record of an optimisation, or of an intermediate state.
std::vector<std::pair<std::string, PropertyValue>> optimiserReached(
  int iterations, double penetration, StopReason reason, bool isResult);

/// Returns the record of a growth on voxels of `spacing` µm: with the fraction filled, if that is less than the target.
std::vector<std::pair<std::string, PropertyValue>> growthReached(double spacing, const SolvedGrowth& growth);

/// Returns the fibres, trimmed to their domain if the stage says so; `kept` as in trimToDomain(). Throws InvalidInput if none is
/// left.
Fibres trimmedFibres(const CapsuleOptimizerStage& stage, Fibres fibres, std::vector<std::size_t>& kept);

/// Returns a remark on a checkpoint that could not be written; empty if it was written, or not requested.
std::string remarkOnCheckpoint(const OptimisationResult& result);

/// What the user of an optimisation has to know, in sentences: where it fell short, resampled fibres or lengthened them; empty
/// where it did none of that.
std::vector<std::string> remarksOnOptimisation(const OptimisationResult& result, const CapsuleOptimizerOptions& options);

/// Returns a remark if fibres without an optimiser's result overlap: capsules of different ones have more than a hundredth of
/// their radii in common; else empty.
std::string remarkOnOverlaps(const Fibres& fibres, int threads);

/// Copies the writer's properties into the folder's contents.
void setWriterOptions(const SubstrateWriterStage& stage, SubstrateFolderContents& contents);

/// Returns the stage's properties as a ProductionOrder.
ProductionOrder productionOrder(
  const SubstrateProductionStage& stage, std::function<Provenance(double spacing, const SolvedGrowth& growth)> provenance);

} // namespace cactus
