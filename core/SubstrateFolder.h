// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Context.h"
#include "Domain.h"
#include "FibreSurfaces.h"
#include "Fibres.h"
#include "McdcConfiguration.h"
#include "SubstrateCertificate.h"

#include <string>
#include <vector>

namespace cactus
{

/// What goes into a substrate folder.
struct SubstrateFolderContents
{
  Domain domain;
  FibreSurfaces outer;
  FibreSurfaces inner;
  const Fibres* fibres = nullptr;      ///< centre lines, if they are to be written too (`fibres.strands`)
  std::vector<std::string> provenance; ///< one line per stage so far
  bool allowOpenSurfaces = false;      ///< write surfaces that leak, too
  SubstrateCertificateOptions certificate;
  McdcOptions mcdc;
};

/// One surface's file, as the manifest lists it.
struct SubstrateFile
{
  std::string path; ///< relative to the folder
  std::string surface;
  int fibreId = 0;
  int bundleId = 0;
  std::size_t triangles = 0;
  double volume = 0.0; ///< µm³
  double area = 0.0;   ///< µm²
  bool closed = false; ///< a closed 2-manifold that points outward
};

/// What has been written, and how good it is.
struct WrittenSubstrate
{
  std::vector<SubstrateFile> files;
  SubstrateCertificate certificate; ///< of the surfaces as the files hold them
  /// What writes that were killed have left beside the folder and is kept, as it holds what is the user's: a sentence for each.
  std::vector<std::string> leftovers;
};

/// Writes a folder for simulators:
///
///   outer/fibre_00001.ply, inner/…   ASCII PLY, µm, one file per fibre and surface
///   mcdc/intra.conf, mcdc/extra.conf MC/DC configurations that run as written, with lists of the surfaces and a PGSE scheme
///   fibres.strands                   the centre lines, where given
///   certificate.csv, certificate_fibres.csv   what certify() found on the surfaces as written
///   manifest.json, README.txt
///
/// The folder appears whole or not at all, and its name holds a whole folder, the former or the new one, at any time (see
/// FolderReplacement). One that is there is replaced if it is a substrate folder in which all is as it was written, by the
/// checksums in its manifest; it is refused, by name, where anything was added, changed or write-protected: results of
/// simulations, an edited configuration, notes. Surfaces that meet or come too near are written, and their certificate says so.
/// Throws InvalidInput (no surfaces, a surface that is not a closed outward 2-manifold, unless allowed; the message names the
/// fibre), FileError, and Cancelled when stopped.
WrittenSubstrate writeSubstrateFolder(
  const SubstrateFolderContents& contents, const std::string& folder, const Context& context = {});

} // namespace cactus
