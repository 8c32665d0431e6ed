// SPDX-License-Identifier: BSD-3-Clause
// How data came about: a record (JSON) for every stage that took part, each of which names those before it.
#pragma once

#include "base/Properties.h"

#include <string>
#include <utility>
#include <vector>

namespace cactus
{

/// The records of all stages that data have gone through, each after those before it; the last is of the stage that made them,
/// and says at which of its outputs. Texts that are no such records (of older versions, or anybody's) stay as they are.
using Provenance = std::vector<std::string>;

/// Where the data at one input came from.
struct DataOrigin
{
  Provenance records;            ///< of the data themselves
  bool isChanged = false;        ///< they are no longer what the last of the records' stages has made
  std::string filter;            ///< of the class that made them of `parts`, which is none of ours; empty for data in blocks
  std::vector<DataOrigin> parts; ///< of data in blocks, or that another filter has made of these

  bool isKnown() const;
};

/// What a stage has read besides its inputs.
struct FileRead
{
  std::string property; ///< that names it
  std::string path;
};

/// What a stage says of itself.
struct StageRecord
{
  std::string filter;
  std::vector<PropertyState> properties; ///< all of them; those that have an effect on the result are kept
  std::vector<std::pair<std::string, PropertyValue>> reached;
  std::vector<FileRead> files;
  std::vector<std::pair<std::string, std::vector<DataOrigin>>> inputs; ///< by name; a datum for each connection
};

/// All records that lead to the stage's inputs, each once, and the stage's own: a JSON object with `id`, a checksum of all else
/// in it, so that the same stage with the same inputs has the same; `filter`, `version`, `properties`, `reached`, `files` (with
/// the SHA-256 of each) and `inputs`. An input is `{"stage": id, "port": number, "checksum": ...}`, with `"changed": true` where
/// its data have been changed since; `{"filter": class, "inputs": [...]}` where another filter made it; `{"blocks": [...]}`; or
/// `{}` where nothing is known of it. Throws FileError where a file cannot be read.
Provenance provenanceOf(const StageRecord& stage);

/// The same for one output: the last record says which, and what its data are known by.
Provenance provenanceOfOutput(Provenance stages, int output, const std::string& checksum);

/// The checksum that the last record has for its data; empty where there is none.
std::string checksumOf(const Provenance& records);

} // namespace cactus
