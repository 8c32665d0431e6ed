// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/NodeLattice.h"
#include "surface/SmoothedField.h"

#include <vector>

namespace cactus
{

/// The volume that contours of a fibre's field hold, from the samples inside the fibre: a sum of the boxes around them, each by
/// how far its sample lies above the level. That costs far less than a contour, and is as near to its volume as a shift of the
/// level by a hundredth of a voxel or two. Near the fibre's own surface, where the field outside counts, it is not.
class SampledVolume
{
public:
  /// For levels from `lowest` (µm) on. The boxes fill `lattice`, one of those of FibreField.
  SampledVolume(const SmoothedField& field, const NodeLattice& lattice, double lowest);

  /// µm³, at a level in µm.
  double at(double level) const { return this->measureAt(level).volume; }
  /// The level between `lower` and `upper` (µm) whose contour holds a volume (µm³), or the nearest of both.
  double levelOf(double volume, double lower, double upper) const;
  /// The largest value of the field at a sample, or `lowest` if that is larger, µm.
  double deepest() const { return this->Deepest; }

private:
  struct Measure
  {
    double volume = 0.0;
    double area = 0.0; ///< by which it falls where the level rises, µm²
  };
  Measure measureAt(double level) const;

  double Spacing; ///< µm
  double Deepest;
  double Inside = 0.0;        ///< µm³, of the samples inside the fibre
  std::vector<float> Depths;  ///< µm, of samples that count at some level, and of others without a box
  std::vector<float> Volumes; ///< of their boxes, µm³
};

} // namespace cactus
