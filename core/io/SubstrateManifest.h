// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/SubstrateContents.h"

#include <map>
#include <optional>
#include <set>
#include <string>

namespace cactus
{

/// What has been written into a folder; all paths are relative to it.
struct WrittenFiles
{
  std::map<std::string, std::string> checksums; ///< path → SHA-256, of every file but the manifest
  std::set<std::string> folders;
};

/// What a manifest says was written.
struct SubstrateManifest
{
  std::string version;       ///< of CACTUS
  bool hasChecksums = false; ///< those of version 0.1.0 had none
  bool asWritten = false;    ///< the manifest itself is as it was written
  WrittenFiles written;
};

/// The name of the manifest's file.
constexpr char manifestName[] = "manifest.json";

/// The manifest (JSON) of a substrate: what it is, how it was made, how good it is, every surface, and the SHA-256 of every file
/// written, that of the manifest itself included, taken with zeros in its place.
std::string manifestText(const SubstrateFolderContents& contents, const WrittenSubstrate& substrate, const WrittenFiles& written);

/// Reads a manifest. Nothing for a text that is none of ours, whatever it is.
std::optional<SubstrateManifest> readManifest(const std::string& text);

} // namespace cactus
