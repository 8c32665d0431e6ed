// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fibres/Fibres.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace cactus
{

/// Fibres as a file holds them.
struct FibresOfFile
{
  Fibres fibres;
  std::vector<std::string> remarks; ///< what of the file was left out or assumed, in sentences
};

/// Gathers the inner and outer radii along one fibre after the other.
class GRatiosOfFile
{
public:
  /// Adds a place on the fibre; an inner radius of 0 is unknown.
  void add(double innerRadius, double outerRadius)
  {
    this->Inner += innerRadius * innerRadius;
    this->Outer += outerRadius * outerRadius;
  }

  /// Gives the last of the fibres its TargetGRatio, the root of inner over outer cross-sections, and begins the next fibre. A
  /// fibre whose radii are equal has no myelin.
  void give(Fibres& fibres)
  {
    const double gRatio = this->Outer > 0.0 ? std::min(std::sqrt(this->Inner / this->Outer), bareGRatio) : 0.0;
    if (targetGRatioColumn.range.holds(gRatio))
    {
      fibres.columns.set(targetGRatioColumn.name, fibres.size() - 1, gRatio);
    }
    this->Inner = this->Outer = 0.0;
  }

private:
  double Inner = 0.0;
  double Outer = 0.0;
};

} // namespace cactus
