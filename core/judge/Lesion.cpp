// SPDX-License-Identifier: BSD-3-Clause
#include "judge/Lesion.h"

#include "base/Constants.h"
#include "base/Error.h"
#include "base/Limits.h"
#include "base/Parallel.h"
#include "base/Random.h"
#include "mesh/SurfaceCheck.h"
#include "mesh/SurfaceWall.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>

namespace cactus
{

namespace
{

/// A fibre that a lesion may take.
struct Candidate
{
  double key = 0.0; ///< of its place in the order
  double length = 0.0;
  bool hasMyelin = false;
};

Candidate candidateOf(
  const Domain& domain, const FibreSurfaces& outer, const FibreSurfaces& inner, std::size_t i, const LesionOptions& options)
{
  const TriangleMesh mesh = outer.mesh(i);
  const SurfaceReport report = checkSurface(mesh);
  if (!report.sound())
  {
    throw InvalidInput(text("the outer surface of fibre ", outer.fibreIds[i], " is not closed, or points inward"));
  }
  const double wall = areaOf(mesh, wallTriangles(mesh, domain, largestInset));
  Candidate found;
  found.length = wall * wall / (4.0 * pi * report.volume);
  const auto axon = inner.placeOf(outer.fibreIds[i]);
  found.hasMyelin = axon && !areSame(inner.mesh(*axon), mesh);
  RandomEngine engine = randomStream(options.seed, RandomStage::Lesion, std::uint64_t(outer.fibreIds[i]));
  found.key = options.order == LesionOrder::Random ? uniform(engine) : wall > 0.0 ? report.volume / wall : 0.0;
  return found;
}

/// Marks candidates, in their order, whose length comes nearest to a fraction of that of all. Returns the fraction reached.
double take(const std::vector<Candidate>& candidates, const std::vector<std::size_t>& order,
  const std::function<bool(std::size_t)>& isEligible, double fraction, FibreInLesion mark, std::vector<FibreInLesion>& fibres)
{
  double all = 0.0;
  for (const std::size_t i : order)
  {
    all += isEligible(i) ? candidates[i].length : 0.0;
  }
  double taken = 0.0;
  for (const std::size_t i : order)
  {
    if (isEligible(i) && taken + 0.5 * candidates[i].length <= fraction * all)
    {
      taken += candidates[i].length;
      fibres[i] = mark;
    }
    else if (isEligible(i))
    {
      break;
    }
  }
  return all > 0.0 ? taken / all : 0.0;
}

/// Returns some of the surfaces, as `mesh` gives those of the places kept.
FibreSurfaces someOf(
  const FibreSurfaces& all, const std::vector<std::size_t>& kept, std::function<TriangleMesh(std::size_t place)> mesh)
{
  FibreSurfaces some;
  for (const std::size_t place : kept)
  {
    some.fibreIds.push_back(all.fibreIds[place]);
    some.bundleIds.push_back(all.bundleIds[place]);
  }
  some.mesh = [kept, mesh = std::move(mesh)](std::size_t i) { return mesh(kept[i]); };
  some.isGiven = all.isGiven;
  some.promisedGap = all.promisedGap;
  return some;
}

} // namespace

const PropertyList<LesionOptions>& LesionOptions::properties()
{
  using Options = LesionOptions;
  static const auto list =
    PropertyList<Options>()
      .add("AxonLoss", &Options::axonLoss, limits::axonLoss,
        "Fraction of the fibres that are gone, by length. Their place belongs to the extra-axonal space.")
      .add("MyelinLoss", &Options::myelinLoss, limits::part,
        "Fraction of the myelinated fibres that are left and have lost their myelin, by length. Their axons stay as they are, "
        "and "
        "the place of the myelin belongs to the extra-axonal space.")
      .add("Order", &Options::order, { "Thinnest first", "Random" },
        "The fibres that are taken first: thin ones, as in most diseases, or any. A larger fraction takes the same fibres and "
        "more. AxonLoss comes before MyelinLoss.")
      .add("Seed", &Options::seed, limits::seed, "Seed of the random order.")
      .where("Order", { 1 });
  return list;
}

void LesionOptions::validate() const
{
  validateProperties(*this);
}

Lesion fibresInLesion(const Domain& domain, const FibreSurfaces& outer, const FibreSurfaces& inner, const LesionOptions& options,
  const Context& context)
{
  options.validate();
  std::vector<Candidate> candidates(outer.size());
  parallelFor(
    outer.size(), context, [&](std::size_t i) { candidates[i] = candidateOf(domain, outer, inner, i, options); },
    "Looking at surfaces");
  std::vector<std::size_t> order(outer.size());
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    order[i] = i;
  }
  std::stable_sort(
    order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return candidates[a].key < candidates[b].key; });
  Lesion lesion;
  lesion.fibres.assign(outer.size(), FibreInLesion::Whole);
  lesion.axonLoss = take(
    candidates, order, [](std::size_t) { return true; }, options.axonLoss, FibreInLesion::Gone, lesion.fibres);
  const std::vector<FibreInLesion> left = lesion.fibres;
  lesion.myelinLoss = take(
    candidates, order, [&](std::size_t i) { return left[i] == FibreInLesion::Whole && candidates[i].hasMyelin; },
    options.myelinLoss, FibreInLesion::WithoutMyelin, lesion.fibres);
  return lesion;
}

FibreSurfaces outerInLesion(const Lesion& lesion, const FibreSurfaces& outer, const FibreSurfaces& inner)
{
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < outer.size(); ++i)
  {
    if (lesion.fibres[i] != FibreInLesion::Gone)
    {
      kept.push_back(i);
    }
  }
  FibreSurfaces some = someOf(outer, kept,
    [fibres = lesion.fibres, &outer, &inner](std::size_t i)
    { return fibres[i] == FibreInLesion::WithoutMyelin ? inner.mesh(*inner.placeOf(outer.fibreIds[i])) : outer.mesh(i); });
  for (const int id : outer.wantedIds)
  {
    const auto place = outer.placeOf(id);
    if (!place || lesion.fibres[*place] != FibreInLesion::Gone)
    {
      some.wantedIds.push_back(id);
    }
  }
  return some;
}

FibreSurfaces innerInLesion(const Lesion& lesion, const FibreSurfaces& outer, const FibreSurfaces& inner)
{
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < inner.size(); ++i)
  {
    const auto fibre = outer.placeOf(inner.fibreIds[i]);
    if (!fibre || lesion.fibres[*fibre] != FibreInLesion::Gone)
    {
      kept.push_back(i);
    }
  }
  return someOf(inner, kept, inner.mesh);
}

} // namespace cactus
