// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkPlacement
 * @brief Places a substrate in an image's space: from its own µm to the scanner's mm, rotated and moved.
 *
 * Input: anything with points (fibres, surfaces), images, tables, and blocks of these in any mixture. Output: the same. Points
 * and the grids of images are moved, with the images' direction matrix; `MeanDirection`, `Direction` and the data's vectors,
 * normals and tangents are rotated; `Radius` and `TargetRadius` become mm. All other arrays stay, including `Domain`, and tables
 * do not change. Data of another type give an error, with an empty vtkPolyData as output; so do empty data.
 *
 * Field data `Placement` holds the affine from µm to mm, row by row. Writers of images and tractograms put it into their files,
 * SubstrateWriter into the manifest; filters that work on fibres and surfaces move these back into the substrate's space.
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
  CACTUS_PRINTS_PROPERTIES

  CACTUS_WHOLE_PROPERTY(Place)
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
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestDataObject(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkPlacement(const vtkPlacement&) = delete;
  void operator=(const vtkPlacement&) = delete;

  std::unique_ptr<cactus::FilterProperties> Properties;
};

#endif
