// SPDX-License-Identifier: BSD-3-Clause
// What the records of earlier stages say of the tract that fibres follow.
#pragma once

#include "base/Placement.h"
#include "base/Provenance.h"
#include "stages/Stages.h"

#include <string>
#include <utility>
#include <vector>

namespace cactus
{

/// The origins of the data at each input of a stage, by name.
using InputOrigins = std::vector<std::pair<std::string, std::vector<DataOrigin>>>;

/// Returns what is asked for, with the unit that TractogramReader gave the streamlines in place of TractUnit::AsRead; micrometres
/// if no TractogramReader is among their origins. Throws InvalidInput if several gave different ones.
TractFibresStage askedOfTract(TractFibresStage stage, const InputOrigins& inputs);

/// Tells whether data are streamlines in the millimetres that TractogramReader gave them, with no stage behind it.
bool areStreamlinesInMillimetres(const InputOrigins& inputs);

/// Returns where a substrate lies on the tract along which TractFibres has laid its fibres: there, and as large as the tract.
/// Throws InvalidInput if no TractFibres is among the origins, or several at different places.
Placement placementOnTract(const InputOrigins& inputs);

} // namespace cactus
