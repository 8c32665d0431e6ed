// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkStrandReader
 * @brief Reads fibres from the CACTUS strand text format (.strands, .init, .partial; µm), from CATERPillar's tables of spheres
 * and from what the White Matter Generator writes.
 *
 * Which of them a file is, its first characters tell, see core/io/FibreFile.h. What is left out of it is a warning.
 *
 * Output: one polyline per fibre with point data `Radius`, cell data `FibreId`, `BundleId`, `TargetRadius` (mean radius of the
 * strand) and field data `Domain` (of a strand file the centred cube of its first line). A file that is truncated or malformed
 * gives one error that names the line, and no output.
 */
#ifndef vtkStrandReader_h
#define vtkStrandReader_h

#include "CactusFiltersModule.h"
#include "FilterProperties.h"

#include <vtkPolyDataAlgorithm.h>

class CACTUSFILTERS_EXPORT vtkStrandReader : public vtkPolyDataAlgorithm
{
public:
  static vtkStrandReader* New();
  vtkTypeMacro(vtkStrandReader, vtkPolyDataAlgorithm);
  CACTUS_PRINTS_PROPERTIES

  /** Whether the file is one of these by its content (ParaView asks before it offers this reader). */
  int CanReadFile(const char* name);

  CACTUS_FILE_PROPERTY(FileName)

  CACTUS_ABORT_IS_NO_CHANGE

protected:
  vtkStrandReader();
  ~vtkStrandReader() override = default;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkStrandReader(const vtkStrandReader&) = delete;
  void operator=(const vtkStrandReader&) = delete;

  std::unique_ptr<cactus::FilterProperties> Properties;
};

#endif
