// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkTractogramReader
 * @brief Reads streamlines from tractograms: MRtrix's .tck, TrackVis's .trk (versions 1 to 3), these packed by gzip, and .trx, an
 * archive or a folder.
 *
 * Output: one polyline per streamline of two points or more, in the scanner's space (RAS), in µm or mm by `LengthUnit`. The
 * file's data per point become point data, those per streamline cell data, by their names; an array `Radius` is a length, in mm
 * in the file. Groups become cell data `BundleId`, from 1 in the order of the field data `BundleName`, for the first group of a
 * streamline (number of groups plus one, if it is in none), unless the file has values of that name; if a streamline is in
 * several, each group is also cell data `Group NAME` (0 or 1). With `Radius` above 0, a file without radii gives fibres of that
 * radius.
 *
 * A warning reports each assumption or omission. A file that is truncated or damaged gives one error, and no output.
 */
#ifndef vtkTractogramReader_h
#define vtkTractogramReader_h

#include "CactusFiltersModule.h"
#include "FilterProperties.h"

#include <vtkPolyDataAlgorithm.h>

class CACTUSFILTERS_EXPORT vtkTractogramReader : public vtkPolyDataAlgorithm
{
public:
  static vtkTractogramReader* New();
  vtkTypeMacro(vtkTractogramReader, vtkPolyDataAlgorithm);
  CACTUS_PRINTS_PROPERTIES

  /** Whether the file is one of these by its content (ParaView asks before it offers this reader). */
  int CanReadFile(const char* name);

  CACTUS_FILE_PROPERTY(FileName)
  CACTUS_WHOLE_PROPERTY(LengthUnit)
  CACTUS_NUMBER_PROPERTY(Radius)

  CACTUS_COUNTS_AS_CHANGED_ONCE_STOPPED
  CACTUS_ABORT_IS_NO_CHANGE

protected:
  vtkTractogramReader();
  ~vtkTractogramReader() override = default;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkTractogramReader(const vtkTractogramReader&) = delete;
  void operator=(const vtkTractogramReader&) = delete;

  std::unique_ptr<cactus::FilterProperties> Properties;
};

#endif
