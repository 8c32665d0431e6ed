// SPDX-License-Identifier: BSD-3-Clause
#include "SurfaceData.h"

#include "Columns.h"
#include "FibreData.h"
#include "InputBlocks.h"
#include "PlacementData.h"
#include "SurfaceFacts.h"
#include "base/Constants.h"
#include "base/Error.h"
#include "mesh/SurfaceDirection.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkIdList.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkTypeInt32Array.h>
#include <vtkTypeInt64Array.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <map>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>

namespace cactus
{

namespace
{

/// A range of consecutive cells.
struct Run
{
  vtkIdType begin;
  vtkIdType end;
};

/// The triangles of one block.
struct Part
{
  vtkCellArray* triangles;
  vtkPoints* points;
  std::optional<Placement> placement;
};

/// One fibre's triangles.
struct Surface
{
  std::size_t part = 0;
  int bundleId = 1;
  double gRatio = 0.0;
  std::vector<Run> runs; ///< usually one
};

vtkDataArray* cellScalars(vtkPolyData* input, const char* name)
{
  vtkDataArray* array = input->GetCellData()->GetArray(name);
  if (array != nullptr && (array->GetNumberOfComponents() != 1 || array->GetNumberOfTuples() != input->GetNumberOfCells()))
  {
    throw InvalidInput(std::string("has cell data ") + name + " that must have one component and a value for each cell");
  }
  return array;
}

/// FibreId or BundleId of a block's cells: cell data or, for a block that is one fibre's surface (see vtkFibreField), one number
/// in its field data.
struct Ids
{
  vtkDataArray* perCell = nullptr;
  vtkDataArray* ofBlock = nullptr;

