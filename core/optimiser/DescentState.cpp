// SPDX-License-Identifier: BSD-3-Clause
#include "optimiser/DescentState.h"

#include "base/Bytes.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

namespace cactus
{

DescentState::DescentState(Fibres& given, bool withRadii)
  : fibres(given)
  , velocity(given.points.size(), Eigen::Vector3d::Zero())
  , radiusVelocity(withRadii ? given.points.size() : 0, 0.0)
  , speed(given.points.size(), 0.0f)
  , push(given.points.size(), 0.0f)
  , displacement(given.points.size())
  , allowance(given.points.size())
{
}

void DescentState::save(SharedCheckpointWriter& file, const SharedCapsules& bodies, const FibreShares& shares) const
{
  file.putAll(this->fibres.points);
  file.putAll(this->fibres.radii);
  file.putAll(this->velocity);
  file.putAll(this->radiusVelocity);
  file.putAll(this->speed);
  file.putAll(this->push);
  file.put(this->relaxation);
  file.put(this->leastAllowance);
  file.put(this->stepsSinceSearch);
  file.put(this->effort.pairEvaluations);
  file.put(this->effort.neighbourSearches);
  file.put(this->effort.evaluationSeconds);
  file.put(this->effort.searchSeconds);
  // The order of a list decides how its sums are rounded.
  file.put(static_cast<std::uint8_t>(this->searchDue()));
  if (!this->searchDue())
  {
    this->saveNeighbours(file, bodies, shares);
    file.putAll(this->displacement);
    file.putAll(this->allowance);
  }
}

void DescentState::saveNeighbours(SharedCheckpointWriter& file, const SharedCapsules& bodies, const FibreShares& shares) const
{
  const std::vector<std::size_t>& offsets = this->neighbours.offsets;
  const std::vector<std::uint32_t>& indices = this->neighbours.indices;
  std::size_t before = 0; // neighbours in the lists of processes before this one
  const std::vector<std::string> counts = shares.sharing().exchange(bytesOf(std::vector<std::size_t>{ indices.size() }));
  for (std::size_t process = 0; process < static_cast<std::size_t>(shares.place()); ++process)
  {
    std::vector<std::size_t> count;
    getAll(counts[process], count);
    before += count.at(0);
  }
  // Where one process's lists end those of the next begin: the last process alone says where its own end.
  const bool isLast = static_cast<std::size_t>(shares.place()) + 1 == shares.processes();
  file.putParts(offsets.size() - (isLast ? 0 : 1), sizeof(std::size_t),
    [&](std::size_t begin, std::size_t end, const SharedCheckpointWriter::Take& take)
    {
      std::vector<std::size_t> piece(offsets.begin() + std::ptrdiff_t(begin), offsets.begin() + std::ptrdiff_t(end));
      std::for_each(piece.begin(), piece.end(), [&](std::size_t& offset) { offset += before; });
      take(piece.data(), piece.size() * sizeof(std::size_t));
    });
  file.putParts(indices.size(), sizeof(std::uint32_t),
    [&](std::size_t begin, std::size_t end, const SharedCheckpointWriter::Take& take)
    {
      std::vector<std::uint32_t> piece(indices.begin() + std::ptrdiff_t(begin), indices.begin() + std::ptrdiff_t(end));
      bodies.numberForAll(piece.data(), piece.size());
      take(piece.data(), piece.size() * sizeof(std::uint32_t));
    });
}

void DescentState::load(SharedCheckpointReader& file, const FibreShares& shares)
{
  const std::size_t count = this->fibres.points.size();
  file.getAll(this->fibres.points, count);
  file.getAll(this->fibres.radii, count);
  file.getAll(this->velocity, count);
  file.getAll(this->radiusVelocity, this->radiusVelocity.size());
  file.getAll(this->speed, count);
  file.getAll(this->push, count);
  const auto visit = [this](auto& visitor)
  {
    visitor(this->relaxation);
    visitor(this->leastAllowance);
    visitor(this->stepsSinceSearch);
    visitor(this->effort.pairEvaluations);
    visitor(this->effort.neighbourSearches);
    visitor(this->effort.evaluationSeconds);
    visitor(this->effort.searchSeconds);
  };
  const std::string numbers = file.fromFile(
    [&](CheckpointReader& from, ByteWriter& put)
    {
      const auto read = [&](auto& value) { from.get(value); };
      visit(read);
      std::uint8_t due = 0;
      from.get(due);
      from.require(due <= 1);
      visit(put);
      put(due);
    });
  ByteReader get(numbers);
  visit(get);
  this->exceeded = get.get<std::uint8_t>() == 1;
  if (!this->exceeded)
  {
    this->loadNeighbours(file, shares);
    file.getAll(this->displacement, count);
    file.getAll(this->allowance, count);
  }
}

/// The first process looks at where lists begin, and tells each process where its own do.
void DescentState::loadNeighbours(SharedCheckpointReader& file, const FibreShares& shares)
{
  std::vector<std::string> toEach(shares.processes());
  file.fromFile(
    [&](CheckpointReader& from, ByteWriter&)
    {
      std::vector<std::size_t> offsets;
      from.getAll(offsets, static_cast<std::int64_t>(shares.capsuleCount() + 1));
      from.require(offsets.front() == 0 && std::is_sorted(offsets.begin(), offsets.end()));
      for (std::size_t process = 0; process < toEach.size(); ++process)
      {
        toEach[process] = bytesOf(std::vector<std::size_t>(offsets.begin() + std::ptrdiff_t(shares.capsuleBegin(process)),
          offsets.begin() + std::ptrdiff_t(shares.capsuleBegin(process + 1)) + 1));
      }
    });
  getAll(shares.sharing().deal(std::move(toEach)).front(), this->neighbours.offsets);
  const std::size_t first = this->neighbours.offsets.front();
  std::for_each(this->neighbours.offsets.begin(), this->neighbours.offsets.end(), [&](std::size_t& offset) { offset -= first; });
  file.getAll(this->neighbours.indices, this->neighbours.offsets.back());
}

} // namespace cactus
