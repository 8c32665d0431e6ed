// SPDX-License-Identifier: BSD-3-Clause
// Data that lie in an image's space (mm) rather than in the substrate's own (µm).
#pragma once

#include "base/Placement.h"

#include <optional>

class vtkDataObject;
class vtkImageData;

namespace cactus
{

/// The field data `Placement` of a data set, or of the first of its blocks that has it: the affine by which it came from the
/// substrate's own space. Nothing for data in that space. Throws InvalidInput for what is no placement.
std::optional<Placement> placementOf(vtkDataObject* data);
void setPlacement(vtkDataObject* data, const Placement& placement);
/// Takes away what an output in the substrate's own space has of a placed input, as VTK passes field data on.
void forgetPlacement(vtkDataObject* data);

/// Throws InvalidInput for data that are placed, where a stage works in the substrate's own space on data as large as images.
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
/// Throws InvalidInput where it does not.
void requirePlaceable(vtkDataObject* data);

/// Turns `output`, a shallow copy of data in the substrate's own space, into that of the image: points or, of an image, its grid;
/// arrays of three floating-point numbers, which are directions, are turned; Radius and TargetRadius become mm; colours of
/// fibres by their direction go by the image's axes. All other numbers stay as they are, and tables altogether. Throws
/// InvalidInput for data of another type and for such as are placed already.
void place(vtkDataObject* output, const Placement& placement);

} // namespace cactus
