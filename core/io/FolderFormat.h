// SPDX-License-Identifier: BSD-3-Clause
// What the formats of substrate folders differ in.
#pragma once

#include "base/Context.h"
#include "base/Sharing.h"
#include "io/CombinedSurfaces.h"
#include "io/FolderWriter.h"
#include "io/SubstrateContents.h"

#include <string>
#include <vector>

namespace cactus
{

/// What a surface's file is named after.
struct SurfaceName
{
  std::string kind;     ///< "outer" or "inner"
  std::string thousand; ///< with a slash, the folder that ids of the same thousand share where there are many; else empty
  std::string fibre;    ///< number with leading zeros
  std::string bundle;   ///< likewise
};

/// The surfaces of one kind that are to be written, and where.
struct SurfacesToWrite
{
  const FibreSurfaces& surfaces;
  const std::string& kind;
  const std::vector<SubstrateFile>& files; ///< one per surface
  PlyEncoding encoding;
};

/// The part of a run in which surfaces are written.
struct WritingRun
{
  const Context& context;
  const Sharing& sharing;
  double from; ///< progress
  double to;
};

/// A format of substrate folders. Its defaults are a PLY file (µm) per fibre and kind of surface, points for walkers to start
/// from where these are asked for, and nothing besides. All functions may throw InvalidInput, OutOfMemory, FileError and
/// Cancelled.
///
/// A new one is a class in a file of its own, a number and a name in SubstrateContents.h, and a line in formatOf().
class FolderFormat
{
public:
  virtual ~FolderFormat() = default;

  // What it can hold.
  virtual bool mayBeBinary() const { return false; } ///< PLY files; most readers take ASCII only
  virtual bool mayBeOpen() const { return false; }   ///< without closed surfaces its reader tells inside from outside
  virtual bool mayBeSample() const { return false; } ///< surfaces of a part of the fibres are of use to its reader
  virtual void requireContents(const SubstrateFolderContents& contents) const;
  virtual void requireRoom(const Domain& domain, double voxelSize) const;
  virtual void requireMemory(const SubstrateCertificate& certificate) const;

  // Its files.
  virtual std::string surfacePath(const SurfaceName& name) const;
  /// Called by all processes.
  virtual void writeSurfaces(const SurfacesToWrite& written, FolderWriter& writer, const WritingRun& run) const;
  virtual std::string strandsName() const { return "fibres.strands"; }
  virtual bool isReadable() const { return true; }   ///< its surfaces can be read again: they are PLY files
  virtual double surfaceUnit() const { return 1.0; } ///< µm in one unit of these files
  /// Writes all else that only this format has, and adds remarks and notes to `substrate`. Called by the first process.
  virtual void writeOwnFiles(
    const SubstrateFolderContents& contents, WrittenSubstrate& substrate, FolderWriter& writer, const Context& context) const;

  // Points for walkers to start from.
  virtual bool hasStartPositions() const { return true; }
  /// Tells whether its reader cannot do without them, so that they are also written if StartPositions is 0.
  virtual bool needsStartPositions(const SubstrateFolderContents& contents) const;
  /// Returns the simulations in whose boxes they are; none: in the start domain.
  virtual std::vector<McdcSimulation> startSimulations(
    const SubstrateFolderContents& contents, const std::vector<SubstrateFile>& files) const;
  virtual Domain startDomain(const Domain& domain) const { return domain; }
  virtual double startUnit() const { return 1.0; } ///< lengths of its reader per µm
  /// Returns the box in which such points are kept, and the origin of their coordinates; `surfaces` hold the walkers in.
  virtual SurfaceBox startBox(const FibreSurfaces& surfaces, const Domain& domain, const Context& context) const;

  // README.txt.
  virtual bool hasSurfaceFolders() const { return true; }   ///< `outer` and `inner`, which README.txt tells of
  virtual const char* fileHolds() const { return "fibre"; } ///< what has a file of its own in them
  /// Returns what README.txt says of its own files, and of how the reader is run.
  virtual std::string readme(const SubstrateFolderContents& contents, const WrittenSubstrate& substrate) const;
};

const FolderFormat& formatOf(SubstrateFormat format);

/// Returns the names of the formats for which a function is true: "MC/DC, Surfaces alone or Surfaces by bundle".
std::string formatsThat(bool (FolderFormat::*may)() const);

// The formats.
const FolderFormat& bundlesFormat();
const FolderFormat& caminoFormat();
const FolderFormat& disimpyFormat();
const FolderFormat& mcdcFormat();
const FolderFormat& mcmrFormat();
const FolderFormat& referenceFormat();
const FolderFormat& rmsFormat();
const FolderFormat& spinDoctorFormat();
const FolderFormat& surfacesFormat();

/// Makes the folders of these files, the outer ones first, and lists the files, for all processes of the run.
void prepareFiles(const std::vector<SubstrateFile>& files, FolderWriter& writer, const WritingRun& run);

/// µm: steps outside the fibres that are longer make diffusion there too slow, see docs/simulators/mcdc.md.
constexpr double longestStep = 0.05;

/// Returns three numbers as words of a command.
std::string numberWords(const Eigen::Vector3d& values, const char* between = " ");

} // namespace cactus
