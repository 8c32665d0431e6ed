// SPDX-License-Identifier: BSD-3-Clause
// Finds the surfaces and fibres of a substrate, for the filters that judge and write it.
#pragma once

#include "base/Domain.h"
#include "base/Sharing.h"
#include "fibres/Fibres.h"
#include "mesh/FibreSurfaces.h"

#include <optional>
#include <string>

class vtkAlgorithm;
class vtkDataObject;

namespace cactus
{

/// The data of a substrate; null for missing ones. They must not change while surfaces taken from them are used.
struct SubstrateData
{
  vtkDataObject* outer = nullptr;
  vtkDataObject* inner = nullptr;
  vtkDataObject* fibres = nullptr;
};

/// Returns the fibres from which the label image at a port was grown; null if it does not come directly from FibreRadialGrowth.
vtkDataObject* fibresOfImage(vtkAlgorithm* consumer, int port);

/// Returns the data at the ports `Outer`, `Inner` and `Fibres` of a filter. If Outer comes directly from MyelinSurface,
/// unconnected ports get that filter's own data: its inner surfaces, and the fibres that were grown before it, as they were then;
/// from SubstrateReader and Lesion, the inner surfaces and the fibres that these give out. So a user who connects only the outer
/// surfaces has the whole substrate judged, not a half of it. A port of -1 does not exist.
SubstrateData substrateDataOf(vtkAlgorithm* self, int outerPort, int innerPort, int fibrePort);

/// Does the same for a filter whose first port is `Fibres`: if that gets the outer surfaces of MyelinSurface,
/// SubstrateReader or Lesion, and nothing is connected as `Outer`, these are measured, with the data that substrateDataOf()
/// finds. Throws InvalidInput if it finds no fibres.
SubstrateData measuredDataOf(vtkAlgorithm* self, int fibrePort, int outerPort, int innerPort);

/// Returns all ranks if they were given the same data and the same `order`, and then they share the work; this rank alone if not,
/// as where a source has data on the first rank only. Collective.
Sharing sharingOf(const SubstrateData& data, const std::string& order, const Sharing& all);

/// The converted data.
struct Substrate
{
  Domain domain;
  FibreSurfaces outer;
  FibreSurfaces inner;
  std::optional<Fibres> fibres;

  const Fibres* fibresOrNull() const { return this->fibres ? &*this->fibres : nullptr; }
};

/// Throws InvalidInput if a fibre of `outer` has a g-ratio, and no surface in `inner`: files and measures of its outer surface
/// alone would take all of it for myelin, without a word.
void requireInnerOf(const FibreSurfaces& outer, const FibreSurfaces& inner);

/// Converts the data. Throws InvalidInput for data that are no surfaces or fibres, or that have different domains.
Substrate substrateFrom(const SubstrateData& data);

/// Does the same, and throws InvalidInput for data that lack inner surfaces, see requireInnerOf().
Substrate wholeSubstrateFrom(const SubstrateData& data);

} // namespace cactus
