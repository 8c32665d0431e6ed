// SPDX-License-Identifier: BSD-3-Clause
#include "growth/CandidateSearch.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cactus
{

namespace
{

constexpr double infinity = std::numeric_limits<double>::infinity();
/// Reach of a search, in extents, that usually suffices at once if fibres lie close together.
constexpr double usualReach = 2.5;

} // namespace

void Candidates::clear()
{
  this->Groups.clear();
  for (std::vector<float>& column : this->Columns)
  {
    column.clear();
  }
  this->Count = 0;
}

void Candidates::beginGroup(int rank)
{
  this->Groups.push_back({ rank, this->Count, this->Count, 0.0f, this->Count });
}

void Candidates::add(const Cone& cone, const Eigen::Vector3d& origin)
{
  const Eigen::Vector3d start = cone.start - origin;
  const double numbers[ConeColumns::Given] = { start.x(), start.y(), start.z(), cone.axis.x(), cone.axis.y(), cone.axis.z(),
    cone.length, cone.radius, cone.slope, cone.lean };
  for (std::size_t n = 0; n < ConeColumns::Given; ++n)
  {
    this->Columns[n].push_back(float(numbers[n]));
  }
  this->Groups.back().end = ++this->Count;
}

void Candidates::finish()
{
  for (std::vector<float>& column : this->Columns)
  {
    column.resize(this->Count + FieldKernels::padding, 0.0f);
  }
}

void Candidates::makeRoomFor(const Candidates& others)
{
  this->Groups.resize(std::max(this->Groups.size(), others.Groups.size()));
  for (std::vector<float>& column : this->Columns)
  {
    column.resize(std::max(column.size(), others.Count + FieldKernels::padding), 0.0f);
  }
}

ConeGroups Candidates::all()
{
  ConeGroups all{ {}, this->Groups.data(), this->Groups.size() };
  for (std::size_t n = 0; n < ConeColumns::Numbers; ++n)
  {
    all.cones.of[n] = this->Columns[n].data();
  }
  all.cones.count = this->Count;
  return all;
}

CandidateSearch::CandidateSearch(const CapsuleSeeds& seeds, const SeedBins& bins)
  : Seeds(seeds)
  , Bins(bins)
  , SeenPieces(seeds.pieces.size())
  , Fields(seeds.fibreOfRank.size(), -infinity)
{
}

double CandidateSearch::piecesWithin(double extent) const
{
  return this->Bins.density() * std::pow(2.0 * usualReach * extent + this->Bins.size(), 3.0);
}

Candidates& CandidateSearch::find(
  const Eigen::Vector3d& centre, double extent, const FieldRelevance& relevance, const Eigen::Vector3d& origin)
{
  ++this->Search;
  double reach = usualReach * extent;
  for (;;)
  {
    this->collect(centre, reach);
    this->rankFields();
    const double needed = this->neededReach(extent, relevance);
    if (needed <= reach)
    {
      break;
    }
    reach = needed;
  }
  this->keep(extent, origin);
  return this->Kept;
}

/// Finds all pieces whose field at the centre is above -reach.
void CandidateSearch::collect(const Eigen::Vector3d& centre, double reach)
{
  for (const int rank : this->Ranks)
  {
    this->Fields[std::size_t(rank)] = -infinity;
  }
  this->Ranks.clear();
  this->Pieces.clear();
  ++this->Collection;
  const double half = std::max(reach, 0.0);
  this->Bins.forEachNear(centre.array() - half, centre.array() + half,
    [&](std::uint32_t p)
    {
      Seen& seen = this->SeenPieces[p];
      if (seen.collection == this->Collection)
      {
        return;
      }
      seen.collection = this->Collection;
      const SeedPiece& piece = this->Seeds.pieces[p];
      if (seen.search != this->Search)
      {
        seen.search = this->Search;
        seen.value = coneValue(piece.cone, centre);
      }
      const double value = seen.value;
      if (value <= -reach)
      {
        return;
      }
      double& field = this->Fields[std::size_t(piece.rank)];
      if (field == -infinity)
      {
        this->Ranks.push_back(piece.rank);
      }
      field = std::max(field, value);
      this->Pieces.push_back({ piece.rank, p, value });
    });
}

void CandidateSearch::rankFields()
{
  this->Best = this->Second = -infinity;
  for (const int rank : this->Ranks)
  {
    const double value = this->Fields[std::size_t(rank)];
    this->Second = std::max(this->Second, std::min(this->Best, value));
    this->Best = std::max(this->Best, value);
  }
}

/// Returns how far all pieces must have been collected, given the fields at the centre and that they are 1-Lipschitz.
double CandidateSearch::neededReach(double extent, const FieldRelevance& relevance) const
{
  double needed = std::min(relevance.bestReach + extent, 2.0 * extent - this->Best);
  if (this->Best + extent > -relevance.secondReach)
  {
    needed = std::max(
      needed, 2.0 * extent + std::min({ this->Best + relevance.sumReach, relevance.contrast - this->Best, -this->Second }));
  }
  return needed;
}

/// Keeps those of the fibres found that can be one of the two largest within `extent`, and those of their pieces that can be
/// their largest.
void CandidateSearch::keep(double extent, const Eigen::Vector3d& origin)
{
  std::sort(this->Pieces.begin(), this->Pieces.end(), [](const Found& a, const Found& b) { return a.piece < b.piece; });
  this->Kept.clear();
  for (auto begin = this->Pieces.begin(); begin != this->Pieces.end();)
  {
    const int rank = begin->rank;
    const auto end = std::find_if(begin, this->Pieces.end(), [&](const Found& found) { return found.rank != rank; });
    const double value = this->Fields[std::size_t(rank)];
    if (value + 2.0 * extent >= this->Second)
    {
      this->Kept.beginGroup(rank);
      for (auto found = begin; found != end; ++found)
      {
        if (found->value >= value - 2.0 * extent)
        {
          this->Kept.add(this->Seeds.pieces[found->piece].cone, origin);
        }
      }
    }
    begin = end;
  }
  this->Kept.finish();
}

} // namespace cactus
