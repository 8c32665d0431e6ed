// SPDX-License-Identifier: BSD-3-Clause
#include "surface/AxonSearch.h"

#include <algorithm>
#include <cmath>

namespace cactus
{

namespace
{

/// Largest volume of an axon's minor pieces that may be left out, relative to its main one.
constexpr double negligiblePart = 1e-3;
constexpr int mostSteps = 40;
/// Levels closer than this fraction of a voxel count as equal.
constexpr double levelTolerance = 1e-3;
/// Largest distance of an inner surface from the right volume before coarsening, as a fraction of a voxel.
constexpr double nearEnough = 0.02;

} // namespace

AxonSearch::AxonSearch(const FibreContours& contours, const SmoothedField& field, double volume, const AxonLevels& levels,
  double spacing, bool isCoarsened)
  : Contours(contours)
  , Field(field)
  , Volume(volume)
  , Levels(levels)
  , Spacing(spacing)
  , Slack(isCoarsened ? nearEnough * spacing : 0.0)
{
}

AxonContour AxonSearch::at(double level, const TriangleTree* within) const
{
  AxonContour axon;
  axon.level = level;
  double dropped = 0.0;
  axon.surface = this->Contours.innerAt(this->Field, level, within, dropped);
  const SurfaceMeasure measured = measure(axon.surface);
  axon.volume = measured.volume;
  axon.area = measured.freeArea;
  axon.onePiece = axon.volume > 0.0 && dropped <= negligiblePart * axon.volume;
  return axon;
}

MyelinState AxonSearch::find(const TriangleTree* within, AxonContour& found) const
{
  double lower = this->Levels.lowest;  // here the axon is too large, or as large as allowed
  double upper = this->Levels.highest; // here it is too small, or in pieces
  double level = std::clamp(this->Levels.guess, lower, upper);
  bool isBroken = false;
  bool isFound = false;
  MyelinState state = MyelinState::AsAsked;
  // Newton's method, since the volume falls by the area of the surface as the level rises; else bisection.
  for (int step = 0; step < mostSteps; ++step)
  {
    const AxonContour axon = this->at(level, within);
    const double error = axon.volume - this->Volume;
    if (!axon.onePiece)
    {
      isBroken = true;
      upper = level;
    }
    else
    {
      // The thickest myelin with an axon in one piece so far.
      (error > 0.0 ? lower : upper) = level;
      found = axon;
      isFound = true;
      if (std::abs(error) <= std::max(axonVolumeTolerance * this->Volume, this->Slack * axon.area))
      {
        return MyelinState::AsAsked;
      }
      if (error < 0.0 && level <= this->Levels.lowest)
      {
        return MyelinState::Thicker;
      }
    }
    if (upper - lower < levelTolerance * this->Spacing)
    {
      // Bracketed between a level with too thin myelin and one at which the axon breaks.
      if (!isFound && lower <= this->Levels.lowest)
      {
        found = this->at(lower, within);
        isFound = found.onePiece;
      }
      state = isBroken ? MyelinState::Thinner : MyelinState::AsAsked;
      break;
    }
    const double newton = axon.onePiece && axon.area > 0.0 ? level + error / axon.area : level;
    level = newton > lower && newton < upper ? newton : 0.5 * (lower + upper);
    if (newton <= lower && axon.onePiece && error < 0.0)
    {
      level = lower;
    }
  }
  return isFound ? state : MyelinState::NoAxon;
}

} // namespace cactus
