// SPDX-License-Identifier: BSD-3-Clause
// The surfaces and fibres of a substrate, for the filters that judge and write it.
#pragma once

#include "base/Domain.h"
#include "fibres/Fibres.h"
#include "mesh/FibreSurfaces.h"

#include <optional>

class vtkAlgorithm;
class vtkDataObject;

namespace cactus
{

/// The data of a substrate; null for what there is none of. They have to stay as they are while surfaces taken from them are
/// used.
struct SubstrateData
{
  vtkDataObject* outer = nullptr;
  vtkDataObject* inner = nullptr;
  vtkDataObject* fibres = nullptr;
};

/// The fibres that the label image at a port was grown from; null where it does not come straight from FibreRadialGrowth.
vtkDataObject* fibresOfImage(vtkAlgorithm* consumer, int port);

/// What is connected to the ports `Outer`, `Inner` and `Fibres` of a filter. Where Outer comes straight from MyelinSurface, what
/// is not connected is that filter's own: its inner surfaces, and the fibres that were grown before it, as they were then. So who
/// connects the outer surfaces alone has the whole substrate judged, not a half of it. A port of -1 is none.
SubstrateData substrateDataOf(vtkAlgorithm* self, int outerPort, int innerPort, int fibrePort);

/// The same for a filter whose first port is `Fibres`: where that is given the outer surfaces of MyelinSurface, and nothing is
/// connected as `Outer`, these are measured, with what substrateDataOf finds. Throws InvalidInput where it finds no fibres.
SubstrateData measuredDataOf(vtkAlgorithm* self, int fibrePort, int outerPort, int innerPort);

/// What is found there, read.
struct Substrate
{
  Domain domain;
  FibreSurfaces outer;
  FibreSurfaces inner;
  std::optional<Fibres> fibres;

  const Fibres* fibresOrNull() const { return this->fibres ? &*this->fibres : nullptr; }
};

/// Throws InvalidInput for data that are no surfaces or fibres, or that have different domains.
Substrate substrateFrom(const SubstrateData& data);

} // namespace cactus
