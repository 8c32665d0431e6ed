// SPDX-License-Identifier: BSD-3-Clause
// The one place that reads the label image of vtkFibreRadialGrowth.
#pragma once

#include "surface/MyelinSurface.h"

class vtkDataObject;
class vtkImageData;

namespace cactus
{

/// A label image, its numbers where VTK keeps them, and what its field data say.
struct LabelImageInput
{
  vtkImageData* image = nullptr;
  LabelImageView view;
  LabelImageFacts facts;
};

/// The input as an image that holds something. Throws InvalidInput for anything else.
vtkImageData* requireImage(vtkDataObject* input);

/// Reads a label image. Throws InvalidInput, naming the array, where it is not one as vtkFibreRadialGrowth makes them.
LabelImageInput labelImageFrom(vtkDataObject* input);

} // namespace cactus
