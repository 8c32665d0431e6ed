// SPDX-License-Identifier: BSD-3-Clause
#include "judge/FindingsNumbers.h"

#include "base/Bytes.h"
#include "mesh/SurfaceReportNumbers.h"

namespace cactus
{

namespace
{

template <typename Radius, typename Visit>
void visitRadius(Radius& radius, Visit&& visit)
{
  visit(radius.cuts);
  visit(radius.mean);
  visit(radius.deviation);
  visit(radius.circularity);
  visit(radius.axisRatio);
}

/// Calls visit(number) for every number of a fibre, which may be const.
template <typename Fibre, typename Visit>
void visitFindings(Fibre& fibre, Visit&& visit)
{
  visit(fibre.fibreId);
  visit(fibre.bundleId);
  visit(fibre.hasOuter);
  visit(fibre.hasInner);
  visit(fibre.isBare);
  visitNumbers(fibre.outer, visit);
  visitNumbers(fibre.inner, visit);
  visit(fibre.outerSelfIntersections);
  visit(fibre.innerSelfIntersections);
  visit(fibre.outerSelfNested);
  visit(fibre.innerSelfNested);
  visit(fibre.meetingFibres);
  visit(fibre.innerLeaves);
  visit(fibre.gap);
  visit(fibre.nearestFibre);
  visit(fibre.myelinThickness);
  visit(fibre.length);
  visitRadius(fibre.outerRadius, visit);
  visitRadius(fibre.innerRadius, visit);
  visit(fibre.gRatio);
}

template <typename Box, typename Visit>
void visitBox(Box& box, Visit&& visit)
{
  for (Eigen::Index i = 0; i < 4; ++i)
  {
    visit(box.lower[i]);
    visit(box.upper[i]);
  }
}

} // namespace

std::string bytesOf(const FibreCertificate& fibre, double reach, const std::vector<FloatBox>& branches)
{
  ByteWriter put;
  visitFindings(fibre, put);
  put(reach);
  for (const FloatBox& box : branches)
  {
    visitBox(box, put);
  }
  return put.bytes();
}

void getFindings(const std::string& bytes, FibreCertificate& fibre, double& reach, std::vector<FloatBox>& branches)
{
  ByteReader get(bytes);
  visitFindings(fibre, get);
  get(reach);
  for (branches.clear(); !get.isAtEnd();)
  {
    visitBox(branches.emplace_back(), get);
  }
}

} // namespace cactus
