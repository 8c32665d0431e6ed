// SPDX-License-Identifier: BSD-3-Clause
#include "io/ElementFiles.h"

#include "base/AtomicFile.h"
#include "base/Constants.h"
#include "base/Error.h"
#include "base/Numbers.h"
#include "base/Parallel.h"
#include "io/PlyFile.h"
#include "mesh/BoxedSurfaces.h"
#include "mesh/SurfaceIntersection.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <functional>

namespace cactus
{

namespace
{

/// µm. MyelinSurface ends axons at most a quarter of a voxel before a face.
constexpr double furthestExtension = 0.5;
constexpr char place[] = "substrate_dir/substrate_mesh";

/// The numbers of compartments, from 0. Those of myelin are by their places among the sheaths.
struct CompartmentNumbers
{
  std::int32_t axons = 0;
  std::int32_t sheaths = 0;

  std::int32_t axon(std::size_t inner) const { return static_cast<std::int32_t>(inner); }
  std::int32_t myelin(std::size_t sheath) const { return this->axons + static_cast<std::int32_t>(sheath); }
  std::int32_t extraAxonal() const { return this->axons + this->sheaths; }
  std::int32_t count() const { return this->extraAxonal() + 1; }
  /// Returns the boundary of a triangle, from 0, by the compartments behind and before it: interfaces by the one behind, then
  /// faces of the domain.
  std::int32_t boundary(const std::array<std::int32_t, 2>& sides) const
  {
    return sides[0] + (sides[1] == BoxedSurfaces::beyond ? this->extraAxonal() : 0);
  }
};

/// Extends an axon up to the domain's faces, except those where it would meet the outer surface, or itself. Returns whether it
/// reaches all of them.
bool extendAxon(TriangleMesh& inner, const TriangleMesh& outer, const Domain& domain)
{
  const TriangleTree around(outer, trianglesOffFaces(outer, domain));
  bool isWhole = true;
  for (int face = 0; face < 6; ++face)
  {
    TriangleMesh extended = inner;
    if (extendToFace(extended, domain, face, furthestExtension))
    {
      const TriangleTree wall(extended, trianglesOffFaces(extended, domain));
      const bool meets = surfacesMeet(wall, around) || meetsItself(wall);
      isWhole = isWhole && !meets;
      inner = meets ? inner : std::move(extended);
    }
  }
  return isWhole;
}

/// The surfaces between compartments, as in the PLY files except for the axons' ends.
struct Compartments
{
  std::vector<CompartmentSurface> surfaces; ///< axons, then sheaths
  std::vector<std::size_t> sheaths;         ///< indices of outer surfaces that bound myelin; that of a bare axon is its wall
  CompartmentNumbers numbers;
  std::vector<int> closed; ///< fibres whose axons do not reach all faces
};

/// Returns the index of each axon's outer surface.
std::vector<std::size_t> outerSurfacesOf(const SubstrateFolderContents& contents)
{
  std::vector<std::size_t> found;
  for (const int id : contents.inner.fibreIds)
  {
    const auto place = contents.outer.placeOf(id);
    if (!place)
    {
      throw InvalidInput(text("fibre ", id, " has an inner surface and no outer one, between which its myelin would be"));
    }
    found.push_back(*place);
  }
  return found;
}

Compartments compartmentsOf(const SubstrateFolderContents& contents, const Context& context)
{
  const std::vector<std::size_t> outerOf = outerSurfacesOf(contents);
  std::vector<TriangleMesh> outer(contents.outer.size());
  parallelFor(outer.size(), context, [&](std::size_t i) { outer[i] = asWritten(contents.outer.mesh(i), contents.encoding); });
  Compartments all;
  all.surfaces.resize(contents.inner.size());
  std::vector<char> isBare(outer.size(), 0);
  std::vector<char> isExtended(contents.inner.size(), 1);
  parallelFor(contents.inner.size(), context,
    [&](std::size_t i)
    {
      TriangleMesh& inner = all.surfaces[i].mesh;
      inner = asWritten(contents.inner.mesh(i), contents.encoding);
      isBare[outerOf[i]] = areSame(inner, outer[outerOf[i]]);
      isExtended[i] = isBare[outerOf[i]] != 0 || extendAxon(inner, outer[outerOf[i]], contents.domain);
    });
  std::vector<std::size_t> sheathOf(outer.size(), 0);
  for (std::size_t i = 0; i < outer.size(); ++i)
  {
    sheathOf[i] = all.sheaths.size();
    if (isBare[i] == 0)
    {
      all.sheaths.push_back(i);
    }
  }
  all.numbers = { static_cast<std::int32_t>(contents.inner.size()), static_cast<std::int32_t>(all.sheaths.size()) };
  for (std::size_t i = 0; i < outerOf.size(); ++i)
  {
    const bool hasMyelin = isBare[outerOf[i]] == 0;
    all.surfaces[i].inside = all.numbers.axon(i);
    all.surfaces[i].outside = hasMyelin ? all.numbers.myelin(sheathOf[outerOf[i]]) : all.numbers.extraAxonal();
    if (!isExtended[i])
    {
      all.closed.push_back(contents.inner.fibreIds[i]);
    }
  }
  for (std::size_t sheath = 0; sheath < all.sheaths.size(); ++sheath)
  {
    all.surfaces.push_back({ std::move(outer[all.sheaths[sheath]]), all.numbers.myelin(sheath), all.numbers.extraAxonal() });
  }
  return all;
}

void appendPlace(std::string& text, const Eigen::Vector3d& point)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    text += ' ' + exactText(point[axis]);
  }
}

