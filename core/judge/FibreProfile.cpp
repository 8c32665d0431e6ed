// SPDX-License-Identifier: BSD-3-Clause
#include "judge/FibreProfile.h"

#include "base/Constants.h"
#include "base/Error.h"
#include "base/Limits.h"
#include "fibres/FibreShape.h"
#include "growth/VolumeInDomain.h"
#include "mesh/CrossSection.h"
#include "mesh/SurfaceWall.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

namespace cactus
{

namespace
{

/// µm. An outline nearer to the domain's boundary, or to a cap of its surface before that, counts as cut off; larger than the
/// rounding of single-precision coordinates.
constexpr double boundaryTolerance = 1e-3;

/// Returns the position (µm) at arc length `s` along a fibre's centre line, whose cumulative lengths are `arc`.
Eigen::Vector3d positionAt(const Fibres& fibres, std::size_t fibre, const std::vector<double>& arc, double s)
{
  const auto after = std::upper_bound(arc.begin() + 1, arc.end() - 1, s);
  const auto segment = static_cast<std::size_t>(after - arc.begin()) - 1;
  const double weight = std::clamp((s - arc[segment]) / (arc[segment + 1] - arc[segment]), 0.0, 1.0);
  const std::size_t first = fibres.offsets[fibre] + segment;
  return (1.0 - weight) * fibres.points[first] + weight * fibres.points[first + 1];
}

} // namespace

std::vector<FibrePlace> placesAlongFibre(const Fibres& fibres, std::size_t fibre, double spacing)
{
  const std::vector<double> arc = arcLengths(fibres, fibre);
  requireWithin("CutSpacing", spacing, limits::cutSpacing);
  if (!(arc.back() / spacing <= limits::cuts))
  {
    throw InvalidInput(text("CutSpacing ", spacing, " µm makes more than ", limits::cuts, " cross-sections of fibre ",
      fibres.fibreIds[fibre], ", whose centre line is ", arc.back(), " µm long: choose a larger CutSpacing"));
  }
  std::vector<FibrePlace> places;
  for (std::size_t number = 0; (static_cast<double>(number) + 0.5) * spacing < arc.back(); ++number)
  {
    const double s = (static_cast<double>(number) + 0.5) * spacing;
    const Eigen::Vector3d point = fibres.domain.inside(positionAt(fibres, fibre, arc, s));
    // The chord over one spacing, so that a kink between two short segments does not tilt the plane of a cut.
    const Eigen::Vector3d chord = positionAt(fibres, fibre, arc, std::min(s + 0.5 * spacing, arc.back())) -
                                  positionAt(fibres, fibre, arc, std::max(s - 0.5 * spacing, 0.0));
    if (fibres.domain.depth(point) > 0.0 && chord.norm() > 0.0)
    {
      places.push_back({ number, point, chord.normalized() });
    }
  }
  return places;
}

std::vector<FibreCut> cutsAlongFibre(const Fibres& fibres, std::size_t fibre, const TriangleMesh& surface, double spacing)
{
  const std::vector<FibrePlace> places = placesAlongFibre(fibres, fibre, spacing);
  const CrossSections sections(surface);
  const Domain whole = betweenCaps(surface, fibres.domain, largestInset);
  std::vector<FibreCut> cuts;
  for (const FibrePlace& place : places)
  {
    const auto outline = sections.outlineAround(place.point, place.direction, 3.0 * fibres.targetRadii[fibre]);
    const bool isWhole = std::all_of(
      outline.begin(), outline.end(), [&](const Eigen::Vector3d& corner) { return whole.depth(corner) > boundaryTolerance; });
    if (!outline.empty() && isWhole)
    {
      const double area = polygonArea(outline, place.direction);
      const double perimeter = polygonPerimeter(outline);
      cuts.push_back(
        { place.number, area, 4.0 * pi * area / (perimeter * perimeter), polygonAxisRatio(outline, place.direction) });
    }
  }
  return cuts;
}

double equivalentRadius(const FibreCut& cut)
{
  return std::sqrt(cut.area / pi);
}

RadiusAlongFibre radiusAlong(const std::vector<FibreCut>& cuts)
{
  RadiusAlongFibre result{ cuts.size(), notANumber, notANumber, notANumber, notANumber };
  if (cuts.empty())
  {
    return result;
  }
  const auto count = static_cast<double>(cuts.size());
  double sum = 0.0;
  double circularities = 0.0;
  double axisRatios = 0.0;
  for (const FibreCut& cut : cuts)
  {
    sum += equivalentRadius(cut);
    circularities += cut.circularity;
    axisRatios += cut.axisRatio;
  }
  result.mean = sum / count;
  result.circularity = circularities / count;
  result.axisRatio = axisRatios / count;
  double squares = 0.0;
  for (const FibreCut& cut : cuts)
  {
    const double radius = equivalentRadius(cut);
    squares += (radius - result.mean) * (radius - result.mean);
  }
  result.deviation = std::sqrt(squares / count);
  return result;
}

namespace
{

/// Appends a segment with points where it passes the planes of the domain's faces, so that the steps of volumeInDomain() end
/// there.
void addSegment(const Eigen::Vector3d& from, const Eigen::Vector3d& to, Fibres& tube)
{
  std::vector<double> parts;
  for (const Eigen::Vector3d& corner : { tube.domain.lower, tube.domain.upper })
  {
    for (Eigen::Index axis = 0; axis < 3; ++axis)
    {
      const double part = (corner[axis] - from[axis]) / (to[axis] - from[axis]);
      if (part > 0.001 && part < 0.999)
      {
        parts.push_back(part);
      }
    }
  }
  std::sort(parts.begin(), parts.end());
  parts.erase(std::unique(parts.begin(), parts.end(), [](double a, double b) { return b - a < 0.001; }), parts.end());
  parts.push_back(1.0);
  for (const double part : parts)
  {
    tube.addPoint((1.0 - part) * from + part * to, 1.0);
  }
}

} // namespace

double radiusOfVolume(const Fibres& fibres, std::size_t fibre, const TriangleMesh& surface, double volume)
{
  if (!(volume > 0.0))
  {
    return notANumber;
  }
  Fibres tube;
  tube.domain = betweenCaps(surface, fibres.domain, largestInset);
  for (const Eigen::Vector3d& point : surface.points) // an unclipped surface ends beyond a face
  {
    tube.domain.lower = tube.domain.lower.cwiseMin(point);
    tube.domain.upper = tube.domain.upper.cwiseMax(point);
  }
  tube.addFibre(1, 1, 1.0);
  tube.addPoint(fibres.points[fibres.offsets[fibre]], 1.0);
  for (std::size_t i = fibres.offsets[fibre] + 1; i < fibres.offsets[fibre + 1]; ++i)
  {
    addSegment(fibres.points[i - 1], fibres.points[i], tube);
  }
  constexpr int samples = 240; // a face may cut a straight fibre alike along its whole length
  double low = 0.0;
  double high = fibres.targetRadii[fibre];
  while (volumeInDomain(tube, 0, high, samples) < volume)
  {
    if (high > limits::radius.highest)
    {
      return notANumber; // a surface that does not belong to this centre line
    }
    low = high;
    high *= 2.0;
  }
  constexpr int halvings = 20;
  for (int i = 0; i < halvings; ++i)
  {
    const double middle = 0.5 * (low + high);
    (volumeInDomain(tube, 0, middle, samples) < volume ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

RadiusAlongFibre radiusAlongFibre(
  const Fibres& fibres, std::size_t fibre, const TriangleMesh& surface, const std::vector<FibreCut>& cuts, double volume)
{
  RadiusAlongFibre radius = radiusAlong(cuts);
  if (cuts.empty())
  {
    radius.mean = radiusOfVolume(fibres, fibre, surface, volume);
  }
  return radius;
}

void EffectiveRadius::add(double area, double count)
{
  const double square = area / pi;
  this->Squares += count * square;
  this->SixthPowers += count * square * square * square;
}

double EffectiveRadius::value() const
{
  return this->Squares > 0.0 ? std::sqrt(std::sqrt(this->SixthPowers / this->Squares)) : notANumber;
}

namespace
{

/// Sets the measures of beads.
void measureBeads(const std::vector<FibreCut>& cuts, double spacing, AxonShape& shape)
{
  constexpr double swollen = 1.1; // of the mean radius
  double mean = 0.0;
  for (const FibreCut& cut : cuts)
  {
    mean += equivalentRadius(cut) / static_cast<double>(cuts.size());
  }
  std::vector<const FibreCut*> beads; // the thickest cut of each
  bool isInside = false;
  for (const FibreCut& cut : cuts)
  {
    const bool isSwollen = equivalentRadius(cut) > swollen * mean;
    if (isSwollen && !isInside)
    {
      beads.push_back(&cut);
    }
    else if (isSwollen && cut.area > beads.back()->area)
    {
      beads.back() = &cut;
    }
    isInside = isSwollen;
  }
  double amplitudes = 0.0;
  for (const FibreCut* bead : beads)
  {
    amplitudes += equivalentRadius(*bead) / mean - 1.0;
  }
  const auto count = static_cast<double>(beads.size());
  shape.beadAmplitude = beads.empty() ? notANumber : amplitudes / count;
  shape.beadSpacing =
    beads.size() < 2 ? notANumber : spacing * static_cast<double>(beads.back()->number - beads.front()->number) / (count - 1.0);
}

} // namespace

AxonShape axonShape(const std::vector<FibreCut>& cuts, double spacing)
{
  AxonShape shape{ notANumber, notANumber, notANumber, notANumber, notANumber, notANumber, notANumber };
  if (cuts.empty())
  {
    return shape;
  }
  const auto count = static_cast<double>(cuts.size());
  double area = 0.0;
  double inverse = 0.0;
  EffectiveRadius effective;
  for (const FibreCut& cut : cuts)
  {
    area += cut.area / count;
    inverse += 1.0 / cut.area / count;
    effective.add(cut.area);
  }
  double variance = 0.0;
  std::complex<double> wave = 0.0;
  const double phase = 2.0 * pi / static_cast<double>(cuts.back().number - cuts.front().number + 1);
  for (const FibreCut& cut : cuts)
  {
    const double excess = cut.area / area - 1.0;
    variance += excess * excess / count;
    wave += excess * std::polar(1.0, -phase * static_cast<double>(cut.number - cuts.front().number));
  }
  shape.meanInverseArea = inverse;
  shape.areaVariance = variance;
  shape.areaFluctuation = cuts.size() >= 3 ? std::norm(wave) * spacing / count : notANumber;
  shape.diffusivityRatio = 1.0 / (area * inverse);
  shape.effectiveRadius = effective.value();
  measureBeads(cuts, spacing, shape);
  return shape;
}

CentreLineShape centreLineShape(const Fibres& fibres, std::size_t fibre)
{
  const std::vector<double> arc = arcLengths(fibres, fibre);
  double entered = notANumber;
  double left = notANumber;
  const Domain domain = fibres.domain.unrolled();
  for (std::size_t segment = 0; segment + 1 < arc.size(); ++segment)
  {
    const std::size_t first = fibres.offsets[fibre] + segment;
    const auto [from, to] = domain.clip(fibres.points[first], fibres.points[first + 1]);
    if (to > from)
    {
      const double length = arc[segment + 1] - arc[segment];
      entered = std::isnan(entered) ? arc[segment] + from * length : entered;
      left = arc[segment] + to * length;
    }
  }
  CentreLineShape shape{ notANumber, notANumber };
  if (!(left > entered))
  {
    return shape;
  }
  const Eigen::Vector3d start = positionAt(fibres, fibre, arc, entered);
  const Eigen::Vector3d chord = positionAt(fibres, fibre, arc, left) - start;
  if (!(chord.norm() > 0.0))
  {
    return shape;
  }
  shape.sinuosity = std::max(1.0, (left - entered) / chord.norm());
  const Eigen::Vector3d direction = chord.normalized();
  const auto offsetAt = [&](double s) -> Eigen::Vector3d
  {
    const Eigen::Vector3d way = positionAt(fibres, fibre, arc, s) - start;
    return way - way.dot(direction) * direction;
  };
  // Offsets a to b along a piece have a mean square of (a² + ab + b²)/3.
  double squares = 0.0;
  for (std::size_t segment = 0; segment + 1 < arc.size(); ++segment)
  {
    const double from = std::max(entered, arc[segment]);
    const double to = std::min(left, arc[segment + 1]);
    if (to > from)
    {
      const Eigen::Vector3d a = offsetAt(from);
      const Eigen::Vector3d b = offsetAt(to);
      squares += (to - from) * (a.squaredNorm() + a.dot(b) + b.squaredNorm()) / 3.0;
    }
  }
  shape.undulation = std::sqrt(squares / (left - entered));
  return shape;
}

double meanSinuosity(const Fibres& fibres)
{
  double sum = 0.0;
  double length = 0.0;
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    const double sinuosity = centreLineShape(fibres, f).sinuosity;
    if (std::isfinite(sinuosity))
    {
      const double own = lengthInDomain(fibres, f);
      sum += own * sinuosity;
      length += own;
    }
  }
  return length > 0.0 ? sum / length : std::numeric_limits<double>::quiet_NaN();
}

} // namespace cactus
