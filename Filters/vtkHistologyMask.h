// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkHistologyMask
 * @brief Cuts a substrate into a mask like those of histology, in AxonDeepSeg's grey values.
 *
 * Input 0 `Outer`, input 1 `Inner` (optional): closed triangle surfaces with cell data `FibreId`, as for vtkSubstrateSampler.
 *
 * Output: an image of one layer, whose points are the middles of pixels. Point data `Mask` (0 background, 127 myelin, 255 axon),
 * so that ParaView's own writers save it as an 8-bit grey PNG or TIFF, and `FibreId`. Field data `PixelSize_um`. The image lies
 * along x and y, as formats of flat images require; its columns and rows run along the two axes of the cut, in their order, from
 * the domain's lower corner.
 */
#ifndef vtkHistologyMask_h
#define vtkHistologyMask_h

#include "CactusFiltersModule.h"
#include "FilterProperties.h"

#include <vtkImageAlgorithm.h>

class CACTUSFILTERS_EXPORT vtkHistologyMask : public vtkImageAlgorithm
{
public:
  static vtkHistologyMask* New();
  vtkTypeMacro(vtkHistologyMask, vtkImageAlgorithm);
  CACTUS_PRINTS_PROPERTIES

  CACTUS_WHOLE_PROPERTY(Normal)
  CACTUS_NUMBER_PROPERTY(Position)
  CACTUS_NUMBER_PROPERTY(PixelSize)
  CACTUS_WHOLE_PROPERTY(NumberOfThreads)

  CACTUS_COUNTS_AS_CHANGED_ONCE_STOPPED

protected:
  vtkHistologyMask();
  ~vtkHistologyMask() override = default;
  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkHistologyMask(const vtkHistologyMask&) = delete;
  void operator=(const vtkHistologyMask&) = delete;

  std::unique_ptr<cactus::FilterProperties> Properties;
};

#endif
