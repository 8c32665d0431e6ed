// SPDX-License-Identifier: BSD-3-Clause
#include "io/OpenSurfaces.h"

#include "base/Bytes.h"
#include "base/Error.h"
#include "io/FolderFormat.h"
#include "mesh/OpenTile.h"
#include "mesh/SurfaceIntersection.h"
#include "mesh/SurfaceWall.h"
#include "mesh/TriangleTree.h"

#include <cstdint>
#include <numeric>

namespace cactus
{

namespace
{

/// Throws if an opened inner surface, whose ends are moved into the faces, meets the outer one or itself.
void requireRoomAround(const TriangleMesh& inner, int fibreId, const FibreSurfaces& outer, const Domain& domain)
{
  const TriangleTree axon(inner);
  const auto place = outer.placeOf(fibreId);
  const TriangleMesh around = place ? openAtPeriodicFaces(outer.mesh(*place), domain) : TriangleMesh();
  const bool isBare = areSame(inner, around); // of an axon without myelin both surfaces are the same
  const bool meets = meetsItself(axon) || (place && !isBare && surfacesMeet(axon, TriangleTree(around)));
  if (meets)
  {
    throw InvalidInput(text("PeriodicFaces Open: extended to the domain's faces, the inner surface of fibre ", fibreId,
      " meets its outer one or itself: choose PeriodicFaces Caps, or another Seed of BundleInitializer"));
  }
}

} // namespace

PeriodicFaces facesFor(PeriodicFaces asked, SubstrateFormat format, const Domain& domain, bool allowOpenSurfaces)
{
  if (asked != PeriodicFaces::ByFormat)
  {
    return asked;
  }
  const bool isOpen = format == SubstrateFormat::Mcdc && domain.isPeriodic() && !allowOpenSurfaces;
  return isOpen ? PeriodicFaces::Open : PeriodicFaces::Caps;
}

void requireOpenable(PeriodicFaces faces, SubstrateFormat format, bool allowOpenSurfaces)
{
  if (faces != PeriodicFaces::Open)
  {
    return;
  }
  if (!formatOf(format).mayBeOpen())
  {
    throw InvalidInput(text("PeriodicFaces Open leaves surfaces open, and Format ", formatNames[std::size_t(format)],
      " needs closed ones to tell inside from outside: choose PeriodicFaces Caps, or Format ",
      formatsThat(&FolderFormat::mayBeOpen)));
  }
  require(!allowOpenSurfaces,
    "PeriodicFaces Open takes the caps off closed surfaces, and with AllowOpenSurfaces they need not be closed: turn that off");
}

void requirePeriodic(PeriodicFaces faces, const Domain& domain)
{
  require(faces != PeriodicFaces::Open || domain.isPeriodic(),
    "PeriodicFaces Open is for a periodic Domain, in whose faces surfaces go on, and this one is not periodic: choose "
    "PeriodicFaces "
    "Caps, or Border Periodic or Periodic across in BundleInitializer");
}

FibreSurfaces openedSurfaces(const FibreSurfaces& surfaces, const std::string& kind, const Domain& domain)
{
  FibreSurfaces open = surfaces;
  open.mesh = [mesh = surfaces.mesh, ids = surfaces.fibreIds, kind, domain](std::size_t i)
  {
    try
    {
      return openAtPeriodicFaces(mesh(i), domain);
    }
    catch (const InvalidInput& error)
    {
      throw InvalidInput(text("PeriodicFaces Open: the ", kind, " surface of fibre ", ids[i], error.what(),
        ", and copies of it would not join: choose PeriodicFaces Caps"));
    }
  };
  return open;
}

void describeOpened(const SubstrateFolderContents& contents, const std::string& kind, std::vector<SubstrateFile>& files,
  const Context& context, const Sharing& sharing, double from, double to)
{
  const FibreSurfaces open = openedSurfaces(kind == "outer" ? contents.outer : contents.inner, kind, contents.domain);
  const auto describe = [&](std::size_t i)
  {
    const TriangleMesh mesh = open.mesh(i);
    if (kind == "inner")
    {
      requireRoomAround(mesh, open.fibreIds[i], contents.outer, contents.domain);
    }
    std::vector<std::uint32_t> all(mesh.triangles.size());
    std::iota(all.begin(), all.end(), 0U);
    files[i].closed = files[i].closed && mesh.triangles.size() == files[i].triangles;
    files[i].triangles = mesh.triangles.size();
    files[i].area = areaOf(mesh, all);
  };
  const auto described = [&](std::size_t i) { return bytesOf(files[i].triangles, files[i].area, files[i].closed); };
  const auto take = [&](std::size_t i, const std::string& bytes)
  { getAll(bytes, files[i].triangles, files[i].area, files[i].closed); };
  sharing.loop(open.size(), context, describe, described, take, "Opening surfaces", from, to);
}

} // namespace cactus
