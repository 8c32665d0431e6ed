// SPDX-License-Identifier: BSD-3-Clause
#include "surface/FibreMesher.h"

#include "base/Constants.h"
#include "base/Error.h"
#include "mesh/OpenTile.h"
#include "mesh/SurfaceCheck.h"
#include "mesh/SurfaceDistance.h"
#include "mesh/SurfacePieces.h"
#include "surface/FibreExtent.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cactus
{

namespace
{

/// Relative volume error of the axons that another library's filters coarsen, and the number of attempts.
constexpr double filteredVolumeTolerance = 5e-3;
constexpr int filterRounds = 4;
/// The usual outward move of an outer surface that compensates smoothing, and the rest allowed before coarsening, as fractions of
/// the tolerance.
constexpr double usualPart = 0.5;
constexpr double restPart = 0.02;
/// Least distance between the planes of an inner and an outer surface's caps, in voxels.
constexpr double smallestInset = 0.05;
/// Room (µm) that growth has to leave between two fibres, so that contours, which differ slightly from the zeros of the fields,
/// stay apart.
constexpr double leastRoom = 0.01;
/// Relative change of an outer surface's volume, when it is kept apart from others, below which the inner one stays.
constexpr double negligibleChange = 2e-4;

/// Largest voxel, in parts of a node's or a paranode's length.
constexpr double voxelInNode = 0.5;
/// Largest voxel, in lengths of a swelling: depths along a fibre are smoothed over a few voxels.
constexpr double voxelInSwelling = 0.125;

/// Returns the least distance of the field from its level at a sample, µm.
double nudgeFor(double spacing, double tolerance)
{
  return std::min(0.02 * spacing, 0.2 * std::max(tolerance, 1e-3 * spacing));
}

/// Tells whether an outer surface has nearly the volume with which it was made.
bool hasVolumeAsMade(const FibreSurfacePair& pair)
{
  return std::abs(pair.outerReport.volume - pair.volumeAsMade) <= negligibleChange * pair.outerReport.volume;
}

/// Tells whether there is an inner surface that would lie in the same place within a slightly larger outer one.
bool hasFreeInner(const FibreSurfacePair& pair)
{
  return pair.state != MyelinState::NoFibre && pair.state != MyelinState::NoAxon && !pair.innerChange.isHemmedIn;
}

/// How far the caps of axons are inside the faces of the box. Rims are blunted in that layer alone, so that outer surfaces come
/// no nearer to inner ones.
double insetFor(double minimumGap, double spacing)
{
  return std::clamp(minimumGap, smallestInset * spacing, 0.25 * spacing);
}

/// Frees the spare capacity of a mesh: all fibres' meshes are in memory at the same time.
TriangleMesh packed(TriangleMesh&& mesh)
{
  mesh.points.shrink_to_fit();
  mesh.triangles.shrink_to_fit();
  return std::move(mesh);
}

} // namespace

FibreMesher::FibreMesher(const std::shared_ptr<const LabelSource>& image, const LabelImageFacts& facts,
  const MyelinSurfaceOptions& options, const SurfaceFilters* filters, const Context& context, const Sharing& sharing,
  const Recollection& known)
  : Facts(facts)
  , Options(options)
  , Filters(filters)
  , Field(image, facts.domain, options.clipToDomain)
  , Places(Field, facts, context, sharing)
  , Spacing(image->grid().spacing)
  , Contours(Field, insetFor(facts.minimumGap, Spacing), nudgeFor(Spacing, facts.surfaceTolerance), filters)
  , Finishing(options.decimationError, options.minimumAngle, Spacing, insetFor(facts.minimumGap, Spacing), Field.box(), filters)
  , Withdrawal(0.5 * std::max(0.0, leastRoom - image->gap()))
  , ThinnestMyelin(std::max({ facts.minimumGap, 4.0 * facts.surfaceTolerance, 1e-3 * Spacing, leastSeparation }))
  , Wall(wallOfMyelin(facts) + lostInFiles)
  , PromisedMyelin(std::max(facts.minimumGap, leastSeparation) + lostInFiles)
{
  if (this->Field.heldFaces() != 0 && (filters != nullptr || options.minimumAngle > 0.0))
  {
    throw InvalidInput(text("the Domain is periodic, and ", filters != nullptr ? "Meshing VTK filters" : "MinimumAngle",
      " would change the rims in its faces, which have to fit those of the opposite ones: ",
      filters != nullptr ? "leave Meshing at CACTUS" : "leave MinimumAngle at 0"));
  }
  if (this->followsLines())
  {
    this->findLines();
  }
  if (options.smoothingIterations > 0)
  {
    this->Thin.emplace(this->Field, this->Places.thinnerThan(ThinFibres::thickTarget * this->Spacing, context, sharing, known));
  }
}

bool FibreMesher::followsLines() const
{
  return this->Options.followsLines() || this->Facts.hasMyelinFractions();
}

void FibreMesher::findLines()
{
  require(this->Filters == nullptr,
    "Meshing VTK filters makes myelin of the same thickness along a fibre: leave MyelinFollowsAxon "
    "off, NodeLength and SwellingAmplitude at 0, and give the fibres no MyelinFraction, or choose Meshing CACTUS");
  require(this->Facts.centreLines != nullptr,
    "the centre lines of the fibres are not at hand, and MyelinFollowsAxon, "
    "NodeLength and SwellingAmplitude need them: give the label image directly from FibreRadialGrowth");
  requireKnownGRatio(*this->Facts.centreLines, this->Options);
  const double shortest = std::min(this->Options.nodeLength, this->Options.paranodeLength);
  if (this->Options.hasNodes() && this->Spacing > voxelInNode * shortest)
  {
    throw InvalidInput(text("voxels of ", this->Spacing, " µm cannot show nodes with a NodeLength of ", this->Options.nodeLength,
      " µm and a ParanodeLength of ", this->Options.paranodeLength, " µm: choose a VoxelSize of at most ", voxelInNode * shortest,
      " in FibreRadialGrowth, or longer ones"));
  }
  if (this->Options.swellingAmplitude > 0.0 && this->Spacing > voxelInSwelling * this->Options.swellingLength)
  {
    throw InvalidInput(text("voxels of ", this->Spacing, " µm cannot show swellings with a SwellingLength of ",
      this->Options.swellingLength, " µm: choose a VoxelSize of at most ", voxelInSwelling * this->Options.swellingLength,
      " in FibreRadialGrowth, or a longer one"));
  }
  this->InternodeLosses = internodeLosses(*this->Facts.centreLines, this->Options);
  const std::vector<int>& ids = this->Facts.centreLines->fibreIds;
  for (std::size_t f = 0; f < ids.size(); ++f)
  {
    this->Lines.emplace(ids[f], f);
  }
}

Eigen::AlignedBox3d FibreMesher::box() const
{
  return { this->Field.box().lower, this->Field.box().upper };
}

bool FibreMesher::movesContours() const
{
  return this->Filters == nullptr && this->Options.decimationError > 0.0;
}

SmoothedField FibreMesher::smoothed(std::int32_t fibreId) const
{
  const int passes = this->Options.smoothingIterations;
  return SmoothedField(this->Field, fibreId, blocksNear(this->Field, this->Places.find(fibreId), passes), passes,
    this->Thin ? &*this->Thin : nullptr);
}

std::unique_ptr<MyelinProfile> FibreMesher::profileOf(const SmoothedField& field, const FibreSurfacePair& pair) const
{
  if (!this->followsLines() || pair.isBare() || field.blocks().empty())
  {
    return nullptr;
  }
  const auto line = this->Lines.find(pair.fibreId);
  if (line == this->Lines.end())
  {
    throw InvalidInput(text("fibre ", pair.fibreId, " of the label image has no centre line among the fibres given with it"));
  }
  if (!this->Options.followsLines() && !lacksMyelin(*this->Facts.centreLines, line->second))
  {
    return nullptr;
  }
  auto profile = std::make_unique<MyelinProfile>(
    field, *this->Facts.centreLines, line->second, this->Options, this->InternodeLosses[line->second]);
  return this->Options.shapesAxons() || profile->lacksMyelin() ? std::move(profile) : nullptr;
}

void FibreMesher::takeMyelin(const SmoothedField& field, MyelinProfile& profile, FibreSurfacePair& pair,
  const std::function<double(double volume)>& gRatio) const
{
  const OuterContour outer = this->contourOuter(field, 0.0);
  pair.targetGRatio = gRatio(outer.volume);
  const double part = pair.targetGRatio * pair.targetGRatio;
  const SmoothedField even =
    this->Options.shapesAxons() ? profile.shaped(part, outer.right, this->ThinnestMyelin, this->Wall) : field;
  AxonContour axon;
  MyelinState state = MyelinState::NoAxon;
  if (outer.volume > 0.0)
  {
    const AxonLevels levels = this->axonLevels(even, part * outer.volume, profile.raised());
    const AxonSearch search(this->Contours, even, part * outer.volume, levels, this->Spacing, this->movesContours());
    state = levels.highest > levels.lowest ? search.find(nullptr, axon) : MyelinState::NoAxon;
  }
  if (state == MyelinState::NoAxon)
  {
    profile.forgetLack();
    return;
  }
  profile.takeMyelin(axon.level, this->Wall, pair.targetGRatio);
  pair.nodes = profile.nodeCount();
  pair.internodeLength = profile.internodeLength();
  pair.wholeMyelin = outer.volume - axon.volume;
}

FibreMesher::OuterContour FibreMesher::contourOuter(const SmoothedField& field, double deeper) const
{
  // Smoothing removes more from ridges than it fills in; the surface moves out until it has the fibre's original volume.
  const double furthest = this->Options.smoothingIterations > 0 ? this->Facts.surfaceTolerance : 0.0;
  const double highest = this->Withdrawal + deeper;
  OuterContour outer;
  outer.level = highest - usualPart * furthest;
  outer.surface = this->Contours.outerAt(field, outer.level, outer.dropped);
  if (outer.surface.mesh.triangles.empty())
  {
    return outer;
  }
  SurfaceMeasure now = measure(outer.surface);
  outer.volume = now.volume;
  outer.right = outer.level;
  if (furthest > 0.0 && now.freeArea > 0.0) // otherwise it consists of caps only
  {
    outer.volume = measure(this->Contours.unsmoothed(field)).volume - deeper * now.freeArea;
    outer.right = std::clamp(outer.level - (outer.volume - now.volume) / now.freeArea, highest - furthest, highest);
    // The move after coarsening does the rest.
    const double rest = restPart * furthest;
    if (!this->movesContours() || outer.surface.held != 0) // whose rims cannot be moved
    {
      if (std::abs(outer.right - outer.level) > rest)
      {
        outer.level = outer.right;
        outer.surface = this->Contours.outerAt(field, outer.level, outer.dropped);
        now = measure(outer.surface);
      }
      outer.right = outer.level;
    }
    const double there = now.volume + (outer.level - outer.right) * now.freeArea;
    outer.volume = std::clamp(outer.volume, there - rest * now.freeArea, there + rest * now.freeArea);
  }
  return outer;
}

void FibreMesher::makeOuter(
  const SmoothedField& field, FibreSurfacePair& pair, const std::vector<LocalErrorBound>& bounds, double deeper) const
{
  pair.outer = TriangleMesh(); // of an earlier attempt
  pair.outerReport = SurfaceReport();
  pair.outerChange = SurfaceChange();
  pair.state = MyelinState::NoFibre;
  OuterContour contour = this->contourOuter(field, deeper);
  pair.outerChange.droppedVolume = contour.dropped;
  if (contour.surface.mesh.triangles.empty())
  {
    return;
  }
  // A surface that is made again is one that did not bear to be moved, and will be moved again.
  const bool isMadeAgain = !bounds.empty() || deeper > 0.0;
  const bool isSound =
    this->Finishing.finish(field, { contour.level, contour.right, contour.volume, nullptr, bounds, !isMadeAgain },
      contour.surface, pair.outerReport, pair.outerChange);
  pair.isFlawed = pair.isFlawed || !isSound;
  pair.outer = packed(std::move(contour.surface.mesh));
  pair.outerLevel = contour.right;
  pair.state = pair.outer.triangles.empty() ? MyelinState::NoFibre : MyelinState::NoAxon;
}

std::vector<Eigen::Vector3d> FibreMesher::checkOuter(FibreSurfacePair& pair) const
{
  const Eigen::AlignedBox3d box = this->box();
  std::vector<std::uint8_t> faces = facesOf(pair.outer, box);
  CappedSurface surface{ std::move(pair.outer), std::move(faces), box, this->Field.heldFaces() };
  this->Finishing.finishMoved(surface);
  pair.outer = std::move(surface.mesh);
  pair.outerReport = keepSoundPieces(pair.outer, pair.outerChange.droppedVolume);
  if (pair.outer.triangles.empty())
  {
    pair.state = MyelinState::NoFibre;
    return {};
  }
  return placesThatMeet(pair.outer);
}

void FibreMesher::evenOuter(FibreSurfacePair& pair) const
{
  if (pair.outer.triangles.empty() || !pair.outerReport.closedManifold())
  {
    return;
  }
  const Eigen::AlignedBox3d box = this->box();
  CappedSurface surface{ pair.outer, facesOf(pair.outer, box), box, this->Field.heldFaces() };
  this->Finishing.even(surface);
  const SurfaceReport report = checkSurface(surface.mesh);
  if (report.sound() && placesThatMeet(surface.mesh).empty())
  {
    pair.outer = packed(std::move(surface.mesh));
    pair.outerReport = report;
  }
}

double FibreMesher::equivalentDiameter(const SmoothedField& field, double outerVolume) const
{
  return 2.0 * std::sqrt(std::max(0.0, outerVolume) / (pi * lengthOf(field, this->Spacing)));
}

/// Returns the levels from the thinnest myelin to the middle of the fibre; the latter is no more than the former if there is no
/// room for an axon.
AxonLevels FibreMesher::axonLevels(const SmoothedField& field, double volume, double raised) const
{
  AxonLevels levels;
  levels.lowest = this->ThinnestMyelin + raised;
  const SampledVolume sampled = this->Contours.innerVolumes(field, levels.lowest);
  levels.highest = sampled.deepest();
  levels.guess = sampled.levelOf(volume, levels.lowest, levels.highest);
  return levels;
}

void FibreMesher::forgetInner(FibreSurfacePair& pair)
{
  pair.inner = TriangleMesh();
  pair.innerReport = SurfaceReport();
  pair.innerChange = SurfaceChange();
  pair.gRatio = 0.0;
  pair.thickness = 0.0;
  pair.state = pair.state == MyelinState::NoFibre ? MyelinState::NoFibre : MyelinState::NoAxon;
  pair.isInnerMade = false;
}

void FibreMesher::makeInner(const SmoothedField& field, FibreSurfacePair& pair, MyelinProfile* profile) const
{
  if (pair.isBare())
  {
    forgetInner(pair);
    pair.inner = pair.outer;
    pair.innerReport = pair.outerReport;
    pair.gRatio = bareGRatio;
    pair.state = MyelinState::AsAsked;
    return;
  }
  if (profile != nullptr && profile->lacksMyelin())
  {
    this->makeInnerOfProfile(*profile, pair);
    return;
  }
  if (pair.outerReport.volume != pair.volumeAsMade && hasVolumeAsMade(pair))
  {
    this->makeInnerWithin(pair.volumeAsMade, field, pair, profile);
    if (hasFreeInner(pair))
    {
      return;
    }
  }
  this->makeInnerWithin(pair.outerReport.volume, field, pair, profile);
}

bool FibreMesher::keepsInner(FibreSurfacePair& pair) const
{
  if (!hasFreeInner(pair) || !hasVolumeAsMade(pair) || pair.isBare())
  {
    return false;
  }
  const TriangleTree wall(pair.outer, this->wallOf(pair.outer));
  if (!liesInside(pair.inner, pair.innerReport, TriangleTree(pair.outer)) || this->gapTo(wall, pair.inner).found())
  {
    return false;
  }
  pair.gRatio = std::sqrt(pair.innerReport.volume / pair.outerReport.volume);
  return true;
}

/// Makes the inner surface for an outer one as if that had `outerVolume` (µm³).
void FibreMesher::makeInnerWithin(
  double outerVolume, const SmoothedField& field, FibreSurfacePair& pair, MyelinProfile* profile) const
{
  forgetInner(pair);
  const double part = pair.targetGRatio * pair.targetGRatio;
  const double wanted = part * outerVolume;
  if (!(wanted > 0.0))
  {
    return; // an outer surface, made elsewhere, that encloses no volume
  }
  std::optional<SmoothedField> even;
  if (profile != nullptr && this->Options.shapesAxons())
  {
    even.emplace(profile->shaped(part, pair.outerLevel, this->ThinnestMyelin, this->Wall));
  }
  const SmoothedField& own = even ? *even : field;
  const AxonLevels levels = this->axonLevels(own, wanted, profile != nullptr ? profile->raised() : 0.0);
  if (levels.highest <= levels.lowest)
  {
    return;
  }
  const AxonSearch search(this->Contours, own, wanted, levels, this->Spacing, this->movesContours());
  AxonContour axon;
  const MyelinState state = search.find(nullptr, axon);
  this->finish(search, state, axon, pair);
}

/// Makes the inner surface of a profile after takeMyelin(): it has the volume of its contour.
void FibreMesher::makeInnerOfProfile(const MyelinProfile& profile, FibreSurfacePair& pair) const
{
  forgetInner(pair);
  AxonLevels levels{ this->ThinnestMyelin, this->Contours.innerVolumes(profile.inner(), profile.level()).deepest(),
    profile.level() };
  AxonContour axon =
    AxonSearch(this->Contours, profile.inner(), 0.0, levels, this->Spacing, this->movesContours()).at(profile.level(), nullptr);
  const AxonSearch search(this->Contours, profile.inner(), axon.volume, levels, this->Spacing, this->movesContours());
  const MyelinState state = search.find(nullptr, axon);
  this->finish(search, state, axon, pair);
}

void FibreMesher::finish(const AxonSearch& search, MyelinState state, AxonContour& axon, FibreSurfacePair& pair) const
{
  if (state != MyelinState::NoAxon)
  {
    this->Filters != nullptr ? this->finishByFilters(search, state, axon, pair) : this->finishInside(search, state, axon, pair);
  }
}

/// Coarsens an inner surface, and makes it again further in until it lies inside the outer one and far enough from its wall.
void FibreMesher::finishInside(const AxonSearch& search, MyelinState state, AxonContour& axon, FibreSurfacePair& pair) const
{
  const TriangleTree outer(pair.outer);
  const TriangleTree wall(pair.outer, this->wallOf(pair.outer));
  const TriangleTree* within = nullptr;
  bool isHemmedIn = false;
  double leastStep = 0.1 * this->ThinnestMyelin;
  double level = axon.level;
  while (state != MyelinState::NoAxon)
  {
    const double volume = state == MyelinState::AsAsked ? search.volume() : axon.volume;
    level = axon.area > 0.0 ? axon.level + (axon.volume - volume) / axon.area : axon.level;
    pair.innerChange = SurfaceChange();
    const bool isSound = this->Finishing.finish(
      search.field(), { axon.level, level, volume, &outer, {} }, axon.surface, pair.innerReport, pair.innerChange);
    const TriangleMesh& inner = axon.surface.mesh;
    const bool isInside = isSound && liesInside(inner, pair.innerReport, outer);
    isHemmedIn = isHemmedIn || pair.innerChange.isHemmedIn || !isInside;
    if (isSound && (inner.triangles.empty() || (within != nullptr && !isInside)))
    {
      state = MyelinState::NoAxon;
      break;
    }
    if (isSound && !isInside)
    {
      // The largest part of the axon lies in a minor part of the fibre, which was left out.
      within = &outer;
      state = search.find(within, axon);
      continue;
    }
    const SurfaceGap gap = isSound ? this->gapTo(wall, inner) : SurfaceGap();
    if (isSound && !gap.found())
    {
      break;
    }
    isHemmedIn = true;
    // The outer surface lies further in than its field, where voxels do not resolve a crease or a neighbour has pushed it.
    state = MyelinState::Thicker;
    const double step = isSound ? std::max(this->PromisedMyelin - gap.distance, leastStep) : this->ThinnestMyelin;
    leastStep = isSound ? 2.0 * leastStep : leastStep;
    axon = search.at(axon.level + step, within);
    if (axon.level > search.levels().highest || !axon.onePiece)
    {
      state = MyelinState::NoAxon;
    }
  }
  if (state == MyelinState::NoAxon)
  {
    forgetInner(pair);
    return;
  }
  pair.inner = packed(std::move(axon.surface.mesh));
  pair.innerChange.isHemmedIn = isHemmedIn;
  pair.thickness = level - pair.outerLevel;
  pair.state = state;
  pair.gRatio = std::sqrt(pair.innerReport.volume / pair.outerReport.volume);
}

/// Coarsens an inner surface by another library's filters. These change its volume, so it is made again at other levels until the
/// volume is right.
void FibreMesher::finishByFilters(const AxonSearch& search, MyelinState state, AxonContour& axon, FibreSurfacePair& pair) const
{
  const double wanted = state == MyelinState::AsAsked ? search.volume() : axon.volume;
  double error = 0.0;
  for (int round = 0; round < filterRounds; ++round)
  {
    if (round > 0)
    {
      const AxonContour next = search.at(std::max(axon.level + error / axon.area, this->ThinnestMyelin), nullptr);
      if (!next.onePiece)
      {
        break;
      }
      axon = next;
    }
    CappedSurface surface = axon.surface;
    pair.innerChange = SurfaceChange();
    this->Finishing.finish(
      search.field(), { axon.level, axon.level, wanted, nullptr, {} }, surface, pair.innerReport, pair.innerChange);
    pair.inner = packed(std::move(surface.mesh));
    error = pair.innerReport.volume - wanted;
    if (std::abs(error) <= axonVolumeTolerance * wanted)
    {
      break;
    }
  }
  pair.thickness = axon.level - pair.outerLevel;
  pair.gRatio = pair.outerReport.volume > 0.0 ? std::sqrt(std::max(0.0, pair.innerReport.volume) / pair.outerReport.volume) : 0.0;
  if (state == MyelinState::AsAsked && std::abs(error) > filteredVolumeTolerance * wanted)
  {
    state = pair.innerReport.volume < wanted ? MyelinState::Thicker : MyelinState::Thinner;
  }
  pair.state = pair.inner.triangles.empty() ? MyelinState::NoAxon : state;
}

/// Returns the gap between the wall of an outer surface and an inner one, also where the latter is extended to periodic faces, if
/// it is less than promised.
SurfaceGap FibreMesher::gapTo(const TriangleTree& wall, const TriangleMesh& inner) const
{
  SurfaceGap gap = smallestGap(TriangleTree(inner), wall, this->PromisedMyelin);
  if (!gap.found() && this->Field.heldFaces() != 0)
  {
    const TriangleMesh extended = withoutPeriodicCaps(inner, this->Field.box());
    gap = smallestGap(TriangleTree(extended), wall, this->PromisedMyelin);
  }
  return gap;
}

/// Returns the triangles of an outer surface that are no caps on the faces of the box.
std::vector<std::uint32_t> FibreMesher::wallOf(const TriangleMesh& outer) const
{
  const std::vector<std::uint8_t> faces = facesOf(outer, this->box());
  std::vector<std::uint32_t> wall;
  for (std::size_t i = 0; i < outer.triangles.size(); ++i)
  {
    const auto& t = outer.triangles[i];
    if ((faces[std::size_t(t[0])] & faces[std::size_t(t[1])] & faces[std::size_t(t[2])]) == 0)
    {
      wall.push_back(static_cast<std::uint32_t>(i));
    }
  }
  return wall;
}

} // namespace cactus
