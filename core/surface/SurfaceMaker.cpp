// SPDX-License-Identifier: BSD-3-Clause
#include "surface/SurfaceMaker.h"

#include "base/Bytes.h"
#include "base/Error.h"
#include "base/Limits.h"
#include "base/Memory.h"
#include "base/Parallel.h"
#include "mesh/SurfaceSpacing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numeric>
#include <set>
#include <utility>

namespace cactus
{

namespace
{

/// Largest relative error of the axons' common volume.
constexpr double volumeTolerance = 2e-3;
/// Extra depth (µm) of each attempt for surfaces that are not coarsened, or for which less coarsening did not help.
constexpr double deeperEachTime = 0.005;
/// Number of attempts to make outer surfaces again that failed when they were moved.
constexpr int remakes = 3;
/// Number of attempts to find a g-ratio that gives all axons together the target volume.
constexpr int commonRounds = 6;

std::int32_t idOf(std::int32_t id)
{
  return id;
}

std::int32_t idOf(const FibreSurfacePair& pair)
{
  return pair.fibreId;
}

std::vector<FibreSurfacePair> fibresOf(const LabelImageFacts& facts, const FibrePlaces& places)
{
  require(facts.bundleIds.size() == facts.fibreIds.size() && facts.targetRadii.size() == facts.fibreIds.size() &&
            (facts.lengths.empty() || facts.lengths.size() == facts.fibreIds.size()),
    "the columns of the label image's FibreTable differ in length");
  std::vector<FibreSurfacePair> pairs(facts.fibreIds.size());
  for (std::size_t i = 0; i < pairs.size(); ++i)
  {
    pairs[i].fibreId = facts.fibreIds[i];
    pairs[i].bundleId = facts.bundleIds[i];
    pairs[i].targetRadius = facts.targetRadii[i];
    validateRow(facts.columns, i, text("the label image's FibreTable, fibre ", facts.fibreIds[i]));
    pairs[i].ownGRatio = facts.columns.value(targetGRatioColumn.name, i);
    pairs[i].isWanted = facts.lengths.empty() || !(facts.lengths[i] <= 0.0);
  }
  std::sort(pairs.begin(), pairs.end(), [](const auto& a, const auto& b) { return a.fibreId < b.fibreId; });
  for (std::size_t i = 0; i < pairs.size(); ++i)
  {
    if (pairs[i].fibreId < 1 || (i > 0 && pairs[i].fibreId == pairs[i - 1].fibreId))
    {
      throw InvalidInput(
        text("the label image's FibreTable names fibre ", pairs[i].fibreId, ": ids must count from 1 and be unique"));
    }
  }
  for (const auto& entry : places.all())
  {
    const bool known =
      std::binary_search(pairs.begin(), pairs.end(), entry.first, [](const auto& a, const auto& b) { return idOf(a) < idOf(b); });
    if (!known && !facts.isSample)
    {
      throw InvalidInput(text("fibre ", entry.first, " of the label image is not in its FibreTable"));
    }
  }
  return pairs;
}

/// Returns a number that is similar for nearby places: their interleaved bits (Morton).
std::uint64_t placeNumber(const std::array<int, 3>& place)
{
  std::uint64_t number = 0;
  for (int bit = 20; bit >= 0; --bit)
  {
    for (const int along : place)
    {
      number = 2 * number + ((std::uint64_t(along) >> bit) & 1U);
    }
  }
  return number;
}

/// Returns the fibres in such an order by their middles, so that samples shared by neighbours are cached.
std::vector<std::size_t> orderByPlace(const std::vector<FibreSurfacePair>& pairs, const FibrePlaces& fibres)
{
  std::vector<std::pair<std::uint64_t, std::size_t>> places;
  for (std::size_t i = 0; i < pairs.size(); ++i)
  {
    const auto found = fibres.all().find(pairs[i].fibreId);
    places.emplace_back(placeNumber(found != fibres.all().end() ? found->second.middle : FibrePlaces::Place().middle), i);
  }
  std::sort(places.begin(), places.end());
  std::vector<std::size_t> order;
  order.reserve(places.size());
  for (const auto& place : places)
  {
    order.push_back(place.second);
  }
  return order;
}

/// Returns the field whose contour is the outer surface.
const SmoothedField& outerOf(const SmoothedField& field, const MyelinProfile* profile)
{
  return profile != nullptr && profile->lacksMyelin() ? profile->outer() : field;
}

/// Throws what myelinSurfaces() throws for options that do not suit the image.
const LabelImageFacts& checked(const LabelImageFacts& facts, const MyelinSurfaceOptions& options)
{
  validate(options);
  requireWithin("MinimumGap of the label image", facts.minimumGap, limits::gap);
  requireWithin("SurfaceTolerance of the label image", facts.surfaceTolerance, limits::surfaceTolerance);
  requireDecimationRoom(options, facts.surfaceTolerance);
  return facts;
}

} // namespace

SurfaceMaker::SurfaceMaker(const std::shared_ptr<const LabelSource>& image, const LabelImageFacts& facts,
  const MyelinSurfaceOptions& options, const Context& context, const SurfaceFilters* filters, const Sharing& sharing,
  const Recollection& known)
  : Facts(checked(facts, options))
  , Options(options)
  , Filters(filters)
  , Caller(context)
  , Shared(sharing)
  , Known(known)
  , Mesher(image, facts, options, filters, context, sharing, known.part("thin"))
  , Pairs(fibresOf(facts, Mesher.places()))
  , Order(orderByPlace(Pairs, Mesher.places()))
{
  keepFreedMemory();
}

/// Returns what other processes need of a fibre that this one has worked on: its pair, and its surfaces in `stores`.
std::string SurfaceMaker::bytesOfFibre(std::size_t i, const Changed& stores) const
{
  ByteWriter put;
  put(this->Pairs[i]);
  for (const SurfaceStore* store : stores)
  {
    put(store->bytesOf(i));
  }
  return std::move(put.bytes());
}

void SurfaceMaker::takeFibre(std::size_t i, const std::string& bytes, const Changed& stores)
{
  ByteReader get(bytes);
  get(this->Pairs[i]);
  for (SurfaceStore* store : stores)
  {
    store->putElsewhere(i, get.get<std::string>());
  }
}

/// Runs body(i) for each of these fibres in one of the processes. Its results have to be in the pair, without meshes, and in
/// `stores`.
template <typename Body>
void SurfaceMaker::forEachOf(const std::vector<std::size_t>& which, const Changed& stores, Body&& body)
{
  this->Shared.loop(
    which.size(), this->Caller, [&](std::size_t i) { body(which[i]); },
    [&](std::size_t i) { return this->bytesOfFibre(which[i], stores); },
    [&](std::size_t i, const std::string& bytes) { this->takeFibre(which[i], bytes, stores); });
}

/// Does the same for those of these fibres without a record in `known`, and notes theirs; each process gets those near each
/// other, which share samples.
template <typename Body>
void SurfaceMaker::makeFor(const std::vector<std::size_t>& which, const Changed& stores, const Recollection& known, Body&& body,
  const char* message, double from, double to)
{
  const std::vector<std::size_t> left =
    known.takeKnown(this->Shared, which, [this](std::size_t i, const std::string& bytes) { getAll(bytes, this->Pairs[i]); });
  std::vector<double> weights;
  for (const std::size_t i : left)
  {
    const auto found = this->Mesher.places().all().find(this->Pairs[i].fibreId);
    weights.push_back(found != this->Mesher.places().all().end() ? 1.0 + found->second.size : 1.0);
  }
  const double done = which.empty() ? 0.0 : 1.0 - static_cast<double>(left.size()) / static_cast<double>(which.size());
  this->Shared.loopAlong(
    weights, this->Caller,
    [&](std::size_t i)
    {
      body(left[i]);
      known.part(std::to_string(left[i])).note(bytesOf(this->Pairs[left[i]]));
    },
    [&](std::size_t i) { return this->bytesOfFibre(left[i], stores); },
    [&](std::size_t i, const std::string& bytes) { this->takeFibre(left[i], bytes, stores); }, message, from + done * (to - from),
    to);
}

void SurfaceMaker::makeOuter(SurfaceStore& outer, SurfaceStore& inner)
{
  this->Pairs = this->Known.part(keptApart).once(this->Shared,
    [&]
    {
      this->Shares = this->isCommon() ? Progress{ 0.45, 0.55 } : Progress{ 0.95, 0.97 };
      this->contour(outer, inner);
      outer.beginMoving();
      if (this->Filters == nullptr)
      {
        this->spaceOut(outer, inner);
      }
      return std::move(this->Pairs);
    });
  std::vector<std::size_t> moved;
  for (std::size_t i = 0; i < this->Pairs.size(); ++i)
  {
    if (this->Pairs[i].isMoved)
    {
      moved.push_back(i);
    }
  }
  outer.endMoving(moved);
  inner.endMoving({});
}

void SurfaceMaker::takeOuter(std::vector<FibreSurfacePair> fibres)
{
  this->Pairs = std::move(fibres);
  for (FibreSurfacePair& pair : this->Pairs)
  {
    FibreMesher::forgetInner(pair);
  }
}

void SurfaceMaker::makeInner(const SurfaceSource& outer, SurfaceStore& inner)
{
  this->isCommon() ? this->makeInnerOfCommonVolume(outer, inner) : this->makeEachInner(outer, inner, this->Known.part("inner"));
}

/// Returns the g-ratio of a fibre whose outer surface has this volume (µm³).
double SurfaceMaker::targetGRatio(const SmoothedField& field, const FibreSurfacePair& pair, double volume) const
{
  if (pair.hasOwnGRatio())
  {
    return pair.ownGRatio;
  }
  switch (this->Options.model)
  {
  case GRatioModel::Constant:
    return this->Options.gRatio;
  case GRatioModel::LogLinear:
    // Another library's filters may leave a surface without a volume.
    return volume > 0.0 ? logLinearGRatio(this->Mesher.equivalentDiameter(field, volume)) : smallestGRatio;
  case GRatioModel::Distributed:
    return distributedGRatio(this->Options.gRatio, this->Options.gRatioDeviation, this->Options.seed, pair.fibreId);
  default:
    return 0.0; // common volume: known once all outer volumes are
  }
}

/// Calls body(field, profile) with the field of a fibre and how its surfaces vary along it; null if they do not.
template <typename Body>
void SurfaceMaker::withField(FibreSurfacePair& pair, Body&& body) const
{
  const SmoothedField field = this->Mesher.smoothed(pair.fibreId);
  const std::unique_ptr<MyelinProfile> profile = this->Mesher.profileOf(field, pair);
  if (profile != nullptr && profile->lacksMyelin())
  {
    this->Mesher.takeMyelin(field, *profile, pair, [&](double volume) { return this->targetGRatio(field, pair, volume); });
  }
  body(field, profile.get());
}

/// Makes the inner surface of a fibre whose outer one is in its pair.
void SurfaceMaker::putInner(std::size_t i, const SmoothedField& field, MyelinProfile* profile, SurfaceStore& inner)
{
  FibreSurfacePair& pair = this->Pairs[i];
  const bool isKnown = profile != nullptr && profile->lacksMyelin(); // that of the internodes
  if (!this->isCommon() && !isKnown)
  {
    pair.targetGRatio = this->targetGRatio(field, pair, pair.volumeAsMade);
  }
  this->Mesher.makeInner(field, pair, profile);
  inner.put(i, std::exchange(pair.inner, TriangleMesh()));
}

void SurfaceMaker::contour(SurfaceStore& outer, SurfaceStore& inner)
{
  this->makeFor(
    this->Order, { &outer, &inner }, this->Known.part(outerMade),
    [&](std::size_t i)
    {
      FibreSurfacePair& pair = this->Pairs[i];
      this->withField(pair,
        [&](const SmoothedField& field, MyelinProfile* profile)
        {
          this->Mesher.makeOuter(outerOf(field, profile), pair);
          if (pair.state != MyelinState::NoFibre)
          {
            pair.volumeAsMade = pair.outerReport.volume;
            if (!this->isCommon())
            {
              this->putInner(i, field, profile, inner);
              pair.isInnerMade = true;
            }
          }
        });
      outer.put(i, std::exchange(pair.outer, TriangleMesh()));
    },
    this->isCommon() ? "making outer surfaces" : "making surfaces", shareOfLooking, this->Shares.contoured);
}

/// Keeps outer surfaces apart. One that meets itself after a move, as a folding thin cap may, is made again with less coarsening
/// there. If surfaces are not coarsened, or if that does not help, it is made deeper, so that it has to move less.
void SurfaceMaker::spaceOut(SurfaceStore& outer, const SurfaceSource& inner)
{
  const double gap = std::max(this->Facts.minimumGap, leastSeparation);
  const bool isCoarsened = this->Options.decimationError > 0.0;
  const Domain& box = this->Mesher.field().box();
  std::vector<std::size_t> made(this->Pairs.size());
  std::iota(made.begin(), made.end(), std::size_t(0));
  std::vector<std::size_t> tooNear; // known so far, increasing
  bool isOneGone = false;           // one of these
  bool isLookedAtAgain = false;     // whether these are looked at once more
  BoundsOfFibres bounds;
  std::set<std::size_t> moved;
  for (int attempt = 0; !made.empty() || isOneGone || isLookedAtAgain; ++attempt)
  {
    // Surfaces that were too near are checked again, since the other one of the pair may be new, or gone.
    std::vector<std::size_t> changed;
    std::set_union(made.begin(), made.end(), tooNear.begin(), tooNear.end(), std::back_inserter(changed));
    const SpacingReport spacing = keepApart(outer, changed, gap, Eigen::AlignedBox3d(box.lower, box.upper), this->Caller,
      attempt == 0 ? this->Shares.contoured : this->Shares.spaced, this->Shares.spaced, this->Shared,
      this->Known.part(text("apart ", attempt)), this->Mesher.field().heldFaces());
    tooNear = spacing.tooNear;
    moved.insert(spacing.moved.begin(), spacing.moved.end());
    made = this->checkMoved(spacing.moved, attempt, outer, bounds);
    this->makeAgain(made, deeperEachTime * (isCoarsened ? attempt : attempt + 1), bounds, outer);
    const auto gone = std::remove_if(
      tooNear.begin(), tooNear.end(), [this](std::size_t i) { return this->Pairs[i].state == MyelinState::NoFibre; });
    isOneGone = gone != tooNear.end();
    tooNear.erase(gone, tooNear.end());
    // Those that were moved in vain were changed again as they were checked, and may be apart now.
    isLookedAtAgain = !isLookedAtAgain && made.empty() && !tooNear.empty();
  }
  for (const std::size_t i : tooNear)
  {
    this->Pairs[i].isFlawed = true;
  }
  for (const std::size_t i : moved)
  {
    this->Pairs[i].isMoved = true;
  }
  this->evenOuter({ moved.begin(), moved.end() }, outer);
  if (!this->isCommon()) // otherwise there is none yet
  {
    this->keepInner(outer, inner);
  }
}

/// Makes the fans of moved surfaces even. Before the last move it would be too early: small triangles fold where large ones do
/// not.
void SurfaceMaker::evenOuter(const std::vector<std::size_t>& which, SurfaceStore& outer)
{
  this->forEachOf(which, { &outer },
    [&](std::size_t i)
    {
      FibreSurfacePair& pair = this->Pairs[i];
      pair.outer = *outer.get(i);
      this->Mesher.evenOuter(pair);
      outer.put(i, std::exchange(pair.outer, TriangleMesh()));
    });
}

/// Checks moved surfaces, and returns those that have to be made again, with bounds at their faults.
std::vector<std::size_t> SurfaceMaker::checkMoved(
  const std::vector<std::size_t>& moved, int attempt, SurfaceStore& outer, BoundsOfFibres& bounds)
{
  std::vector<std::vector<Eigen::Vector3d>> faults(moved.size());
  this->Shared.loop(
    faults.size(), this->Caller,
    [&](std::size_t i)
    {
      FibreSurfacePair& pair = this->Pairs[moved[i]];
      pair.isInnerMade = false;
      pair.outer = *outer.get(moved[i]);
      faults[i] = this->Mesher.checkOuter(pair);
      outer.put(moved[i], std::exchange(pair.outer, TriangleMesh()));
    },
    [&](std::size_t i) { return bytesOf(this->bytesOfFibre(moved[i], { &outer }), faults[i]); },
    [&](std::size_t i, const std::string& bytes)
    {
      std::string fibre;
      getAll(bytes, fibre, faults[i]);
      this->takeFibre(moved[i], fibre, { &outer });
    });
  std::vector<std::size_t> again;
  for (std::size_t i = 0; i < faults.size(); ++i)
  {
    this->Pairs[moved[i]].isFlawed = !faults[i].empty();
    if (!faults[i].empty() && attempt < remakes)
    {
      const auto more = boundsAround(faults[i], this->Mesher.field().grid().spacing, attempt);
      std::vector<LocalErrorBound>& all = bounds[moved[i]];
      all.insert(all.end(), more.begin(), more.end());
      again.push_back(moved[i]);
    }
  }
  return again;
}

void SurfaceMaker::makeAgain(
  const std::vector<std::size_t>& which, double deeper, const BoundsOfFibres& bounds, SurfaceStore& outer)
{
  this->forEachOf(which, { &outer },
    [&](std::size_t i)
    {
      FibreSurfacePair& pair = this->Pairs[i];
      pair.isFlawed = false; // of the old surface
      FibreMesher::forgetInner(pair);
      pair.outer = *outer.get(i);
      this->withField(pair, [&](const SmoothedField& field, MyelinProfile* profile)
        { this->Mesher.makeOuter(outerOf(field, profile), pair, bounds.at(i), deeper); });
      outer.put(i, std::exchange(pair.outer, TriangleMesh()));
    });
}

/// Checks the inner surfaces whose outer ones were moved, and resets those that have to be made again.
void SurfaceMaker::keepInner(const SurfaceSource& outer, const SurfaceSource& inner)
{
  std::vector<std::size_t> looked;
  for (std::size_t i = 0; i < this->Pairs.size(); ++i)
  {
    const FibreSurfacePair& pair = this->Pairs[i];
    if (!pair.isInnerMade && !std::isnan(pair.volumeAsMade) && pair.state != MyelinState::NoAxon)
    {
      looked.push_back(i);
    }
  }
  this->forEachOf(looked, {},
    [&](std::size_t i)
    {
      FibreSurfacePair& pair = this->Pairs[i];
      pair.outer = *outer.get(i);
      pair.inner = *inner.get(i);
      pair.isInnerMade = this->Mesher.keepsInner(pair);
      if (!pair.isInnerMade)
      {
        FibreMesher::forgetInner(pair);
      }
      pair.outer = TriangleMesh(); // frees its memory, unlike an empty copy
      pair.inner = TriangleMesh();
    });
}

void SurfaceMaker::makeEachInner(const SurfaceSource& outer, SurfaceStore& inner, const Recollection& known)
{
  std::vector<std::size_t> which;
  std::copy_if(this->Order.begin(), this->Order.end(), std::back_inserter(which),
    [this](std::size_t i) { return !std::isnan(this->Pairs[i].volumeAsMade) && !this->Pairs[i].isInnerMade; });
  this->makeFor(
    which, { &inner }, known,
    [&](std::size_t i)
    {
      FibreSurfacePair& pair = this->Pairs[i];
      if (pair.state != MyelinState::NoFibre)
      {
        pair.outer = *outer.get(i);
        this->withField(
          pair, [&](const SmoothedField& field, MyelinProfile* profile) { this->putInner(i, field, profile, inner); });
        pair.outer = TriangleMesh();
      }
      else
      {
        inner.put(i, TriangleMesh()); // replaces one made before the outer one was found to be empty
      }
    },
    "making inner surfaces", this->Shares.spaced, 1.0);
}

/// Makes inner surfaces with one g-ratio for all, so that all axons together have the target volume; if a fibre cannot have that
/// g-ratio, or has one of its own, the others compensate.
void SurfaceMaker::makeInnerOfCommonVolume(const SurfaceSource& outer, SurfaceStore& inner)
{
  const double boxVolume = this->Mesher.field().box().volume();
  const double wanted = this->Options.targetAxonVolumeFraction * boxVolume;
  double given = 0.0; // inner volume of fibres that cannot have the common g-ratio
  double open = 0.0;  // outer volume of the others
  double reached = 0.0;
  double whole = 0.0;
  for (const FibreSurfacePair& pair : this->Pairs)
  {
    const double volume = pair.outerReport.volume;
    whole += volume;
    open += pair.hasOwnGRatio() ? 0.0 : volume;
    given += pair.hasOwnGRatio() ? pair.ownGRatio * pair.ownGRatio * volume : 0.0;
  }
  require(open > 0.0 || whole == 0.0, "TargetAxonVolumeFraction cannot be aimed at, because every fibre has a TargetGRatio of "
                                      "its own: choose another GRatioModel, or "
                                      "take the array TargetGRatio off the fibres");
  const double fibreFraction = whole / boxVolume;
  double before = 0.0;
  double correction = 1.0; // for the sum of the fibres' own tolerances
  for (int round = 0; round < commonRounds; ++round)
  {
    double square = open > 0.0 ? correction * (wanted - given) / open : 2.0; // of the g-ratio
    if (square == before && reached > given)
    {
      correction *= (wanted - given) / (reached - given);
      square = correction * (wanted - given) / open;
    }
    before = square;
    if (!(square > 0.0 && square < 1.0))
    {
      break;
    }
    for (FibreSurfacePair& pair : this->Pairs)
    {
      pair.targetGRatio = pair.hasOwnGRatio() ? pair.ownGRatio : std::sqrt(square);
    }
    this->makeEachInner(outer, inner, this->Known.part(text("inner ", round)));
    given = open = reached = 0.0;
    for (const FibreSurfacePair& pair : this->Pairs)
    {
      const bool isOpen = pair.state == MyelinState::AsAsked && !pair.hasOwnGRatio();
      reached += pair.innerReport.volume;
      (isOpen ? open : given) += isOpen ? pair.outerReport.volume : pair.innerReport.volume;
    }
    if (std::abs(reached - wanted) <= volumeTolerance * wanted)
    {
      return;
    }
  }
  throw Infeasible(text("TargetAxonVolumeFraction ", this->Options.targetAxonVolumeFraction,
    " cannot be reached: the fibres fill ", fibreFraction, " of the box, and ",
    reached < wanted ? "with the thinnest myelin allowed their axons fill " : "the nearest that their axons come to is ",
    reached / boxVolume, ". Ask for another fraction, or grow the fibres further"));
}

} // namespace cactus
