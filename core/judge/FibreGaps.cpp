// SPDX-License-Identifier: BSD-3-Clause
#include "judge/FibreGaps.h"

#include "base/Bytes.h"
#include "base/Parallel.h"
#include "mesh/SurfaceDistance.h"
#include "mesh/SurfacePieces.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <memory>
#include <set>
#include <tuple>
#include <utility>

namespace cactus
{

namespace
{

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr float unboundedLine = std::numeric_limits<float>::infinity();
/// Shares of the progress for finding neighbours, in the domain and beyond its faces.
constexpr double neighboursShare = 0.3;
constexpr double imagesShare = 0.05;

/// A pair of fibres.
struct FibrePair
{
  std::size_t a = 0;
  std::size_t b = 0;
  double gap = infinite; ///< as far as it matters to one of them
  bool nested = false;
  std::size_t image = 0; ///< of b: 0 for itself, or 1 + the number of its shift
};

auto membersOf(FibrePair& pair)
{
  return std::tie(pair.a, pair.b, pair.gap, pair.nested, pair.image);
}

/// Fibre `inPlace` and an image of fibre `other`, by rank, that come near each other. Images are numbered as in FibrePair.
struct NearImage
{
  std::size_t inPlace = 0;
  std::size_t other = 0;
  std::size_t image = 0;
};

/// Returns the box of a tree's triangles.
Eigen::AlignedBox3d boxOf(const TriangleTree& tree)
{
  if (tree.empty())
  {
    return {};
  }
  const FloatBox& box = tree.nodes()[0].box;
  return { box.lower.head<3>().cast<double>().matrix(), box.upper.head<3>().cast<double>().matrix() };
}

FloatBox shifted(const FloatBox& box, const Eigen::Vector3d& shift)
{
  const Eigen::Vector3d lower = box.lower.head<3>().cast<double>().matrix() + shift;
  const Eigen::Vector3d upper = box.upper.head<3>().cast<double>().matrix() + shift;
  return shift.isZero(0.0) ? box : FloatBox::around(lower, upper, upper);
}

/// Returns the triangles of a shifted mesh that come within a distance of a box, by their own boxes.
TriangleMesh partNear(const TriangleMesh& mesh, const Eigen::Vector3d& shift, const Eigen::AlignedBox3d& box, double distance)
{
  const double squared = distance * distance;
  TriangleMesh part;
  for (const auto& t : mesh.triangles)
  {
    std::array<Eigen::Vector3d, 3> corners;
    Eigen::AlignedBox3d own;
    for (std::size_t i = 0; i < 3; ++i)
    {
      corners[i] = mesh.points[std::size_t(t[i])] + shift;
      own.extend(corners[i]);
    }
    if (box.squaredExteriorDistance(own) <= squared)
    {
      const auto first = static_cast<std::int32_t>(part.points.size());
      part.points.insert(part.points.end(), corners.begin(), corners.end());
      part.triangles.push_back({ { first, first + 1, first + 2 } });
    }
  }
  return part;
}

class GapSearch
{
public:
  GapSearch(const Domain& domain, const OuterSurfaces& outer, SubstrateCertificate& certificate);

  void run(const Context& context, double from, const Sharing& sharing, const Recollection& known)
  {
    const double middle = from + neighboursShare * (1.0 - from);
    std::vector<std::vector<std::size_t>> near(this->Present.size());
    known.part("neighbours")
      .loop(
        sharing, near.size(), context,
        [&](std::size_t rank)
        {
          this->Bound[rank] = this->gapToLikeliest(rank);
          near[rank] = this->thoseWithin(rank, this->Bound[rank]);
          this->addThoseAround(rank, near[rank]);
        },
        [&](std::size_t rank) { return bytesOf(this->Bound[rank], near[rank]); },
        [&](std::size_t rank, const std::string& bytes) { getAll(bytes, this->Bound[rank], near[rank]); }, "Measuring gaps", from,
        middle);
    std::vector<std::vector<FibrePair>> pairs = this->pairsOf(near);
    const double beyond = middle + (this->Shifts.empty() ? 0.0 : imagesShare * (1.0 - from));
    this->addPairsAcross(context, middle, beyond, pairs);
    known.part("gaps").loop(
      sharing, pairs.size(), context,
      [&](std::size_t rank)
      {
        for (FibrePair& pair : pairs[rank])
        {
          this->measure(pair);
        }
      },
      [&](std::size_t rank) { return bytesOf(pairs[rank]); },
      [&](std::size_t rank, const std::string& bytes) { getAll(bytes, pairs[rank]); }, "Measuring gaps", beyond, 1.0);
    this->enter(pairs);
  }

private:
  // Fibres are numbered by rank: consecutive ones are near each other, so that few surfaces are in use at a time.

