// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vtkSmartPointer.h>

class vtkDataObject;

namespace cactus
{

/// Returns the middle slices of images, across their third axis, as surfaces with the images' values: of one image as
/// vtkPolyData, of blocks as blocks. Of several signed distance fields (point data `Field`, µm, see vtkFibreField) there is the
/// part inside the fibres, since their images overlap. Returns nullptr where there is no image.
vtkSmartPointer<vtkDataObject> imageSections(vtkDataObject* data);

} // namespace cactus
