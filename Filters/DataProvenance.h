// SPDX-License-Identifier: BSD-3-Clause
// The records of stages (core/base/Provenance.h) in the field data `Provenance` of their outputs.
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

/// Returns the origins of the data at each port and connection of `self`, by the names of the ports. Data that differ from their
/// last recorded stage were changed by filters in between: these are looked up in the pipeline, as far as it is accessible, and
/// named.
std::vector<std::pair<std::string, std::vector<DataOrigin>>> originsOf(vtkAlgorithm* self, const std::vector<std::string>& ports);

/// Makes a stage's record: the properties, files and inputs of `self`, and the values that it reached.
template <typename Stage>
Provenance recordOf(vtkAlgorithm* self, const std::string& filter, const Stage& stage, const std::vector<std::string>& ports,
  std::vector<std::pair<std::string, PropertyValue>> reached = {})
{
  return provenanceOf({ filter, Stage::properties().states(stage), std::move(reached), {}, originsOf(self, ports) });
}

/// Returns the checksums that identify our data, or all parts of them: their points, and the arrays that later stages use.
std::string checksumsOf(vtkDataObject* data);

/// Tells whether data, or all parts of them, are unchanged since their last recorded stage.
bool areAsMade(vtkDataObject* data);

/// Puts the records into the field data of the output at a port; everything else of it has to be complete.
void setProvenance(vtkDataObject* data, const Provenance& records, int port);

} // namespace cactus
