// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Context.h"
#include "base/Domain.h"
#include "base/Properties.h"
#include "fibres/Fibres.h"
#include "mesh/FibreSurfaces.h"
#include "mesh/VoxelVolumes.h"

#include <array>
#include <map>
#include <vector>

namespace cactus
{

/// Edges of voxels: from a hundredth of usual ones of growth to those of images.
constexpr Range sampledVoxel{ 1e-3, 1e5, " µm" };

/// The even order of the spherical harmonics of orientation distributions.
enum class HarmonicsOrder
{
  None,
  Two,
  Four,
  Six,
  Eight,
  Ten,
  Twelve
};

struct SubstrateSamplerOptions
{
  double voxelSize = 1.0; ///< µm, edge of a voxel
  HarmonicsOrder harmonics = HarmonicsOrder::None;
  bool peaks = false; ///< whether to compute the bundles' directions

  static const PropertyList<SubstrateSamplerOptions>& properties();
};

/// The main compartment of a voxel.
enum class Compartment : unsigned char
{
  ExtraAxonal = 0,
  Axon = 1,
  Myelin = 2
};

/// A substrate on a grid of voxels; lists go by VoxelBoxes::index().
struct SampledSubstrate
{
  VoxelBoxes voxels;
  std::vector<double> axonFraction;                  ///< of the voxel's part in the domain, inside inner surfaces
  std::vector<double> myelinFraction;                ///< inside outer surfaces and not inside inner ones
  std::map<int, std::vector<double>> bundleFraction; ///< inside the outer surfaces of a bundle, by BundleId
  std::vector<Compartment> compartment;              ///< the one with the largest fraction
  std::vector<int> fibreId;                          ///< fibre with the largest volume, if the compartment is not extra-axonal;
                                                     ///< else 0
  std::vector<int> fibreCount;                       ///< number of fibres with a part in the voxel
  int openSurfaces = 0; ///< surfaces that are no closed, outward 2-manifolds, so that their volumes are unreliable
  /// Directions of the fibres' centre lines, each weighted with its fibre's volume in the voxel: the least-squares axis (unit, z
  /// not negative), and the angle (degrees) to it whose squared cosine is the mean of theirs. Empty without centre lines; zero
  /// and NaN without a fibre.
  std::vector<Eigen::Vector3d> direction;
  std::vector<double> dispersion;
  int harmonicsOrder = 0;        ///< 0 for none
  std::vector<double> harmonics; ///< harmonicCount(harmonicsOrder) for each voxel; see sampleSubstrate()
  /// The axes of the peakCount bundles that fill most of the voxel, largest first, each as long as the fraction of the voxel that
  /// the bundle fills; NaN for missing ones. Empty unless requested.
  static constexpr std::size_t peakCount = 3;
  std::vector<std::array<Eigen::Vector3d, peakCount>> peaks;
};

/// Returns the grid: voxels from the domain's lower corner on, as many as cover it.
VoxelBoxes samplerGrid(const Domain& domain, const SubstrateSamplerOptions& options);

/// Samples a substrate. Fractions are exact volumes of the meshes (see voxelVolumes) over that of the voxel's part in the domain,
/// so that their means over the domain are those of the whole. Only a few meshes per thread are in memory at once. Gives the same
/// bits on any number of threads. `fibres` may be null.
///
/// The fibre orientation distribution has, for every fibre, its directions in the voxel, weighted with its fraction. Its integral
/// over the sphere is the fraction of all fibres; the result holds its coefficients up to an order (harmonicsAt).
///
/// Throws InvalidInput for options out of range, for a grid of too many voxels, for no surfaces, and for directions without
/// fibres; OutOfMemory, and Cancelled.
SampledSubstrate sampleSubstrate(const Domain& domain, const FibreSurfaces& outer, const FibreSurfaces& inner,
  const Fibres* fibres, const SubstrateSamplerOptions& options, const Context& context = {});

} // namespace cactus