  std::shared_ptr<const TreedSurface> surface(std::size_t rank) const { return this->Outer.get(this->Present[rank]); }
  const FibreCertificate& findings(std::size_t rank) const { return this->Result.fibres[this->Present[rank]]; }

  std::size_t likeliestNeighbour(std::size_t rank) const;
  double gapToLikeliest(std::size_t rank) const;
  std::vector<std::size_t> thoseWithin(
    std::size_t rank, double distance, const Eigen::Vector3d& shift = Eigen::Vector3d::Zero()) const;
  void addThoseAround(std::size_t rank, std::vector<std::size_t>& found) const;
  std::vector<std::size_t> thoseOnAllSides(const Eigen::Vector3d& point) const;
  std::vector<std::vector<FibrePair>> pairsOf(const std::vector<std::vector<std::size_t>>& near) const;
  std::vector<NearImage> imagesNear(std::size_t rank) const;
  void addPairsAcross(const Context& context, double from, double to, std::vector<std::vector<FibrePair>>& pairs) const;
  void measure(FibrePair& pair) const;
  bool hasPieceInside(
    const TreedSurface& inside, std::size_t insideRank, const TreedSurface& around, std::size_t aroundRank) const;
  void enter(const std::vector<std::vector<FibrePair>>& pairsOfRanks);

