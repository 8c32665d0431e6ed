// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vtkNIFTIImageHeader.h>
#include <vtkNIFTIImageReader.h>
#include <vtkNew.h>
#include <vtkType.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <vector>

class vtkDataArray;
class vtkInformation;
class vtkObject;

namespace cactus
{

/// VTK's reader of a NIfTI image, whose faults are exceptions.
class NiftiFile
{
public:
  /// Reads the header. Throws InvalidInput without a name, and FileError for a header that cannot be true.
  explicit NiftiFile(const std::string& path);
  NiftiFile(const NiftiFile&) = delete;
  NiftiFile& operator=(const NiftiFile&) = delete;
  ~NiftiFile() { this->Reader->RemoveAllObservers(); }

  vtkNIFTIImageHeader& header() const { return *this->Reader->GetNIFTIHeader(); }
  std::size_t size(int axis) const { return static_cast<std::size_t>(std::max<vtkTypeInt64>(1, this->dimension(axis + 1))); }
  /// Numbers of a voxel: volumes of a series, of a vector, of a colour or of a complex number.
  int components() const;
  /// VTK's type of the numbers stored.
  int storedType() const;
  /// A value is slope times the number stored, plus the intercept.
  bool isScaled() const { return this->Slope != 1.0 || this->Intercept != 0.0; }
  double slope() const { return this->Slope; }
  double intercept() const { return this->Intercept; }
  /// VTK's type of the values.
  int valueType() const;
  /// From i, j, k of VTK's image, which may have the slices of the file in reverse, to mm of the scanner.
  const Eigen::Affine3d& toScanner() const { return this->ToScanner; }

  /// Reads all numbers as they are stored. Throws FileError and OutOfMemory.
  vtkDataArray* numbers();
  /// Reads the values of one voxel, by its numbers in the file. Throws FileError, and InvalidInput for a voxel outside the image.
  std::vector<double> voxel(const std::array<std::size_t, 3>& place);

private:
  static void hear(vtkObject* object, unsigned long event, void* self, void* message);
  [[noreturn]] void fail(const std::string& why) const;
  void throwFault() const;
  /// What VTK's reader says of the numbers before it reads them.
  vtkInformation* stored() const;
  vtkTypeInt64 dimension(int i) const { return this->header().GetDim(i); }
  /// Refuses types of numbers that are none: VTK 9.3 reads memory that is not its own there.
  void requireKnownType() const;
  /// Refuses what VTK's reader takes at its word.
  void validate();
  /// VTK's reader itself refuses more than seven, and negative ones.
  void validateDimensions() const;
  void readScale(int type);
  void readPlace();

  std::string Path;
  std::string Fault;
  vtkNew<vtkNIFTIImageReader> Reader;
  double Slope = 1.0;
  double Intercept = 0.0;
  Eigen::Affine3d ToScanner = Eigen::Affine3d::Identity();
};

} // namespace cactus
