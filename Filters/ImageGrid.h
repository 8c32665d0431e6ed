// SPDX-License-Identifier: BSD-3-Clause
// Support for filters whose output is an image on its own grid, which depends on the inputs' data.
#pragma once

#include "FilterSupport.h"
#include "WholeData.h"

#include <vtkDataObject.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <array>

namespace cactus
{

/// The points of an image whose axes are those of space.
struct ImageGrid
{
  std::array<int, 3> count{};
  std::array<double, 3> origin{}; ///< of the first point
  double spacing = 1.0;

  std::array<int, 6> extent() const { return { { 0, this->count[0] - 1, 0, this->count[1] - 1, 0, this->count[2] - 1 } }; }
};

inline void setGrid(vtkImageData* image, const ImageGrid& grid)
{
  image->SetExtent(grid.extent().data());
  image->SetOrigin(grid.origin.data());
  image->SetSpacing(grid.spacing, grid.spacing, grid.spacing);
}

/// For RequestInformation: updates the inputs at port 0, and tells the pipeline the grid `gridOf(data)`, and the type of its
/// active scalars. Without a grid the pipeline gets a place holder: it needs an extent even if there is no image.
template <typename GridOf>
void announceGrid(vtkAlgorithm* self, vtkInformationVector** inputs, vtkInformationVector* outputs, int scalars, GridOf&& gridOf)
{
  vtkInformation* info = outputs->GetInformationObject(0);
  vtkDataObject::SetPointDataActiveScalarInfo(info, scalars, 1);
  const std::array<int, 6> placeHolder{};
  info->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), placeHolder.data(), 6);
  quietly(
    [&]
    {
      updateWholeInputs(self, inputs);
      const ImageGrid grid = gridOf(vtkDataObject::GetData(inputs[0]));
      const std::array<double, 3> spacing{ { grid.spacing, grid.spacing, grid.spacing } };
      info->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), grid.extent().data(), 6);
      info->Set(vtkDataObject::ORIGIN(), grid.origin.data(), 3);
      info->Set(vtkDataObject::SPACING(), spacing.data(), 3);
    });
}

} // namespace cactus
