// SPDX-License-Identifier: BSD-3-Clause
#include "judge/SubstrateCertificate.h"

#include "base/Error.h"
#include "base/Limits.h"
#include "base/Parallel.h"
#include "mesh/SurfaceDistance.h"
#include "mesh/SurfaceIntersection.h"
#include "mesh/SurfacePieces.h"
#include "mesh/TriangleTree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <unordered_map>
#include <utility>

namespace cactus
{

namespace
{

/// Pairs of triangles of a surface that are counted: a ruined one may have half a billion.
constexpr std::size_t mostIntersections = 10000;
constexpr double notANumber = std::numeric_limits<double>::quiet_NaN();
constexpr double infinite = std::numeric_limits<double>::infinity();
/// Of a fibre of which only the id is known; behind all others.
constexpr int unknownBundle = std::numeric_limits<int>::max();
/// µm that a surface may reach out of the domain, as the rounding of a clip does.
constexpr double clipTolerance = 0.1;
/// µm. Triangles as near as this to a face of the domain with all corners are a cap's.
constexpr double capTolerance = 1e-6;
/// Shares of the work.
constexpr double surfacesDone = 0.6;
constexpr double firstGapsDone = 0.7;

/// An outer surface and the tree over it, which refers to it.
struct TreedSurface
{
  explicit TreedSurface(TriangleMesh surface)
    : mesh(std::move(surface))
    , tree(this->mesh)
  {
  }
  TreedSurface(const TreedSurface&) = delete;
  TreedSurface& operator=(const TreedSurface&) = delete;

  TriangleMesh mesh;
  TriangleTree tree;
};

/// Two fibres by their places in the table.
struct FibrePair
{
  std::size_t a = 0;
  std::size_t b = 0;
  double gap = infinite; ///< as far as it matters to one of them
  bool nested = false;
};

class Certifier
{
public:
  Certifier(const Domain& domain, const FibreSurfaces& outer, const FibreSurfaces& inner, const Fibres* fibres,
    const SubstrateCertificateOptions& options, const Context& context)
    : Box(domain)
    , Outer(outer)
    , Inner(inner)
    , Lines(fibres)
    , Options(options)
    , Caller(context)
  {
    this->list();
  }

  SubstrateCertificate run()
  {
    parallelFor(
      this->Result.fibres.size(), this->Caller, [this](std::size_t f) { this->lookAt(f); }, "Looking at surfaces", 0.0,
      surfacesDone);
    this->findGaps();
    this->sum();
    this->judge();
    return std::move(this->Result);
  }

private:
  using Index = std::unordered_map<int, std::size_t>;

  static Index indexOf(const std::vector<int>& ids)
  {
    Index index;
    for (std::size_t i = 0; i < ids.size(); ++i)
    {
      index[ids[i]] = i;
    }
    return index;
  }

  void list()
  {
    this->OuterIndex = indexOf(this->Outer.fibreIds);
    this->InnerIndex = indexOf(this->Inner.fibreIds);
    this->LineIndex = this->Lines != nullptr ? indexOf(this->Lines->fibreIds) : Index();
    std::vector<std::pair<int, int>> found; // id and bundle
    for (const FibreSurfaces* surfaces : { &this->Outer, &this->Inner })
    {
      for (std::size_t i = 0; i < surfaces->size(); ++i)
      {
        found.emplace_back(surfaces->fibreIds[i], surfaces->bundleIds[i]);
      }
    }
    for (const FibreSurfaces* surfaces : { &this->Outer, &this->Inner })
    {
      for (const int id : surfaces->wantedIds)
      {
        found.emplace_back(id, unknownBundle);
      }
    }
    for (std::size_t f = 0; this->Lines != nullptr && f < this->Lines->size(); ++f)
    {
      if (lengthInDomain(*this->Lines, f) > 0.0)
      {
        found.emplace_back(this->Lines->fibreIds[f], this->Lines->bundleIds[f]);
      }
    }
    std::sort(found.begin(), found.end());
    for (const auto& entry : found)
    {
      if (this->Result.fibres.empty() || this->Result.fibres.back().fibreId != entry.first)
      {
        this->Result.fibres.emplace_back();
        this->Result.fibres.back().fibreId = entry.first;
        this->Result.fibres.back().bundleId = entry.second == unknownBundle ? 0 : entry.second;
      }
    }
    this->Trees.resize(this->Result.fibres.size());
    this->Reach.assign(this->Result.fibres.size(), 0.0);
  }