/// Writes a file line by line.
void writeLines(const std::string& path, FolderWriter& writer, const Context& context, const std::string& head, std::size_t count,
  const std::function<std::string(std::size_t)>& line, const std::string& tail)
{
  constexpr std::size_t block = 4096;
  writer.writeBy(path,
    [&](const std::string& where)
    {
      AtomicFile file(where);
      file.stream() << head;
      for (std::size_t i = 0; i < count; ++i)
      {
        if (i % block == 0)
        {
          context.checkpoint();
        }
        file.stream() << line(i);
      }
      file.stream() << tail;
      file.commit();
    });
}

/// Writes the complex for SpinDoctor, whose reader counts lines: comments have fixed lines.
void writeComplex(const BoxedSurfaces& joined, const std::vector<CompartmentPoint>& points, const CompartmentNumbers& numbers,
  FolderWriter& writer, const Context& context)
{
  writeLines(
    std::string(place) + ".node", writer, context,
    "# CACTUS " CACTUS_VERSION ": points of a substrate, micrometres\n# number, dimension, attributes, markers\n" +
      std::to_string(joined.mesh.points.size()) + " 3 0 0\n# point x y z\n",
    joined.mesh.points.size(),
    [&](std::size_t i)
    {
      std::string line = std::to_string(i + 1);
      appendPlace(line, joined.mesh.points[i]);
      return line + '\n';
    },
    "");
  std::string regions =
    "# holes\n0\n# regions: x y z compartment largest volume (-1: any)\n" + std::to_string(points.size()) + '\n';
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    regions += std::to_string(i + 1);
    appendPlace(regions, points[i].point);
    regions += ' ' + std::to_string(points[i].compartment + 1) + " -1\n";
  }
  writeLines(
    std::string(place) + ".poly", writer, context,
    "# CACTUS " CACTUS_VERSION ": surfaces of a substrate and faces of its domain\n# points are in the .node file\n0\n"
    "# facets\n# number, with boundary markers\n" +
      std::to_string(joined.mesh.triangles.size()) + " 1\n# polygons, holes, boundary; then corners\n",
    joined.mesh.triangles.size(),
    [&](std::size_t t)
    {
      const auto& corners = joined.mesh.triangles[t];
      std::string line = "1 0 " + std::to_string(numbers.boundary(joined.sides[t]) + 1) + "\n3";
      for (const std::int32_t corner : corners)
      {
        line += ' ' + std::to_string(corner + 1);
      }
      return line + '\n';
    },
    regions);
}

