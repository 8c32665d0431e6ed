// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/NodeLattice.h"
#include "surface/SmoothedField.h"

#include <vector>

namespace cactus
{

/// The volume inside contours of a fibre's field, from the samples inside the fibre: a sum of the boxes around them, each
/// weighted by how far its sample lies above the level. This costs far less than a contour, and its error corresponds to a shift
/// of the level by a hundredth of a voxel or two. It is less accurate near the fibre's own surface, where the field outside
/// counts.
class SampledVolume
{
public:
  /// For levels from `lowest` (µm) on. The boxes fill `lattice`, one of those of FibreField.
  SampledVolume(const SmoothedField& field, const NodeLattice& lattice, double lowest);

  /// Returns the volume (µm³) at a level (µm).
  double at(double level) const { return this->measureAt(level).volume; }
  /// Returns the level between `lower` and `upper` (µm) whose contour encloses a volume (µm³), or the nearer of both.
  double levelOf(double volume, double lower, double upper) const;
  /// Returns the largest value of the field at a sample, or `lowest` if that is larger, µm.
  double deepest() const { return this->Deepest; }

private:
  struct Measure
  {
    double volume = 0.0;
    double area = 0.0; ///< decrease of the volume per rise of the level, µm²
  };
  Measure measureAt(double level) const;

  double Spacing; ///< µm
  double Deepest;
  double Inside = 0.0;        ///< µm³, of the samples inside the fibre
  std::vector<float> Depths;  ///< µm, of samples that count at some level, and of others without a box
  std::vector<float> Volumes; ///< volumes of their boxes, µm³
};

} // namespace cactus
