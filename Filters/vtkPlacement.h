// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkPlacement
 * @brief Puts a substrate where it lies in an image's space: from its own µm to the scanner's mm, turned and moved.
 *
 * Input: anything with points (fibres, surfaces), images, tables, and blocks of these in any mixture. Output: the same. Points
 * and the grids of images are moved, whose direction matrix turns; arrays of three floating-point numbers are directions, and
 * turned; `Radius` and `TargetRadius` become mm. All other arrays stay as they are, `Domain` too; tables stay altogether.
 * Data of another type end in an error, with an empty vtkPolyData as output; so do data that hold nothing at all.
 *
 * Field data `Placement` holds the affine from µm to mm, row by row. Writers of images and tractograms put it into their files,
 * SubstrateWriter into the manifest; filters that work on fibres and surfaces take these back into the substrate's own space.
 */
#ifndef vtkPlacement_h
#define vtkPlacement_h

#include "CactusFiltersModule.h"
#include "FilterProperties.h"

#include <vtkPassInputTypeAlgorithm.h>

class CACTUSFILTERS_EXPORT vtkPlacement : public vtkPassInputTypeAlgorithm
{
public:
  static vtkPlacement* New();
  vtkTypeMacro(vtkPlacement, vtkPassInputTypeAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  CACTUS_NUMBER_PROPERTY(PositionX)
  CACTUS_NUMBER_PROPERTY(PositionY)
  CACTUS_NUMBER_PROPERTY(PositionZ)
  CACTUS_NUMBER_PROPERTY(RotationX)
  CACTUS_NUMBER_PROPERTY(RotationY)
  CACTUS_NUMBER_PROPERTY(RotationZ)
  CACTUS_NUMBER_PROPERTY(ScaleFactor)

protected:
  vtkPlacement();
  ~vtkPlacement() override = default;
  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestDataObject(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkPlacement(const vtkPlacement&) = delete;
  void operator=(const vtkPlacement&) = delete;

  std::unique_ptr<cactus::FilterProperties> Properties;
};

#endif
