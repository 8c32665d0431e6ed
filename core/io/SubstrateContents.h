// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Domain.h"
#include "base/Placement.h"
#include "base/Provenance.h"
#include "fibres/Fibres.h"
#include "io/McdcConfiguration.h"
#include "io/PlyFile.h"
#include "io/StrandFile.h"
#include "judge/SubstrateCertificate.h"
#include "mesh/FibreSurfaces.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace cactus
{

/// The reader that a substrate folder is for.
enum class SubstrateFormat
{
  Mcdc = 0,       ///< MC/DC: a PLY file per surface (µm), configurations that run as written
  Reference = 1,  ///< the reference program's run folder, as dmipy-sim loads it (µm)
  Camino = 2,     ///< one PLY file per kind of surface (m)
  Disimpy = 3,    ///< NumPy arrays of vertices (m) and faces per kind of surface
  Rms = 4,        ///< RMS: voxel labels, beside a PLY file per surface (µm)
  Surfaces = 5,   ///< for no simulator: only a PLY file per surface (µm)
  SpinDoctor = 6, ///< finite elements: one complex of triangles for tetgen, beside a PLY file per surface (µm)
  Bundles = 7,    ///< no simulator's: a PLY file per bundle and kind of surface (µm) and nothing beside
  Mcmr = 8        ///< MCMRSimulator.jl: its geometry file, beside a PLY file per surface (µm)
};

/// Their names, by their numbers.
constexpr const char* formatNames[] = { "MC/DC", "Reference program", "Camino", "Disimpy", "RMS", "Surfaces alone", "SpinDoctor",
  "Surfaces by bundle", "MCMRSimulator" };

/// How surfaces end in the faces across which a domain repeats.
enum class PeriodicFaces
{
  Caps = 0,    ///< each piece of a fibre is closed
  Open = 1,    ///< without caps, so that copies join to endless surfaces (see openAtPeriodicFaces())
  ByFormat = 2 ///< as the format's simulator is right with (see facesFor()), which is one of the others
};

/// Their names, by their numbers.
constexpr const char* periodicFacesNames[] = { "Caps", "Open", "By format" };

/// A sample of a substrate's fibres of which surfaces were made.
struct SubstrateSample
{
  std::size_t fibres = 0; ///< number of all fibres of the substrate
  double share = 1.0;     ///< volume of the sample over that of all fibres
};

/// The content of a substrate folder.
struct SubstrateFolderContents
{
  Domain domain;
  FibreSurfaces outer;
  FibreSurfaces inner;
  const Fibres* fibres = nullptr;        ///< centre lines to be written (`fibres.strands`), or null
  std::optional<SubstrateSample> sample; ///< if the surfaces belong to a sample of the fibres
  std::optional<Placement> placement;    ///< in an image's space; files stay in the substrate's space, and the manifest records
                                         ///< the placement
  Provenance provenance;                 ///< of the surfaces and their output
  bool allowOpenSurfaces = false;        ///< write surfaces that leak, too
  PeriodicFaces periodicFaces = PeriodicFaces::Caps;
  SubstrateCertificateOptions certificate;
  SubstrateFormat format = SubstrateFormat::Mcdc;
  PlyEncoding encoding = PlyEncoding::Ascii; ///< of PLY files
  McdcOptions mcdc;
  double voxelSize = 0.1; ///< µm, of label volumes
  int startPositions = 0; ///< points in each compartment for walkers to start from
  std::uint64_t seed = 1; ///< of their places
};

/// Tells whether the folder has the centre lines: a strand file can hold them.
inline bool hasStrandFile(const SubstrateFolderContents& contents)
{
  return contents.fibres != nullptr && fitsStrandFile(contents.fibres->domain);
}

/// The file of one surface, as listed in the manifest.
struct SubstrateFile
{
  std::string path; ///< relative to the folder
  std::string surface;
  int fibreId = 0;
  int bundleId = 0;
  std::size_t triangles = 0;
  double volume = 0.0; ///< µm³, with caps
  double area = 0.0;   ///< µm²
  bool closed = false; ///< a closed 2-manifold that points outward; not one that is opened at periodic faces
};

/// The part of the walkers outside the fibres that leaves the substrate within a simulation.
struct LeavingShare
{
  double share;        ///< 0 to 1
  std::size_t walkers; ///< number of walkers measured; 0: share of free walkers, an upper bound
};

/// What has been written, and how good it is.
struct WrittenSubstrate
{
  std::vector<SubstrateFile> files;
  SubstrateCertificate certificate;    ///< of the surfaces as the files hold them
  std::optional<LeavingShare> leaving; ///< for MC/DC, where that is known
  /// What its user has to know of it as the format has it: a sentence for each thing.
  std::vector<std::string> remarks;
  /// What README.txt says besides, which nobody has to be warned of: a sentence for each thing.
  std::vector<std::string> notes;
};

} // namespace cactus
