// SPDX-License-Identifier: BSD-3-Clause
#include "io/FolderFormat.h"
#include "io/RmsFiles.h"

namespace cactus
{

namespace
{

/// RMS: voxel labels, beside a PLY file per surface.
class RmsFormat : public FolderFormat
{
public:
  bool mayBeBinary() const override { return true; }
  bool hasStartPositions() const override { return false; }

  void requireRoom(const Domain& domain, double voxelSize) const override { requireRmsVoxels(domain, voxelSize); }

  void writeOwnFiles(const SubstrateFolderContents& contents, WrittenSubstrate& substrate, FolderWriter& writer,
    const Context& context) const override
  {
    writeRms(contents, substrate, writer, context);
  }

  std::string readme(const SubstrateFolderContents& /*contents*/, const WrittenSubstrate& /*substrate*/) const override
  {
    return "intra/, extra/  simulations for RMS (extra/ where the labels hold it): fiber.txt holds the labels of the voxels (1: "
           "walkers), simParamInput.txt their\n"
           "                size and numbers, the time step and how many "
           "(github.com/NYU-DiffusionMRI/monte-carlo-simulation-3D-RMS)\n\n"
           "    cd intra && cp .../hpc_code/lib/main.cu . && nvcc main.cu -o main_cuda && ./main_cuda\n";
  }
};

} // namespace

const FolderFormat& rmsFormat()
{
  static const RmsFormat format;
  return format;
}

} // namespace cactus
