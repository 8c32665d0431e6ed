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
#include "FilterProperties.h"

#include <vtkPolyDataAlgorithm.h>

class CACTUSFILTERS_EXPORT vtkTractFibres : public vtkPolyDataAlgorithm
{
public:
  static vtkTractFibres* New();
  vtkTypeMacro(vtkTractFibres, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

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
  CACTUS_WHOLE_PROPERTY(RadiusDistribution)
  CACTUS_NUMBER_PROPERTY(GammaShape)
  CACTUS_NUMBER_PROPERTY(GammaScale)
  CACTUS_NUMBER_PROPERTY(LognormalMean)
  CACTUS_NUMBER_PROPERTY(LognormalDeviation)
  CACTUS_TEXT_PROPERTY(RadiusTable)
  CACTUS_FILE_PROPERTY(RadiusTableFile)
  CACTUS_TEXT_PROPERTY(RadiusTableColumn)
  CACTUS_NUMBER_PROPERTY(RadiusTableFactor)
  CACTUS_WHOLE_PROPERTY(RadiusHistogram)
  CACTUS_NUMBER_PROPERTY(RadiusHistogramFactor)
  CACTUS_NUMBER_PROPERTY(RadiusHistogramGRatio)
  CACTUS_NUMBER_PROPERTY(MinimumRadius)
  CACTUS_NUMBER_PROPERTY(MaximumRadius)
  CACTUS_WHOLE_PROPERTY(CalibreModel)
  CACTUS_NUMBER_PROPERTY(CalibreVariation)
  CACTUS_NUMBER_PROPERTY(CalibreCorrelationLength)
  CACTUS_NUMBER_PROPERTY(BeadAmplitude)
  CACTUS_NUMBER_PROPERTY(BeadSpacing)
  CACTUS_NUMBER_PROPERTY(BeadSpacingDeviation)
  CACTUS_NUMBER_PROPERTY(BeadLength)
  CACTUS_NUMBER_PROPERTY(SectionAxisRatio)
  CACTUS_NUMBER_PROPERTY(GRatio)
  CACTUS_NUMBER_PROPERTY(UnmyelinatedFraction)
  CACTUS_NUMBER_PROPERTY(UnmyelinatedRadius)
  CACTUS_NUMBER_PROPERTY(UnmyelinatedRadiusDeviation)
  CACTUS_WHOLE_PROPERTY(UnmyelinatedCluster)
  CACTUS_NUMBER_PROPERTY(SpacingFactor)
  CACTUS_NUMBER_PROPERTY(MinimumSpacing)
  CACTUS_NUMBER_PROPERTY(MaximumSpacing)
  CACTUS_WHOLE_PROPERTY(Seed)

  /** Counts as changed after it was stopped, so that a new request repeats the warning; not on several ranks. */
  int ComputePipelineMTime(vtkInformation*, vtkInformationVector**, vtkInformationVector*, int, vtkMTimeType* time) override;

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
