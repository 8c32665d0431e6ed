// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Context.h"
#include "Domain.h"
#include "FibreField.h"
#include "GRatio.h"
#include "SurfaceCheck.h"
#include "SurfaceFilters.h"
#include "TriangleMesh.h"

#include <cstdint>
#include <string>
#include <vector>

namespace cactus
{

/// µm that surfaces of two fibres keep from each other, and inner surfaces from outer ones, however little is asked for: a
/// simulator's walls have that thickness (MC/DC: 1 nm).
constexpr double leastSeparation = 0.001;

/// Parameters of the surfaces; lengths in µm.
struct MyelinSurfaceOptions
{
  GRatioModel model = GRatioModel::Constant;
  /// The ratio of inner to outer diameter (Constant, 0.05 to 0.99), or its mean (Distributed, 0.3 to 0.95).
  double gRatio = 0.7;
  /// Standard deviation of the g-ratio (Distributed), in [0, 0.3].
  double gRatioDeviation = 0.04;
  /// Fraction of the box that the axons are to fill (TargetAxonVolumeFraction), 0.0001 to 0.999.
  double targetAxonVolumeFraction = 0.0;
  /// Passes of smoothing of the fields before they are contoured (see SmoothedField), 0 to 20 (see Limits.h); 0: none.
  int smoothingIterations = 2;
  /// Distance by which coarsening may move a surface, at most the tolerance that growth kept, as an aim and no strict bound (see
  /// myelinSurfaces()); 0: surfaces stay as contoured.
  double decimationError = 0.005;
  /// Cut fibres off at the faces of the domain, else where the image ends.
  bool clipToDomain = true;
  std::uint64_t seed = 1;
};

/// Throws InvalidInput, naming the parameter, for a value out of range.
void validate(const MyelinSurfaceOptions& options);

/// What comes with a label image; lengths in µm.
struct LabelImageFacts
{
  Domain domain;
  double minimumGap = 0.02;        ///< least distance between the surfaces of two fibres
  double surfaceTolerance = 0.005; ///< room beside the gap, on either side, for moving surfaces
  std::vector<int> fibreIds;       ///< all fibres, unique, in any order
  std::vector<int> bundleIds;      ///< one per fibre
  std::vector<double> targetRadii; ///< one per fibre
  /// µm of each fibre's centre line inside the domain: one of 0 only passes by outside. Empty where that is not known.
  std::vector<double> lengths;
};

/// How a fibre's myelin came out.
enum class MyelinState
{
  AsAsked = 0,
  Thinner = 1, ///< than asked: else the axon would break within the box
  Thicker = 2, ///< than asked: myelin is at least MinimumGap (and leastSeparation) thick, and the axon does not leave it
  NoAxon = 3,  ///< the fibre is too thin to hold an unbroken axon inside myelin of that thickness: no inner surface
  NoFibre = 4  ///< the fibre has no voxel of the image, or too few for a closed surface: neither surface
};

/// The surfaces of one fibre and what was measured on them.
struct FibreSurfacePair
{
  int fibreId = 0;
  int bundleId = 0;
  double targetRadius = 0.0;
  TriangleMesh outer; ///< empty for NoFibre
  TriangleMesh inner; ///< empty for NoFibre and NoAxon
  SurfaceReport outerReport;
  SurfaceReport innerReport;
  MyelinState state = MyelinState::NoFibre;
  double outerLevel = 0.0; ///< µm, the field's value on the outer surface, 0 or a little less
  double thickness = 0.0;  ///< µm, depth of the inner surface below the outer one: the difference of the field
  double targetGRatio = 0.0;
  double gRatio = 0.0;        ///< reached: sqrt(inner volume / outer volume); 0 without an axon
  double droppedVolume = 0.0; ///< µm³, of pieces apart from the main one, and of closed-in cavities, that were left out
  bool isWanted = true;       ///< false only where the centre line is known to pass by outside the domain
  /// A surface has a fault that could not be mended: it meets itself or the other one, or is nearer than MinimumGap (and
  /// leastSeparation) to another fibre.
  bool isFlawed = false;
  double largestMove = 0.0; ///< µm, the largest |field - level| found on the final surfaces away from caps
};

/// Outer and inner surfaces of all fibres of a label image, in increasing order of fibres.
///
/// The outer surface of a fibre is where its smoothed field (see SmoothedField) equals a level at or just below 0, contoured by
/// contour(), with flat caps on the faces of the box. The level makes up for the volume that smoothing takes off the fibre, as
/// far as it takes no more than the tolerance. The inner surface is where the field is `thickness`, its caps moved into the box
/// by MinimumGap, but at least a twentieth and at most a quarter of a voxel, so that they do not meet the outer ones. The
/// thickness is solved for so that inner volume over outer volume is the square of the fibre's g-ratio, measured on the final
/// surfaces.
///
/// Each surface is coarsened so far that the field at points spread over it stays within decimationError of its level, or within
/// what the surface as contoured is off by, and moved along its normals to the volume that it is to have. It has to be a closed,
/// outward 2-manifold that does not meet itself (exact predicates), nor its outer surface; where it fails it is made
/// again with less coarsening around that place, at last with none. Triangles whose squared edges have a ratio above 800 are
/// split. Then outer surfaces are moved inwards, by nanometres, where two of them are nearer than MinimumGap (see keepApart());
/// one that then meets itself is made again with less coarsening, or deeper where nothing is coarsened. Where growth has left
/// less than 0.01 µm between two fibres, outer surfaces lie deeper by half of what is missing of that. Inner surfaces keep as
/// much from the walls of the outer ones: where coarsening or creases bring them nearer, the myelin gets thicker (Thicker), or
/// there is no axon. All that is looked for without coarsening, too. What still is not as it should be is marked (isFlawed). A
/// piece of a surface that encloses no positive volume, as of a fibre of a voxel or two, is left out.
///
/// A fibre that leaves the box through a face and comes back has a piece for each stay; of other pieces the largest is kept (see
/// keepMainPart()).
///
/// With `filters` these contour the fields, unsmoothed, and coarsen what comes out, in place of all this; surfaces are then not
/// mended and not moved apart. What is wrong with a surface by itself is marked (isFlawed); what is wrong between two is for the
/// certificate to find, see markFaults().
///
/// Throws InvalidInput (options; an image that is not valid; a fibre in the image that
/// is not in the table; decimationError above the tolerance), Infeasible (a target fraction that cannot be met), Cancelled.
std::vector<FibreSurfacePair> myelinSurfaces(const LabelImageView& image, const LabelImageFacts& facts,
  const MyelinSurfaceOptions& options, const Context& context = {}, const SurfaceFilters* filters = nullptr);

/// How many fibres did not come out as asked, in what way, and what to do about it, in one sentence; empty where all did. Fibres
/// that pass by outside the domain are not missed.
std::string notAsAsked(
  const std::vector<FibreSurfacePair>& pairs, const LabelImageView& image, const LabelImageFacts& facts, bool byFilters = false);

} // namespace cactus
