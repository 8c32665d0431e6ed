// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Domain.h"
#include "base/Properties.h"
#include "bundle/CalibreVariation.h"
#include "bundle/ControlPointSpacing.h"
#include "bundle/DirectionDistribution.h"
#include "bundle/RadiusDistribution.h"
#include "bundle/UnmyelinatedAxons.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace cactus
{

/// How two crossing bundles share the space.
enum class Mixing
{
  Interpenetrating, ///< each fills the whole domain; where their fibres meet, the optimiser bends them around each other
  Layers            ///< each has layers of its own
};

/// The layers of two crossing bundles. A fibre stays within its layer from end to end, so straight fibres of different bundles
/// never meet.
enum class CrossingStyle
{
  Interwoven, ///< thin layers of random thickness, one or two fibres thick, alternating in y
  Sheets      ///< few layers of equal thickness
};

/// How fibres meet the sides of the domain.
enum class Border
{
  Cut,            ///< the domain is cut from the middle of a larger bundle, so that fibres run out through all its faces
  Walls,          ///< all fibres of a bundle start and end within the domain's faces, as between walls
  PeriodicAcross, ///< a fibre that leaves through a face across x or y comes in again through the opposite one; cut along z
  Periodic        ///< the same across z, too: the domain and its copies are endless tissue
};

/// Options of initialiseBundles(). Lengths in µm, angles in degrees.
struct BundleInitializerOptions
{
  double side = 30.0;  ///< of the domain along x and y
  double length = 0.0; ///< of the domain along z; 0: side
  /// In (0, 1). Volume of the capsules within the domain (see capsuleVolumeInDomain) over that of the domain; one bundle between
  /// walls: area of the circles on the end faces over the area of the faces.
  double fibreVolumeFraction = 0.6;
  RadiusDistributionOptions radius; ///< outer radii of the fibres
  CalibreVariation calibre;         ///< how they vary along a fibre
  UnmyelinatedAxons unmyelinated;   ///< among them; not with bundles in layers
  /// Fraction of the domain that growth is to fill later, at least fibreVolumeFraction. Capsules start thinner than the sampled
  /// target radii by sqrt(fibreVolumeFraction / this), so that grown fibres have the target radii; 0: capsules have the target
  /// radii.
  double grownFibreVolumeFraction = 0.9;
  Border border = Border::Cut;
  /// Mean angle between fibres and the bundle's axis, in [0, 45]. Where fibres follow a stationary flow, it is that of their
  /// directions at any place, without undulation; otherwise that of their directions from end to end.
  double meanDispersion = 5.0;
  /// With Coherent, fibres follow a flow; with the others they are straight. Layers of two crossing bundles are too thin for a
  /// flow, so that their fibres are drawn as with Watson.
  DispersionModel dispersionModel = DispersionModel::Coherent;
  /// With DispersionModel::Harmonics, coefficients of the distribution of directions, see HarmonicsDistribution. Needs
  /// Border::Cut and numberOfBundles 1, as does Peaks.
  std::vector<double> harmonics;
  std::vector<Eigen::Vector3d> peaks; ///< with DispersionModel::Peaks, see orientedBundles()
  /// Lateral distance over which the directions of DispersionModel::Coherent are alike (see StationaryFlow). Between walls it may
  /// be 0: four times the mean shift of the fibres from face to face, at least a 32nd of the face (see CoherentFlow).
  double correlationLength = 8.0;
  /// Mean length of fibres over the distance of their ends along one wavelength, with a stationary flow; 1: no undulation.
  double sinuosity = 1.03;
  double undulationWavelength = 25.0; ///< µm, along the fibres
  /// Axis of a single bundle, of any length. Another one than ±z needs Border::Cut.
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();
  int numberOfBundles = 1;                  ///< 1 or 2
  double crossingAngle = 90.0;              ///< between the axes of two bundles, in (0, 90]
  Mixing mixing = Mixing::Interpenetrating; ///< with Border::Cut; between walls bundles have layers
  CrossingStyle crossingStyle = CrossingStyle::Interwoven;
  /// Least thickness of each layer of CrossingStyle::Sheets; 0: a sixth of the region's height, or the need of the largest
  /// radius.
  double sheetThickness = 0.0;
  /// Width by which the fibres extend laterally beyond each side of the domain (for two bundles on all sides). -1: as needed,
  /// that is with Border::Cut as wide as the fibres' slants ask, and a little beyond the ends (see surroundings()), and 0 with
  /// walls.
  double margin = -1.0;
  ControlPointSpacing spacing;
  std::uint64_t seed = 1;

  static const PropertyList<BundleInitializerOptions>& properties();
  /// Throws InvalidInput, naming the property, unless every value that has an effect is within its range.
  void validate() const;
  bool isCutOut() const { return this->border != Border::Walls; }
  bool isPeriodic() const { return this->border == Border::PeriodicAcross || this->border == Border::Periodic; }
  /// Tells whether two bundles have layers of their own.
  bool isLayered() const { return this->numberOfBundles == 2 && (this->mixing == Mixing::Layers || !this->isCutOut()); }
  /// Tells whether straight fibres are laid evenly in space, see layLinesInSpace().
  bool isAnywhere() const
  {
    return this->dispersionModel == DispersionModel::Harmonics || this->dispersionModel == DispersionModel::Peaks;
  }
  /// Returns the lateral correlation length (µm): in a periodic domain at most a third of its side, so that some waves fit in.
  double lateralCorrelationLength() const;
  /// Returns the box around the origin in which the fibres are asked for.
  Domain domain() const;
  /// Returns the rotation of a single bundle from z to its direction, see turnTo().
  Eigen::Matrix3d turn() const;
  /// Returns the size of the box along the axes of a single bundle that just holds the domain.
  Eigen::Vector3d extent() const;
  /// Returns the radius of the capsules over the sampled target radius.
  double thinning() const;
  /// Returns the part of the fibres' volume that axons without myelin have.
  double unmyelinatedShare() const;
  /// Returns the distance (µm) of control points of a fibre of this radius.
  double controlPointSpacing(double fibreRadius) const;

private:
  void requirePeriodic() const;
  void requireUnmyelinated() const;
};

/// Returns the smallest rotation that turns z to a direction (of any length) or the opposite one: the same for both.
Eigen::Matrix3d turnTo(const Eigen::Vector3d& direction);

/// How far the fibres extend beyond the domain, in µm.
struct Surroundings
{
  double sides = 0.0; ///< beyond each lateral face; with layers and with isAnywhere() beyond all faces
  double ends = 0.0;  ///< beyond the faces that the fibres of a single bundle run to; with Border::Periodic they are repeated
};

/// Returns the margin, or, where it is to be as wide as needed, the width within which the bundle's own border still shows: as
/// far as fibres get sideways in half its length, and beside its walls, where circles lie in rows.
Surroundings surroundings(const BundleInitializerOptions& options);

/// Tells whether fibres follow a flow: layers of two crossing bundles are too thin for one.
bool isCoherent(const BundleInitializerOptions& options);

/// Tells whether that flow is a stationary one, which does not end at the domain's faces.
bool isStationary(const BundleInitializerOptions& options);

} // namespace cactus
