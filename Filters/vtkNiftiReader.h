// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkNiftiReader
 * @brief Reads images in NIfTI-1 and NIfTI-2 (.nii, .hdr with .img), also packed by gzip, where they lie in the scanner's space.
 *
 * Output: an image whose grid has origin, spacing and directions by the s-form or, where its code is 0, by the q-form, in mm or
 * µm by `LengthUnit`. Its axes are those of the file, in the order and the sense closest to right, front and up, so that slices
 * are sagittal, coronal and axial; no voxel is resampled. Point data: one array with the name of the file, whose components are
 * the volumes of a series, the numbers of a vector, the coefficients of spherical harmonics, or red, green and blue. Its values
 * are those that the header means by its scale.
 *
 * It stands on vtkNIFTIImageReader, which gives place and scale apart from the image, and takes a header at its word: what that
 * would not survive is refused before.
 */
#ifndef vtkNiftiReader_h
#define vtkNiftiReader_h

#include "CactusFiltersModule.h"
#include "FilterProperties.h"

#include <vtkImageAlgorithm.h>

class CACTUSFILTERS_EXPORT vtkNiftiReader : public vtkImageAlgorithm
{
public:
  static vtkNiftiReader* New();
  vtkTypeMacro(vtkNiftiReader, vtkImageAlgorithm);
  CACTUS_PRINTS_PROPERTIES

  /** Whether the file is one of these by its content (ParaView asks before it offers this reader). */
  int CanReadFile(const char* name);

  CACTUS_FILE_PROPERTY(FileName)
  CACTUS_WHOLE_PROPERTY(LengthUnit)

  CACTUS_COUNTS_AS_CHANGED_ONCE_STOPPED
  CACTUS_ABORT_IS_NO_CHANGE

protected:
  vtkNiftiReader();
  ~vtkNiftiReader() override = default;
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkNiftiReader(const vtkNiftiReader&) = delete;
  void operator=(const vtkNiftiReader&) = delete;

  std::unique_ptr<cactus::FilterProperties> Properties;
};

#endif