  /// All that concerns one fibre alone.
  void lookAt(std::size_t f)
  {
    FibreCertificate& fibre = this->Result.fibres[f];
    fibre.outerRadius = fibre.innerRadius = { 0, notANumber, notANumber };
    fibre.gap = fibre.myelinThickness = fibre.gRatio = notANumber;
    const auto outerEntry = this->OuterIndex.find(fibre.fibreId);
    if (outerEntry != this->OuterIndex.end())
    {
      fibre.hasOuter = true;
      this->Trees[f] = this->measure(this->Outer, outerEntry->second, f, fibre.outer, fibre.outerSelfIntersections,
        fibre.outerSelfNested, fibre.outerRadius, "outer");
    }
    const auto innerEntry = this->InnerIndex.find(fibre.fibreId);
    if (innerEntry != this->InnerIndex.end())
    {
      fibre.hasInner = true;
      const auto innerTree = this->measure(this->Inner, innerEntry->second, f, fibre.inner, fibre.innerSelfIntersections,
        fibre.innerSelfNested, fibre.innerRadius, "inner");
      fibre.innerLeaves = !fibre.hasOuter || this->leaves(*innerTree, fibre.inner, *this->Trees[f], fibre.outer);
      if (fibre.hasOuter)
      {
        fibre.gRatio = gRatioOf(fibre.inner.volume, fibre.outer.volume);
        const TriangleTree wall(this->Trees[f]->mesh, this->wallOf(this->Trees[f]->mesh));
        const SurfaceGap gap = smallestGap(innerTree->tree, wall);
        fibre.myelinThickness = gap.found() ? gap.distance : notANumber;
      }
    }
  }

  std::unique_ptr<TreedSurface> measure(const FibreSurfaces& surfaces, std::size_t index, std::size_t f, SurfaceReport& report,
    std::size_t& intersections, bool& nested, RadiusAlongFibre& radius, const std::string& name)
  {
    TriangleMesh mesh = surfaces.mesh(index);
    const int id = this->Result.fibres[f].fibreId;
    try
    {
      report = checkSurface(mesh);
    }
    catch (const InvalidInput& error)
    {
      throw InvalidInput("the " + name + " surface of fibre " + std::to_string(id) + ": " + error.what());
    }
    for (const Eigen::Vector3d& point : mesh.points)
    {
      this->Reach[f] = std::max(this->Reach[f], -this->Box.depth(point));
    }
    auto surface = std::make_unique<TreedSurface>(std::move(mesh));
    intersections = selfIntersections(surface->tree, mostIntersections).size();
    nested = report.pieces.size() > 1 && report.closed() && intersections == 0 && holdsItself(surface->mesh);
    const auto line = this->LineIndex.find(id);
    if (line != this->LineIndex.end())
    {
      radius = radiusAlongFibre(*this->Lines, line->second, surface->mesh, this->Options.cutSpacing);
    }
    return surface;
  }

