// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkSubstrateStatistics
 * @brief Measures a substrate on its final surfaces.
 *
 * Input 0 `Fibres`: polylines with point data `Radius`. Input 1 `Outer` and input 2 `Inner`, both optional: closed triangle
 * surfaces with cell data `FibreId`, clipped to the Domain and capped. If input 0 gets the outer surfaces of a vtkMyelinSurface
 * and input 1 nothing, these are measured, with that filter's inner surfaces and the fibres before it.
 *
 * Output 0 `Substrate`: one row; volume fractions, aggregate g-ratio sqrt(1 - MVF / FVF) (Stikov 2015), dispersion, mean radii,
 * and how many surfaces are closed, outward 2-manifolds. Output 1 `Fibres`: one row per fibre. Output 2 `Histograms`: one row per
 * bin of radius and of g-ratio. Output 3 `Profiles`: one row per cut of a fibre, with its diameters there. Output 4 `Summary`:
 * output 0 as readable text, a row per column (`Quantity`, `Value`). Columns, formulas and their sources are in
 * docs/statistics.md. Lengths are in µm and angles in degrees, as the columns' names say.
 *
 * Volumes are those enclosed by the meshes. Radii are those of circles with the area of the mesh's cross-section orthogonal to
 * the centre line, every CutSpacing µm (CACTUS 2023, "Experiments"), for cuts that lie wholly inside the domain. Values without a
 * surface or a cut are NaN. A surface that reaches more than 0.1 µm out of the domain is an error.
 */
#ifndef vtkSubstrateStatistics_h
#define vtkSubstrateStatistics_h

#include "CactusFiltersModule.h"
#include "FilterProperties.h"

#include <vtkTableAlgorithm.h>

class CACTUSFILTERS_EXPORT vtkSubstrateStatistics : public vtkTableAlgorithm
{
public:
  static vtkSubstrateStatistics* New();
  vtkTypeMacro(vtkSubstrateStatistics, vtkTableAlgorithm);
  CACTUS_PRINTS_PROPERTIES

  CACTUS_NUMBER_PROPERTY(CutSpacing)
  CACTUS_WHOLE_PROPERTY(NumberOfBins)
  CACTUS_WHOLE_PROPERTY(ExtraAxonalWalkers)
  CACTUS_NUMBER_PROPERTY(WalkDistance)
  CACTUS_NUMBER_PROPERTY(WalkStep)
  CACTUS_WHOLE_PROPERTY(WalkSeed)
  CACTUS_WHOLE_PROPERTY(NumberOfThreads)

  CACTUS_COUNTS_AS_CHANGED_ONCE_STOPPED

protected:
  vtkSubstrateStatistics();
  ~vtkSubstrateStatistics() override = default;
  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkSubstrateStatistics(const vtkSubstrateStatistics&) = delete;
  void operator=(const vtkSubstrateStatistics&) = delete;

  std::unique_ptr<cactus::FilterProperties> Properties;
};

#endif
