// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Context.h"
#include "base/Recollection.h"
#include "base/Sharing.h"
#include "mesh/SurfaceStore.h"
#include "surface/FibreMesher.h"
#include "surface/FibreSurfacePair.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace cactus
{

/// Makes the surfaces of all fibres (see myelinSurfaces()) in two steps. The first one's outer surfaces do not depend on
/// g-ratios, so that they can be kept and used again. Meshes are put into stores, by the indices of their fibres in fibres(), and
/// kept in memory only while they are worked on.
class SurfaceMaker
{
public:
  /// The names of what is known of each fibre whose outer surface is made, and of all of them once they are kept apart.
  static constexpr char outerMade[] = "outer";
  static constexpr char keptApart[] = "apart";

  /// All arguments passed by reference have to outlive the object. A surface is stored before the record of its fibre is noted in
  /// `known`; what an earlier run has noted there is not made again. Of processes that share the work, each has stores of its
  /// own, or all have those and `known` on a disk; fibres() is the same in all, and so are the surfaces. Throws as
  /// myelinSurfaces() does.
  SurfaceMaker(const std::shared_ptr<const LabelSource>& image, const LabelImageFacts& facts, const MyelinSurfaceOptions& options,
    const Context& context, const SurfaceFilters* filters = nullptr, const Sharing& sharing = Sharing(),
    const Recollection& known = {});

  /// Returns the records of all fibres, by increasing id; their meshes are in the stores.
  const std::vector<FibreSurfacePair>& fibres() const { return this->Pairs; }
  /// Returns the box of the surfaces: the domain within the image, or the whole image if surfaces are not clipped.
  const Domain& box() const { return this->Mesher.field().box(); }

  /// Makes the outer surfaces and keeps them apart. If g-ratios do not depend on all fibres, it also makes each inner surface
  /// from the same field.
  void makeOuter(SurfaceStore& outer, SurfaceStore& inner);
  /// Replaces makeOuter(): takes the fibres() after makeOuter() of another maker with the same image, facts and options except
  /// those of g-ratios. No inner surface is made yet.
  void takeOuter(std::vector<FibreSurfacePair> fibres);
  /// Makes the inner surfaces that are missing, or outdated since the outer one was moved; outer ones are in place.
  void makeInner(const SurfaceSource& outer, SurfaceStore& inner);

private:
  /// The progress when outer surfaces are made, and when they are kept apart.
  struct Progress
  {
    double contoured;
    double spaced;
  };
  using BoundsOfFibres = std::map<std::size_t, std::vector<LocalErrorBound>>;
  /// The stores whose surfaces a loop changes.
  using Changed = std::vector<SurfaceStore*>;

  std::string bytesOfFibre(std::size_t i, const Changed& stores) const;
  void takeFibre(std::size_t i, const std::string& bytes, const Changed& stores);
  template <typename Body>
  void forEachOf(const std::vector<std::size_t>& which, const Changed& stores, Body&& body);
  template <typename Body>
  void makeFor(const std::vector<std::size_t>& which, const Changed& stores, const Recollection& known, Body&& body,
    const char* message, double from, double to);
  double targetGRatio(const SmoothedField& field, const FibreSurfacePair& pair, double volume) const;
  template <typename Body>
  void withField(FibreSurfacePair& pair, Body&& body) const;
  bool isCommon() const { return this->Options.model == GRatioModel::TargetAxonVolumeFraction; }
  void putInner(std::size_t i, const SmoothedField& field, MyelinProfile* profile, SurfaceStore& inner);
  void contour(SurfaceStore& outer, SurfaceStore& inner);
  void spaceOut(SurfaceStore& outer, const SurfaceSource& inner);
  void evenOuter(const std::vector<std::size_t>& which, SurfaceStore& outer);
  std::vector<std::size_t> checkMoved(
    const std::vector<std::size_t>& moved, int attempt, SurfaceStore& outer, BoundsOfFibres& bounds);
  void makeAgain(const std::vector<std::size_t>& which, double deeper, const BoundsOfFibres& bounds, SurfaceStore& outer);
  void keepInner(const SurfaceSource& outer, const SurfaceSource& inner);
  void makeEachInner(const SurfaceSource& outer, SurfaceStore& inner, const Recollection& known);
  void makeInnerOfCommonVolume(const SurfaceSource& outer, SurfaceStore& inner);

  const LabelImageFacts& Facts;
  const MyelinSurfaceOptions& Options;
  const SurfaceFilters* Filters;
  const Context Caller;
  const Sharing Shared;
  const Recollection Known;
  FibreMesher Mesher;
  std::vector<FibreSurfacePair> Pairs;
  Progress Shares{ 0.0, 0.0 };
  std::vector<std::size_t> Order; ///< order of work: neighbours one after the other
};

} // namespace cactus
