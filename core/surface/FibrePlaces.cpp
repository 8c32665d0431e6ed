// SPDX-License-Identifier: BSD-3-Clause
#include "surface/FibrePlaces.h"

#include "base/Parallel.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <mutex>

namespace cactus
{

namespace
{

/// From this part of all fibres on, next to no sample need not be looked at to find them.
constexpr double mostOfAll = 0.5;

} // namespace

FibrePlaces::FibrePlaces(const FibreField& field, const LabelImageFacts& facts, const Context& context, const Sharing& sharing)
  : Field(field)
  , Pieces(field.samples())
{
  for (std::size_t i = 0; i < std::min(facts.fibreIds.size(), facts.targetRadii.size()); ++i)
  {
    this->TargetRadii.emplace(facts.fibreIds[i], facts.targetRadii[i]);
  }
  if (const KnownFibres* source = field.knownFibres())
  {
    this->addKnown(*source);
    return;
  }
  this->Found = findFibres(field, context, sharing);
  this->addFound();
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
    this->TargetRadii[outline.fibreId] = outline.targetRadius;
  }
}

void FibrePlaces::addFound()
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

/// All that may hold samples of some fibres that the source knows.
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

FoundFibres FibrePlaces::thinnerThan(double radius, const Context& context, const Sharing& sharing) const
{
  std::set<std::int32_t> thin;
  double size = 0.0;
  double thinSize = 0.0;
  for (const auto& [id, place] : this->Places)
  {
    const auto known = this->TargetRadii.find(id);
    const bool isThin = known == this->TargetRadii.end() || !(known->second > 0.0) || known->second < radius;
    size += place.size;
    if (isThin)
    {
      thin.insert(id);
      thinSize += place.size;
    }
  }
  if (this->Field.knownFibres() != nullptr && thinSize < mostOfAll * size)
  {
    return findFibres(this->Field, thin, this->piecesOf(thin, context), context, sharing);
  }
  FoundFibres found = this->Field.knownFibres() != nullptr ? findFibres(this->Field, context, sharing) : this->Found;
  for (auto fibre = found.begin(); fibre != found.end();)
  {
    fibre = thin.count(fibre->first) != 0 ? std::next(fibre) : found.erase(fibre);
  }
  return found;
}

} // namespace cactus
