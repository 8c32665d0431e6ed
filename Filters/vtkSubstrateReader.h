// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkSubstrateReader
 * @brief Reads a substrate folder again.
 *
 * Outputs 0 `Outer` and 1 `Inner`: triangles with the arrays that vtkMyelinSurface gives, in µm and the substrate's own space.
 * VTK reads their files, in single precision, in which vtkMyelinSurface makes points; those on faces of the domain lie on them to
 * the bit. Output 2 `Fibres`: the centre lines, with the ids of the surfaces. Outputs 3 `Certificate` and 4 `Certificate of
 * fibres`: the folder's tables. What the folder does not have is empty. `Radius` comes from the length of the centre line in the
 * certificate, and is NaN if the folder has none.
 *
 * Every file read is compared with its SHA-256. One error names a file that is missing or was changed, and no output is given. On
 * several ranks the first piece has everything.
 */
#ifndef vtkSubstrateReader_h
#define vtkSubstrateReader_h

#include "CactusFiltersModule.h"
#include "FilterProperties.h"

#include <vtkPolyDataAlgorithm.h>

class CACTUSFILTERS_EXPORT vtkSubstrateReader : public vtkPolyDataAlgorithm
{
public:
  static vtkSubstrateReader* New();
  vtkTypeMacro(vtkSubstrateReader, vtkPolyDataAlgorithm);
  CACTUS_PRINTS_PROPERTIES

  /** Whether it is a manifest of ours, or a folder with one, by its content (ParaView asks before it offers this reader). */
  int CanReadFile(const char* name);

  CACTUS_FILE_PROPERTY(FileName)

  CACTUS_COUNTS_AS_CHANGED_ONCE_STOPPED
  CACTUS_ABORT_IS_NO_CHANGE

protected:
  vtkSubstrateReader();
  ~vtkSubstrateReader() override = default;
  int FillOutputPortInformation(int, vtkInformation*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkSubstrateReader(const vtkSubstrateReader&) = delete;
  void operator=(const vtkSubstrateReader&) = delete;

  std::unique_ptr<cactus::FilterProperties> Properties;
};

#endif
