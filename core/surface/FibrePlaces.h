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

/// Where the fibres of a field are. An image whose source knows its fibres is looked at where they may be, one by one when they
/// are asked for; of any other all samples are looked at once. Of both the same is told.
class FibrePlaces
{
public:
  /// `field` has to outlive the object. Throws as findFibres() does.
  FibrePlaces(
    const FibreField& field, const LabelImageFacts& facts, const Context& context = {}, const Sharing& sharing = Sharing());

  /// About where a fibre is, and how large it is beside others.
  struct Place
  {
    std::array<int, 3> middle{ { 0, 0, 0 } }; ///< in pieces (see ImagePieces) from where the field begins
    double size = 0.0;
    double targetRadius = 0.0; ///< µm; 0 where that is not known
  };
  /// All that have samples and, where the source knows its fibres, maybe others. By FibreId.
  const std::map<std::int32_t, Place>& all() const { return this->Places; }

  /// Without samples where there is no such fibre. May be used from several threads.
  FoundFibre find(std::int32_t fibreId) const;

  /// Those with a target radius below that (µm), or with none that is known. What `known` has of them is not looked for again.
  FoundFibres thinnerThan(
    double radius, const Context& context = {}, const Sharing& sharing = Sharing(), const Recollection& known = {}) const;

private:
  void addKnown(const KnownFibres& source);
  void addFound(const LabelImageFacts& facts);
  std::vector<std::uint32_t> piecesOf(const std::set<std::int32_t>& fibres, const Context& context) const;

  const FibreField& Field;
  const ImagePieces Pieces;
  FoundFibres Found; ///< all, where the source does not know its fibres
  std::map<std::int32_t, Place> Places;
};

} // namespace cactus