  bool isGiven() const { return this->perCell != nullptr || this->ofBlock != nullptr; }
  int at(vtkIdType cell) const { return this->perCell != nullptr ? idFrom(this->perCell, cell) : idFrom(this->ofBlock, 0); }
};

Ids idsOf(vtkPolyData* input, const char* name)
{
  Ids ids;
  ids.perCell = cellScalars(input, name);
  vtkDataArray* array = input->GetFieldData()->GetArray(name);
  if (array != nullptr && array->GetNumberOfTuples() == 1 && array->GetNumberOfComponents() == 1)
  {
    ids.ofBlock = array;
  }
  return ids;
}

void requireTriangles(vtkPolyData* input)
{
  vtkCellArray* triangles = input->GetPolys();
  if (input->GetNumberOfLines() > 0 && input->GetNumberOfLines() == input->GetNumberOfCells())
  {
    throw InvalidInput("holds lines, as fibres are, and no surfaces: connect those that MyelinSurface makes of them");
  }
  if (triangles->GetNumberOfCells() != input->GetNumberOfCells() || triangles->IsHomogeneous() != 3)
  {
    throw InvalidInput("holds cells that are not triangles: apply Triangulate first");
  }
  double range[2];
  triangles->GetConnectivityArray()->GetRange(range);
  if (range[0] < 0.0 || range[1] >= static_cast<double>(input->GetNumberOfPoints()))
  {
    throw InvalidInput("holds triangles with points that do not exist: the mesh is damaged");
  }
}

/// Adds the surfaces of one block.
void addSurfaces(vtkPolyData* input, std::size_t part, const std::string& port, int surface, std::map<int, Surface>& surfaces)
{
  requireTriangles(input);
  const Ids fibreId = idsOf(input, "FibreId");
  const Ids bundleId = idsOf(input, "BundleId");
  vtkDataArray* kind = cellScalars(input, "Surface");
  vtkDataArray* gRatio = cellScalars(input, "GRatio");
  if (!fibreId.isGiven())
  {
    throw InvalidInput("has no cell data FibreId, which tells whose surface each triangle is (nor field data FibreId, as a block "
                       "of one fibre may have)");
  }
  for (vtkIdType cell = 0; cell < input->GetNumberOfCells(); ++cell)
  {
    if (kind != nullptr && kind->GetComponent(cell, 0) != surface)
    {
      throw InvalidInput(text("holds ", surface == 0 ? "inner" : "outer", " surfaces (cell data Surface is ",
        kind->GetComponent(cell, 0), " in cell ", cell, "): connect MyelinSurface's port ", port));
    }
    const int id = fibreId.at(cell);
    Surface& mine = surfaces[id];
    if (mine.runs.empty())
    {
      mine.part = part;
      mine.bundleId = bundleId.isGiven() ? bundleId.at(cell) : 1;
      mine.gRatio = gRatio != nullptr ? gRatio->GetComponent(cell, 0) : 0.0;
    }
    if (mine.part != part)
    {
      throw InvalidInput(text("holds FibreId ", id, ", and so does block ", mine.part + 1,
        ": give each surface a FibreId of its own, or "
        "merge the blocks where each holds a part of it"));
    }
    if (mine.runs.empty() || mine.runs.back().end != cell)
    {
      mine.runs.push_back({ cell, cell });
    }
    ++mine.runs.back().end;
  }
}

/// Returns a surface with its own points.
TriangleMesh meshOf(const Part& part, const Surface& surface)
{
  TriangleMesh mesh;
  std::vector<vtkIdType> ids;
  vtkNew<vtkIdList> corners; // its own list makes reading a cell thread-safe
  for (const Run& run : surface.runs)
  {
    for (vtkIdType cell = run.begin; cell < run.end; ++cell)
    {
      part.triangles->GetCellAtId(cell, corners);
      ids.insert(ids.end(), { corners->GetId(0), corners->GetId(1), corners->GetId(2) });
    }
  }
  std::vector<vtkIdType> used = ids;
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  mesh.points.resize(used.size());
  for (std::size_t i = 0; i < used.size(); ++i)
  {
    part.points->GetPoint(used[i], mesh.points[i].data());
    if (part.placement)
    {
      mesh.points[i] = part.placement->toSubstrate(mesh.points[i]);
    }
  }
  mesh.triangles.resize(ids.size() / 3);
  for (std::size_t i = 0; i < ids.size(); ++i)
  {
    const auto place = std::lower_bound(used.begin(), used.end(), ids[i]) - used.begin();
    mesh.triangles[i / 3][i % 3] = static_cast<std::int32_t>(place);
  }
  return mesh;
}

} // namespace

FibreSurfaces surfacesFrom(vtkDataObject* input, const std::string& port, int surface)
{
  FibreSurfaces result;
  readSurfaceFacts(input, result);
  const auto blocks = polyDataBlocks(input, port + " surfaces are triangles (vtkPolyData) with cell data FibreId");
  std::vector<Part> parts;
  std::map<int, Surface> surfaceOf;
  for (const InputBlock& block : blocks)
  {
    try
    {
      addSurfaces(block.data, parts.size(), port, surface, surfaceOf);
    }
    catch (const InvalidInput& error)
    {
      throw InvalidInput(port + (block.name.empty() ? " " : ", " + block.name + " ") + error.what());
    }
    parts.push_back({ block.data->GetPolys(), block.data->GetPoints(), placementOf(block.data) });
  }
  auto surfaces = std::make_shared<std::vector<Surface>>();
  for (auto& entry : surfaceOf)
  {
    result.fibreIds.push_back(entry.first);
    result.bundleIds.push_back(entry.second.bundleId);
    result.gRatios.push_back(entry.second.gRatio);
    surfaces->push_back(std::move(entry.second));
  }
  result.mesh = [surfaces, parts](std::size_t index) { return meshOf(parts[(*surfaces)[index].part], (*surfaces)[index]); };
  return result;
}

void toPolyData(std::vector<NamedSurface> surfaces, int surface, vtkPolyData* output, std::size_t mostInShort)
{
  std::size_t pointCount = 0;
  std::size_t triangleCount = 0;
  for (const NamedSurface& named : surfaces)
  {
    pointCount += named.mesh.points.size();
    triangleCount += named.mesh.triangles.size();
  }
  auto place = makeArray<vtkDoubleArray>("Points", pointCount, 3);
  vtkNew<vtkPoints> points;
  points->SetData(place);
  double* coordinates = place->GetPointer(0);
  const vtkSmartPointer<vtkIntArray> columns[3] = { makeArray<vtkIntArray>("FibreId", triangleCount),
    makeArray<vtkIntArray>("BundleId", triangleCount), makeArray<vtkIntArray>("Surface", triangleCount) };
  vtkIdType point = 0;
  vtkIdType triangle = 0;
  const auto fill = [&](auto& offsets, auto& corners)
  {
    using Index = typename std::decay_t<decltype(corners)>::ValueType;
    for (NamedSurface& named : surfaces)
    {
      const auto first = static_cast<Index>(point);
      for (const Eigen::Vector3d& p : named.mesh.points)
      {
        std::copy(p.data(), p.data() + 3, coordinates + 3 * point++);
      }
      for (const auto& t : named.mesh.triangles)
      {
        for (int i = 0; i < 3; ++i)
        {
          corners.SetValue(3 * triangle + i, first + t[static_cast<std::size_t>(i)]);
        }
        columns[0]->SetValue(triangle, named.fibreId);
        columns[1]->SetValue(triangle, named.bundleId);
        columns[2]->SetValue(triangle, surface);
        ++triangle;
      }
      named.mesh = TriangleMesh();
    }
    for (vtkIdType i = 0; i <= triangle; ++i)
    {
      offsets.SetValue(i, static_cast<Index>(3 * i));
    }
  };
  vtkNew<vtkCellArray> triangles;
  const auto set = [&](auto offsets, auto corners)
  {
    fill(*offsets, *corners);
    triangles->SetData(offsets, corners);
  };
  if (std::max(pointCount, 3 * triangleCount) > mostInShort)
  {
    set(makeArray<vtkTypeInt64Array>("", triangleCount + 1), makeArray<vtkTypeInt64Array>("", 3 * triangleCount));
  }
  else
  {
    set(makeArray<vtkTypeInt32Array>("", triangleCount + 1), makeArray<vtkTypeInt32Array>("", 3 * triangleCount));
  }
  output->SetPoints(points);
  output->SetPolys(triangles);
  for (const auto& column : columns)
  {
    output->GetCellData()->AddArray(column);
  }
}

FibreValues fibreValues(const TriangleMesh& mesh, double volume, double length, double gRatio, const Domain& domain)
{
  SurfaceDirection direction;
  for (const auto& triangle : mesh.triangles)
  {
    const auto corner = [&](std::size_t c) { return mesh.points[std::size_t(triangle[c])]; };
    direction.add(domain, corner(0), corner(1), corner(2));
  }
  const double radius = std::sqrt(volume / (pi * length));
  return { length > radius ? float(radius) : std::numeric_limits<float>::quiet_NaN(), float(gRatio),
    directionColour(direction.direction()) };
}

void addFibreValues(vtkPolyData* surfaces, const std::map<int, FibreValues>& valuesOf)
{
  auto* ids = vtkIntArray::SafeDownCast(surfaces->GetCellData()->GetArray("FibreId"));
  const auto count = static_cast<std::size_t>(ids != nullptr ? ids->GetNumberOfValues() : 0);
  const auto radius = makeArray<vtkFloatArray>("Radius", count);
  const auto gRatio = makeArray<vtkFloatArray>("GRatio", count);
  const auto direction = makeArray<vtkUnsignedCharArray>("Direction", count, 3);
  FibreValues values;
  int last = 0; // triangles of a fibre follow each other
  for (vtkIdType cell = 0; cell < static_cast<vtkIdType>(count); ++cell)
  {
    if (ids->GetValue(cell) != last)
    {
      last = ids->GetValue(cell);
      values = valuesOf.at(last);
    }
    radius->SetValue(cell, values.radius);
    gRatio->SetValue(cell, values.gRatio);
    direction->SetTypedTuple(cell, values.colour.data());
  }
  for (vtkDataArray* array : std::initializer_list<vtkDataArray*>{ radius, gRatio, direction })
  {
    surfaces->GetCellData()->AddArray(array);
  }
}

void requireSameDomain(const Domain& domain, vtkDataObject* surfaces, const std::string& port)
{
  if (surfaces == nullptr || !hasDomain(surfaces))
  {
    return;
  }
  const Domain other = domainFrom(surfaces);
  if ((other.lower - domain.lower).cwiseAbs().maxCoeff() > 1e-6 || (other.upper - domain.upper).cwiseAbs().maxCoeff() > 1e-6)
  {
    throw InvalidInput(
      port +
      " has another Domain than the other inputs: connect fibres and surfaces of one substrate (of a label image that was cut, "
      "surfaces have the Domain that is left)");
  }
}

} // namespace cactus
