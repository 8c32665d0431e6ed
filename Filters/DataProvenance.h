// SPDX-License-Identifier: BSD-3-Clause
// The records of stages (core/base/Provenance.h) in the field data `Provenance` of what they make.
#pragma once

#include "base/Properties.h"
#include "base/Provenance.h"

#include <string>
#include <utility>
#include <vector>

class vtkAlgorithm;
class vtkDataObject;

namespace cactus
{

/// Where the data that come in at each port and connection of `self` came from, by the names of the ports. Data that are not as
/// the stage has left them that they tell of were made by filters in between: these are looked up in the pipeline, as far as it
/// is at hand, and named.
std::vector<std::pair<std::string, std::vector<DataOrigin>>> originsOf(vtkAlgorithm* self, const std::vector<std::string>& ports);

/// A stage's record: what `self` was told, has read and was given, and what it has reached.
template <typename Stage>
Provenance recordOf(vtkAlgorithm* self, const std::string& filter, const Stage& stage, const std::vector<std::string>& ports,
  std::vector<std::pair<std::string, PropertyValue>> reached = {})
{
  return provenanceOf({ filter, Stage::properties().states(stage), std::move(reached), {}, originsOf(self, ports) });
}

/// Whether data, or all parts of them, are as the last stage has left them that they tell of.
bool areAsMade(vtkDataObject* data);

/// Puts the records into the field data of what comes out at a port, all else of which has to be there.
void setProvenance(vtkDataObject* data, const Provenance& records, int port);

} // namespace cactus
