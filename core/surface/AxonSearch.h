// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/TriangleTree.h"
#include "surface/FibreContours.h"
#include "surface/FibreSurfacePair.h"

namespace cactus
{

/// An inner surface before coarsening.
struct AxonContour
{
  CappedSurface surface;
  double level = 0.0;
  double volume = 0.0; ///< µm³
  double area = 0.0;   ///< µm², without caps
  bool onePiece = false;
};

/// Levels of the field, in µm, between which an axon is looked for.
struct AxonLevels
{
  double lowest = 0.0; ///< that the thinnest myelin allows
  double highest = 0.0;
  double guess = 0.0;
};

/// Looks for the level at which the contour of a fibre's field has the volume of the axon.
class AxonSearch
{
public:
  /// `volume` is in µm³, `spacing` that of the voxels. What is coarsened afterwards (`isCoarsened`) is moved to its volume then,
  /// and may be off by a little more. What is given by reference has to outlive the object.
  AxonSearch(const FibreContours& contours, const SmoothedField& field, double volume, const AxonLevels& levels, double spacing,
    bool isCoarsened);

  double volume() const { return this->Volume; }
  const AxonLevels& levels() const { return this->Levels; }
  const SmoothedField& field() const { return this->Field; }

  /// The axon at a level, or what of it begins inside `within`, where given.
  AxonContour at(double level, const TriangleTree* within) const;

  /// The axon of the volume, or what comes nearest to it in one piece; says which of these `found` is, or that there is none
  /// (NoAxon).
  MyelinState find(const TriangleTree* within, AxonContour& found) const;

private:
  const FibreContours& Contours;
  const SmoothedField& Field;
  double Volume;
  AxonLevels Levels;
  double Spacing;
  double Slack; ///< µm that a contour may lie beside the one of the right volume
};

/// Relative error of an inner volume that is good enough.
constexpr double axonVolumeTolerance = 1e-3;

} // namespace cactus
