// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkTractogramWriter
 * @brief Writes fibres as a tractogram for MRtrix, dipy and others: .tck (centre lines) or .trx (with radii, ids, bundles), in
 * mm, or in µm by `LengthUnit`.
 *
 * Input: polylines with point data `Radius` (µm; mm where they come from a vtkTractogramReader with that `LengthUnit`). A .trx
 * has `dpv/Radius`, `dps/FibreId`, `dps/BundleId` and a group for each bundle. The file appears whole or not at all.
 */
#ifndef vtkTractogramWriter_h
#define vtkTractogramWriter_h

#include "CactusFiltersModule.h"
#include "FilterProperties.h"

#include <vtkWriter.h>

class CACTUSFILTERS_EXPORT vtkTractogramWriter : public vtkWriter
{
public:
  static vtkTractogramWriter* New();
  vtkTypeMacro(vtkTractogramWriter, vtkWriter);
  CACTUS_PRINTS_PROPERTIES

  CACTUS_FILE_PROPERTY(FileName)
  CACTUS_WHOLE_PROPERTY(LengthUnit)

protected:
  vtkTractogramWriter();
  ~vtkTractogramWriter() override = default;
  void WriteData() override;
  int FillInputPortInformation(int port, vtkInformation* info) override;

private:
  vtkTractogramWriter(const vtkTractogramWriter&) = delete;
  void operator=(const vtkTractogramWriter&) = delete;

  std::unique_ptr<cactus::FilterProperties> Properties;
};

#endif
