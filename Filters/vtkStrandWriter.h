// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkStrandWriter
 * @brief Writes fibres in the CACTUS strand text format (µm, nine significant digits).
 *
 * Input: polylines with point data `Radius`; the format holds a centred cube, positions and radii, no ids. The file appears whole
 * or not at all.
 */
#ifndef vtkStrandWriter_h
#define vtkStrandWriter_h

#include "CactusFiltersModule.h"
#include "FilterProperties.h"

#include <vtkWriter.h>

class CACTUSFILTERS_EXPORT vtkStrandWriter : public vtkWriter
{
public:
  static vtkStrandWriter* New();
  vtkTypeMacro(vtkStrandWriter, vtkWriter);
  CACTUS_PRINTS_PROPERTIES

  CACTUS_FILE_PROPERTY(FileName)

protected:
  vtkStrandWriter();
  ~vtkStrandWriter() override = default;
  void WriteData() override;
  int FillInputPortInformation(int port, vtkInformation* info) override;

private:
  vtkStrandWriter(const vtkStrandWriter&) = delete;
  void operator=(const vtkStrandWriter&) = delete;

  std::unique_ptr<cactus::FilterProperties> Properties;
};

#endif
