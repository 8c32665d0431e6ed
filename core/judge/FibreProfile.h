// SPDX-License-Identifier: BSD-3-Clause
// A fibre cut again and again along its centre line, and what its cuts tell.
#pragma once

#include "fibres/Fibres.h"
#include "mesh/TriangleMesh.h"

#include <cstddef>
#include <vector>

namespace cactus
{

/// One cross-section of a surface, orthogonal to its fibre's centre line.
struct FibreCut
{
  std::size_t number = 0;   ///< from 0 along the centre line: the cut lies at (number + 1/2) · spacing
  double area = 0.0;        ///< µm²
  double circularity = 0.0; ///< 4π · area / perimeter²: 1 for circles, 0.91 for hexagons, 0.79 for squares
};

/// The surface at every `spacing` µm along fibre number `fibre`'s centre line, from cuts orthogonal to it, in their order. Cuts
/// that reach the domain's boundary or a cap of the surface (inner surfaces end before the boundary), or around a point that lies
/// outside the surface, do not count. Throws InvalidInput for a spacing out of range, or with which there would be more than
/// limits::cuts cuts.
std::vector<FibreCut> cutsAlongFibre(const Fibres& fibres, std::size_t fibre, const TriangleMesh& surface, double spacing);

/// The radius (µm) of the circle with a cut's area.
double equivalentRadius(const FibreCut& cut);

/// The cross-sections of one surface along its fibre. The equivalent radius of a cut is that of the circle of the same area.
struct RadiusAlongFibre
{
  std::size_t cuts = 0;     ///< cross-sections that lie wholly inside the domain; without any, the others are NaN
  double mean = 0.0;        ///< µm, of the equivalent radius
  double deviation = 0.0;   ///< µm, standard deviation of the equivalent radius along the fibre
  double circularity = 0.0; ///< mean over the cuts
};

RadiusAlongFibre radiusAlong(const std::vector<FibreCut>& cuts);

/// radiusAlong() the fibre's cutsAlongFibre().
RadiusAlongFibre radiusAlongFibre(const Fibres& fibres, std::size_t fibre, const TriangleMesh& surface, double spacing);

/// (⟨r⁶⟩ / ⟨r²⟩)^¼ over cross-sections of axons: the radius that diffusion across wide-pulse gradients sees (Burcaw et al. 2015,
/// NeuroImage 114:18; Veraart et al. 2020, eLife 9:e49855).
class EffectiveRadius
{
public:
  void add(const FibreCut& cut);
  /// µm; NaN without a cut.
  double value() const;

private:
  double Squares = 0.0;
  double SixthPowers = 0.0;
};

/// What of an axon's cross-sectional area A along its fibre decides diffusion along it; NaN without cuts.
struct AxonShape
{
  double meanInverseArea = 0.0; ///< µm⁻², ⟨1/A⟩
  double areaVariance = 0.0;    ///< ⟨A²⟩/⟨A⟩² - 1, the variance of A/⟨A⟩
  /// µm, Γ(k) = |∫ (A/⟨A⟩ - 1) exp(-iks) ds|² / L at the smallest wave number that fits the cuts' length L, k = 2π/L: what is
  /// seen of the plateau Γ(k → 0) of short-range disorder, by which the diffusivity along axons goes to its limit as t^-½
  /// (Novikov et al. 2014, PNAS 111:5088; normalised as Γ_1d of Lee et al. 2020, Communications Biology 3:354). Its scatter is as
  /// large as itself: a mean over axons estimates the plateau. NaN for fewer than three cuts.
  double areaFluctuation = 0.0;
  /// 1 / (⟨A⟩⟨1/A⟩), to which the diffusivity along a straight axon falls in units of that of free water when its calibre varies
  /// slowly (Lifson and Jackson 1962, J Chem Phys 36:2410).
  double diffusivityRatio = 0.0;
  double effectiveRadius = 0.0; ///< µm, see EffectiveRadius
};

/// Of an axon's cuts at every `spacing` µm. Where cuts are missing between others, L is the length of those there are.
AxonShape axonShape(const std::vector<FibreCut>& cuts, double spacing);

/// Length (µm) of fibre number `fibre`'s centre line inside the domain.
double lengthInDomain(const Fibres& fibres, std::size_t fibre);

/// Length of fibre number `fibre`'s centre line from where it first enters the domain to where it last leaves it, over the
/// distance of these two points: 1 for a straight fibre. NaN for a fibre that is not in the domain or ends where it began.
double tortuosityInDomain(const Fibres& fibres, std::size_t fibre);

} // namespace cactus
