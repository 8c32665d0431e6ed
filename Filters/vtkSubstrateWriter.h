// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkSubstrateWriter
 * @brief Writes a substrate as a folder that a Monte-Carlo diffusion simulator runs on.
 *
 * Input 0 `Outer`, input 1 `Inner` (optional): closed, outward triangle surfaces with cell data `FibreId` and `BundleId`. Input 2
 * `Fibres` (optional): their centre lines. The folder is written when the filter executes for the first time after one of its own
 * properties or connections has changed, and by Write(); not because its input has changed. It holds the surfaces in the format
 * of the simulator `Format` (for MC/DC one ASCII PLY file (µm) per fibre and surface, and configurations; for RMS also voxel
 * labels; for SpinDoctor the input from which tetgen makes finite elements;
 * for MCMRSimulator.jl its geometry file), a certificate (see vtkSubstrateCertificate), a
 * manifest, a README.txt and, with `Fibres`, a strand file.
 *
 * Output: a table of the files written, with fibre, bundle, triangles, volume and area. A warning says why the surfaces, as
 * stored in the files, are not certified; open surfaces are refused.
 *
 * The folder appears whole or not at all. An existing one is replaced if it is a substrate folder with nothing else in it, and
 * refused otherwise. Ranks that were given the same surfaces share the work, and see one disk; the first gives the table.
 */
#ifndef vtkSubstrateWriter_h
#define vtkSubstrateWriter_h

#include "CactusFiltersModule.h"
#include "FilterProperties.h"
#include "KeptFolder.h"

#include <vtkNew.h>
#include <vtkTable.h>
#include <vtkTableAlgorithm.h>

namespace cactus
{
class Sharing;
}

class CACTUSFILTERS_EXPORT vtkSubstrateWriter : public vtkTableAlgorithm
{
public:
  static vtkSubstrateWriter* New();
  vtkTypeMacro(vtkSubstrateWriter, vtkTableAlgorithm);
  CACTUS_PRINTS_PROPERTIES

  CACTUS_FILE_PROPERTY(FolderName)
  CACTUS_WHOLE_PROPERTY(Format)
  CACTUS_WHOLE_PROPERTY(Encoding)
  CACTUS_NUMBER_PROPERTY(Permeability)
  CACTUS_NUMBER_PROPERTY(VoxelSize)
  CACTUS_WHOLE_PROPERTY(StartPositions)
  CACTUS_WHOLE_PROPERTY(Seed)
  CACTUS_WHOLE_PROPERTY(PeriodicFaces)
  CACTUS_SWITCH_PROPERTY(AllowOpenSurfaces)
  CACTUS_NUMBER_PROPERTY(MinimumGap)
  CACTUS_WHOLE_PROPERTY(NumberOfThreads)

  /** Writes the folder, whether or not anything has changed. Returns 1, or 0 if it could not be written. */
  int Write();

  CACTUS_COUNTS_AS_CHANGED_ONCE_STOPPED
  CACTUS_ABORT_IS_NO_CHANGE

protected:
  vtkSubstrateWriter();
  ~vtkSubstrateWriter() override = default;
  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkSubstrateWriter(const vtkSubstrateWriter&) = delete;
  void operator=(const vtkSubstrateWriter&) = delete;

  /// Writes the folder, and fills WrittenFiles. Collective.
  void WriteFolder(const cactus::Sharing& all);

  std::unique_ptr<cactus::FilterProperties> Properties;
  cactus::KeptFolder Kept;
  vtkNew<vtkTable> WrittenFiles; ///< the last files written
};

#endif
