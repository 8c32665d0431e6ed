// SPDX-License-Identifier: BSD-3-Clause
// What a substrate folder says of its files, for a reader of them.
#pragma once

#include "base/Domain.h"
#include "base/Provenance.h"
#include "fibres/Fibres.h"
#include "io/SubstrateContents.h"
#include "io/SubstrateManifest.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace cactus
{

/// A substrate folder according to its manifest.
struct SubstrateDescription
{
  std::string folder;
  std::string strands;            ///< file with the centre lines; empty without one
  std::vector<int> strandFibres;  ///< whose lines these are; empty in folders of versions before 0.3.0
  std::vector<int> strandBundles; ///< likewise
  double unit = 1.0;              ///< µm in one unit of the surfaces' files
  Domain domain;
  std::vector<SubstrateFile> files; ///< the surfaces, those in the same file in its order
  std::size_t sampledFibres = 0;    ///< number of all fibres, if the surfaces are those of a sample; else 0
  bool isOpen = false;              ///< whether surfaces lack their caps in periodic faces
  Provenance provenance;            ///< up to the writer of the folder
  WrittenFiles written;
};

/// Returns the manifest of a path that is a manifest or a substrate folder.
std::string manifestOf(const std::string& path);

/// Tells whether a path is the manifest of a substrate folder, or such a folder, by its content.
bool isSubstrate(const std::string& path);

/// Reads the manifest. Throws FileError if it is none of ours or was changed, and InvalidInput for a format that cannot be read
/// again (see FolderFormat::isReadable()).
SubstrateDescription describeSubstrate(const std::string& path);

/// Returns the path of a file of the folder. Throws FileError, naming it, if it is missing or was changed.
std::string fileAsWritten(const SubstrateDescription& substrate, const std::string& name);

/// Reads the centre lines with the ids of their fibres, which a strand file does not have. Returns nothing if the folder has no
/// such file, or does not tell whose lines they are. Throws as readStrandFile() and fileAsWritten() do.
std::optional<Fibres> centreLines(const SubstrateDescription& substrate);

} // namespace cactus
