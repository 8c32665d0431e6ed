// SPDX-License-Identifier: BSD-3-Clause
// cactus_mesh_oracle [--gap DISTANCE] FOLDER: judges the surfaces in a folder, by CGAL with exact predicates.
//
// Shares no code with the product, so that it can judge the product's surfaces independently. Reads every .ply and .off below
// FOLDER and prints one JSON object:
//   summary: counts over all meshes and pairs
//   meshes:  per file its numbers, and whether it is closed, manifold, outward and free of self-intersections
//   pairs:   those that intersect ("intersect"), that lie inside one another ("a_in_b", "b_in_a"; "a_partly_in_b",
//            "b_partly_in_a" if only some connected pieces do) or, with --gap, that come closer than DISTANCE ("near"), with
//            their distance
// Touching counts as intersecting. The result is 0 whatever is found, 1 if a file cannot be read, 2 for wrong arguments.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/IO/OFF.h>
#include <CGAL/IO/PLY.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Segment = Kernel::Segment_3;
using Triangle = Kernel::Triangle_3;
using Mesh = CGAL::Surface_mesh<Point>;
using Side = CGAL::Side_of_triangle_mesh<Mesh, Kernel>;
using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, const Triangle*>;

struct Surface
{
  std::string file;
  std::vector<Point> points;
  std::vector<Triangle> triangles;
  CGAL::Bbox_3 bounds;
  Mesh mesh;                   ///< empty if the triangles do not make a manifold
  std::vector<Point> onPieces; ///< one point of each connected piece
  std::unique_ptr<Side> side;  ///< null if the surface is not closed
  bool manifold = false;       ///< at most two triangles to an edge, in opposite senses, and one fan of triangles to a point
  bool closed = false;
  bool outward = false; ///< each connected piece is closed and has its normals outside
  bool selfIntersecting = false;
  std::size_t degenerate = 0;
  double volume = 0.0;
  double area = 0.0;
};

struct Pair
{
  std::size_t a = 0;
  std::size_t b = 0;
  const char* relation = nullptr;                            ///< null if the two do not interact
  double distance = std::numeric_limits<double>::infinity(); ///< known if it is less than the requested gap
};

Surface read(const std::filesystem::path& path, const std::filesystem::path& folder)
{
  Surface surface;
  surface.file = std::filesystem::relative(path, folder).string();
  std::vector<std::vector<std::size_t>> polygons;
  const bool read = path.extension() == ".ply" ? CGAL::IO::read_PLY(path.string(), surface.points, polygons)
                                               : CGAL::IO::read_OFF(path.string(), surface.points, polygons);
  if (!read || polygons.empty())
  {
    throw std::runtime_error(path.string() + " cannot be read as a mesh");
  }
  for (const Point& p : surface.points)
  {
    if (!std::isfinite(p.x()) || !std::isfinite(p.y()) || !std::isfinite(p.z()))
    {
      throw std::runtime_error(path.string() + " has a coordinate that is not finite");
    }
  }
  for (const auto& polygon : polygons)
  {
    if (polygon.size() != 3)
    {
      throw std::runtime_error(path.string() + " has a face that is not a triangle");
    }
    for (std::size_t corner : polygon)
    {
      if (corner >= surface.points.size())
      {
        throw std::runtime_error(path.string() + " has a face that names a point which is not there");
      }
    }
    surface.triangles.emplace_back(surface.points[polygon[0]], surface.points[polygon[1]], surface.points[polygon[2]]);
    surface.degenerate += surface.triangles.back().is_degenerate() ? 1 : 0;
    surface.area += std::sqrt(surface.triangles.back().squared_area());
    surface.bounds += surface.triangles.back().bbox();
  }
  // Points that no triangle uses are not part of the surface.
  pmp::remove_isolated_points_in_polygon_soup(surface.points, polygons);
  surface.manifold = pmp::is_polygon_soup_a_polygon_mesh(polygons);
  if (surface.manifold)
  {
    pmp::polygon_soup_to_polygon_mesh(surface.points, polygons, surface.mesh);
  }
  return surface;
}

void examine(Surface& surface)
{
  if (!surface.manifold)
  {
    return;
  }
  Mesh& mesh = surface.mesh;
  surface.closed = CGAL::is_closed(mesh);
  surface.selfIntersecting = pmp::does_self_intersect(mesh);
  std::vector<Mesh> pieces;
  pmp::split_connected_components(mesh, pieces);
  surface.outward = surface.closed;
  for (const Mesh& piece : pieces)
  {
    surface.onPieces.push_back(piece.point(*piece.vertices().begin()));
    surface.outward = surface.outward && pmp::is_outward_oriented(piece);
  }
  if (surface.closed)
  {
    surface.volume = pmp::volume(mesh);
    surface.side = std::make_unique<Side>(mesh);
  }
}

