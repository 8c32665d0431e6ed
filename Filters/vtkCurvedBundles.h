// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkCurvedBundles
 * @brief Lays fibres in a bundle that bends or fans out, or in two that kiss, as the start of a substrate.
 *
 * Output: fibres as those of vtkBundleInitializer, in a box around the origin. The method and its guarantees are
 * documented in cactus::layCurvedBundles.
 */
#ifndef vtkCurvedBundles_h
#define vtkCurvedBundles_h

#include "CactusFiltersModule.h"
#include "OptionProperties.h"

#include <vtkPolyDataAlgorithm.h>

class CACTUSFILTERS_EXPORT vtkCurvedBundles : public vtkPolyDataAlgorithm
{
public:
  static vtkCurvedBundles* New();
  vtkTypeMacro(vtkCurvedBundles, vtkPolyDataAlgorithm);
  CACTUS_PRINTS_PROPERTIES

  CACTUS_WHOLE_PROPERTY(Shape)
  CACTUS_NUMBER_PROPERTY(BendRadius)
  CACTUS_NUMBER_PROPERTY(FanAngle)
  CACTUS_NUMBER_PROPERTY(KissDistance)
  CACTUS_NUMBER_PROPERTY(Side)
  CACTUS_NUMBER_PROPERTY(Length)
  CACTUS_NUMBER_PROPERTY(FibreVolumeFraction)
  CACTUS_NUMBER_PROPERTY(GrownFibreVolumeFraction)
  CACTUS_NUMBER_PROPERTY(Margin)
  CACTUS_RADIUS_DISTRIBUTION_PROPERTIES
  CACTUS_CALIBRE_VARIATION_PROPERTIES
  CACTUS_NUMBER_PROPERTY(SectionAxisRatio)
  CACTUS_NUMBER_PROPERTY(GRatio)
  CACTUS_CONTROL_POINT_SPACING_PROPERTIES
  CACTUS_WHOLE_PROPERTY(Seed)

  CACTUS_COUNTS_AS_CHANGED_ONCE_STOPPED
  CACTUS_ABORT_IS_NO_CHANGE

protected:
  vtkCurvedBundles();
  ~vtkCurvedBundles() override = default;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkCurvedBundles(const vtkCurvedBundles&) = delete;
  void operator=(const vtkCurvedBundles&) = delete;

  std::unique_ptr<cactus::FilterProperties> Properties;
};

#endif
