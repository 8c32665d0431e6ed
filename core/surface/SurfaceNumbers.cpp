// SPDX-License-Identifier: BSD-3-Clause
#include "surface/SurfaceNumbers.h"

#include "base/Bytes.h"
#include "mesh/SurfaceReportNumbers.h"

namespace cactus
{

namespace
{

template <typename Change, typename Visit>
void visitChange(Change& change, Visit&& visit)
{
  visit(change.largestMove);
  visit(change.droppedVolume);
  visit(change.isHemmedIn);
}

/// Calls visit(number) for every number of a pair, which may be const.
template <typename Pair, typename Visit>
void visitPair(Pair& pair, Visit&& visit)
{
  visit(pair.fibreId);
  visit(pair.bundleId);
  visit(pair.targetRadius);
  visitNumbers(pair.outerReport, visit);
  visitNumbers(pair.innerReport, visit);
  visitChange(pair.outerChange, visit);
  visitChange(pair.innerChange, visit);
  visit(pair.state);
  visit(pair.volumeAsMade);
  visit(pair.outerLevel);
  visit(pair.thickness);
  visit(pair.ownGRatio);
  visit(pair.targetGRatio);
  visit(pair.nodes);
  visit(pair.internodeLength);
  visit(pair.wholeMyelin);
  visit(pair.gRatio);
  visit(pair.isWanted);
  visit(pair.isFlawed);
  visit(pair.isInnerMade);
}

} // namespace

std::string bytesOf(const FibreSurfacePair& pair)
{
  ByteWriter put;
  visitPair(pair, put);
  return put.bytes();
}

FibreSurfacePair pairFrom(const std::string& bytes)
{
  FibreSurfacePair pair;
  ByteReader get(bytes);
  visitPair(pair, get);
  return pair;
}

} // namespace cactus