CGAL::Bbox_3 grown(const CGAL::Bbox_3& box, double by)
{
  return { box.xmin() - by, box.ymin() - by, box.zmin() - by, box.xmax() + by, box.ymax() + by, box.zmax() + by };
}

/// Squared distance of two triangles that do not intersect: it lies between a corner and a face, or between two edges.
double squaredDistance(const Triangle& s, const Triangle& t)
{
  double smallest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i)
  {
    smallest = std::min({ smallest, CGAL::squared_distance(s.vertex(i), t), CGAL::squared_distance(t.vertex(i), s) });
    for (int j = 0; j < 3; ++j)
    {
      smallest =
        std::min(smallest, CGAL::squared_distance(Segment(s.vertex(i), s.vertex(i + 1)), Segment(t.vertex(j), t.vertex(j + 1))));
    }
  }
  return smallest;
}

/// Returns the boxes, grown by `gap`, of those triangles that come near `where`.
std::vector<Box> boxesNear(const Surface& surface, const CGAL::Bbox_3& where, double gap)
{
  std::vector<Box> boxes;
  for (const Triangle& triangle : surface.triangles)
  {
    const CGAL::Bbox_3 box = grown(triangle.bbox(), gap);
    if (CGAL::do_overlap(box, where))
    {
      boxes.emplace_back(box, &triangle);
    }
  }
  return boxes;
}

/// Returns how many connected pieces of `inner` lie inside `outer`, for two surfaces that do not intersect.
std::size_t piecesInside(const Surface& inner, const Surface& outer)
{
  if (outer.side == nullptr)
  {
    return 0;
  }
  return static_cast<std::size_t>(std::count_if(inner.onPieces.begin(), inner.onPieces.end(),
    [&outer](const Point& point) { return (*outer.side)(point) == CGAL::ON_BOUNDED_SIDE; }));
}

struct Found // thrown out of CGAL's search, which cannot be stopped otherwise
{
};

Pair compare(const std::vector<Surface>& surfaces, std::size_t a, std::size_t b, double gap)
{
  const Surface& first = surfaces[a];
  const Surface& second = surfaces[b];
  Pair pair;
  pair.a = a;
  pair.b = b;
  std::vector<Box> boxesA = boxesNear(first, second.bounds, gap);
  std::vector<Box> boxesB = boxesNear(second, grown(first.bounds, gap), 0.0);
  double closest = std::numeric_limits<double>::infinity();
  try
  {
    CGAL::box_intersection_d(boxesA.begin(), boxesA.end(), boxesB.begin(), boxesB.end(),
      [&closest, gap](const Box& s, const Box& t)
      {
        if (CGAL::do_intersect(*s.info(), *t.info()))
        {
          throw Found();
        }
        if (gap > 0.0)
        {
          closest = std::min(closest, squaredDistance(*s.info(), *t.info()));
        }
      });
  }
  catch (const Found&)
  {
    pair.relation = "intersect";
    pair.distance = 0.0;
    return pair;
  }
  if (closest < gap * gap)
  {
    pair.relation = "near";
    pair.distance = std::sqrt(closest);
  }
  const std::size_t firstInside = piecesInside(first, second);
  const std::size_t secondInside = piecesInside(second, first);
  if (firstInside > 0)
  {
    pair.relation = firstInside == first.onPieces.size() ? "a_in_b" : "a_partly_in_b";
  }
  else if (secondInside > 0)
  {
    pair.relation = secondInside == second.onPieces.size() ? "b_in_a" : "b_partly_in_a";
  }
  return pair;
}

std::string quoted(const std::string& text)
{
  std::string result = "\"";
  for (char c : text)
  {
    if (c == '"' || c == '\\')
    {
      result += '\\';
    }
    result += c;
  }
  return result + '"';
}

const char* json(bool value)
{
  return value ? "true" : "false";
}

