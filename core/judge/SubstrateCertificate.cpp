// SPDX-License-Identifier: BSD-3-Clause
#include "judge/SubstrateCertificate.h"

#include "base/Bytes.h"
#include "base/Error.h"
#include "base/Limits.h"
#include "base/Parallel.h"
#include "fibres/FibreShape.h"
#include "judge/CertificateSummary.h"
#include "judge/FibreExamination.h"
#include "judge/FibreGaps.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace cactus
{

namespace
{

/// Bundle of a fibre of which only the id is known; sorted behind all others.
constexpr int unknownBundle = std::numeric_limits<int>::max();
/// Share of the progress for examining each fibre by itself.
constexpr double surfacesDone = 0.6;
/// Memory for outer surfaces in all processes, and at least in each.
constexpr std::size_t bytesOfSurfaces = std::size_t(1) << 30;
constexpr std::size_t leastBytesOfSurfaces = std::size_t(1) << 28;

/// Returns fibres with a surface, those that were to have one, and those whose centre lines run through the domain, by increasing
/// id.
std::vector<FibreCertificate> fibresToExamine(const FibreSurfaces& outer, const FibreSurfaces& inner, const Fibres* lines)
{
  std::vector<std::pair<int, int>> found; // id and bundle
  for (const FibreSurfaces* surfaces : { &outer, &inner })
  {
    for (std::size_t i = 0; i < surfaces->size(); ++i)
    {
      found.emplace_back(surfaces->fibreIds[i], surfaces->bundleIds[i]);
    }
    for (const int id : surfaces->wantedIds)
    {
      found.emplace_back(id, unknownBundle);
    }
  }
  for (std::size_t f = 0; lines != nullptr && f < lines->size(); ++f)
  {
    if (lengthInDomain(*lines, f) > 0.0)
    {
      found.emplace_back(lines->fibreIds[f], lines->bundleIds[f]);
    }
  }
  std::sort(found.begin(), found.end());
  std::vector<FibreCertificate> fibres;
  for (const auto& [id, bundle] : found)
  {
    if (fibres.empty() || fibres.back().fibreId != id)
    {
      fibres.emplace_back();
      fibres.back().fibreId = id;
      fibres.back().bundleId = bundle == unknownBundle ? 0 : bundle;
    }
  }
  return fibres;
}

} // namespace

const PropertyList<SubstrateCertificateOptions>& SubstrateCertificateOptions::properties()
{
  using Options = SubstrateCertificateOptions;
  static const auto list =
    PropertyList<Options>()
      .add("MinimumGap", &Options::minimumGap, limits::judgedGap,
        "Smallest distance in µm that the outer surfaces of two fibres must keep. -1: the distance that they promise, which is "
        "the MinimumGap of their FibreRadialGrowth. 0: they only must not meet; -1 means the same for surfaces that promise "
        "nothing, such as those of a file. MinimumGap_um in the table is the distance used.")
      .add("CutSpacing", &Options::cutSpacing, limits::cutSpacing,
        "Distance in µm between two cross-sections along a fibre, 0.01 to 1000.");
  return list;
}

void SubstrateCertificateOptions::validate() const
{
  validateProperties(*this);
}

SubstrateCertificate certify(const Domain& domain, const FibreSurfaces& outer, const FibreSurfaces& inner, const Fibres* fibres,
  const SubstrateCertificateOptions& options, const Context& context, const Sharing& sharing, const Recollection& known)
{
  options.validate();
  if (fibres != nullptr)
  {
    validate(*fibres);
  }
  if (outer.size() + inner.size() + outer.wantedIds.size() + inner.wantedIds.size() == 0)
  {
    throw InvalidInput("there are no surfaces to certify: connect MyelinSurface's Outer and Inner");
  }
  SubstrateCertificate certificate;
  certificate.fibres = fibresToExamine(outer, inner, fibres);
  const std::size_t count = certificate.fibres.size();
  const FibreExamination examination(domain, outer, inner, fibres, options.cutSpacing);
  OuterSurfaces surfaces(count, std::max(leastBytesOfSurfaces, bytesOfSurfaces / std::size_t(sharing.size())),
    [&](std::size_t f) { return examination.outerOf(certificate.fibres[f].fibreId); });
  std::vector<double> reach(count, 0.0);
  known.part("fibres").loop(
    sharing, count, context, [&](std::size_t f) { surfaces.enter(f, examination.examine(certificate.fibres[f], reach[f])); },
    [&](std::size_t f) { return bytesOf(certificate.fibres[f], reach[f], surfaces.branches(f)); },
    [&](std::size_t f, const std::string& bytes)
    {
      std::vector<FloatBox> branches;
      getAll(bytes, certificate.fibres[f], reach[f], branches);
      surfaces.enter(f, std::move(branches));
    },
    "Looking at surfaces", 0.0, surfacesDone);
  findGaps(domain, surfaces, certificate, context, surfacesDone, sharing, known);
  const double requiredGap = options.minimumGap < 0.0 ? outer.promisedGap : options.minimumGap;
  summarise(domain, outer, inner, requiredGap, count > 0 ? *std::max_element(reach.begin(), reach.end()) : 0.0, certificate);
  listFaults(certificate);
  return certificate;
}

} // namespace cactus
