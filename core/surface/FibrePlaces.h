// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Context.h"
#include "base/Recollection.h"
#include "base/Sharing.h"
#include "growth/LabelSource.h"
#include "surface/FibreField.h"
#include "surface/FibreSurvey.h"
#include "surface/ImagePieces.h"
#include "surface/MyelinSurfaceOptions.h"

#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <vector>

namespace cactus
{

/// Where the fibres of a field are. If the source knows its fibres, each is searched for only where it may be, on demand;
/// otherwise all samples are read once. The results are the same.
class FibrePlaces
{
public:
  /// Finds the places; `field` has to outlive the object. Throws as findFibres() does.
  FibrePlaces(
    const FibreField& field, const LabelImageFacts& facts, const Context& context = {}, const Sharing& sharing = Sharing());

  /// A fibre's approximate position and relative size.
  struct Place
  {
    std::array<int, 3> middle{ { 0, 0, 0 } }; ///< in pieces (see ImagePieces) from the beginning of the field
    double size = 0.0;
    double targetRadius = 0.0; ///< µm; 0 if unknown
  };
  /// Returns all fibres with samples and, if the source knows its fibres, possibly others. By FibreId.
  const std::map<std::int32_t, Place>& all() const { return this->Places; }

  /// Returns no samples for an unknown fibre. Thread-safe.
  FoundFibre find(std::int32_t fibreId) const;

  /// Returns the fibres with a target radius below `radius` (µm), or an unknown one. Results in the cache `known` are not
  /// computed again.
  FoundFibres thinnerThan(
    double radius, const Context& context = {}, const Sharing& sharing = Sharing(), const Recollection& known = {}) const;

private:
  void addKnown(const KnownFibres& source);
  void addFound(const LabelImageFacts& facts);
  std::vector<std::uint32_t> piecesOf(const std::set<std::int32_t>& fibres, const Context& context) const;

  const FibreField& Field;
  const ImagePieces Pieces;
  FoundFibres Found; ///< all, if the source does not know its fibres
  std::map<std::int32_t, Place> Places;
};

} // namespace cactus
