// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkFibreField
 * @brief The signed distance field of single fibres of a label image, for VTK's own contouring, smoothing and decimation.
 *
 * Input: the image that vtkFibreRadialGrowth makes, with its field data. Output: a multiblock data set with an image for each
 * chosen fibre, as large as the fibre, with point data `Field` (float, µm, positive inside, 0 on the outer surface) and field
 * data `FibreId`, `BundleId`, `Domain` and `Provenance`, which VTK's filters pass on.
 *
 * In the label image, neighbouring fibres are closer than a voxel, so a contour of its `Depth` fuses them. The fields here belong
 * to one fibre each (see core/surface/FibreField.h), and the zero contours of two of them do not meet. Beyond the faces of the
 * domain each image has samples that make a contour at `Level` (µm) end in flat caps on these faces.
 *
 * The whole image is needed at once. If the pipeline runs on several ranks, the first one gives the result.
 */
#ifndef vtkFibreField_h
#define vtkFibreField_h

#include "CactusFiltersModule.h"
#include "FilterProperties.h"

#include <vtkMultiBlockDataSetAlgorithm.h>

class CACTUSFILTERS_EXPORT vtkFibreField : public vtkMultiBlockDataSetAlgorithm
{
public:
  static vtkFibreField* New();
  vtkTypeMacro(vtkFibreField, vtkMultiBlockDataSetAlgorithm);
  CACTUS_PRINTS_PROPERTIES

  /** Values of Select. */
  enum
  {
    ONE_FIBRE = 0,
    ONE_BUNDLE = 1,
    ALL_FIBRES = 2
  };

  CACTUS_WHOLE_PROPERTY(Select)
  CACTUS_WHOLE_PROPERTY(FibreId)
  CACTUS_WHOLE_PROPERTY(BundleId)
  CACTUS_NUMBER_PROPERTY(Level)
  CACTUS_SWITCH_PROPERTY(ClipToDomain)
  CACTUS_WHOLE_PROPERTY(NumberOfThreads)

  CACTUS_COUNTS_AS_CHANGED_ONCE_STOPPED

protected:
  vtkFibreField();
  ~vtkFibreField() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkFibreField(const vtkFibreField&) = delete;
  void operator=(const vtkFibreField&) = delete;

  std::unique_ptr<cactus::FilterProperties> Properties;
};

#endif
