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
  std::string strands; ///< file with the centre lines; empty without one
  double unit = 1.0;   ///< µm in one unit of the surfaces' files
  Domain domain;
  std::vector<SubstrateFile> files; ///< the surfaces, those in the same file in its order
  std::size_t sampledFibres = 0;    ///< number of all fibres, if the surfaces are those of a sample; else 0
  bool isOpen = false;              ///< whether surfaces lack their caps in periodic faces
  Provenance provenance;            ///< up to the writer of the folder
  WrittenFiles written;
};

/// A fibre of the folder's table of fibres.
struct FibreOfFolder
{
  int fibreId = 0;
  int bundleId = 0;
  double length = 0.0; ///< µm, of the centre line in the domain; NaN if it has none
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

/// Reads the centre lines and numbers them: a strand file has no ids, but is sorted by them. Lines outside the domain that the
/// table does not list are left out. Returns nothing if the table does not fit the lines, or if there is no file of them. Throws
/// as readStrandFile() and fileAsWritten() do.
std::optional<Fibres> centreLines(const SubstrateDescription& substrate, const std::vector<FibreOfFolder>& table);

} // namespace cactus
