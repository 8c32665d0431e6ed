// SPDX-License-Identifier: BSD-3-Clause
// Data that lie in an image's space (mm) rather than in the substrate's own (µm).
#pragma once

#include "base/Placement.h"

#include <optional>

class vtkDataObject;
class vtkImageData;

namespace cactus
{

/// Returns the field data `Placement` of a data set, or of the first of its blocks that has it: the affine from the substrate's
/// space. Nothing for data in that space. Throws InvalidInput for an invalid placement.
std::optional<Placement> placementOf(vtkDataObject* data);
void setPlacement(vtkDataObject* data, const Placement& placement);
/// Removes the placement from an output in the substrate's space: VTK passes the field data of a placed input on.
void forgetPlacement(vtkDataObject* data);

/// Throws InvalidInput for placed data, if a stage works in the substrate's space on data as large as images.
void requireNotPlaced(vtkDataObject* data);

/// Throws InvalidInput for data that are placed, in mm, where a file is to have another unit.
void requireFileUnit(LengthUnit unit, bool isPlaced);
/// What is to be known of a file, named before it, with lengths in micrometres.
constexpr const char* micrometresInFile =
  " has its lengths in micrometres, and most readers take them for millimetres: set LengthUnit to Millimetre for these";

/// Turns the grid of an image, and nothing else, into that of the space where it is placed.
void placeGrid(vtkImageData* image, const Placement& placement);

/// Whether place() takes data of this type: what has points, images and tables.
bool isPlaceable(vtkDataObject* data);
/// Throws InvalidInput if it does not.
void requirePlaceable(vtkDataObject* data);

/// Moves `output`, a shallow copy of data in the substrate's space, into that of the image: points or an image's grid; arrays of
/// directions are rotated; Radius and TargetRadius become mm; colours of fibres by their
/// direction follow the image's axes. All other numbers stay, and tables do not change. Throws InvalidInput for data of another
/// type and for placed data.
void place(vtkDataObject* output, const Placement& placement);

} // namespace cactus
