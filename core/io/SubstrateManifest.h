// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/SubstrateContents.h"

#include <map>
#include <optional>
#include <set>
#include <string>

namespace cactus
{

/// The files written into a folder; all paths are relative to it.
struct WrittenFiles
{
  std::map<std::string, std::string> checksums; ///< path → SHA-256, of every file but the manifest
  std::set<std::string> folders;
};

/// The written files according to a manifest.
struct SubstrateManifest
{
  std::string version;       ///< of CACTUS
  bool hasChecksums = false; ///< those of version 0.1.0 had none
  bool asWritten = false;    ///< whether the manifest itself is as it was written
  WrittenFiles written;
};

/// The file name of the manifest.
constexpr char manifestName[] = "manifest.json";

/// Returns the manifest (JSON) of a substrate: its description, history and certificate, every surface, and the SHA-256 of every
/// file written, including that of the manifest itself, computed with zeros in its place.
std::string manifestText(const SubstrateFolderContents& contents, const WrittenSubstrate& substrate, const WrittenFiles& written);

/// Reads a manifest. Returns nothing for any text that is none of ours.
std::optional<SubstrateManifest> readManifest(const std::string& text);

} // namespace cactus