std::string compartmentTable(
  const SubstrateFolderContents& contents, const Compartments& compartments, const std::vector<double>& volumes)
{
  const CompartmentNumbers& numbers = compartments.numbers;
  std::string table = "Compartment,Kind,FibreId,BundleId,Volume_um3\n";
  const auto add = [&](std::int32_t number, const std::string& kind, int fibre, int bundle)
  {
    table += std::to_string(number + 1) + ',' + kind + ',' + std::to_string(fibre) + ',' + std::to_string(bundle) + ',';
    appendNumber(table, volumes[std::size_t(number)], 9);
    table += '\n';
  };
  for (std::size_t i = 0; i < contents.inner.size(); ++i)
  {
    add(numbers.axon(i), "axon", contents.inner.fibreIds[i], contents.inner.bundleIds[i]);
  }
  for (std::size_t i = 0; i < compartments.sheaths.size(); ++i)
  {
    const std::size_t outer = compartments.sheaths[i];
    add(numbers.myelin(i), "myelin", contents.outer.fibreIds[outer], contents.outer.bundleIds[outer]);
  }
  add(numbers.extraAxonal(), "extra-axonal", 0, 0);
  return table;
}

/// Returns the circles from which SpinDoctor would have made cylinders; it requires the file, and shows them.
std::string cellText(
  const std::vector<CompartmentSurface>& surfaces, const CompartmentNumbers& numbers, const std::vector<double>& volumes)
{
  std::vector<double> within(volumes.size(), 0.0); // volume directly within each compartment
  for (const CompartmentSurface& surface : surfaces)
  {
    within[std::size_t(surface.outside)] += volumes[std::size_t(surface.inside)];
  }
  std::string text = "# number of cells\n" + std::to_string(numbers.sheaths) + "\n# dimension\n2\n# cell x y radius\n";
  for (std::int32_t i = 0; i < numbers.sheaths; ++i)
  {
    const CompartmentSurface& outer = surfaces[std::size_t(numbers.axons + i)];
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& point : outer.mesh.points)
    {
      box.extend(point);
    }
    const double volume = within[std::size_t(outer.inside)] + volumes[std::size_t(outer.inside)];
    text += std::to_string(i + 1);
    for (const double number : { box.center()[0], box.center()[1], std::sqrt(volume / (pi * box.sizes().maxCoeff())) })
    {
      text += ' ';
      appendNumber(text, number, 9);
    }
    text += '\n';
  }
  return text;
}

/// Returns a first simulation for SpinDoctor: that of MC/DC's scheme, in µm and µs.
std::string setupText(const SubstrateFolderContents& contents, const CompartmentNumbers& numbers)
{
  constexpr double second = 1e6;               // µs
  constexpr double squareMetrePerSecond = 1e6; // µm²/µs
  const McdcOptions& options = contents.mcdc;
  const double diffusivity = squareMetrePerSecond * options.diffusivity;
  TextStream out;
  out.precision(9);
  out << "% SpinDoctor setup of a substrate of CACTUS " CACTUS_VERSION ". Lengths are in micrometres, times in microseconds.\n"
      << "setup.name = fileparts(mfilename(\"fullpath\")) + \"/substrate\";\n"
      << "% Without setup.geometry.refinement: with it SpinDoctor looks for files of another name, and makes cylinders.\n"
      << "setup.geometry.cell_shape = \"cylinder\";\n"
      << "setup.geometry.ncell = " << numbers.sheaths << ";\n"
      << "setup.geometry.rmin = 0.1;\nsetup.geometry.rmax = 1;\nsetup.geometry.dmin = 0.1;\nsetup.geometry.dmax = 0.2;\n"
      << "setup.geometry.height = " << contents.domain.size()[2] << ";\n"
      << "setup.geometry.deformation = [0; 0];\n"
      << "setup.geometry.include_in = " << (numbers.axons > 0 ? "true" : "false") << ";\n"
      << "setup.geometry.in_ratio = 0.7;\n"
      << "setup.geometry.ecs_shape = \"box\";\n"
      << "setup.geometry.ecs_ratio = 0.1;\n\n";
  for (const char* compartment : { "in", "out", "ecs" })
  {
    out << "setup.pde.diffusivity_" << compartment << " = " << diffusivity << ";\n"
        << "setup.pde.relaxation_" << compartment << " = Inf;\n"
        << "setup.pde.initial_density_" << compartment << " = 1;\n"
        << "setup.pde.permeability_" << compartment << " = 0;\n";
  }
  out << "setup.pde.permeability_in_out = 0;\nsetup.pde.permeability_out_ecs = 0;\n\n"
      << "setup.gradient.values = [0";
  for (const double b : options.bValues)
  {
    out << ' ' << b / squareMetrePerSecond;
  }
  out << "];\nsetup.gradient.values_type = \"b\";\n"
      << "setup.gradient.sequences = {PGSE(" << second * options.gradientDuration << ", " << second * options.gradientSeparation
      << ")};\nsetup.gradient.directions = [";
  for (const Eigen::Vector3d& direction : mcdcDirections(options.directions))
  {
    out << direction[0] << ' ' << direction[1] << ' ' << direction[2] << "; ";
  }
  out << "]';\n\nsetup.btpde.ode_solver = @ode15s;\nsetup.btpde.reltol = 1e-4;\nsetup.btpde.abstol = 1e-6;\n";
  return out.str();
}

