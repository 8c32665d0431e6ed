// SPDX-License-Identifier: BSD-3-Clause
// Reads the label image of vtkFibreRadialGrowth.
#pragma once

#include "surface/MyelinSurface.h"

class vtkDataObject;
class vtkImageData;

namespace cactus
{

/// A label image: a view of VTK's arrays, and the facts in its field data.
struct LabelImageInput
{
  vtkImageData* image = nullptr;
  LabelImageView view;
  LabelImageFacts facts;
};

/// Returns the input as a non-empty image. Throws InvalidInput for anything else.
vtkImageData* requireImage(vtkDataObject* input);

/// Reads a label image. Throws InvalidInput, naming the array, if vtkFibreRadialGrowth cannot have made it.
LabelImageInput labelImageFrom(vtkDataObject* input);

} // namespace cactus
