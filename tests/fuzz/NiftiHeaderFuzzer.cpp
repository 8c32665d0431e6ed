// SPDX-License-Identifier: BSD-3-Clause
// Any bytes as the header of a NIfTI image: a grid of some volume with countable numbers, or one error of ours.
#include "base/Error.h"
#include "io/NiftiFile.h"

#include "Fuzzing.h"

#include <Eigen/LU>

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv)
{
  const std::string one("\0\0\x80\x3f", 4);
  std::string first(348, '\0');
  first.replace(0, 4, std::string("\x5c\1\0\0", 4));
  first.replace(40, 10, std::string("\4\0\2\0\3\0\4\0\5\0", 10));
  first.replace(70, 4, std::string("\4\0\x10\0", 4));
  first.replace(76, 16, one + one + one + one);
  first.replace(108, 4, std::string("\0\0\xb0\x43", 4)); // 352
  first[252] = '\1';
  first.replace(344, 4, std::string("n+1\0", 4));
  std::string byRows = first;
  byRows[254] = '\1';
  for (const std::size_t diagonal : { 280, 300, 320 })
  {
    byRows.replace(diagonal, 4, one);
  }
  const std::string wideOne("\0\0\0\0\0\0\xf0\x3f", 8);
  std::string second(540, '\0');
  second.replace(0, 12, std::string("\x1c\2\0\0n+2\0\r\n\x1a\n", 12));
  second.replace(12, 4, std::string("\4\0\x10\0", 4));
  for (const std::size_t dimension : { 16, 24, 32, 40 })
  {
    second[dimension] = '\3';
  }
  second.replace(168, 2, std::string("\x20\2", 2)); // 544
  second[348] = '\1';
  for (const std::size_t diagonal : { 400, 440, 480 })
  {
    second.replace(diagonal, 8, wideOne);
  }
  writeSeeds(*argc, *argv, { first, byRows, second });
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  try
  {
    const auto header = cactus::parseNiftiHeader(std::string(reinterpret_cast<const char*>(data), size), "fuzz.nii");
    promise(header.voxels() > 0 && header.numbersPerVoxel() > 0, "there are numbers");
    promise(header.valueBytes() < 1e19, "their bytes can be counted");
    const cactus::NiftiGrid grid(header);
    promise(grid.size[0] * grid.size[1] * grid.size[2] == header.voxels(), "the grid has all voxels");
    promise(grid.origin.allFinite() && grid.spacing.minCoeff() > 0.0, "the grid has a place");
    promise(grid.axes.determinant() > 0.0, "the grid is right-handed");
  }
  catch (const cactus::FileError&)
  {
  }
  return 0;
}