std::vector<std::string> remarksOn(
  const BoxedSurfaces& joined, const Compartments& compartments, std::size_t fibres, double smallestGap)
{
  const CompartmentNumbers& numbers = compartments.numbers;
  const std::vector<int>& closed = compartments.closed;
  constexpr double narrow = 0.1; // µm, see docs/simulators/spindoctor.md
  std::vector<std::string> remarks;
  if (smallestGap < narrow)
  {
    remarks.push_back(text("The smallest gap between two fibres is ", smallestGap, " µm: gaps below ", narrow,
      " µm take tetgen so many tetrahedra that it may not end in reasonable time (240 s were not enough at 0.02 µm and 8 µm). "
      "Grow with a MinimumGap of ",
      narrow, " µm or more, and make even triangles with MinimumAngle 20"));
  }
  if (!closed.empty())
  {
    remarks.push_back(text("The axons of ", closed.size(), " fibres (such as ", closed.front(),
      ") end just before the faces of the domain, in myelin, since they would meet its surface up to the faces"));
  }
  std::vector<char> isThere(std::size_t(2 * numbers.count() - 1), 0);
  for (const auto& sides : joined.sides)
  {
    isThere[std::size_t(numbers.boundary(sides))] = 1;
  }
  const bool hasAll = std::all_of(isThere.begin(), isThere.end(), [](char there) { return there != 0; });
  if (!hasAll || (numbers.axons > 0 && numbers.axons != numbers.sheaths))
  {
    remarks.push_back(text("SpinDoctor's create_geometry refuses this mesh, since not every one of the ", fibres,
      " fibres has an axon and myelin, and both end in a face of the domain: call tetgen yourself, and give split_mesh what "
      "read_tetgen "
      "reads"));
  }
  return remarks;
}

} // namespace

std::vector<std::string> writeElementFiles(
  const SubstrateFolderContents& contents, double smallestGap, FolderWriter& writer, const Context& context)
{
  const Compartments compartments = compartmentsOf(contents, context);
  const CompartmentNumbers& numbers = compartments.numbers;
  const BoxedSurfaces joined = joinInBox(contents.domain, compartments.surfaces, numbers.extraAxonal());
  const std::vector<double> volumes = joined.volumes(std::size_t(numbers.count()));
  writer.makeFolder("substrate_dir");
  writeComplex(joined, joined.pointsInside(context), numbers, writer, context);
  writer.write("compartments.csv", compartmentTable(contents, compartments, volumes));
  writer.write("substrate_cells", cellText(compartments.surfaces, numbers, volumes));
  writer.write("setup_substrate.m", setupText(contents, numbers));
  return remarksOn(joined, compartments, contents.outer.size(), smallestGap);
}

} // namespace cactus
