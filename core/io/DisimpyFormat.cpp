// SPDX-License-Identifier: BSD-3-Clause
#include "io/FolderFormat.h"

namespace cactus
{

namespace
{

/// NumPy arrays of vertices (m) and faces per kind of surface.
class DisimpyFormat : public FolderFormat
{
public:
  bool hasSurfaceFolders() const override { return false; }
  double startUnit() const override { return 1e-6; }
  bool isReadable() const override { return false; } // the place of their box is lost

  /// Disimpy moves a mesh to the lower corner of its box.
  SurfaceBox startBox(const FibreSurfaces& surfaces, const Domain& /*domain*/, const Context& context) const override
  {
    return surfaceBox(surfaces, context);
  }

  std::string surfacePath(const SurfaceName& name) const override { return name.kind + "_vertices.npy"; }

  void writeSurfaces(const SurfacesToWrite& written, FolderWriter& writer, const WritingRun& run) const override
  {
    run.context.report(run.from, "Writing surfaces");
    if (run.sharing.isFirst())
    {
      writeDisimpySurfaces(written.surfaces, written.kind, writer, run.context);
    }
  }

  std::string readme(const SubstrateFolderContents& contents, const WrittenSubstrate& /*substrate*/) const override
  {
    return std::string(
             "outer_vertices.npy, outer_faces.npy, inner_...   all outer, and all inner, surfaces, in metres, with their box's "
             "lower\n"
             "corner at the origin (Disimpy)\n\n"
             "    vertices, faces = numpy.load('inner_vertices.npy'), numpy.load('inner_faces.npy')\n"
             "    substrate = disimpy.substrates.mesh(vertices, faces, periodic=False, init_pos='intra')\n") +
           (contents.domain.periodic[2]
               ? "\nOutside the fibres: outer_vertices.npy, outer_faces.npy, periodic=True, init_pos='extra'.\n"
               : "");
  }
};

} // namespace

const FolderFormat& disimpyFormat()
{
  static const DisimpyFormat format;
  return format;
}

} // namespace cactus
