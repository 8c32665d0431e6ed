// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkSubstrateProduction
 * @brief Grows fibres, makes their surfaces and writes them as a substrate folder, without holding label image and surfaces in
 * memory.
 *
 * Input: fibres, as for vtkFibreRadialGrowth. The filter writes when it executes for the first time after one of its own
 * properties or connections has changed, and by Write(), but not because its input has changed. It writes the files of
 * vtkFibreRadialGrowth, vtkMyelinSurface and vtkSubstrateWriter with the same properties (Seed is that of both), with the same
 * bits. Output 0 `Files`: the table of the files. Output 1 `Fibre statistics`: that of vtkMyelinSurface.
 *
 * Work in progress is kept in the folder `FolderName.work`. A run that was stopped or killed continues from there when the filter
 * executes again, with the same fibres, properties and version; the folder is removed at the end. Progress includes the speed.
 * The method is core/stages/SubstrateProduction.h. On several ranks all of them share the work; the first one has the tables, and
 * reports.
 */
#ifndef vtkSubstrateProduction_h
#define vtkSubstrateProduction_h

#include "CactusFiltersModule.h"
#include "KeptFolder.h"
#include "OptionProperties.h"

#include <vtkNew.h>
#include <vtkTable.h>
#include <vtkTableAlgorithm.h>

class CACTUSFILTERS_EXPORT vtkSubstrateProduction : public vtkTableAlgorithm
{
public:
  static vtkSubstrateProduction* New();
  vtkTypeMacro(vtkSubstrateProduction, vtkTableAlgorithm);
  CACTUS_PRINTS_PROPERTIES

  CACTUS_FIBRE_RADIAL_GROWTH_PROPERTIES
  CACTUS_MYELIN_SURFACE_PROPERTIES
  CACTUS_WHOLE_PROPERTY(Seed)
  CACTUS_FILE_PROPERTY(FolderName)
  CACTUS_WHOLE_PROPERTY(Format)
  CACTUS_WHOLE_PROPERTY(Encoding)
  CACTUS_WHOLE_PROPERTY(PeriodicFaces)
  CACTUS_SWITCH_PROPERTY(AllowOpenSurfaces)
  CACTUS_NUMBER_PROPERTY(SampledFraction)
  CACTUS_WHOLE_PROPERTY(NumberOfThreads)

  /** Writes the folder, whether or not anything has changed. Returns 1, or 0 if it could not be written. */
  int Write();

  CACTUS_COUNTS_AS_CHANGED_ONCE_STOPPED
  CACTUS_ABORT_IS_NO_CHANGE

protected:
  vtkSubstrateProduction();
  ~vtkSubstrateProduction() override = default;
  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkSubstrateProduction(const vtkSubstrateProduction&) = delete;
  void operator=(const vtkSubstrateProduction&) = delete;

  void Produce();

  std::unique_ptr<cactus::FilterProperties> Properties;
  cactus::KeptFolder Kept;
  vtkNew<vtkTable> Files; ///< the last files written
  vtkNew<vtkTable> Fibres;
};

#endif
