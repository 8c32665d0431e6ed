// SPDX-License-Identifier: BSD-3-Clause
// The stages of the chain as users see them: the options of the method, and the filter's further properties.
#pragma once

#include "base/LengthUnit.h"
#include "base/Placement.h"
#include "base/Properties.h"
#include "bundle/BundleInitializerOptions.h"
#include "bundle/CurvedBundlesOptions.h"
#include "bundle/TractFibresOptions.h"
#include "growth/FibreRadialGrowthOptions.h"
#include "io/SubstrateContents.h"
#include "judge/HistologyMask.h"
#include "judge/Lesion.h"
#include "judge/MaskColours.h"
#include "judge/SubstrateCertificate.h"
#include "judge/SubstrateSampler.h"
#include "judge/SubstrateStatistics.h"
#include "optimiser/CapsuleOptimizerOptions.h"
#include "stages/VtkMeshingOptions.h"
#include "surface/MyelinSurfaceOptions.h"

#include <cstdint>
#include <string>
#include <vector>

namespace cactus
{

struct BundleInitializerStage
{
  BundleInitializerOptions options;
  std::string radiusTable;          ///< radii (µm) as text, see parseRadiusTable(); they replace those of `options`
  std::string radiusTableFile;      ///< the same as a file
  std::string radiusTableColumn;    ///< for a file with a named column; empty for a plain list
  double radiusTableFactor = 1.0;   ///< factor on the file's numbers
  double watsonKappa = 0.0;         ///< in place of MeanDispersion, where it is above 0
  double odi = 0.0;                 ///< the same as an orientation dispersion index
  std::string orientationHarmonics; ///< coefficients as text, for DispersionModel::Harmonics
  std::string orientationPeaks;     ///< axes as text, for DispersionModel::Peaks
  std::string orientationFile;      ///< image whose voxel has these numbers, which only the filter reads
  Eigen::Vector3d orientationVoxel = Eigen::Vector3d::Zero(); ///< its whole numbers i, j and k, from 0

  static const PropertyList<BundleInitializerStage>& properties();
};

struct CurvedBundlesStage
{
  CurvedBundlesOptions options;
  std::string radiusTable;        ///< as in BundleInitializerStage
  std::string radiusTableFile;    ///< the same as a file
  std::string radiusTableColumn;  ///< as in BundleInitializerStage
  double radiusTableFactor = 1.0; ///< the same

  static const PropertyList<CurvedBundlesStage>& properties();
};

struct TractFibresStage
{
  TractFibresOptions options;
  std::string radiusTable;        ///< as in BundleInitializerStage
  std::string radiusTableFile;    ///< the same as a file
  std::string radiusTableColumn;  ///< as in BundleInitializerStage
  double radiusTableFactor = 1.0; ///< the same

  static const PropertyList<TractFibresStage>& properties();
};

struct CapsuleOptimizerStage
{
  CapsuleOptimizerOptions options;
  bool trimToDomain = true;
  int threads = 0;
  bool keepHistory = false;
  int historyInterval = 10;
  int showEvery = 0; ///< iterations; 0: only the result

  static const PropertyList<CapsuleOptimizerStage>& properties();
};

struct FibreRadialGrowthStage
{
  FibreRadialGrowthOptions options;
  int threads = 0;

  static const PropertyList<FibreRadialGrowthStage>& properties();
};

/// The code that makes surfaces.
enum class Meshing
{
  Cactus = 0, ///< core's own contouring, coarsening and spacing, with its guarantees
  Vtk = 1     ///< VTK's filters, without guarantees
};

struct MyelinSurfaceStage
{
  MyelinSurfaceOptions options;
  Meshing meshing = Meshing::Cactus;
  VtkMeshingOptions vtkMeshing;
  bool releaseInput = false;
  int threads = 0;

  static const PropertyList<MyelinSurfaceStage>& properties();
};

/// The fibres whose fields FibreField gives.
enum class FibreSelection
{
  OneFibre = 0,
  OneBundle = 1,
  AllFibres = 2
};

struct FibreFieldStage
{
  FibreSelection select = FibreSelection::OneFibre;
  int fibreId = 0; ///< 0: the first one
  int bundleId = 1;
  double level = 0.0; ///< µm
  bool clipToDomain = true;
  int threads = 0;

