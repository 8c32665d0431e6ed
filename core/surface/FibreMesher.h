// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "surface/AxonSearch.h"
#include "surface/FibreContours.h"
#include "surface/FibreField.h"
#include "surface/FibrePlaces.h"
#include "surface/FibreSurfacePair.h"
#include "surface/MyelinSurfaceOptions.h"
#include "surface/SurfaceFilters.h"
#include "surface/SurfaceFinishing.h"
#include "surface/ThinFibres.h"

#include <Eigen/Core>

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace cactus
{

/// Makes the surfaces of one fibre after the other (see myelinSurfaces() for what they are). May be used from several threads.
class FibreMesher
{
public:
  /// What is given has to outlive the mesher, except the context, the sharing and what is `known` of thin fibres. With `filters`
  /// these contour the fields and coarsen what comes out. Throws InvalidInput where the image is not a proper one, and Cancelled.
  FibreMesher(const std::shared_ptr<const LabelSource>& image, const LabelImageFacts& facts, const MyelinSurfaceOptions& options,
    const SurfaceFilters* filters = nullptr, const Context& context = {}, const Sharing& sharing = Sharing(),
    const Recollection& known = {});

  FibreMesher(const FibreMesher&) = delete;
  FibreMesher& operator=(const FibreMesher&) = delete;

  const FibreField& field() const { return this->Field; }
  const FibrePlaces& places() const { return this->Places; }

  SmoothedField smoothed(std::int32_t fibreId) const;

  /// Makes the outer surface, coarsened within `bounds`, and `deeper` (µm) than it might be; leaves the pair's state at NoFibre
  /// if there is none, else at NoAxon.
  void makeOuter(const SmoothedField& field, FibreSurfacePair& pair, const std::vector<LocalErrorBound>& bounds = {},
    double deeper = 0.0) const;

  /// Measures the outer surface again after it has been moved, and says where it now meets itself. Needles that moving has left
  /// are split, and pieces that have been turned inside out go; where nothing is left, the pair's state is NoFibre.
  std::vector<Eigen::Vector3d> checkOuter(FibreSurfacePair& pair) const;

  /// Diameter (µm) of the circle whose area is the mean cross-section: outer volume over the length of the fibre.
  double equivalentDiameter(const SmoothedField& field, double outerVolume) const;

  /// As if no inner surface had been made.
  static void forgetInner(FibreSurfacePair& pair);

  /// Makes the inner surface for the pair's targetGRatio, inside its outer one: with thicker myelin if it would leave that or
  /// come nearer to its wall than promised, and without an axon if no thickness prevents that. Where the outer one was moved and
  /// has next to the volume (volumeAsMade) that it had before, the inner one is that of before, unless it is in the way.
  void makeInner(const SmoothedField& field, FibreSurfacePair& pair) const;

  /// Whether the inner surface of a pair is the one that makeInner() would make now that the outer one was moved. Sets the
  /// g-ratio if so.
  bool keepsInner(FibreSurfacePair& pair) const;

private:
  Eigen::AlignedBox3d box() const;
  /// Whether contours that lie a little beside where they are to be are moved there, rather than made again.
  bool movesContours() const;
  void makeInnerWithin(double outerVolume, const SmoothedField& field, FibreSurfacePair& pair) const;
  AxonLevels axonLevels(const SmoothedField& field, double volume) const;
  void finishInside(const AxonSearch& search, MyelinState state, AxonContour& axon, FibreSurfacePair& pair) const;
  void finishByFilters(const AxonSearch& search, MyelinState state, AxonContour& axon, FibreSurfacePair& pair) const;
  std::vector<std::uint32_t> wallOf(const TriangleMesh& outer) const;

  const LabelImageFacts& Facts;
  const MyelinSurfaceOptions& Options;
  const SurfaceFilters* Filters; ///< null for core's own means
  FibreField Field;
  FibrePlaces Places;
  std::optional<ThinFibres> Thin; ///< if surfaces are smoothed
  double Spacing;
  FibreContours Contours;
  SurfaceFinishing Finishing;
  double Withdrawal;     ///< µm; outer surfaces lie so deep where growth has left next to no room between fibres
  double ThinnestMyelin; ///< µm; inner and outer surfaces keep apart even where both move
  double PromisedMyelin; ///< µm, least distance of inner surfaces to the walls of outer ones
};

} // namespace cactus