  /// The triangles that are no caps on the faces of the domain.
  std::vector<std::uint32_t> wallOf(const TriangleMesh& mesh) const
  {
    Eigen::Vector3d lower = this->Box.lower;
    Eigen::Vector3d upper = this->Box.upper;
    for (const Eigen::Vector3d& point : mesh.points)
    {
      lower = lower.cwiseMin(point);
      upper = upper.cwiseMax(point);
    }
    // Surfaces that were not clipped to the domain end in planes, too: those of the image.
    const Eigen::Vector3d planes[4] = { this->Box.lower, this->Box.upper, lower, upper };
    std::vector<unsigned> faces(mesh.points.size(), 0U);
    for (std::size_t i = 0; i < mesh.points.size(); ++i)
    {
      for (int face = 0; face < 12; ++face)
      {
        const int axis = face % 3;
        faces[i] |= std::fabs(mesh.points[i][axis] - planes[face / 3][axis]) <= capTolerance ? 1U << face : 0U;
      }
    }
    std::vector<std::uint32_t> wall;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    {
      const auto& t = mesh.triangles[i];
      if ((faces[std::size_t(t[0])] & faces[std::size_t(t[1])] & faces[std::size_t(t[2])]) == 0U)
      {
        wall.push_back(static_cast<std::uint32_t>(i));
      }
    }
    return wall;
  }

  /// Whether a piece of `inside` cannot be shown to lie strictly inside `around`.
  static bool leaves(
    const TreedSurface& inside, const SurfaceReport& pieces, const TreedSurface& around, const SurfaceReport& aroundReport)
  {
    if (!aroundReport.closed() || surfacesMeet(inside.tree, around.tree))
    {
      return true;
    }
    return std::any_of(pieces.pieces.begin(), pieces.pieces.end(),
      [&](std::int32_t point) { return sideOf(around.tree, inside.mesh.points[std::size_t(point)]) != Side::Inside; });
  }

  const FloatBox& boxOf(std::size_t f) const { return this->Trees[f]->tree.nodes()[0].box; }

  /// For surfaces that do not meet.
  bool hasPieceInside(std::size_t inside, std::size_t around) const
  {
    if (!this->Result.fibres[around].outer.closed())
    {
      return false; // it has no inside, and is a fault by itself
    }
    const auto& pieces = this->Result.fibres[inside].outer.pieces;
    return std::any_of(pieces.begin(), pieces.end(),
      [&](std::int32_t point)
      { return sideOf(this->Trees[around]->tree, this->Trees[inside]->mesh.points[std::size_t(point)]) == Side::Inside; });
  }

  void findGaps()
  {
    std::vector<std::size_t> present;
    for (std::size_t f = 0; f < this->Trees.size(); ++f)
    {
      if (this->Trees[f] != nullptr && !this->Trees[f]->tree.empty())
      {
        present.push_back(f);
      }
    }
    // A first neighbour, whose box lies likeliest, bounds how far the others matter.
    std::vector<double> bound(this->Trees.size(), infinite);
    parallelFor(
      present.size(), this->Caller, [&](std::size_t i) { bound[present[i]] = this->gapToLikeliest(present[i], present); },
      "Measuring gaps", surfacesDone, firstGapsDone);

    std::vector<FibrePair> pairs;
    for (std::size_t i = 0; i < present.size(); ++i)
    {
      for (std::size_t j = i + 1; j < present.size(); ++j)
      {
        const double reach = std::max(bound[present[i]], bound[present[j]]);
        if (double(this->boxOf(present[i]).squaredDistance(this->boxOf(present[j]))) <= reach * reach)
        {
          pairs.push_back({ present[i], present[j] });
        }
      }
    }
    parallelFor(
      pairs.size(), this->Caller,
      [&](std::size_t i)
      {
        FibrePair& pair = pairs[i];
        // A little more than the bound, so that what equals it is found.
        const double below = 1.000001 * std::max(bound[pair.a], bound[pair.b]) + 1e-9;
        pair.gap = smallestGap(this->Trees[pair.a]->tree, this->Trees[pair.b]->tree, below).distance;
        pair.nested = pair.gap > 0.0 && (this->hasPieceInside(pair.a, pair.b) || this->hasPieceInside(pair.b, pair.a));
      },
      "Measuring gaps", firstGapsDone, 1.0);

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
      this->Result.smallestGap = notANumber;
    }
  }

