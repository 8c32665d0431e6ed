// SPDX-License-Identifier: BSD-3-Clause
// The history of data: a record (JSON) for every stage, which names the stages before it.
#pragma once

#include "base/Properties.h"

#include <string>
#include <utility>
#include <vector>

namespace cactus
{

/// The records of all stages that data have gone through, each after those before it; the last is that of the stage that made
/// them, and names the output. Texts that are no such records (of older versions or foreign programs) are kept as they are.
using Provenance = std::vector<std::string>;

/// The origin of the data at one input.
struct DataOrigin
{
  Provenance records;            ///< records carried by the data themselves
  bool isChanged = false;        ///< true if the data differ from what the last record's stage made
  std::string filter;            ///< class of the foreign filter that made the data of `parts`; empty for data in blocks
  std::vector<DataOrigin> parts; ///< origins of the blocks, or of the foreign filter's inputs

  bool isKnown() const;
};

/// A file that a stage has read besides its inputs.
struct FileRead
{
  std::string property; ///< the property that holds the path
  std::string path;
};

/// A stage's report of its own run.
struct StageRecord
{
  std::string filter;
  std::vector<PropertyState> properties; ///< all of them; those that have an effect on the result are kept
  std::vector<std::pair<std::string, PropertyValue>> reached;
  std::vector<FileRead> files;
  std::vector<std::pair<std::string, std::vector<DataOrigin>>> inputs; ///< by name; one origin for each connection
};

/// Returns all records that lead to the stage's inputs, each once, and the stage's own: a JSON object with `id`, a checksum of
/// everything else in it, so that the same stage with the same inputs has the same id; `filter`, `version`, `properties`,
/// `reached`, `files` (with the SHA-256 of each) and `inputs`. An input is `{"stage": id, "port": number, "checksum": ...}`, with
/// `"changed": true` if its data have been changed since; `{"filter": class, "inputs": [...]}` if another filter made it;
/// `{"blocks": [...]}`; or `{}` if its origin is unknown. Throws FileError if a file cannot be read.
Provenance provenanceOf(const StageRecord& stage);

/// Returns the same for one output: the last record gets its number and the checksum of its data.
Provenance provenanceOfOutput(Provenance stages, int output, const std::string& checksum);

/// Returns the checksum that the last record has for its data; empty if there is none.
std::string checksumOf(const Provenance& records);

} // namespace cactus
