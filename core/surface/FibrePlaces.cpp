// SPDX-License-Identifier: BSD-3-Clause
#include "surface/FibrePlaces.h"

#include "base/Parallel.h"

#include <algorithm>
#include <cstddef>
#include <mutex>

namespace cactus
{

namespace
{

/// Fraction of all fibres from which on nearly all samples have to be read to find them.
constexpr double mostOfAll = 0.5;

} // namespace

FibrePlaces::FibrePlaces(const FibreField& field, const LabelImageFacts& facts, const Context& context, const Sharing& sharing)
  : Field(field)
  , Pieces(field.samples())
{
  if (const KnownFibres* source = field.knownFibres())
  {
    this->addKnown(*source);
    return;
  }
  this->Found = findFibres(field, context, sharing);
  this->addFound(facts);
}

void FibrePlaces::addKnown(const KnownFibres& source)
{
  for (const FibreOutline& outline : source.outlines())
  {
    Place& place = this->Places[outline.fibreId];
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      place.middle[axis] = std::max(0, (outline.middle[axis] - this->Field.samples().first[axis]) / ImagePieces::edge);
    }
    place.size = outline.length;
    place.targetRadius = outline.targetRadius;
  }
}

void FibrePlaces::addFound(const LabelImageFacts& facts)
{
  for (const auto& [id, fibre] : this->Found)
  {
    std::array<double, 3> sum{ { 0.0, 0.0, 0.0 } };
    for (const FoundBox& box : fibre.boxes)
    {
      const NodeRange nodes = nodesOf(this->Field, box);
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        sum[axis] += nodes.first[axis];
      }
    }
    Place& place = this->Places[id];
    place.size = static_cast<double>(fibre.boxes.size());
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      place.middle[axis] = static_cast<int>(sum[axis] / (place.size * ImagePieces::edge));
    }
  }
  for (std::size_t i = 0; i < std::min(facts.fibreIds.size(), facts.targetRadii.size()); ++i)
  {
    const auto place = this->Places.find(facts.fibreIds[i]);
    if (place != this->Places.end())
    {
      place->second.targetRadius = facts.targetRadii[i];
    }
  }
}

FoundFibre FibrePlaces::find(std::int32_t fibreId) const
{
  if (const KnownFibres* source = this->Field.knownFibres())
  {
    return findFibre(this->Field, fibreId, this->Pieces.among(source->tilesOf(fibreId)));
  }
  const auto found = this->Found.find(fibreId);
  return found != this->Found.end() ? found->second : FoundFibre();
}

/// Returns all pieces that may hold samples of some fibres that the source knows.
std::vector<std::uint32_t> FibrePlaces::piecesOf(const std::set<std::int32_t>& fibres, const Context& context) const
{
  const std::vector<std::int32_t> ids(fibres.begin(), fibres.end());
  std::vector<bool> isAmong(this->Pieces.count());
  std::mutex mutex;
  parallelFor(ids.size(), context,
    [&](std::size_t i)
    {
      const std::vector<std::uint32_t> own = this->Pieces.among(this->Field.knownFibres()->tilesOf(ids[i]));
      const std::lock_guard<std::mutex> lock(mutex);
      for (const std::uint32_t piece : own)
      {
        isAmong[piece] = true;
      }
    });
  std::vector<std::uint32_t> pieces;
  for (std::size_t piece = 0; piece < isAmong.size(); ++piece)
  {
    if (isAmong[piece])
    {
      pieces.push_back(std::uint32_t(piece));
    }
  }
  return pieces;
}

FoundFibres FibrePlaces::thinnerThan(
  double radius, const Context& context, const Sharing& sharing, const Recollection& known) const
{
  std::set<std::int32_t> thin;
  double size = 0.0;
  double thinSize = 0.0;
  for (const auto& [id, place] : this->Places)
  {
    size += place.size;
    if (!(place.targetRadius > 0.0) || place.targetRadius < radius)
    {
      thin.insert(id);
      thinSize += place.size;
    }
  }
  if (this->Field.knownFibres() != nullptr)
  {
    return known.once(sharing,
      [&]
      {
        return thinSize < mostOfAll * size ? findFibres(this->Field, thin, this->piecesOf(thin, context), context, sharing)
                                           : findFibres(this->Field, thin, context, sharing);
      });
  }
  FoundFibres found;
  for (const auto& fibre : this->Found)
  {
    if (thin.count(fibre.first) != 0)
    {
      found.insert(fibre);
    }
  }
  return found;
}

} // namespace cactus
