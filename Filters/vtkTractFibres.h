// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkTractFibres
 * @brief Lays a bundle of fibres around each of some streamlines, as the start of a substrate that follows a tract.
 *
 * Input: polylines, such as vtkTractogramReader's, with or without cell data `BundleId`. Output: fibres as those of
 * vtkBundleInitializer, in a box around the origin whose middle lies on a streamline; axes keep their directions. The
 * method and its guarantees are documented in cactus::layTractFibres. A warning says where bends had to be rounded off, or where
 * a streamline that ends in the domain was continued.
 */
#ifndef vtkTractFibres_h
#define vtkTractFibres_h

#include "CactusFiltersModule.h"
#include "OptionProperties.h"

#include <vtkPolyDataAlgorithm.h>

class CACTUSFILTERS_EXPORT vtkTractFibres : public vtkPolyDataAlgorithm
{
public:
  static vtkTractFibres* New();
  vtkTypeMacro(vtkTractFibres, vtkPolyDataAlgorithm);
  CACTUS_PRINTS_PROPERTIES

  CACTUS_WHOLE_PROPERTY(Select)
  CACTUS_WHOLE_PROPERTY(FirstStreamline)
  CACTUS_WHOLE_PROPERTY(LastStreamline)
  CACTUS_WHOLE_PROPERTY(BundleId)
  CACTUS_WHOLE_PROPERTY(NumberOfStreamlines)
  CACTUS_WHOLE_PROPERTY(Middle)
  CACTUS_NUMBER_PROPERTY(PointX)
  CACTUS_NUMBER_PROPERTY(PointY)
  CACTUS_NUMBER_PROPERTY(PointZ)
  CACTUS_WHOLE_PROPERTY(LengthUnit)
  CACTUS_NUMBER_PROPERTY(ScaleFactor)
  CACTUS_NUMBER_PROPERTY(Side)
  CACTUS_NUMBER_PROPERTY(Length)
  CACTUS_NUMBER_PROPERTY(FibreVolumeFraction)
  CACTUS_NUMBER_PROPERTY(GrownFibreVolumeFraction)
  CACTUS_NUMBER_PROPERTY(BundleDiameter)
  CACTUS_NUMBER_PROPERTY(Margin)
  CACTUS_RADIUS_DISTRIBUTION_PROPERTIES
  CACTUS_CALIBRE_VARIATION_PROPERTIES
  CACTUS_NUMBER_PROPERTY(SectionAxisRatio)
  CACTUS_NUMBER_PROPERTY(GRatio)
  CACTUS_UNMYELINATED_AXONS_PROPERTIES
  CACTUS_CONTROL_POINT_SPACING_PROPERTIES
  CACTUS_WHOLE_PROPERTY(Seed)

  CACTUS_COUNTS_AS_CHANGED_ONCE_STOPPED
  CACTUS_ABORT_IS_NO_CHANGE

protected:
  vtkTractFibres();
  ~vtkTractFibres() override = default;
  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkTractFibres(const vtkTractFibres&) = delete;
  void operator=(const vtkTractFibres&) = delete;

  std::unique_ptr<cactus::FilterProperties> Properties;
};

#endif