  std::vector<Eigen::Vector3d> Shifts; ///< µm, to images of the domain, see Domain::shiftsToImages()
  const OuterSurfaces& Outer;
  SubstrateCertificate& Result;
  BoxTree Branches;                 ///< over the parts of all surfaces
  std::vector<std::size_t> RankOf;  ///< of the part's fibre
  std::vector<std::size_t> Present; ///< indices of fibres with an outer surface, by rank
  std::vector<double> Bound;        ///< µm, by rank: an upper bound of the gap
};

GapSearch::GapSearch(const Domain& domain, const OuterSurfaces& outer, SubstrateCertificate& certificate)
  : Shifts(domain.shiftsToImages())
  , Outer(outer)
  , Result(certificate)
{
  std::vector<BoxTree::Item> items;
  std::vector<std::size_t> placeOf;
  for (std::size_t f = 0; f < outer.size(); ++f)
  {
    for (const FloatBox& box : outer.branches(f))
    {
      items.push_back({ box, static_cast<std::uint32_t>(placeOf.size()) });
      placeOf.push_back(f);
    }
  }
  this->Branches = BoxTree(std::move(items));
  std::vector<std::size_t> rankOf(outer.size(), outer.size());
  for (const std::uint32_t branch : this->Branches.order())
  {
    std::size_t& rank = rankOf[placeOf[branch]];
    if (rank == outer.size())
    {
      rank = this->Present.size();
      this->Present.push_back(placeOf[branch]);
    }
  }
  this->RankOf.reserve(placeOf.size());
  for (const std::size_t place : placeOf)
  {
    this->RankOf.push_back(rankOf[place]);
  }
  this->Bound.resize(this->Present.size(), infinite);
}

/// Returns the fibre with the part whose box is nearest to the middle of this one's middle part; itself if there is no other.
std::size_t GapSearch::likeliestNeighbour(std::size_t rank) const
{
  const std::vector<FloatBox>& own = this->Outer.branches(this->Present[rank]);
  const FloatBox& box = own[own.size() / 2];
  FloatBox middle;
  middle.lower = middle.upper = 0.5F * (box.lower + box.upper);
  std::size_t likeliest = rank;
  float least = std::numeric_limits<float>::infinity();
  const auto& boxes = this->Branches.boxes();
  visitPlaces(
    this->Branches, [&](const FloatBox& other) { return middle.squaredDistance(other) < least; },
    [&](std::uint32_t place)
    {
      const std::size_t other = this->RankOf[this->Branches.order()[place]];
      const float apart = middle.squaredDistance(boxes[place]);
      if (other != rank && apart < least)
      {
        least = apart;
        likeliest = other;
      }
      return false;
    });
  return likeliest;
}

double GapSearch::gapToLikeliest(std::size_t rank) const
{
  const std::size_t likeliest = this->likeliestNeighbour(rank);
  return likeliest == rank ? infinite : smallestGap(this->surface(rank)->tree, this->surface(likeliest)->tree).distance;
}

/// Returns the other fibres with a part whose box is within `distance` of one of this fibre's, once it is shifted (µm).
std::vector<std::size_t> GapSearch::thoseWithin(std::size_t rank, double distance, const Eigen::Vector3d& shift) const
{
  std::vector<std::size_t> found;
  const double squared = distance * distance;
  for (const FloatBox& branch : this->Outer.branches(this->Present[rank]))
  {
    const FloatBox box = shifted(branch, shift);
    const auto isNear = [&](const FloatBox& other) { return double(box.squaredDistance(other)) <= squared; };
    visitPlaces(this->Branches, isNear,
      [&](std::uint32_t place)
      {
        const std::size_t other = this->RankOf[this->Branches.order()[place]];
        if (other != rank && isNear(this->Branches.boxes()[place]))
        {
          found.push_back(other);
        }
        return false;
      });
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

/// Adds the fibres that may contain a piece of this one.
void GapSearch::addThoseAround(std::size_t rank, std::vector<std::size_t>& found) const
{
  const std::shared_ptr<const TreedSurface> own = this->surface(rank);
  for (const std::int32_t point : this->findings(rank).outer.pieces)
  {
    for (const std::size_t other : this->thoseOnAllSides(own->mesh.points[std::size_t(point)]))
    {
      if (other != rank)
      {
        found.push_back(other);
      }
    }
  }
}

/// Returns the fibres that have parts' boxes on the half-lines from a point in all six directions, as every surface around the
/// point has.
std::vector<std::size_t> GapSearch::thoseOnAllSides(const Eigen::Vector3d& point) const
{
  std::vector<std::size_t> all;
  for (int side = 0; side < 6; ++side)
  {
    FloatBox ray = FloatBox::around(point);
    (side % 2 == 0 ? ray.lower : ray.upper)[side / 2] = side % 2 == 0 ? -unboundedLine : unboundedLine;
    std::vector<std::size_t> hit;
    visitPlaces(
      this->Branches, [&](const FloatBox& box) { return ray.overlaps(box); },
      [&](std::uint32_t place)
      {
        if (ray.overlaps(this->Branches.boxes()[place]))
        {
          hit.push_back(this->RankOf[this->Branches.order()[place]]);
        }
        return false;
      });
    std::sort(hit.begin(), hit.end());
    hit.erase(std::unique(hit.begin(), hit.end()), hit.end());
    if (side == 0)
    {
      all.swap(hit);
      continue;
    }
    std::vector<std::size_t> both;
    std::set_intersection(all.begin(), all.end(), hit.begin(), hit.end(), std::back_inserter(both));
    all.swap(both);
  }
  return all;
}

/// Returns each pair once, under the smaller of its ranks.
std::vector<std::vector<FibrePair>> GapSearch::pairsOf(const std::vector<std::vector<std::size_t>>& near) const
{
  std::vector<std::pair<std::size_t, std::size_t>> ranks;
  for (std::size_t rank = 0; rank < near.size(); ++rank)
  {
    for (const std::size_t other : near[rank])
    {
      ranks.emplace_back(std::min(rank, other), std::max(rank, other));
    }
  }
  std::sort(ranks.begin(), ranks.end());
  ranks.erase(std::unique(ranks.begin(), ranks.end()), ranks.end());
  std::vector<std::vector<FibrePair>> pairs(near.size());
  for (const auto& [one, other] : ranks)
  {
    // The smaller index first: the last bits of a distance depend on it.
    const bool isInOrder = this->Present[one] < this->Present[other];
    pairs[one].push_back({ isInOrder ? one : other, isInOrder ? other : one });
  }
  return pairs;
}

/// Returns pairs of a fibre and an image of another one that are within the bound of this fibre's gap, by the boxes of their
/// parts. Either of the two may be this fibre.
std::vector<NearImage> GapSearch::imagesNear(std::size_t rank) const
{
  std::vector<NearImage> found;
  for (std::size_t image = 1; image <= this->Shifts.size(); ++image)
  {
    const Eigen::Vector3d& shift = this->Shifts[image - 1];
    for (const std::size_t other : this->thoseWithin(rank, this->Bound[rank], -shift))
    {
      found.push_back({ rank, other, image });
    }
    for (const std::size_t other : this->thoseWithin(rank, this->Bound[rank], shift))
    {
      found.push_back({ other, rank, image });
    }
  }
  return found;
}

/// Adds the pairs of a fibre and an image of another one, each once.
void GapSearch::addPairsAcross(const Context& context, double from, double to, std::vector<std::vector<FibrePair>>& pairs) const
{
  std::vector<std::vector<NearImage>> near(this->Shifts.empty() ? 0 : pairs.size());
  parallelFor(
    near.size(), context, [&](std::size_t rank) { near[rank] = this->imagesNear(rank); }, "Measuring gaps", from, to);
  std::set<std::array<std::size_t, 3>> all;
  for (const std::vector<NearImage>& ofRank : near)
  {
    for (const NearImage& one : ofRank)
    {
      all.insert({ { one.inPlace, one.other, one.image } });
    }
  }
  for (const auto& [inPlace, other, image] : all)
  {
    pairs[inPlace].push_back({ inPlace, other, infinite, false, image });
  }
}

void GapSearch::measure(FibrePair& pair) const
{
  const std::shared_ptr<const TreedSurface> a = this->surface(pair.a);
  const std::shared_ptr<const TreedSurface> b = this->surface(pair.b);
  // A little more than the bound, so that an equal value is found.
  const double below = 1.000001 * std::max(this->Bound[pair.a], this->Bound[pair.b]) + 1e-9;
  if (pair.image > 0)
  {
    const Eigen::Vector3d& shift = this->Shifts[pair.image - 1];
    const TriangleMesh image = partNear(b->mesh, shift, boxOf(a->tree), below);
    const TriangleTree ofImage(image);
    const TriangleMesh inPlace = partNear(a->mesh, Eigen::Vector3d::Zero(), boxOf(ofImage), below);
    pair.gap = smallestGap(TriangleTree(inPlace), ofImage, below).distance;
    return; // surfaces end at the domain's faces: none lies inside another one's image
  }
  pair.gap = smallestGap(a->tree, b->tree, below).distance;
  pair.nested = pair.gap > 0.0 && (this->hasPieceInside(*a, pair.a, *b, pair.b) || this->hasPieceInside(*b, pair.b, *a, pair.a));
}

/// Requires that the surfaces do not meet.
bool GapSearch::hasPieceInside(
  const TreedSurface& inside, std::size_t insideRank, const TreedSurface& around, std::size_t aroundRank) const
{
  return this->findings(aroundRank).outer.closed() && // otherwise it has no inside, and is a fault itself
         anyLiesInside(inside.mesh, this->findings(insideRank).outer, around.tree);
}

void GapSearch::enter(const std::vector<std::vector<FibrePair>>& pairsOfRanks)
{
  std::vector<FibrePair> pairs; // by indices
  for (const std::vector<FibrePair>& ofRank : pairsOfRanks)
  {
    for (const FibrePair& pair : ofRank)
    {
      const auto [a, b] = std::minmax(this->Present[pair.a], this->Present[pair.b]);
      pairs.push_back({ a, b, pair.gap, pair.nested });
    }
  }
  std::stable_sort(
    pairs.begin(), pairs.end(), [](const FibrePair& p, const FibrePair& q) { return std::pair(p.a, p.b) < std::pair(q.a, q.b); });
  // Two fibres may be near each other in the domain and beyond its faces.
  std::size_t count = 0;
  for (const FibrePair& pair : pairs)
  {
    if (count > 0 && pairs[count - 1].a == pair.a && pairs[count - 1].b == pair.b)
    {
      pairs[count - 1].gap = std::min(pairs[count - 1].gap, pair.gap);
      pairs[count - 1].nested = pairs[count - 1].nested || pair.nested;
      continue;
    }
    pairs[count++] = pair;
  }
  pairs.resize(count);
  this->Result.smallestGap = infinite;
  for (const FibrePair& pair : pairs)
  {
    FibreCertificate& a = this->Result.fibres[pair.a];
    FibreCertificate& b = this->Result.fibres[pair.b];
    // Pairs come by increasing ids, so that of equal gaps the smaller id stays.
    for (auto [own, other] : { std::pair(&a, &b), std::pair(&b, &a) })
    {
      if (pair.gap < infinite && !(own->gap <= pair.gap))
      {
        own->gap = pair.gap;
        own->nearestFibre = other->fibreId;
      }
      own->meetingFibres += pair.gap == 0.0 || pair.nested ? 1 : 0;
    }
    this->Result.meetingPairs += pair.gap == 0.0 ? 1 : 0;
    this->Result.nestedPairs += pair.nested ? 1 : 0;
    if (pair.gap < this->Result.smallestGap)
    {
      this->Result.smallestGap = pair.gap;
      this->Result.gapFibreA = a.fibreId;
      this->Result.gapFibreB = b.fibreId;
    }
  }
  if (pairs.empty())
  {
    this->Result.smallestGap = std::numeric_limits<double>::quiet_NaN();
  }
}

} // namespace

void findGaps(const Domain& domain, const OuterSurfaces& outer, SubstrateCertificate& certificate, const Context& context,
  double from, const Sharing& sharing, const Recollection& known)
{
  GapSearch(domain, outer, certificate).run(context, from, sharing, known);
}

} // namespace cactus
