// SPDX-License-Identifier: BSD-3-Clause
#include "base/Error.h"
#include "base/Memory.h"
#include "io/ElementFiles.h"
#include "io/FolderFormat.h"

#include <cstdint>

namespace cactus
{

namespace
{

/// SpinDoctor and finite elements: one complex of triangles for tetgen, beside a PLY file per surface.
class SpinDoctorFormat : public FolderFormat
{
public:
  bool mayBeBinary() const override { return true; }
  bool hasStartPositions() const override { return false; }

  void requireContents(const SubstrateFolderContents& contents) const override
  {
    require(contents.outer.size() > 0, "Format SpinDoctor has a compartment outside the fibres: connect MyelinSurface's Outer");
  }

  /// All surfaces are joined in memory.
  void requireMemory(const SubstrateCertificate& certificate) const override
  {
    constexpr double bytesOfTriangle = 80.0; // twice with its part of the points, once with the compartments of its sides
    double triangles = 0.0;
    for (const FibreCertificate& fibre : certificate.fibres)
    {
      triangles += double(fibre.outer.triangles) + double(fibre.inner.triangles);
    }
    cactus::requireMemory(bytesOfTriangle * triangles,
      "Format SpinDoctor, which joins " + std::to_string(std::uint64_t(triangles)) + " triangles,",
      "choose another Format, or make a smaller substrate");
  }

  void writeOwnFiles(const SubstrateFolderContents& contents, WrittenSubstrate& substrate, FolderWriter& writer,
    const Context& context) const override
  {
    substrate.remarks = writeElementFiles(contents, substrate.certificate.smallestGap, writer, context);
  }

  std::string readme(const SubstrateFolderContents& /*contents*/, const WrittenSubstrate& /*substrate*/) const override
  {
    return "substrate_dir/  all surfaces and the faces of the domain as one complex of triangles, in micrometres\n"
           "compartments.csv   which compartment is which fibre's, with its volume\n\n"
           "    tetgen -pqA substrate_dir/substrate_mesh.poly   (any finite elements)\n\n"
           "setup_substrate.m, substrate_cells   for SpinDoctor (github.com/SpinDoctorMRI/SpinDoctor), in MATLAB, in its "
           "folder:\n\n"
           "    addpath(genpath('src')); run('.../setup_substrate.m')\n"
           "    setup.pde = prepare_pde(setup); setup = prepare_experiments(setup);\n"
           "    femesh = create_geometry(setup);\n";
  }
};

} // namespace

const FolderFormat& spinDoctorFormat()
{
  static const SpinDoctorFormat format;
  return format;
}

} // namespace cactus
