// SPDX-License-Identifier: BSD-3-Clause
#include "io/FolderFormat.h"

#include <map>

namespace cactus
{

namespace
{

/// The surfaces of a bundle.
struct BundleSurfaces
{
  FibreSurfaces surfaces;
  std::vector<std::size_t> places; ///< indices among all
};

/// Groups the surfaces by bundle. `all` has to outlive the result.
std::map<int, BundleSurfaces> byBundle(const FibreSurfaces& all)
{
  std::map<int, BundleSurfaces> bundles;
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    BundleSurfaces& bundle = bundles[all.bundleIds[i]];
    bundle.surfaces.fibreIds.push_back(all.fibreIds[i]);
    bundle.surfaces.bundleIds.push_back(all.bundleIds[i]);
    bundle.places.push_back(i);
  }
  for (auto& entry : bundles)
  {
    BundleSurfaces& bundle = entry.second;
    bundle.surfaces.mesh = [&all, &bundle](std::size_t i) { return all.mesh(bundle.places[i]); };
  }
  return bundles;
}

/// For no simulator: a PLY file per bundle and kind of surface.
class BundlesFormat : public FolderFormat
{
public:
  bool mayBeBinary() const override { return true; }
  bool mayBeOpen() const override { return true; }
  bool mayBeSample() const override { return true; }
  const char* fileHolds() const override { return "bundle"; }

  std::string surfacePath(const SurfaceName& name) const override { return name.kind + "/bundle_" + name.bundle + ".ply"; }

  void writeSurfaces(const SurfacesToWrite& written, FolderWriter& writer, const WritingRun& run) const override
  {
    prepareFiles(written.files, writer, run);
    const std::map<int, BundleSurfaces> bundles = byBundle(written.surfaces);
    std::vector<const BundleSurfaces*> inTurn;
    inTurn.reserve(bundles.size());
    for (const auto& entry : bundles)
    {
      inTurn.push_back(&entry.second);
    }
    const auto fileOf = [&](std::size_t i) -> const SubstrateFile& { return written.files[inTurn[i]->places.front()]; };
    const Context context = run.context.forThreads();
    std::vector<std::string> checksums(inTurn.size());
    run.sharing.loop(
      inTurn.size(), context,
      [&](std::size_t i)
      {
        const SubstrateFile& file = fileOf(i);
        const std::string comment =
          "CACTUS " CACTUS_VERSION ", " + file.surface + " surfaces of bundle " + std::to_string(file.bundleId) + ", micrometres";
        checksums[i] = writeBundleSurfaces(inTurn[i]->surfaces, file.path, comment, written.encoding, writer, context);
      },
      [&](std::size_t i) { return checksums[i]; }, [&](std::size_t i, const std::string& checksum) { checksums[i] = checksum; },
      "Writing surfaces", run.from, run.to);
    for (std::size_t i = 0; i < inTurn.size(); ++i)
    {
      writer.remember(fileOf(i).path, checksums[i]);
    }
  }

  std::string readme(const SubstrateFolderContents& /*contents*/, const WrittenSubstrate& /*substrate*/) const override
  {
    return "\nIn a file fibres follow each other by their ids, each with the triangles that manifest.json tells of it.\n";
  }
};

} // namespace

const FolderFormat& bundlesFormat()
{
  static const BundlesFormat format;
  return format;
}

} // namespace cactus
