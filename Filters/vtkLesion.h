// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkLesion
 * @brief Takes axons, or their myelin, from a substrate: the twin of a healthy one.
 *
 * Input 0 `Outer`, input 1 `Inner`, input 2 `Fibres` (optional): closed triangle surfaces with cell data `FibreId`, and the
 * centre lines. Connected to MyelinSurface, Outer brings the others along.
 *
 * Output 0 `Outer`, output 1 `Inner`: the surfaces that are left, as MyelinSurface gives them. The outer surface of an axon that
 * has lost its myelin is its inner one, bit for bit. All surfaces that a lesion leaves alone are the same as in the input, bit
 * for bit. Output 2 `Fibres`: the centre lines of the fibres that are left; empty without that input. The record of the outputs
 * tells the fractions of length that were reached with whole fibres.
 *
 * On several ranks the first does the work.
 */
#ifndef vtkLesion_h
#define vtkLesion_h

#include "CactusFiltersModule.h"
#include "FilterProperties.h"

#include <vtkPolyDataAlgorithm.h>

class CACTUSFILTERS_EXPORT vtkLesion : public vtkPolyDataAlgorithm
{
public:
  static vtkLesion* New();
  vtkTypeMacro(vtkLesion, vtkPolyDataAlgorithm);
  CACTUS_PRINTS_PROPERTIES

  CACTUS_NUMBER_PROPERTY(AxonLoss)
  CACTUS_NUMBER_PROPERTY(MyelinLoss)

  /** Values of Order. */
  enum
  {
    THINNEST_FIRST = 0,
    RANDOM = 1
  };

  CACTUS_WHOLE_PROPERTY(Order)
  CACTUS_WHOLE_PROPERTY(Seed)
  CACTUS_WHOLE_PROPERTY(NumberOfThreads)

  CACTUS_COUNTS_AS_CHANGED_ONCE_STOPPED

protected:
  vtkLesion();
  ~vtkLesion() override = default;
  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkLesion(const vtkLesion&) = delete;
  void operator=(const vtkLesion&) = delete;

  std::unique_ptr<cactus::FilterProperties> Properties;
};

#endif