  double gapToLikeliest(std::size_t f, const std::vector<std::size_t>& present) const
  {
    std::size_t likeliest = f;
    float least = std::numeric_limits<float>::infinity();
    const auto centre = [](const FloatBox& box) -> Eigen::Array4f { return 0.5F * (box.lower + box.upper); };
    for (const std::size_t other : present)
    {
      const float apart = (centre(this->boxOf(f)) - centre(this->boxOf(other))).square().sum();
      if (other != f && apart < least)
      {
        least = apart;
        likeliest = other;
      }
    }
    return likeliest == f ? infinite : smallestGap(this->Trees[f]->tree, this->Trees[likeliest]->tree).distance;
  }

  /// Sums and extremes in the order of the fibres.
  void sum()
  {
    SubstrateCertificate& all = this->Result;
    all.outerSurfaces = this->Outer.size();
    all.innerSurfaces = this->Inner.size();
    all.requiredGap = this->Options.minimumGap;
    all.promisedGap = this->Inner.promisedGap;
    all.wantedFibres = all.fibres.size();
    all.smallestMyelin = all.smallestFeature = all.largestAspect = all.largestSquaredEdgeRatio = notANumber;
    double outerVolume = 0.0;
    double innerVolume = 0.0;
    double area = 0.0;
    for (std::size_t f = 0; f < all.fibres.size(); ++f)
    {
      const FibreCertificate& fibre = all.fibres[f];
      this->add(fibre.hasOuter, fibre.outer, fibre.outerSelfIntersections);
      this->add(fibre.hasInner, fibre.inner, fibre.innerSelfIntersections);
      all.selfNested += (fibre.outerSelfNested ? 1 : 0) + (fibre.innerSelfNested ? 1 : 0);
      all.leavingInner += fibre.innerLeaves ? 1 : 0;
      all.withoutOuter += fibre.hasOuter ? 0 : 1;
      all.withoutInner += fibre.hasOuter && !fibre.hasInner ? 1 : 0;
      all.thinMyelin += fibre.myelinThickness < this->Inner.promisedGap ? 1 : 0;
      all.reach = std::max(all.reach, this->Reach[f]);
      outerVolume += fibre.outer.volume;
      innerVolume += fibre.inner.volume;
      area += fibre.outer.area + fibre.inner.area;
      if (fibre.myelinThickness < all.smallestMyelin || (std::isnan(all.smallestMyelin) && !std::isnan(fibre.myelinThickness)))
      {
        all.smallestMyelin = fibre.myelinThickness;
        all.myelinFibre = fibre.fibreId;
      }
    }
    const bool hasOuter = this->Outer.given() && all.reach <= clipTolerance;
    const bool hasInner = this->Inner.given() && all.reach <= clipTolerance;
    const double volume = this->Box.volume();
    all.fibreVolumeFraction = hasOuter ? outerVolume / volume : notANumber;
    all.axonVolumeFraction = hasInner ? innerVolume / volume : notANumber;
    all.myelinVolumeFraction = hasOuter && hasInner ? (outerVolume - innerVolume) / volume : notANumber;
    all.aggregateGRatio = hasOuter && hasInner ? gRatioOf(innerVolume, outerVolume) : notANumber;
    if (all.reach > clipTolerance)
    {
      all.remarks.push_back("surfaces reach " + std::to_string(all.reach) +
                            " µm out of the domain, so that their volumes are no fractions of it and none are given: turn on "
                            "ClipToDomain in MyelinSurface to have them");
    }
    all.trianglesPerArea = area > 0.0 ? static_cast<double>(all.triangles) / area : notANumber;
  }

  void add(bool has, const SurfaceReport& report, std::size_t intersections)
  {
    if (!has)
    {
      return;
    }
    SubstrateCertificate& all = this->Result;
    all.triangles += report.triangles;
    all.notClosed += report.closed() ? 0 : 1;
    all.notManifold += report.closed() && !report.closedManifold() ? 1 : 0;
    all.notOutward += report.outward() ? 0 : 1;
    all.selfIntersecting += intersections > 0 ? 1 : 0;
    all.smallestFeature = std::fmin(all.smallestFeature, report.smallestAltitude);
    all.largestAspect = std::fmax(all.largestAspect, report.largestAspect);
    all.largestSquaredEdgeRatio = std::fmax(all.largestSquaredEdgeRatio, report.largestSquaredEdgeRatio);
  }

