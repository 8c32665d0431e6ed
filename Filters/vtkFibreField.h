// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkFibreField
 * @brief The signed distance field of single fibres of a label image, for VTK's own contouring, smoothing and decimation.
 *
 * Input: the image that vtkFibreRadialGrowth makes, with its field data. Output: a multiblock data set with an image for each
 * fibre chosen, as large as the fibre, with point data `Field` (float, µm, positive inside, 0 on the outer surface) and field
 * data `FibreId`, `BundleId`, `Domain` and `Provenance`, which the filters of VTK pass on.
 *
 * In the label image neighbours are nearer to each other than a voxel is wide, so that a contour of its `Depth` fuses them.
 * The fields here are those of one fibre each (see core/surface/FibreField.h), and the zero contours of two of them do not meet.
 * Beyond the faces of the domain each image has samples that make a contour at `Level` (µm) end in flat caps on these faces.
 *
 * All of the image is needed at once. Where the pipeline runs on several ranks, the first one gives the result.
 */
#ifndef vtkFibreField_h
#define vtkFibreField_h

#include "CactusFiltersModule.h"

#include <vtkMultiBlockDataSetAlgorithm.h>

class CACTUSFILTERS_EXPORT vtkFibreField : public vtkMultiBlockDataSetAlgorithm
{
public:
  static vtkFibreField* New();
  vtkTypeMacro(vtkFibreField, vtkMultiBlockDataSetAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** Values of Select. */
  enum
  {
    ONE_FIBRE = 0,
    ONE_BUNDLE = 1,
    ALL_FIBRES = 2
  };

  ///@{
  /** Whose fields to give. */
  vtkSetMacro(Select, int);
  vtkGetMacro(Select, int);
  ///@}

  ///@{
  /** The fibre (ONE_FIBRE), from 1. */
  vtkSetMacro(FibreId, int);
  vtkGetMacro(FibreId, int);
  ///@}

  ///@{
  /** The bundle (ONE_BUNDLE), from 1. */
  vtkSetMacro(BundleId, int);
  vtkGetMacro(BundleId, int);
  ///@}

  ///@{
  /** The value (µm) at which contours will be taken, and for which the caps on the domain's faces are made: 0 is the outer
   * surface, a depth inside an axon's. */
  vtkSetMacro(Level, double);
  vtkGetMacro(Level, double);
  ///@}

  ///@{
  /** Cut fibres off at the faces of the domain, else where the image ends. */
  vtkSetMacro(ClipToDomain, bool);
  vtkGetMacro(ClipToDomain, bool);
  ///@}

  ///@{
  /** Threads to use; 0 takes all. The result does not depend on it. */
  vtkSetMacro(NumberOfThreads, int);
  vtkGetMacro(NumberOfThreads, int);
  ///@}

  /** Counts as changed after it was stopped, so that it is asked again and says so. */
  int ComputePipelineMTime(vtkInformation*, vtkInformationVector**, vtkInformationVector*, int, vtkMTimeType* time) override;

protected:
  vtkFibreField() = default;
  ~vtkFibreField() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  int Select = ONE_FIBRE;
  int FibreId = 1;
  int BundleId = 1;
  double Level = 0.0;
  bool ClipToDomain = true;
  int NumberOfThreads = 0;

private:
  vtkFibreField(const vtkFibreField&) = delete;
  void operator=(const vtkFibreField&) = delete;
};

#endif
