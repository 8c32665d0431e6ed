// SPDX-License-Identifier: BSD-3-Clause
#include "OverlapRemark.h"

#include "DataProvenance.h"
#include "InputBlocks.h"
#include "stages/StageWork.h"

#include <vtkDataArray.h>
#include <vtkDataObject.h>
#include <vtkFieldData.h>

#include <algorithm>
#include <vector>

namespace cactus
{

namespace
{

/// Returns the optimiser's field data Converged, 1 or 0, of each part of the input. Parts changed since do not count.
std::vector<bool> verdictsOfOptimiser(const std::vector<vtkDataObject*>& parts)
{
  std::vector<bool> verdicts;
  for (vtkDataObject* part : parts)
  {
    vtkDataArray* converged = part->GetFieldData()->GetArray("Converged");
    if (converged != nullptr && converged->GetNumberOfTuples() > 0 && areAsMade(part))
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
  // Several inputs that were optimised separately may overlap each other.
  if (!verdicts.empty() && isOne)
  {
    return {};
  }
  return remarkOnOverlaps(fibres, threads);
}

} // namespace cactus
