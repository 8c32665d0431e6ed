// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/SurfaceDecimation.h"
#include "mesh/TriangleTree.h"
#include "surface/FibreField.h"
#include "surface/FibreSurfacePair.h"
#include "surface/MyelinSurfaceOptions.h"
#include "surface/SurfaceFilters.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace cactus
{

/// Makes the surfaces of one fibre after the other (see myelinSurfaces() for what they are). May be used from several threads.
class FibreMesher
{
public:
  /// What is given has to outlive the mesher, except the context. With `filters` these contour the fields and coarsen what comes
  /// out. Throws InvalidInput where the image is not a proper one, and Cancelled.
  FibreMesher(const LabelImageView& image, const LabelImageFacts& facts, const MyelinSurfaceOptions& options,
    const SurfaceFilters* filters = nullptr, const Context& context = {});

  const FibreField& field() const { return this->Field; }

  /// The field of a fibre, from the blocks that findFibres() found for it.
  SmoothedField smoothed(const std::vector<std::uint32_t>& blocks, int fibreId) const;

  /// Makes the outer surface, with less coarsening in `bounds`, and `deeper` (µm) than it might be; leaves the pair's state at
  /// NoFibre where there is none, else at NoAxon.
  void makeOuter(const SmoothedField& field, FibreSurfacePair& pair, const std::vector<LocalErrorBound>& bounds = {},
    double deeper = 0.0) const;

  /// Measures the outer surface again after it has been changed, and says where it now meets itself. Pieces that have been turned
  /// inside out go; where nothing is left, the pair's state is NoFibre.
  std::vector<Eigen::Vector3d> checkOuter(FibreSurfacePair& pair) const;

  /// What has to be coarsened less where something went wrong at some places, for the first time (0) or once more.
  std::vector<LocalErrorBound> boundsAround(const std::vector<Eigen::Vector3d>& places, int attempt) const;

  /// Diameter (µm) of the circle whose area is the mean cross-section: outer volume over the length of the fibre.
  double equivalentDiameter(const SmoothedField& field, const FibreSurfacePair& pair) const;

  /// Makes the inner surface for the pair's targetGRatio, inside its outer one: with thicker myelin where it would leave it or
  /// come nearer to its wall than promised, and without an axon where no thickness prevents that.
  void makeInner(const SmoothedField& field, FibreSurfacePair& pair) const;

private:
  struct Inner;

  CappedSurface contourAt(double inset, const SmoothedField& field, double level) const;
  Inner innerAt(const SmoothedField& field, double level, const TriangleTree* within) const;
  MyelinState solve(
    const SmoothedField& field, double wanted, double deepest, double guess, const TriangleTree* within, Inner& best) const;
  bool finish(const SmoothedField& field, CappedSurface& surface, double level, double volume, const TriangleTree* container,
    const std::vector<LocalErrorBound>& bounds, SurfaceReport& report, FibreSurfacePair& pair) const;
  bool finishByFilters(const SmoothedField& field, double wanted, Inner& best, FibreSurfacePair& pair) const;
  std::vector<std::uint32_t> wallOf(const TriangleMesh& outer) const;
  double largestMove(const SmoothedField& field, const CappedSurface& surface, double level) const;

  template <typename Visit>
  void forEachSample(const SmoothedField& field, Visit&& visit) const;
  double smallestPiece() const { return this->Spacing * this->Spacing * this->Spacing; } ///< µm³, that is kept
  bool isSample(const std::array<int, 3>& node) const;
  std::vector<float> depths(const SmoothedField& field) const;
  double length(const SmoothedField& field) const;

  const LabelImageFacts& Facts;
  const MyelinSurfaceOptions& Options;
  const SurfaceFilters* Filters; ///< null for core's own means
  FibreField Field;
  double Spacing;
  double Inset; ///< of the inner surfaces' caps
  NodeLattice OuterLattice;
  NodeLattice InnerLattice;
  double Withdrawal;     ///< µm; outer surfaces lie so deep where growth has left next to no room between fibres
  double Nudge;          ///< least distance of the field from its level at a sample
  double ThinnestMyelin; ///< µm; inner and outer surfaces keep apart even where both move
  double PromisedMyelin; ///< µm, least distance of inner surfaces to the walls of outer ones
};

} // namespace cactus
