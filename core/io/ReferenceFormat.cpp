// SPDX-License-Identifier: BSD-3-Clause
#include "base/Error.h"
#include "io/FolderFormat.h"

namespace cactus
{

namespace
{

/// The reference program's run folder, as dmipy-sim loads it.
class ReferenceFormat : public FolderFormat
{
public:
  bool hasSurfaceFolders() const override { return false; }
  std::string strandsName() const override { return "optimized_final.txt"; }

  void requireContents(const SubstrateFolderContents& contents) const override
  {
    require(contents.fibres != nullptr && contents.inner.size() > 0,
      "Format Reference program has both surfaces of each fibre and their centre lines: connect Inner and Fibres");
  }

  void requireRoom(const Domain& domain, double /*voxelSize*/) const override
  {
    require(fitsStrandFile(domain) && isCube(domain),
      "Format Reference program has the fibres in a strand file, of which that program reads only those of a cube centred on the "
      "origin, and the Domain "
      "is something else: choose another Format");
  }

  std::string surfacePath(const SurfaceName& name) const override
  {
    return "meshes/simulations/strand_" + name.fibre + '_' + name.kind + "_erode_0.ply";
  }

  std::string readme(const SubstrateFolderContents& /*contents*/, const WrittenSubstrate& /*substrate*/) const override
  {
    return "optimized_final.txt, meshes/simulations/   as the reference program leaves them, in micrometres\n\n"
           "    from dmipy_sim.io.cactus import load_cactus_bundle\n"
           "    bundle = load_cactus_bundle('.', volume_reference='box')\n";
  }
};

} // namespace

const FolderFormat& referenceFormat()
{
  static const ReferenceFormat format;
  return format;
}

} // namespace cactus