  /// The first fibre for which `is` holds, for a sentence.
  template <typename Is>
  std::string first(Is&& is) const
  {
    const auto found = std::find_if(this->Result.fibres.begin(), this->Result.fibres.end(), is);
    return found == this->Result.fibres.end() ? std::string() : " (fibre " + std::to_string(found->fibreId) + " first)";
  }

  void judge()
  {
    SubstrateCertificate& all = this->Result;
    using Fibre = FibreCertificate;
    const auto fault = [&all](std::size_t count, const std::string& what)
    {
      if (count > 0)
      {
        all.faults.push_back(std::to_string(count) + " " + what);
      }
    };
    fault(all.withoutOuter, "of " + std::to_string(all.wantedFibres) + " fibres have no outer surface" +
                              this->first([](const Fibre& f) { return !f.hasOuter; }));
    fault(all.notClosed,
      "surfaces are not closed" +
        this->first([](const Fibre& f) { return (f.hasOuter && !f.outer.closed()) || (f.hasInner && !f.inner.closed()); }));
    fault(all.notManifold, "surfaces are pinched in a point or use a corner twice" +
                             this->first(
                               [](const Fibre& f)
                               {
                                 return (f.hasOuter && f.outer.closed() && !f.outer.closedManifold()) ||
                                        (f.hasInner && f.inner.closed() && !f.inner.closedManifold());
                               }));
    fault(all.notOutward,
      "surfaces do not point outward" +
        this->first([](const Fibre& f) { return (f.hasOuter && !f.outer.outward()) || (f.hasInner && !f.inner.outward()); }));
    fault(all.selfIntersecting,
      "surfaces cut or touch themselves" +
        this->first([](const Fibre& f) { return f.outerSelfIntersections + f.innerSelfIntersections > 0; }));
    fault(all.selfNested, "surfaces have a piece inside another of their pieces" +
                            this->first([](const Fibre& f) { return f.outerSelfNested || f.innerSelfNested; }));
    fault(all.meetingPairs,
      "pairs of outer surfaces cut or touch each other" + this->first([](const Fibre& f) { return f.gap == 0.0; }));
    fault(all.nestedPairs,
      "pairs of fibres lie inside one another" + this->first([](const Fibre& f) { return f.meetingFibres > 0 && f.gap != 0.0; }));
    fault(all.leavingInner, "inner surfaces leave their outer ones" + this->first([](const Fibre& f) { return f.innerLeaves; }));
    fault(all.thinMyelin, "fibres have myelin thinner than the " + text(all.promisedGap) + " µm that it was made with" +
                            this->first([&all](const Fibre& f) { return f.myelinThickness < all.promisedGap; }));
    if (all.smallestGap < all.requiredGap && all.meetingPairs == 0)
    {
      all.faults.push_back("fibres " + std::to_string(all.gapFibreA) + " and " + std::to_string(all.gapFibreB) +
                           " come as near as " + text(all.smallestGap) + " µm, less than MinimumGap " + text(all.requiredGap) +
                           " µm");
    }
  }

  const Domain& Box;
  const FibreSurfaces& Outer;
  const FibreSurfaces& Inner;
  const Fibres* Lines;
  const SubstrateCertificateOptions& Options;
  const Context& Caller;
  Index OuterIndex;
  Index InnerIndex;
  Index LineIndex;
  std::vector<std::unique_ptr<TreedSurface>> Trees; ///< per fibre, of its outer surface
  std::vector<double> Reach;                        ///< per fibre, µm out of the domain
  SubstrateCertificate Result;
};

/// Columns over rows of anything.
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

const PropertyList<SubstrateCertificateOptions>& SubstrateCertificateOptions::properties()
{
  using Options = SubstrateCertificateOptions;
  static const auto list =
    PropertyList<Options>()
      .add("MinimumGap", &Options::minimumGap, limits::gap,
        "Distance that the outer surfaces of any two fibres have to keep; 0 asks only that they do not meet")
      .add("CutSpacing", &Options::cutSpacing, limits::cutSpacing, "Distance between two cross-sections along a fibre");
  return list;
}

void SubstrateCertificateOptions::validate() const
{
  validateProperties(*this);
}

std::string SubstrateCertificate::verdict() const
{
  std::string text = this->faults.empty() ? "certified" : "";
  for (const std::string& fault : this->faults)
  {
    text += (text.empty() ? "" : "; ") + fault;
  }
  return text;
}

SubstrateCertificate certify(const Domain& domain, const FibreSurfaces& outer, const FibreSurfaces& inner, const Fibres* fibres,
  const SubstrateCertificateOptions& options, const Context& context)
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
  return Certifier(domain, outer, inner, fibres, options, context).run();
}

