// SPDX-License-Identifier: BSD-3-Clause
// What a stage does around its method, the same in ParaView and without it: properties become options, what is kept of a run in
// its record, and what its user is told.
#pragma once

#include "base/Context.h"
#include "base/Provenance.h"
#include "bundle/BundleInitializer.h"
#include "bundle/Streamlines.h"
#include "bundle/TractFibres.h"
#include "fibres/Fibres.h"
#include "io/FibreFile.h"
#include "io/SubstrateContents.h"
#include "io/SubstrateProduction.h"
#include "io/Tractogram.h"
#include "optimiser/CapsuleOptimizer.h"
#include "stages/Stages.h"

#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace cactus
{

/// The options, with the radii of a table that is given as text or as a file. Throws InvalidInput for both at once, FileError,
/// and as the readers of such tables do.
BundleInitializerOptions bundleOptions(const BundleInitializerStage& stage);

/// What was asked of a bundle and reached. A table of radii is kept as numbers, a file of them by its name and checksum.
StageRecord bundleRecord(const BundleInitializerStage& stage, const BundleInitializerOptions& options, std::size_t fibres,
  const BundleInitializerReport& report);

/// The same two for fibres along a tract.
TractFibresOptions tractOptions(const TractFibresStage& stage);
StageRecord tractRecord(
  const TractFibresStage& stage, const TractFibresOptions& options, std::size_t fibres, const TractFibresReport& report);

/// The tractogram of the file, with its lengths in the unit that is asked for. Throws InvalidInput where none is named, and as
/// readTractogram() does.
Tractogram tractogramOf(const TractogramReaderStage& stage, const Context& context = {});
/// Of a .trx that is a folder all files in it are noted.
StageRecord tractogramRecord(const TractogramReaderStage& stage);
/// The streamlines of several tractograms one after the other, validated, with bundles where all of them have any.
Streamlines streamlinesOf(const std::vector<const Tractogram*>& tractograms);

/// What of the streamlines the fibres do not follow; empty where they follow all.
std::string remarksOnTract(const TractFibresReport& report);

/// The fibres of the file. Throws InvalidInput where none is named, and as readFibreFile() does.
FibresOfFile strandsOf(const StrandReaderStage& stage);
StageRecord strandRecord(const StrandReaderStage& stage);

/// What is kept of an optimisation, or of a state on its way.
std::vector<std::pair<std::string, PropertyValue>> optimiserReached(
  int iterations, double penetration, StopReason reason, bool isResult);

/// The fibres, trimmed to their domain if the stage says so; `kept` as of trimToDomain(). Throws InvalidInput where none is left.
Fibres trimmedFibres(const CapsuleOptimizerStage& stage, Fibres fibres, std::vector<std::size_t>& kept);

/// Empty where what is to be gone on from could be written down, or was not asked for.
std::string remarkOnCheckpoint(const OptimisationResult& result);

/// What the user of an optimisation has to know, in sentences: where it fell short, resampled fibres or lengthened them; empty
/// where it did none of that.
std::vector<std::string> remarksOnOptimisation(const OptimisationResult& result, const CapsuleOptimizerOptions& options);

/// That fibres which no optimiser has parted overlap, where capsules of different ones have more than a hundredth of their radii
/// in common; empty else.
std::string remarkOnOverlaps(const Fibres& fibres, int threads);

/// Puts what the writer was told into what is to be written.
void setWriterOptions(const SubstrateWriterStage& stage, SubstrateFolderContents& contents);

/// What a production was told.
ProductionOrder productionOrder(
  const SubstrateProductionStage& stage, std::function<Provenance(double spacing, double growth)> provenance);

} // namespace cactus
