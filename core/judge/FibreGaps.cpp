// SPDX-License-Identifier: BSD-3-Clause
#include "judge/FibreGaps.h"

#include "base/Parallel.h"
#include "mesh/SurfaceDistance.h"
#include "mesh/SurfacePieces.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

namespace cactus
{

namespace
{

constexpr double infinite = std::numeric_limits<double>::infinity();
/// Share of the work that looking for first neighbours takes.
constexpr double firstNeighboursShare = 0.25;

/// Two fibres by their places in the certificate.
struct FibrePair
{
  std::size_t a = 0;
  std::size_t b = 0;
  double gap = infinite; ///< as far as it matters to one of them
  bool nested = false;
};

class GapSearch
{
public:
  GapSearch(const std::vector<std::unique_ptr<TreedSurface>>& outer, SubstrateCertificate& certificate)
    : Outer(outer)
    , Result(certificate)
  {
    for (std::size_t f = 0; f < outer.size(); ++f)
    {
      if (outer[f] != nullptr && !outer[f]->tree.empty())
      {
        Present.push_back(f);
      }
    }
  }

  void run(const Context& context, double from)
  {
    const double middle = from + firstNeighboursShare * (1.0 - from);
    std::vector<double> bound(this->Outer.size(), infinite);
    parallelFor(
      this->Present.size(), context, [&](std::size_t i) { bound[this->Present[i]] = this->gapToLikeliest(this->Present[i]); },
      "Measuring gaps", from, middle);
    std::vector<FibrePair> pairs = this->pairsWithin(bound);
    parallelFor(
      pairs.size(), context,
      [&](std::size_t i)
      {
        FibrePair& pair = pairs[i];
        // A little more than the bound, so that what equals it is found.
        const double below = 1.000001 * std::max(bound[pair.a], bound[pair.b]) + 1e-9;
        pair.gap = smallestGap(this->Outer[pair.a]->tree, this->Outer[pair.b]->tree, below).distance;
        pair.nested = pair.gap > 0.0 && (this->hasPieceInside(pair.a, pair.b) || this->hasPieceInside(pair.b, pair.a));
      },
      "Measuring gaps", middle, 1.0);
    this->enter(pairs);
  }

private:
  const FloatBox& boxOf(std::size_t f) const { return this->Outer[f]->tree.nodes()[0].box; }

  /// The gap to the fibre whose box is nearest, which bounds how far the others matter.
  double gapToLikeliest(std::size_t f) const
  {
    std::size_t likeliest = f;
    float least = std::numeric_limits<float>::infinity();
    const auto centre = [](const FloatBox& box) -> Eigen::Array4f { return 0.5F * (box.lower + box.upper); };
    for (const std::size_t other : this->Present)
    {
      const float apart = (centre(this->boxOf(f)) - centre(this->boxOf(other))).square().sum();
      if (other != f && apart < least)
      {
        least = apart;
        likeliest = other;
      }
    }
    return likeliest == f ? infinite : smallestGap(this->Outer[f]->tree, this->Outer[likeliest]->tree).distance;
  }

  /// The pairs whose boxes come as near as the bound of one of the two.
  std::vector<FibrePair> pairsWithin(const std::vector<double>& bound) const
  {
    std::vector<FibrePair> pairs;
    for (std::size_t i = 0; i < this->Present.size(); ++i)
    {
      for (std::size_t j = i + 1; j < this->Present.size(); ++j)
      {
        const std::size_t a = this->Present[i];
        const std::size_t b = this->Present[j];
        const double reach = std::max(bound[a], bound[b]);
        if (double(this->boxOf(a).squaredDistance(this->boxOf(b))) <= reach * reach)
        {
          pairs.push_back({ a, b });
        }
      }
    }
    return pairs;
  }

  /// For surfaces that do not meet.
  bool hasPieceInside(std::size_t inside, std::size_t around) const
  {
    const auto& fibres = this->Result.fibres;
    return fibres[around].outer.closed() && // else it has no inside, and is a fault by itself
           anyLiesInside(this->Outer[inside]->mesh, fibres[inside].outer, this->Outer[around]->tree);
  }

  void enter(const std::vector<FibrePair>& pairs)
  {
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

  const std::vector<std::unique_ptr<TreedSurface>>& Outer;
  SubstrateCertificate& Result;
  std::vector<std::size_t> Present; ///< places of fibres with an outer surface
};

} // namespace

void findGaps(
  const std::vector<std::unique_ptr<TreedSurface>>& outer, SubstrateCertificate& certificate, const Context& context, double from)
{
  GapSearch(outer, certificate).run(context, from);
}

} // namespace cactus
