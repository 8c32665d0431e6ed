// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/SurfaceDistance.h"
#include "surface/AxonSearch.h"
#include "surface/FibreContours.h"
#include "surface/FibreField.h"
#include "surface/FibrePlaces.h"
#include "surface/FibreSurfacePair.h"
#include "surface/MyelinProfile.h"
#include "surface/MyelinSurfaceOptions.h"
#include "surface/SurfaceFilters.h"
#include "surface/SurfaceFinishing.h"
#include "surface/ThinFibres.h"

#include <Eigen/Core>

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace cactus
{

/// Makes the surfaces of single fibres (see myelinSurfaces()). Thread-safe.
class FibreMesher
{
public:
  /// All arguments have to outlive the mesher, except the context, the sharing and the cache `known` of thin fibres. With
  /// `filters` these contour the fields and coarsen the contours. Throws InvalidInput if the image is invalid, and Cancelled.
  FibreMesher(const std::shared_ptr<const LabelSource>& image, const LabelImageFacts& facts, const MyelinSurfaceOptions& options,
    const SurfaceFilters* filters = nullptr, const Context& context = {}, const Sharing& sharing = Sharing(),
    const Recollection& known = {});

  FibreMesher(const FibreMesher&) = delete;
  FibreMesher& operator=(const FibreMesher&) = delete;

  const FibreField& field() const { return this->Field; }
  const FibrePlaces& places() const { return this->Places; }

  SmoothedField smoothed(std::int32_t fibreId) const;

  /// Returns how the surfaces of the pair's fibre depend on the place along it; null if they do not. `field` is smoothed() of the
  /// fibre and has to outlive the profile.
  std::unique_ptr<MyelinProfile> profileOf(const SmoothedField& field, const FibreSurfacePair& pair) const;

  /// Takes myelin from the fields of a profile that lacks some. gRatio(volume) returns the g-ratio with all myelin, which is
  /// recorded in the pair, for a fibre whose outer surface would then have that volume (µm³).
  void takeMyelin(const SmoothedField& field, MyelinProfile& profile, FibreSurfacePair& pair,
    const std::function<double(double volume)>& gRatio) const;

  /// Makes the outer surface, coarsened within `bounds`, and moved `deeper` (µm) than necessary. Sets the pair's state to NoFibre
  /// if there is none, else to NoAxon.
  void makeOuter(const SmoothedField& field, FibreSurfacePair& pair, const std::vector<LocalErrorBound>& bounds = {},
    double deeper = 0.0) const;

  /// Measures the outer surface again after it has been moved, and returns where it now meets itself. Needles left by moving are
  /// split, and pieces turned inside out are removed; if nothing is left, the pair's state is NoFibre.
  std::vector<Eigen::Vector3d> checkOuter(FibreSurfacePair& pair) const;

  /// Makes the fans of an outer surface even (see evenFans) and measures it again. A faulty surface stays as it is.
  void evenOuter(FibreSurfacePair& pair) const;

  /// Returns the diameter (µm) of the circle whose area is the mean cross-section: outer volume over the length of the fibre.
  double equivalentDiameter(const SmoothedField& field, double outerVolume) const;

  /// Resets the pair to a state without an inner surface.
  static void forgetInner(FibreSurfacePair& pair);

  /// Makes the inner surface for the pair's targetGRatio, inside its outer one: with thicker myelin if it would otherwise leave
  /// the outer one or come nearer to its wall than promised, and without an axon if no thickness prevents that. If the outer one
  /// was moved and nearly kept its volume (volumeAsMade), the old inner one is kept, unless it is in the way. Of a fibre without
  /// myelin the inner surface is the outer one. With a profile, the myelin is as thick as that says along the fibre; if it has
  /// nodes, the axon is the one for which they were let in.
  void makeInner(const SmoothedField& field, FibreSurfacePair& pair, MyelinProfile* profile = nullptr) const;

  /// Tells whether the pair's inner surface is the same that makeInner() would make now that the outer one was moved. Sets the
  /// g-ratio if so.
  bool keepsInner(FibreSurfacePair& pair) const;

private:
  bool followsLines() const;
  void findLines();
  Eigen::AlignedBox3d box() const;
  /// Tells whether contours slightly beside their target are moved there, rather than made again.
  bool movesContours() const;
  /// An outer surface before coarsening, and what it is to be moved to.
  struct OuterContour
  {
    CappedSurface surface;
    double level = 0.0;   ///< of the contour, µm
    double right = 0.0;   ///< at which it should lie, µm
    double volume = 0.0;  ///< that it should have, µm³
    double dropped = 0.0; ///< µm³
  };
  OuterContour contourOuter(const SmoothedField& field, double deeper) const;
  void makeInnerWithin(double outerVolume, const SmoothedField& field, FibreSurfacePair& pair, MyelinProfile* profile) const;
  void makeInnerOfProfile(const MyelinProfile& profile, FibreSurfacePair& pair) const;
  void finish(const AxonSearch& search, MyelinState state, AxonContour& axon, FibreSurfacePair& pair) const;
  AxonLevels axonLevels(const SmoothedField& field, double volume, double raised) const;
  void finishInside(const AxonSearch& search, MyelinState state, AxonContour& axon, FibreSurfacePair& pair) const;
  void finishByFilters(const AxonSearch& search, MyelinState state, AxonContour& axon, FibreSurfacePair& pair) const;
  SurfaceGap gapTo(const TriangleTree& wall, const TriangleMesh& inner) const;
  std::vector<std::uint32_t> wallOf(const TriangleMesh& outer) const;

  const LabelImageFacts& Facts;
  const MyelinSurfaceOptions& Options;
  const SurfaceFilters* Filters; ///< null for core's own means
  FibreField Field;
  FibrePlaces Places;
  std::optional<ThinFibres> Thin;            ///< if surfaces are smoothed
  std::map<std::int32_t, std::size_t> Lines; ///< numbers of the fibres among those with centre lines, if surfaces depend on these
  std::vector<double> InternodeLosses;       ///< by these numbers, see internodeLosses()
  double Spacing;
  FibreContours Contours;
  SurfaceFinishing Finishing;
  double Withdrawal;     ///< µm; depth of outer surfaces where growth has left almost no room between fibres
  double ThinnestMyelin; ///< µm; keeps inner and outer surfaces apart even if both move
  double Wall;           ///< µm, least thickness of the myelin in nodes, where it is lost, and over swellings
  double PromisedMyelin; ///< µm, least distance of inner surfaces from the walls of outer ones
};

} // namespace cactus
