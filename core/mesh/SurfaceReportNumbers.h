// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/SurfaceCheck.h"

namespace cactus
{

/// Calls visit(number) for every number of a report, which may be const, and visit(pieces).
template <typename Report, typename Visit>
void visitNumbers(Report& report, Visit&& visit)
{
  visit(report.triangles);
  visit(report.points);
  visit(report.components);
  visit(report.openEdges);
  visit(report.crowdedEdges);
  visit(report.flippedEdges);
  visit(report.pinchedPoints);
  visit(report.degenerateTriangles);
  visit(report.repeatedCorners);
  visit(report.inwardComponents);
  visit(report.volume);
  visit(report.area);
  visit(report.smallestAngle);
  visit(report.largestSquaredEdgeRatio);
  visit(report.smallestAltitude);
  visit(report.largestAspect);
  visit(report.largestNormalAngle);
  visit(report.pieces);
}

} // namespace cactus
