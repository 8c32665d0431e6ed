// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Context.h"
#include "base/Error.h"
#include "base/Team.h"
#include "fibres/Fibres.h"
#include "growth/FibreRadialGrowthOptions.h"
#include "growth/GrowthTarget.h"
#include "io/SubstrateContents.h"
#include "surface/FibreSurfacePair.h"
#include "surface/MyelinSurfaceOptions.h"

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace cactus
{

/// The options of a production.
struct ProductionOrder
{
  FibreRadialGrowthOptions growth;
  MyelinSurfaceOptions surfaces;
  SubstrateFormat format = SubstrateFormat::Mcdc; ///< voxel labels use growth's voxels
  PlyEncoding encoding = PlyEncoding::Ascii;
  PeriodicFaces periodicFaces = PeriodicFaces::ByFormat;
  bool allowOpenSurfaces = false;
  /// The fraction of all fibres whose surfaces are made, drawn at random by the surfaces' seed, each fibre independently: a
  /// larger fraction includes the fibres of a smaller one.
  double sampledFraction = 1.0;
  /// Returns the records of the output, given the size of a voxel (µm) and the growth that was solved for.
  std::function<Provenance(double spacing, const SolvedGrowth& growth)> provenance;
};

/// Throws InvalidInput for options out of range, an encoding that the format's files do not have, and a sample that is to be
/// simulated or whose volumes depend on all fibres.
void validate(const ProductionOrder& order);

/// Result of produceSubstrate().
struct ProducedSubstrate
{
  WrittenSubstrate written;
  std::vector<FibreSurfacePair> fibres; ///< without their meshes
  std::string remarks;                  ///< see remarkOnGrowth() and notAsAsked()
  std::size_t found = 0;                ///< number of fibres whose outer surfaces an earlier run had left
};

/// Thrown when the user has stopped a production that can continue from its work folder.
class WorkKept : public Cancelled
{
public:
  explicit WorkKept(const std::string& folder)
    : Cancelled("stopped by the user, and what is finished is kept in " + folder + ": Write, or the same script, goes on with it")
    , Folder(folder)
  {
  }

  const std::string& folder() const { return this->Folder; } ///< see workFolderOf()

private:
  std::string Folder;
};

/// Returns the folder in which a production keeps its work: beside its output folder.
std::string workFolderOf(const std::string& folder);

/// Grows fibres, makes their surfaces and writes them as a substrate folder (see writeSubstrateFolder()), with the same bits as
/// growFibres(), myelinSurfaces() and that function, with a certificate for the growth's minimumGap. The label image is computed
/// tile by tile on demand, and surfaces go to workFolderOf(folder) as soon as they are made, so that neither is in memory as a
/// whole. A run that was stopped or killed continues from there, if fibres, options and version are the same; at its end the work
/// folder is removed. Outer surfaces are in memory while they are judged, see certify(). The surfaces of a sample are the same as
/// among all fibres, except where they would be kept apart from fibres outside the sample.
///
/// The processes of a team, which all get the same arguments, share the work, and all get the result; any number of them
/// continues the work that any others have left. An error in one ends it in all (see Sharing::together()).
///
/// Throws the errors of these functions and of validate(), WorkKept, InvalidInput for a work folder of something else and if no
/// fibre has a surface; and FileError. A request that cannot be met leaves no work folder but an earlier run's. Surfaces that
/// cannot be written in this way (an open surface, a format that cannot hold it) stay, and the same call with another format,
/// encoding, periodicFaces or allowOpenSurfaces writes them.
ProducedSubstrate produceSubstrate(const Fibres& fibres, const ProductionOrder& order, const std::string& folder,
  const Context& context = {}, Team* team = nullptr);

} // namespace cactus