std::vector<CertificateColumn> substrateColumns(const SubstrateCertificate& certificate)
{
  using All = SubstrateCertificate;
  const std::vector<const All*> row{ &certificate };
  Columns<const All*> columns(row);
  columns.count("Certified", [](const All* c) { return c->certified() ? 1 : 0; });
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
  const auto sound = [](const SurfaceReport& report) { return report.sound() ? 1 : 0; };
  columns.count("FibreId", [](const Fibre& f) { return f.fibreId; });
  columns.count("BundleId", [](const Fibre& f) { return f.bundleId; });
  columns.count("HasOuter", [](const Fibre& f) { return f.hasOuter ? 1 : 0; });
  columns.count("HasInner", [](const Fibre& f) { return f.hasInner ? 1 : 0; });
  columns.count("OuterSound", [&](const Fibre& f) { return sound(f.outer); });
  columns.count("InnerSound", [&](const Fibre& f) { return sound(f.inner); });
  columns.count("OuterSelfIntersections", [](const Fibre& f) { return f.outerSelfIntersections; });
  columns.count("InnerSelfIntersections", [](const Fibre& f) { return f.innerSelfIntersections; });
  columns.count("SelfNested", [](const Fibre& f) { return f.outerSelfNested || f.innerSelfNested ? 1 : 0; });
  columns.count("MeetingFibres", [](const Fibre& f) { return f.meetingFibres; });
  columns.count("InnerLeaves", [](const Fibre& f) { return f.innerLeaves ? 1 : 0; });
  columns.number("SmallestGap_um", [](const Fibre& f) { return f.gap; });
  columns.count("NearestFibre", [](const Fibre& f) { return f.nearestFibre; });
  columns.number("SmallestMyelin_um", [](const Fibre& f) { return f.myelinThickness; });
  columns.number("OuterRadius_um", [](const Fibre& f) { return f.outerRadius.mean; });
  columns.number("InnerRadius_um", [](const Fibre& f) { return f.innerRadius.mean; });
  columns.number("GRatio", [](const Fibre& f) { return f.gRatio; });
  columns.number("OuterVolume_um3", [](const Fibre& f) { return f.outer.volume; });
  columns.number("InnerVolume_um3", [](const Fibre& f) { return f.inner.volume; });
  columns.number("OuterArea_um2", [](const Fibre& f) { return f.outer.area; });
  columns.number("InnerArea_um2", [](const Fibre& f) { return f.inner.area; });
  columns.count("OuterTriangles", [](const Fibre& f) { return f.outer.triangles; });
  columns.count("InnerTriangles", [](const Fibre& f) { return f.inner.triangles; });
  const auto least = [](double a, double b) { return std::fmin(a, b); };
  const auto of = [](bool has, double value) { return has ? value : notANumber; };
  columns.number("SmallestFeature_um",
    [&](const Fibre& f) { return least(of(f.hasOuter, f.outer.smallestAltitude), of(f.hasInner, f.inner.smallestAltitude)); });
  columns.number("LargestSquaredEdgeRatio",
    [](const Fibre& f) { return std::fmax(f.outer.largestSquaredEdgeRatio, f.inner.largestSquaredEdgeRatio); });
  return columns.take();
}

} // namespace cactus
