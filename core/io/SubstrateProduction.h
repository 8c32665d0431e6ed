// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Context.h"
#include "base/Error.h"
#include "base/Team.h"
#include "fibres/Fibres.h"
#include "growth/FibreRadialGrowthOptions.h"
#include "io/SubstrateContents.h"
#include "surface/FibreSurfacePair.h"
#include "surface/MyelinSurfaceOptions.h"

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace cactus
{

/// What a substrate is to be made of fibres and written as.
struct ProductionOrder
{
  FibreRadialGrowthOptions growth;
  MyelinSurfaceOptions surfaces;
  SubstrateFormat format = SubstrateFormat::Mcdc; ///< labels of voxels are those of growth's voxels
  PlyEncoding encoding = PlyEncoding::Ascii;
  bool allowOpenSurfaces = false;
  /// Of all fibres, the part whose surfaces are made, drawn at random by the surfaces' seed, each fibre by itself: a larger part
  /// has those of a smaller one.
  double sampledFraction = 1.0;
  /// Of what is written, from the size of a voxel and the growth that was solved for (µm).
  std::function<Provenance(double spacing, double growth)> provenance;
};

/// Throws InvalidInput for options out of their ranges, an encoding that the format's files are not to be had in, and a sample
/// that is to be simulated or whose volumes all fibres decide on.
void validate(const ProductionOrder& order);

/// What came of it.
struct ProducedSubstrate
{
  WrittenSubstrate written;
  std::vector<FibreSurfacePair> fibres; ///< without their meshes
  std::string remarks;                  ///< see notAsAsked()
  std::size_t found = 0;                ///< surfaces that an earlier run had left
};

/// Thrown where the user has stopped a production that can go on from what it has made so far.
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

/// Where a production keeps what it has made so far: beside its folder.
std::string workFolderOf(const std::string& folder);

/// Grows fibres, makes their surfaces and writes them as a substrate folder (see writeSubstrateFolder()), the same to the bit as
/// growFibres(), myelinSurfaces() and that would, with a certificate for the growth's minimumGap. The label image is computed
/// tile by tile where it is needed, and surfaces go to workFolderOf(folder) as soon as they are made, so that neither is held in
/// memory. A run that was stopped or killed goes on from there, if fibres, options and version are the same; at its end the work
/// folder is removed. Outer surfaces are held while they are judged, see certify(). Those of a sample are what they are among
/// all, but for what keeps them apart from fibres that have none.
///
/// The processes of a team, which are all given the same, share the work, and all get the result; any number of them goes on with
/// what any other has left. An error in one ends it in all (see Sharing::together()).
///
/// Throws what these and validate() do, WorkKept, InvalidInput for a work folder of something else and where no fibre has a
/// surface; and FileError. What cannot be made leaves no work folder but an earlier run's; what has been made and cannot be
/// written so (an open surface, a format that has no room for it) stays, and the same call with another format, encoding or
/// allowOpenSurfaces writes it.
ProducedSubstrate produceSubstrate(const Fibres& fibres, const ProductionOrder& order, const std::string& folder,
  const Context& context = {}, Team* team = nullptr);

} // namespace cactus