  static const PropertyList<FibreFieldStage>& properties();
};

struct SubstrateStatisticsStage
{
  SubstrateStatisticsOptions options;
  int bins = 25;
  int threads = 0;

  static const PropertyList<SubstrateStatisticsStage>& properties();
};

struct SubstrateCertificateStage
{
  SubstrateCertificateOptions options;
  int threads = 0;

  static const PropertyList<SubstrateCertificateStage>& properties();
};

struct LesionStage
{
  LesionOptions options;
  int threads = 0;

  static const PropertyList<LesionStage>& properties();
};

struct SubstrateSamplerStage
{
  SubstrateSamplerOptions options;
  int threads = 0;

  static const PropertyList<SubstrateSamplerStage>& properties();
};

struct HistologyMaskStage
{
  HistologyMaskOptions options;
  int threads = 0;

  static const PropertyList<HistologyMaskStage>& properties();
};

struct HistologyRadiiStage
{
  double pixelSize = 0.1;      ///< µm
  double smallestRadius = 0.0; ///< µm, of the smallest axons that count
  bool leaveOutBorder = true;  ///< leave out fibres that are cut off there
  MaskColour axonColour = MaskColour::White;
  MaskColour myelinColour = MaskColour::Grey;

  static const PropertyList<HistologyRadiiStage>& properties();
};

struct SubstrateWriterStage
{
  std::string folderName;
  SubstrateFormat format = SubstrateFormat::Mcdc;
  PlyEncoding encoding = PlyEncoding::Ascii;
  double permeability = McdcOptions().permeability;
  double voxelSize = SubstrateFolderContents().voxelSize; ///< µm
  int startPositions = 0;
  std::uint64_t seed = 1;
  PeriodicFaces periodicFaces = PeriodicFaces::ByFormat;
  bool allowOpenSurfaces = false;
  double minimumGap = SubstrateCertificateOptions().minimumGap; ///< µm
  int threads = 0;

  static const PropertyList<SubstrateWriterStage>& properties();
};

struct SubstrateProductionStage
{
  FibreRadialGrowthOptions growth; ///< except its seed, which is that of the surfaces
  MyelinSurfaceOptions surfaces;
  std::string folderName;
  SubstrateFormat format = SubstrateFormat::Mcdc;
  PlyEncoding encoding = PlyEncoding::Ascii;
  PeriodicFaces periodicFaces = PeriodicFaces::ByFormat;
  bool allowOpenSurfaces = false;
  double sampledFraction = 1.0;
  int threads = 0;

  static const PropertyList<SubstrateProductionStage>& properties();
};

struct StrandReaderStage
{
  std::string fileName;

  static const PropertyList<StrandReaderStage>& properties();
};

struct SubstrateReaderStage
{
  std::string fileName;

  static const PropertyList<SubstrateReaderStage>& properties();
};

struct StrandWriterStage
{
  std::string fileName;

  static const PropertyList<StrandWriterStage>& properties();
};

struct TractogramReaderStage
{
  std::string fileName;
  LengthUnit lengthUnit = LengthUnit::Micrometre; ///< of the output
  double radius = 0.0;                            ///< µm, of every point if the file has none; 0 for none

  static const PropertyList<TractogramReaderStage>& properties();
};

struct TractogramWriterStage
{
  std::string fileName;
  LengthUnit lengthUnit = LengthUnit::Millimetre; ///< of the file

  static const PropertyList<TractogramWriterStage>& properties();
};

struct PlacementStage
{
  PlacementOptions options;

  static const PropertyList<PlacementStage>& properties();
};

struct NiftiReaderStage
{
  std::string fileName;
  LengthUnit lengthUnit = LengthUnit::Millimetre; ///< of the output

  static const PropertyList<NiftiReaderStage>& properties();
};

struct NiftiWriterStage
{
  std::string fileName;
  std::string array;                              ///< name of the point data to write; empty for the active scalars
  LengthUnit lengthUnit = LengthUnit::Millimetre; ///< of the file

  static const PropertyList<NiftiWriterStage>& properties();
};

/// A stage with its properties at their defaults, without those of PropertyUse::Code.
struct StageDescription
{
  std::string name;
  std::vector<PropertyState> properties;
};

/// Returns all stages, in the order of the chain.
std::vector<StageDescription> describeStages();

} // namespace cactus
