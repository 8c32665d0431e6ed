// SPDX-License-Identifier: BSD-3-Clause
// Cross-sections of a fibre along its centre line, and measures of these.
#pragma once

#include "fibres/Fibres.h"
#include "mesh/TriangleMesh.h"

#include <cstddef>
#include <tuple>
#include <vector>

namespace cactus
{

/// A place on a fibre's centre line.
struct FibrePlace
{
  std::size_t number = 0;                              ///< from 0 along the centre line, at (number + 1/2) · spacing
  Eigen::Vector3d point = Eigen::Vector3d::Zero();     ///< µm
  Eigen::Vector3d direction = Eigen::Vector3d::Zero(); ///< unit vector: the chord over one spacing
};

/// Returns the places inside the domain at every `spacing` µm along fibre number `fibre`'s centre line, in their order. Throws
/// InvalidInput for a spacing that is out of range or gives more than limits::cuts places.
std::vector<FibrePlace> placesAlongFibre(const Fibres& fibres, std::size_t fibre, double spacing);

/// One cross-section of a surface, orthogonal to its fibre's centre line.
struct FibreCut
{
  std::size_t number = 0;   ///< of its place, see FibrePlace
  double area = 0.0;        ///< µm²
  double circularity = 0.0; ///< 4π · area / perimeter²: 1 for circles, 0.91 for hexagons, 0.79 for squares
  double axisRatio = 0.0;   ///< minor over major axis, see polygonAxisRatio()
};

/// Returns the cross-sections of a surface at every `spacing` µm along fibre number `fibre`'s centre line, orthogonal to it, in
/// their order. Cuts that reach the domain's boundary or a cap of the surface (inner surfaces end before the boundary), or around
/// a point outside the surface, do not count. Throws as placesAlongFibre() does.
std::vector<FibreCut> cutsAlongFibre(const Fibres& fibres, std::size_t fibre, const TriangleMesh& surface, double spacing);

/// Returns the radius (µm) of the circle with a cut's area.
double equivalentRadius(const FibreCut& cut);

/// Statistics of one surface's cross-sections along its fibre. The equivalent radius of a cut is that of the circle of the same
/// area.
struct RadiusAlongFibre
{
  std::size_t cuts = 0;     ///< number of cross-sections that lie wholly inside the domain; without any, the others are NaN
  double mean = 0.0;        ///< µm, of the equivalent radius; without a cut, see radiusAlongFibre()
  double deviation = 0.0;   ///< µm, standard deviation of the equivalent radius along the fibre
  double circularity = 0.0; ///< mean over the cuts
  double axisRatio = 0.0;   ///< likewise
};

/// Lists all of a radius, see base/Bytes.h.
inline auto membersOf(RadiusAlongFibre& radius)
{
  return std::tie(radius.cuts, radius.mean, radius.deviation, radius.circularity, radius.axisRatio);
}

RadiusAlongFibre radiusAlong(const std::vector<FibreCut>& cuts);

/// Returns the radius (µm) of the tube around fibre number `fibre`'s centre line that has the given volume (µm³) between the caps
/// of the fibre's surface; NaN unless the volume is positive. The tube is cut by the domain's faces as the surface is, so the
/// radius is that of the whole fibre, however much of it lies inside.
double radiusOfVolume(const Fibres& fibres, std::size_t fibre, const TriangleMesh& surface, double volume);

/// Returns radiusAlong() of the fibre's `cuts`, those of cutsAlongFibre(). Without a cut, the mean is radiusOfVolume() of the
/// surface's volume.
RadiusAlongFibre radiusAlongFibre(
  const Fibres& fibres, std::size_t fibre, const TriangleMesh& surface, const std::vector<FibreCut>& cuts, double volume);

/// Computes (⟨r⁶⟩ / ⟨r²⟩)^¼ over cross-sections of axons: the effective radius of wide-pulse diffusion MRI (Burcaw et al. 2015,
/// NeuroImage 114:18; Veraart et al. 2020, eLife 9:e49855).
class EffectiveRadius
{
public:
  /// Adds cross-sections of the given area (µm²).
  void add(double area, double count = 1.0);
  /// Returns µm; NaN without a cross-section.
  double value() const;

private:
  double Squares = 0.0;
  double SixthPowers = 0.0;
};

/// Properties of an axon's cross-sectional area A along its fibre that determine diffusion along it; NaN without cuts.
struct AxonShape
{
  double meanInverseArea = 0.0; ///< µm⁻², ⟨1/A⟩
  double areaVariance = 0.0;    ///< ⟨A²⟩/⟨A⟩² - 1, the variance of A/⟨A⟩
  /// µm, Γ(k) = |∫ (A/⟨A⟩ - 1) exp(-iks) ds|² / L at the smallest wave number that fits the cuts' length L, k = 2π/L: an estimate
  /// of the plateau Γ(k → 0) of short-range disorder, which determines how the diffusivity along axons approaches its limit as
  /// t^-½ (Novikov et al. 2014, PNAS 111:5088; normalised as Γ_1d of Lee et al. 2020, Communications Biology 3:354). Its scatter
  /// is as large as itself: a mean over axons estimates the plateau. NaN for fewer than three cuts.
  double areaFluctuation = 0.0;
  /// 1 / (⟨A⟩⟨1/A⟩): the diffusivity along a straight axon of slowly varying calibre, relative to free water (Lifson and Jackson
  /// 1962, J Chem Phys 36:2410).
  double diffusivityRatio = 0.0;
  double effectiveRadius = 0.0; ///< µm, see EffectiveRadius
  /// Mean over the axon's beads, which are stretches of cuts thicker than 1.1 times the mean radius, of the largest radius over
  /// the mean radius, minus 1; NaN without a bead.
  double beadAmplitude = 0.0;
  double beadSpacing = 0.0; ///< µm, mean distance of the thickest places of neighbouring beads; NaN for fewer than two
};

/// Returns the shape from an axon's cuts at every `spacing` µm. If cuts are missing in between, L is the length of the existing
/// ones.
AxonShape axonShape(const std::vector<FibreCut>& cuts, double spacing);

/// How a centre line runs from its first entry into the domain to its last exit; NaN if it is not in the domain or ends where it
/// began.
struct CentreLineShape
{
  double sinuosity = 0.0;  ///< its length over the distance of these two points: 1 for a straight one
  double undulation = 0.0; ///< µm, root mean square of its distance from the straight line through them
};

/// Returns the shape of fibre number `fibre`'s centre line.
CentreLineShape centreLineShape(const Fibres& fibres, std::size_t fibre);

/// Returns the mean sinuosity over the lengths of fibres in the domain that have one; NaN if none has.
double meanSinuosity(const Fibres& fibres);

} // namespace cactus
