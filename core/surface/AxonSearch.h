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

/// Levels of the field, in µm, that bound the search for an axon.
struct AxonLevels
{
  double lowest = 0.0; ///< level of the thinnest allowed myelin
  double highest = 0.0;
  double guess = 0.0;
};

/// Finds the level at which the contour of a fibre's field has the volume of the axon.
class AxonSearch
{
public:
  /// `volume` is in µm³, `spacing` that of the voxels. A contour that will be coarsened (`isCoarsened`) is moved to its volume
  /// then, so a slightly larger error is allowed now. All arguments passed by reference have to outlive the object.
  AxonSearch(const FibreContours& contours, const SmoothedField& field, double volume, const AxonLevels& levels, double spacing,
    bool isCoarsened);

  double volume() const { return this->Volume; }
  const AxonLevels& levels() const { return this->Levels; }
  const SmoothedField& field() const { return this->Field; }

  /// Returns the axon at a level, or its pieces that begin inside `within`, if given.
  AxonContour at(double level, const TriangleTree* within) const;

  /// Finds the axon of the volume, or the nearest one in one piece; returns which of these `found` is, or NoAxon.
  MyelinState find(const TriangleTree* within, AxonContour& found) const;

private:
  const FibreContours& Contours;
  const SmoothedField& Field;
  double Volume;
  AxonLevels Levels;
  double Spacing;
  double Slack; ///< µm; largest distance of a contour from the one of the right volume
};

/// Largest relative error of an inner volume.
constexpr double axonVolumeTolerance = 1e-3;

} // namespace cactus
