// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Context.h"
#include "base/Sharing.h"
#include "mesh/SurfaceStore.h"
#include "surface/FibreMesher.h"
#include "surface/FibreSurfacePair.h"
#include "surface/SurfaceJournal.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace cactus
{

/// Makes the surfaces of all fibres (see myelinSurfaces() for what they are) in two steps. What the first makes of outer surfaces
/// does not depend on g-ratios, so that it can be kept and used again. Meshes are put into stores, by the places of their
/// fibres in fibres(), and held in memory only while they are worked on.
class SurfaceMaker
{
public:
  /// What is given by reference has to outlive the object. With a journal, what it recalls is not made again. Processes that
  /// share the work have stores and journal in common, and fibres() is the same in all. Throws as myelinSurfaces() does.
  SurfaceMaker(const std::shared_ptr<const LabelSource>& image, const LabelImageFacts& facts, const MyelinSurfaceOptions& options,
    const Context& context, const SurfaceFilters* filters = nullptr, SurfaceJournal* journal = nullptr,
    const Sharing& sharing = Sharing());

  /// All fibres, by increasing id, and what is known of them; their meshes are in the stores.
  const std::vector<FibreSurfacePair>& fibres() const { return this->Pairs; }
  /// In which surfaces are: the domain as far as the image reaches, or all of the image where surfaces are not clipped.
  const Domain& box() const { return this->Mesher.field().box(); }

  /// Makes the outer surfaces and keeps them apart; and with each, from the same field, the inner one, if g-ratios do not depend
  /// on all fibres.
  void makeOuter(SurfaceStore& outer, SurfaceStore& inner);
  /// Instead: what fibres() was after makeOuter() of another maker, whose image, facts and options were the same but for what is
  /// asked of g-ratios. No inner surface is made yet.
  void takeOuter(std::vector<FibreSurfacePair> fibres);
  /// Makes the inner surfaces that are still to be made, or again since the outer one was moved; outer ones are in their places.
  void makeInner(const SurfaceSource& outer, SurfaceStore& inner);

private:
  /// How much is done when outer surfaces are made, and when they are kept apart.
  struct Progress
  {
    double contoured;
    double spaced;
  };
  using BoundsOfFibres = std::map<std::size_t, std::vector<LocalErrorBound>>;

  template <typename IsMade, typename Body>
  void forEachFibre(IsMade&& isMade, Body&& body, const char* message, double from, double to);
  double targetGRatio(const SmoothedField& field, const FibreSurfacePair& pair) const;
  bool isCommon() const { return this->Options.model == GRatioModel::TargetAxonVolumeFraction; }
  void putInner(std::size_t i, const SmoothedField& field, SurfaceStore& inner);
  void contour(SurfaceStore& outer, SurfaceStore& inner);
  void spaceOut(SurfaceStore& outer, const SurfaceSource& inner);
  std::vector<std::size_t> checkMoved(
    const std::vector<std::size_t>& moved, int attempt, SurfaceStore& outer, BoundsOfFibres& bounds);
  void makeAgain(const std::vector<std::size_t>& which, double deeper, const BoundsOfFibres& bounds, SurfaceStore& outer);
  void keepInner(const SurfaceSource& outer, const SurfaceSource& inner);
  void makeEachInner(const SurfaceSource& outer, SurfaceStore& inner);
  void makeInnerOfCommonVolume(const SurfaceSource& outer, SurfaceStore& inner);

  const LabelImageFacts& Facts;
  const MyelinSurfaceOptions& Options;
  const SurfaceFilters* Filters;
  const Context Caller;
  const Sharing Shared;
  SurfaceJournal NoJournal;
  SurfaceJournal& Journal;
  FibreMesher Mesher;
  std::vector<FibreSurfacePair> Pairs;
  Progress Shares{ 0.0, 0.0 };
  std::vector<std::size_t> Order; ///< in which to work on them: one after the other what is near each other
};

} // namespace cactus