void print(const std::vector<Surface>& surfaces, const std::vector<Pair>& pairs)
{
  const auto meshes = [&surfaces](auto is) { return std::count_if(surfaces.begin(), surfaces.end(), is); };
  const auto related = [&pairs](const std::string& relation)
  { return std::count_if(pairs.begin(), pairs.end(), [&relation](const Pair& p) { return p.relation == relation; }); };
  std::cout.precision(17);
  std::cout << "{\n\"summary\": {\"meshes\": " << surfaces.size()
            << ", \"closed\": " << meshes([](const Surface& s) { return s.closed; })
            << ", \"manifold\": " << meshes([](const Surface& s) { return s.manifold; })
            << ", \"outward\": " << meshes([](const Surface& s) { return s.outward; })
            << ", \"self_intersecting\": " << meshes([](const Surface& s) { return s.selfIntersecting; })
            << ", \"intersecting_pairs\": " << related("intersect") << ", \"near_pairs\": " << related("near") << "},\n"
            << "\"meshes\": [";
  const char* separator = "\n";
  for (const Surface& s : surfaces)
  {
    std::cout << separator << "{\"file\": " << quoted(s.file) << ", \"points\": " << s.points.size()
              << ", \"triangles\": " << s.triangles.size() << ", \"pieces\": " << s.onPieces.size()
              << ", \"manifold\": " << json(s.manifold) << ", \"closed\": " << json(s.closed)
              << ", \"outward\": " << json(s.outward) << ", \"self_intersecting\": " << json(s.selfIntersecting)
              << ", \"degenerate\": " << s.degenerate << ", \"volume\": " << s.volume << ", \"area\": " << s.area << "}";
    separator = ",\n";
  }
  std::cout << "],\n\"pairs\": [";
  separator = "\n";
  for (const Pair& p : pairs)
  {
    std::cout << separator << "{\"a\": " << quoted(surfaces[p.a].file) << ", \"b\": " << quoted(surfaces[p.b].file)
              << ", \"relation\": " << quoted(p.relation) << ", \"distance\": ";
    if (std::isfinite(p.distance))
    {
      std::cout << p.distance << "}";
    }
    else
    {
      std::cout << "null}";
    }
    separator = ",\n";
  }
  std::cout << "]\n}\n";
}

/// Calls work(i) for 0 ≤ i < count in parallel, and rethrows an exception of one of the calls.
template <typename Work>
void inParallel(std::size_t count, Work work)
{
  std::string failure;
#pragma omp parallel for schedule(dynamic)
  for (std::size_t i = 0; i < count; ++i)
  {
    try
    {
      work(i);
    }
    catch (const std::exception& error)
    {
#pragma omp critical
      failure = error.what();
    }
  }
  if (!failure.empty())
  {
    throw std::runtime_error(failure);
  }
}

void run(const std::filesystem::path& folder, double gap)
{
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
  {
    if (entry.path().extension() == ".ply" || entry.path().extension() == ".off")
    {
      paths.push_back(entry.path());
    }
  }
  if (paths.empty())
  {
    throw std::runtime_error("there is no .ply or .off file in " + folder.string());
  }
  std::sort(paths.begin(), paths.end());

  std::vector<Surface> surfaces(paths.size());
  inParallel(paths.size(),
    [&](std::size_t i)
    {
      surfaces[i] = read(paths[i], folder);
      examine(surfaces[i]);
    });

  std::vector<Pair> pairs;
  for (std::size_t a = 0; a < surfaces.size(); ++a)
  {
    for (std::size_t b = a + 1; b < surfaces.size(); ++b)
    {
      if (CGAL::do_overlap(grown(surfaces[a].bounds, gap), surfaces[b].bounds))
      {
        pairs.emplace_back();
        pairs.back().a = a;
        pairs.back().b = b;
      }
    }
  }
  inParallel(pairs.size(), [&](std::size_t i) { pairs[i] = compare(surfaces, pairs[i].a, pairs[i].b, gap); });
  pairs.erase(std::remove_if(pairs.begin(), pairs.end(), [](const Pair& pair) { return pair.relation == nullptr; }), pairs.end());
  print(surfaces, pairs);
}

} // namespace

int main(int argc, char** argv)
{
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  char* end = nullptr;
  const bool withGap = arguments.size() == 3 && arguments[0] == "--gap";
  const double gap = withGap ? std::strtod(arguments[1].c_str(), &end) : 0.0;
  if ((arguments.size() != 1 && !withGap) || (withGap && (*end != '\0' || !(gap > 0.0))))
  {
    std::cerr << "usage: cactus_mesh_oracle [--gap DISTANCE] FOLDER\n";
    return 2;
  }
  try
  {
    run(arguments.back(), gap);
  }
  catch (const std::exception& error)
  {
    std::cerr << "cactus_mesh_oracle: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
