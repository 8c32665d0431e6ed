// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkBundleInitializer
 * @brief Makes one bundle of straight fibres, or two crossing ones, with chosen radii, density and dispersion.
 *
 * Output: one polyline per fibre with point data `Radius` (µm), cell data `FibreId`, `BundleId`, `TargetRadius` and field data
 * `Domain` and `Provenance`. The fibres' circles do not overlap on either end face of their bundle; between the faces fibres do,
 * and vtkCapsuleOptimizer parts them. The method is cactus::initialiseBundles, whose header says how it works and what it
 * promises. A density or dispersion out of reach gives one error with the value that was reached, and no output.
 *
 * Method: CACTUS, initialisation.
 */
#ifndef vtkBundleInitializer_h
#define vtkBundleInitializer_h

#include "CactusFiltersModule.h"

#include <vtkPolyDataAlgorithm.h>

class CACTUSFILTERS_EXPORT vtkBundleInitializer : public vtkPolyDataAlgorithm
{
public:
  static vtkBundleInitializer* New();
  vtkTypeMacro(vtkBundleInitializer, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum RadiusDistributions
  {
    GAMMA = 0,
    LOGNORMAL = 1,
    TABLE = 2
  };
  enum DispersionModels
  {
    WATSON = 0,
    CONE = 1,
    COHERENT = 2
  };
  enum CrossingStyles
  {
    INTERWOVEN = 0,
    SHEETS = 1
  };

  ///@{
  /** Side (µm) of the cubic domain, centred on the origin. Default 30. */
  vtkSetMacro(Side, double);
  vtkGetMacro(Side, double);
  ///@}

  ///@{
  /** In (0, 1), default 0.7. One bundle: area of the fibres' circles on the end faces over the area of the faces. Two bundles,
   * whose faces lie outside the domain: the fibres' volume within the domain over that of the domain. */
  vtkSetMacro(FibreVolumeFraction, double);
  vtkGetMacro(FibreVolumeFraction, double);
  ///@}

  ///@{
  /** Fraction of the domain that FibreRadialGrowth is to fill later, from FibreVolumeFraction to below 1: the capsules are made
   * thinner than the radii drawn, by sqrt(FibreVolumeFraction / this), so that these are what the grown fibres have
   * (`TargetRadius`). Default 0: the capsules have the radii drawn, and growth makes them thicker. */
  vtkSetMacro(GrownFibreVolumeFraction, double);
  vtkGetMacro(GrownFibreVolumeFraction, double);
  ///@}

  ///@{
  /** One of RadiusDistributions, for the outer radius. Default GAMMA. */
  vtkSetMacro(RadiusDistribution, int);
  vtkGetMacro(RadiusDistribution, int);
  ///@}

  ///@{
  /** Shape (default 2.4) and scale (µm, default 0.25) of the gamma distribution. */
  vtkSetMacro(GammaShape, double);
  vtkGetMacro(GammaShape, double);
  vtkSetMacro(GammaScale, double);
  vtkGetMacro(GammaScale, double);
  ///@}

  ///@{
  /** Mean (µm, default 0.6) and standard deviation (µm, default 0.39) of a lognormal radius before it is cut to its limits. */
  vtkSetMacro(LognormalMean, double);
  vtkGetMacro(LognormalMean, double);
  vtkSetMacro(LognormalDeviation, double);
  vtkGetMacro(LognormalDeviation, double);
  ///@}

  ///@{
  /** Radii (µm) to draw from, with replacement: numbers separated by blanks or commas, or a text file of such. Give one of them.
   */
  vtkSetStringMacro(RadiusTable);
  vtkGetStringMacro(RadiusTable);
  vtkSetFilePathMacro(RadiusTableFile);
  vtkGetFilePathMacro(RadiusTableFile);
  ///@}

  ///@{
  /** Limits (µm) of the outer radius: what is drawn outside is drawn again. Defaults 0.2 and 2. */
  vtkSetMacro(MinimumRadius, double);
  vtkGetMacro(MinimumRadius, double);
  vtkSetMacro(MaximumRadius, double);
  vtkGetMacro(MaximumRadius, double);
  ///@}

  ///@{
  /** Mean angle (degrees, 0 to 45) between a fibre's end-to-end direction and its bundle's axis. Default 5. */
  vtkSetMacro(MeanDispersion, double);
  vtkGetMacro(MeanDispersion, double);
  ///@}

  ///@{
  /** One of DispersionModels. Default COHERENT. */
  vtkSetMacro(DispersionModel, int);
  vtkGetMacro(DispersionModel, int);
  ///@}

  ///@{
  /** Distance (µm) over which the directions of COHERENT are alike. Default 0: four times the fibres' mean shift between the
   * faces. */
  vtkSetMacro(CorrelationLength, double);
  vtkGetMacro(CorrelationLength, double);
  ///@}

  ///@{
  /** 1 (default) or 2. */
  vtkSetMacro(NumberOfBundles, int);
  vtkGetMacro(NumberOfBundles, int);
  ///@}

  ///@{
  /** Angle (degrees, above 0 and up to 90) between the axes of two bundles. Default 90. */
  vtkSetMacro(CrossingAngle, double);
  vtkGetMacro(CrossingAngle, double);
  ///@}

  ///@{
  /** One of CrossingStyles. Default INTERWOVEN. */
  vtkSetMacro(CrossingStyle, int);
  vtkGetMacro(CrossingStyle, int);
  ///@}

  ///@{
  /** Least thickness (µm) of each layer of SHEETS; 0 (default) takes a sixth of the height, or what the largest radius needs. */
  vtkSetMacro(SheetThickness, double);
  vtkGetMacro(SheetThickness, double);
  ///@}

  ///@{
  /** Width (µm) by which the fibres extend beyond each lateral side of the domain. Default 0. */
  vtkSetMacro(Margin, double);
  vtkGetMacro(Margin, double);
  ///@}

  ///@{
  /** Distance between control points: this multiple of the radius (default 1.25), within two limits (µm, 0.8 and 2). */
  vtkSetMacro(SpacingFactor, double);
  vtkGetMacro(SpacingFactor, double);
  vtkSetMacro(MinimumSpacing, double);
  vtkGetMacro(MinimumSpacing, double);
  vtkSetMacro(MaximumSpacing, double);
  vtkGetMacro(MaximumSpacing, double);
  ///@}

  ///@{
  /** Seed of all random numbers, not negative. Default 1. */
  vtkSetMacro(Seed, int);
  vtkGetMacro(Seed, int);
  ///@}

  /** Counts as changed after it was stopped, so that it is asked again and says so. */
  int ComputePipelineMTime(vtkInformation*, vtkInformationVector**, vtkInformationVector*, int, vtkMTimeType* time) override;

protected:
  vtkBundleInitializer();
  ~vtkBundleInitializer() override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkBundleInitializer(const vtkBundleInitializer&) = delete;
  void operator=(const vtkBundleInitializer&) = delete;

  double Side = 30.0;
  double FibreVolumeFraction = 0.7;
  double GrownFibreVolumeFraction = 0.0;
  int RadiusDistribution = GAMMA;
  double GammaShape = 2.4;
  double GammaScale = 0.25;
  double LognormalMean = 0.6;
  double LognormalDeviation = 0.39;
  char* RadiusTable = nullptr;
  char* RadiusTableFile = nullptr;
  double MinimumRadius = 0.2;
  double MaximumRadius = 2.0;
  double MeanDispersion = 5.0;
  int DispersionModel = COHERENT;
  double CorrelationLength = 0.0;
  int NumberOfBundles = 1;
  double CrossingAngle = 90.0;
  int CrossingStyle = INTERWOVEN;
  double SheetThickness = 0.0;
  double Margin = 0.0;
  double SpacingFactor = 1.25;
  double MinimumSpacing = 0.8;
  double MaximumSpacing = 2.0;
  int Seed = 1;
};

#endif
