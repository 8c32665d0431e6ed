// SPDX-License-Identifier: BSD-3-Clause
#include "judge/CertificateTables.h"

#include "base/Numbers.h"

#include <cmath>
#include <limits>
#include <utility>

namespace cactus
{

namespace
{

/// Builds columns over rows of any type.
template <typename Row>
class Columns
{
public:
  explicit Columns(const std::vector<Row>& rows)
    : Rows(rows)
  {
  }

  template <typename Value>
  void add(const std::string& name, bool whole, Value&& value)
  {
    CertificateColumn column{ name, whole, {} };
    for (const Row& row : this->Rows)
    {
      column.values.push_back(static_cast<double>(value(row)));
    }
    this->Result.push_back(std::move(column));
  }
  template <typename Value>
  void count(const std::string& name, Value&& value)
  {
    this->add(name, true, value);
  }
  template <typename Value>
  void number(const std::string& name, Value&& value)
  {
    this->add(name, false, value);
  }

  std::vector<CertificateColumn> take() { return std::move(this->Result); }

private:
  const std::vector<Row>& Rows;
  std::vector<CertificateColumn> Result;
};

} // namespace

std::vector<CertificateColumn> substrateColumns(const SubstrateCertificate& certificate)
{
  using All = SubstrateCertificate;
  const std::vector<const All*> row{ &certificate };
  Columns<const All*> columns(row);
  columns.count("Certified", [](const All* c) { return c->certified() ? 1 : 0; });
  columns.count("OuterJudged", [](const All* c) { return c->outerJudged ? 1 : 0; });
  columns.count("InnerJudged", [](const All* c) { return c->innerJudged ? 1 : 0; });
  columns.count("OuterSurfaces", [](const All* c) { return c->outerSurfaces; });
  columns.count("InnerSurfaces", [](const All* c) { return c->innerSurfaces; });
  columns.count("NotClosed", [](const All* c) { return c->notClosed; });
  columns.count("NotManifold", [](const All* c) { return c->notManifold; });
  columns.count("NotOutward", [](const All* c) { return c->notOutward; });
  columns.count("SelfIntersecting", [](const All* c) { return c->selfIntersecting; });
  columns.count("SelfNested", [](const All* c) { return c->selfNested; });
  columns.count("OuterPairsMeeting", [](const All* c) { return c->meetingPairs; });
  columns.count("OuterPairsNested", [](const All* c) { return c->nestedPairs; });
  columns.count("InnerLeaving", [](const All* c) { return c->leavingInner; });
  columns.count("Fibres", [](const All* c) { return c->wantedFibres; });
  columns.count("WithoutOuter", [](const All* c) { return c->withoutOuter; });
  columns.count("WithoutInner", [](const All* c) { return c->withoutInner; });
  columns.count("Unmyelinated", [](const All* c) { return c->bare; });
  columns.count("ThinMyelin", [](const All* c) { return c->thinMyelin; });
  columns.number("SmallestGap_um", [](const All* c) { return c->smallestGap; });
  columns.count("SmallestGapFibreA", [](const All* c) { return c->gapFibreA; });
  columns.count("SmallestGapFibreB", [](const All* c) { return c->gapFibreB; });
  columns.number("MinimumGap_um", [](const All* c) { return c->requiredGap; });
  columns.number("SmallestMyelin_um", [](const All* c) { return c->smallestMyelin; });
  columns.count("SmallestMyelinFibre", [](const All* c) { return c->myelinFibre; });
  columns.number("SmallestFeature_um", [](const All* c) { return c->smallestFeature; });
  columns.number("LargestAspect", [](const All* c) { return c->largestAspect; });
  columns.number("LargestSquaredEdgeRatio", [](const All* c) { return c->largestSquaredEdgeRatio; });
  columns.number("LargestNormalAngle_deg", [](const All* c) { return c->largestNormalAngle; });
  columns.number("Reach_um", [](const All* c) { return c->reach; });
  columns.number("FVF", [](const All* c) { return c->fibreVolumeFraction; });
  columns.number("AVF", [](const All* c) { return c->axonVolumeFraction; });
  columns.number("MVF", [](const All* c) { return c->myelinVolumeFraction; });
  columns.number("AggregateGRatio", [](const All* c) { return c->aggregateGRatio; });
  columns.count("Triangles", [](const All* c) { return c->triangles; });
  columns.number("TrianglesPerArea_um-2", [](const All* c) { return c->trianglesPerArea; });
  return columns.take();
}

std::vector<CertificateColumn> fibreColumns(const SubstrateCertificate& certificate)
{
  using Fibre = FibreCertificate;
  Columns<Fibre> columns(certificate.fibres);
  columns.count("FibreId", [](const Fibre& f) { return f.fibreId; });
  columns.count("BundleId", [](const Fibre& f) { return f.bundleId; });
  columns.count("HasOuter", [](const Fibre& f) { return f.hasOuter ? 1 : 0; });
  columns.count("HasInner", [](const Fibre& f) { return f.hasInner ? 1 : 0; });
  columns.count("OuterSound", [](const Fibre& f) { return f.outer.sound() ? 1 : 0; });
  columns.count("InnerSound", [](const Fibre& f) { return f.inner.sound() ? 1 : 0; });
  columns.count("OuterSelfIntersections", [](const Fibre& f) { return f.outerSelfIntersections; });
  columns.count("InnerSelfIntersections", [](const Fibre& f) { return f.innerSelfIntersections; });
  columns.count("SelfNested", [](const Fibre& f) { return f.outerSelfNested || f.innerSelfNested ? 1 : 0; });
  columns.count("MeetingFibres", [](const Fibre& f) { return f.meetingFibres; });
  columns.count("InnerLeaves", [](const Fibre& f) { return f.innerLeaves ? 1 : 0; });
  columns.number("SmallestGap_um", [](const Fibre& f) { return f.gap; });
  columns.count("NearestFibre", [](const Fibre& f) { return f.nearestFibre; });
  columns.number("SmallestMyelin_um", [](const Fibre& f) { return f.myelinThickness; });
  columns.number("Length_um", [](const Fibre& f) { return f.length; });
  columns.number("OuterRadius_um", [](const Fibre& f) { return f.outerRadius.mean; });
  columns.number("InnerRadius_um", [](const Fibre& f) { return f.innerRadius.mean; });
  columns.count("OuterCuts", [](const Fibre& f) { return f.outerRadius.cuts; });
  columns.count("InnerCuts", [](const Fibre& f) { return f.innerRadius.cuts; });
  columns.number("GRatio", [](const Fibre& f) { return f.gRatio; });
  columns.number("OuterVolume_um3", [](const Fibre& f) { return f.outer.volume; });
  columns.number("InnerVolume_um3", [](const Fibre& f) { return f.inner.volume; });
  columns.number("OuterArea_um2", [](const Fibre& f) { return f.outer.area; });
  columns.number("InnerArea_um2", [](const Fibre& f) { return f.inner.area; });
  columns.count("OuterTriangles", [](const Fibre& f) { return f.outer.triangles; });
  columns.count("InnerTriangles", [](const Fibre& f) { return f.inner.triangles; });
  const auto least = [](double a, double b) { return std::fmin(a, b); };
  const auto of = [](bool has, double value) { return has ? value : std::numeric_limits<double>::quiet_NaN(); };
  columns.number("SmallestFeature_um",
    [&](const Fibre& f) { return least(of(f.hasOuter, f.outer.smallestAltitude), of(f.hasInner, f.inner.smallestAltitude)); });
  columns.number("LargestSquaredEdgeRatio",
    [](const Fibre& f) { return std::fmax(f.outer.largestSquaredEdgeRatio, f.inner.largestSquaredEdgeRatio); });
  columns.number(
    "LargestNormalAngle_deg", [](const Fibre& f) { return std::fmax(f.outer.largestNormalAngle, f.inner.largestNormalAngle); });
  return columns.take();
}

std::vector<CertificateLine> certificateLines(const SubstrateCertificate& certificate)
{
  std::string verdict = (certificate.certified() ? "" : "not certified: ") + certificate.verdict();
  if (certificate.certified() && !certificate.scope().empty())
  {
    verdict += " " + certificate.scope();
  }
  std::vector<CertificateLine> lines{ { "Verdict", std::move(verdict) } };
  for (const CertificateColumn& column : substrateColumns(certificate))
  {
    const double value = column.values.front();
    CertificateLine line{ column.name, std::isnan(value) ? "-" : "" };
    if (!std::isnan(value))
    {
      appendNumber(line.value, value, column.whole ? 15 : 6);
    }
    lines.push_back(std::move(line));
  }
  return lines;
}

} // namespace cactus
