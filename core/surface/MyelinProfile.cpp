// SPDX-License-Identifier: BSD-3-Clause
#include "surface/MyelinProfile.h"

#include "base/RandomVariates.h"
#include "bundle/Beads.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace cactus
{

MyelinProfile::MyelinProfile(
  const SmoothedField& field, const Fibres& fibres, std::size_t fibre, const MyelinSurfaceOptions& options, double internodeLoss)
  : Field(field)
  , Options(options)
  , FibreId(fibres.fibreIds[fibre])
  , Line(fibres, fibre)
  , Depths(field, this->Line)
{
  if (options.hasNodes())
  {
    this->Nodes.emplace(options, this->FibreId, 2.0 * fibres.targetRadii[fibre], internodeLoss, this->Line.period());
    if (!this->Nodes->reachInto(this->Depths.first(), this->Depths.last()))
    {
      this->Nodes.reset();
    }
  }
  this->Lacks = this->Nodes.has_value() || this->Line.lacksMyelin(this->Depths.first(), this->Depths.last());
}

SmoothedField MyelinProfile::shaped(double part, double outer, double thinnest, double wall)
{
  AlongLine depth;
  if (this->Options.myelinFollowsAxon)
  {
    depth = this->Depths.depthOfPart(part, outer);
  }
  else
  {
    depth = [level = this->Depths.levelOfPart(part, outer)](double) { return level; };
  }
  depth = this->Options.swellingAmplitude > 0.0 ? this->swollen(depth, wall) : depth;
  const auto atLeast = [depth, thinnest](double along) { return std::max(depth(along), thinnest); };
  const double mean = this->Depths.mean(atLeast);
  this->Raised = this->Options.swellingAmplitude > 0.0 ? mean - this->Depths.least(atLeast) : 0.0;
  this->Deeper = [atLeast, mean](double along) { return atLeast(along) - mean; };
  return this->Depths.lowered(this->Deeper);
}

/// Returns the depth of the axon with swellings, of the same volume as the one at `depth`.
AlongLine MyelinProfile::swollen(const AlongLine& depth, double shallowest) const
{
  BeadShape shape = this->Options.swellings();
  const double period = this->Line.period();
  if (period > 0.0)
  {
    // A whole number fits a period, on average as many as in other fibres.
    RandomEngine engine =
      randomStream(this->Options.seed, RandomStage::SwellingCount, std::uint64_t(std::uint32_t(this->FibreId)));
    const double most = std::floor(period / shape.leastSpacing(this->Options.swellingAmplitude));
    const double count = std::min(most, std::floor(period / shape.spacing + uniformFromZero(engine)));
    if (count == 0.0)
    {
      return depth;
    }
    shape.spacingDeviation *= period / count / shape.spacing;
    shape.spacing = period / count;
  }
  const double height = shape.heightOf(this->Options.swellingAmplitude);
  const double half = 0.5 * (period > 0.0 ? period : this->Line.length());
  const Beads beads(shape, this->Options.seed, this->FibreId, half, period > 0.0, RandomStage::Swellings);
  const auto relativeArea = [&](double along)
  {
    const double radius = 1.0 + height * beads.at(along - half);
    return radius * radius;
  };
  return this->Depths.redistributed(depth, relativeArea, shallowest);
}

int MyelinProfile::nodeCount() const
{
  int count = 0;
  if (this->Nodes)
  {
    for (const double middle : this->Nodes->between(this->Depths.first(), this->Depths.last()))
    {
      const Eigen::Vector3d point = this->Line.point(middle);
      bool isInside = true;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        const std::vector<double>& planes = this->Field.lattice().planes[axis];
        const double at = point[Eigen::Index(axis)];
        const bool isAcross = this->Field.repeats(axis) && axis < 2; // the line goes on beyond these faces
        isInside = isInside && (isAcross || (at >= planes.front() && at < planes.back()));
      }
      count += isInside ? 1 : 0;
    }
  }
  return count;
}

double MyelinProfile::internodeLength() const
{
  return this->nodeCount() > 0 ? this->Nodes->spacing() - this->Options.nodeLength : 0.0;
}

void MyelinProfile::takeMyelin(double level, double wall, double gRatio)
{
  this->Level = level;
  const AlongLine whole = [this, level](double along) { return level + (this->Deeper ? this->Deeper(along) : 0.0); };
  const AlongLine inNodes = [this](double along) { return this->Nodes ? this->Nodes->myelinPart(along) : 1.0; };
  const double area = this->Options.nodeConstriction * this->Options.nodeConstriction;
  const AlongLine constricted = this->Nodes && area < 1.0 ? this->Depths.depthOfPartBelow(area, whole) : whole;
  const AlongLine axon = [&](double along)
  {
    const double bare = 1.0 - inNodes(along);
    return bare > 0.0 ? whole(along) + bare * (constricted(along) - whole(along)) : whole(along);
  };
  this->Inner = this->Depths.lowered([&](double along) { return axon(along) - level; });
  // Myelin that came back is as thick as its g-ratio makes it, and no thicker than it was.
  const double thinner = std::min(1.0, gRatio * (1.0 / this->Options.remyelinatedGRatio - 1.0) / (1.0 - gRatio));
  const auto afterLoss = [&](double along, double room)
  {
    switch (this->Nodes ? this->Nodes->internodeAt(along) : Internode::Whole)
    {
    case Internode::Whole:
      return 1.0;
    case Internode::Remyelinated:
      return std::max(0.0, (thinner * (room + wall) - wall) / room);
    default:
      return 0.0;
    }
  };
  this->Outer = this->Depths.lowered(
    [&](double along)
    {
      const double room = axon(along) - wall; // between the wall and the whole fibre's surface
      const double left = inNodes(along) * this->Line.myelinAt(along);
      return room > 0.0 ? (1.0 - left * afterLoss(along, room)) * room : 0.0;
    });
}

} // namespace cactus
