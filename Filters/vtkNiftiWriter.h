// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkNiftiWriter
 * @brief Writes one array of an image as NIfTI-1, .nii or .nii.gz, with q- and s-form; in mm, or in µm by `LengthUnit` if it is
 * not placed in the space of another image (see vtkPlacement).
 *
 * Input: an image. `Array` names the point data to write; without a name, the active scalars are written. Directions of three
 * numbers are written as a fifth dimension, arrays of more numbers as volumes, the fourth. The file appears whole or not at all.
 */
#ifndef vtkNiftiWriter_h
#define vtkNiftiWriter_h

#include "CactusFiltersModule.h"
#include "FilterProperties.h"

#include <vtkWriter.h>

class CACTUSFILTERS_EXPORT vtkNiftiWriter : public vtkWriter
{
public:
  static vtkNiftiWriter* New();
  vtkTypeMacro(vtkNiftiWriter, vtkWriter);
  CACTUS_PRINTS_PROPERTIES

  CACTUS_FILE_PROPERTY(FileName)
  CACTUS_TEXT_PROPERTY(Array)
  CACTUS_WHOLE_PROPERTY(LengthUnit)

protected:
  vtkNiftiWriter();
  ~vtkNiftiWriter() override = default;
  void WriteData() override;
  int FillInputPortInformation(int port, vtkInformation* info) override;

private:
  vtkNiftiWriter(const vtkNiftiWriter&) = delete;
  void operator=(const vtkNiftiWriter&) = delete;

  std::unique_ptr<cactus::FilterProperties> Properties;
};

#endif
