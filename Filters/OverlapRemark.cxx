// SPDX-License-Identifier: BSD-3-Clause
#include "OverlapRemark.h"

#include "InputBlocks.h"
#include "base/Error.h"
#include "optimiser/OverlapReport.h"

#include <vtkDataArray.h>
#include <vtkDataObject.h>
#include <vtkFieldData.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace cactus
{

namespace
{

/// Well above what the optimiser leaves (OverlapTolerance, 0.001), and above the digits of a file.
constexpr double harmlessPenetration = 0.01;

/// What the optimiser has said in each part of the input: Converged, 1 or 0.
std::vector<bool> verdictsOfOptimiser(const std::vector<vtkDataObject*>& parts)
{
  std::vector<bool> verdicts;
  for (vtkDataObject* part : parts)
  {
    vtkDataArray* converged = part->GetFieldData()->GetArray("Converged");
    if (converged != nullptr && converged->GetNumberOfTuples() > 0)
    {
      verdicts.push_back(converged->GetComponent(0, 0) != 0.0);
    }
  }
  return verdicts;
}

} // namespace

std::string remarkOnOverlaps(vtkDataObject* input, const Fibres& fibres, int threads)
{
  std::vector<vtkDataObject*> parts = leavesOf(input);
  const bool isOne = parts.size() <= 1;
  parts.push_back(input);
  const std::vector<bool> verdicts = verdictsOfOptimiser(parts);
  if (std::find(verdicts.begin(), verdicts.end(), false) != verdicts.end())
  {
    return "these fibres still overlap (Converged is 0) and take space from each other: let CapsuleOptimizer run on or, where it "
           "keeps its history, go to the last time step";
  }
  // Several that were parted each for itself may overlap each other.
  if (!verdicts.empty() && isOne)
  {
    return {};
  }
  const OverlapReport report = measureOverlap(fibres, harmlessPenetration, threads);
  if (report.overlappingPairs == 0)
  {
    return {};
  }
  return text(report.overlappingPairs, " pairs of capsules of different fibres overlap, the worst by ",
    std::lround(100.0 * report.largestPenetration),
    " % of their radii, and take space from each other: the optimiser has not parted these fibres. Apply CapsuleOptimizer first, "
    "and grow what it gives");
}

} // namespace cactus
