// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkHistologyRadii
 * @brief Measures the axons of a histology mask (AxonDeepSeg's grey values), as a table of radii to draw fibres from.
 *
 * Input: a flat image of grey values, as point or cell data: about 0 background, 127 myelin, 255 axon; or of colours, of which
 * `AxonColour` and `MyelinColour` say what they are. Transparent pixels are background.
 *
 * Output: a table with a row for each axon: `X_um`, `Y_um` (its centre of mass, from the image's corner), `AxonRadius_um` and
 * `FibreRadius_um` (of circles with the areas of the axon, and of the axon with its myelin), `GRatio`, `AxonArea_um2`,
 * `MyelinArea_um2`, `AtBorder` (0 or 1). Field data `LooseMyelin_um2`: the area of myelin without an axon.
 */
#ifndef vtkHistologyRadii_h
#define vtkHistologyRadii_h

#include "CactusFiltersModule.h"
#include "FilterProperties.h"

#include <vtkTableAlgorithm.h>

class CACTUSFILTERS_EXPORT vtkHistologyRadii : public vtkTableAlgorithm
{
public:
  static vtkHistologyRadii* New();
  vtkTypeMacro(vtkHistologyRadii, vtkTableAlgorithm);
  CACTUS_PRINTS_PROPERTIES

  CACTUS_NUMBER_PROPERTY(PixelSize)
  CACTUS_NUMBER_PROPERTY(SmallestRadius)
  CACTUS_SWITCH_PROPERTY(LeaveOutBorder)
  CACTUS_WHOLE_PROPERTY(AxonColour)
  CACTUS_WHOLE_PROPERTY(MyelinColour)

protected:
  vtkHistologyRadii();
  ~vtkHistologyRadii() override = default;
  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkHistologyRadii(const vtkHistologyRadii&) = delete;
  void operator=(const vtkHistologyRadii&) = delete;

  std::unique_ptr<cactus::FilterProperties> Properties;
};

#endif
