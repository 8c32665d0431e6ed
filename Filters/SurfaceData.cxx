// SPDX-License-Identifier: BSD-3-Clause
#include "SurfaceData.h"

#include "Error.h"
#include "FibreData.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkIdList.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkTypeInt32Array.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <utility>

namespace cactus
{

namespace
{

/// Cells that follow one another.
struct Run
{
  vtkIdType begin;
  vtkIdType end;
};

vtkDataArray* cellScalars(vtkPolyData* input, const char* name, const std::string& port)
{
  vtkDataArray* array = input->GetCellData()->GetArray(name);
  if (array != nullptr && array->GetNumberOfComponents() != 1)
  {
    throw InvalidInput(port + ": cell data " + name + " must have one component");
  }
  return array;
}

} // namespace

FibreSurfaces surfacesFrom(vtkPolyData* input, const std::string& port, int surface)
{
  FibreSurfaces result;
  if (input == nullptr || input->GetNumberOfCells() == 0)
  {
    return result;
  }
  vtkCellArray* triangles = input->GetPolys();
  if (triangles->GetNumberOfCells() != input->GetNumberOfCells() || triangles->IsHomogeneous() != 3)
  {
    throw InvalidInput(port + " holds cells that are not triangles: apply Triangulate first");
  }
  vtkDataArray* fibreId = cellScalars(input, "FibreId", port);
  vtkDataArray* bundleId = cellScalars(input, "BundleId", port);
  vtkDataArray* kind = cellScalars(input, "Surface", port);
  if (fibreId == nullptr)
  {
    throw InvalidInput(port + " has no cell data FibreId, which tells whose surface each triangle is");
  }

  std::map<int, std::vector<Run>> runsOf; // most often one for each
  for (vtkIdType cell = 0; cell < input->GetNumberOfCells(); ++cell)
  {
    if (kind != nullptr && static_cast<int>(kind->GetComponent(cell, 0)) != surface)
    {
      const std::string other = surface == 0 ? "inner" : "outer";
      throw InvalidInput(port + " holds " + other + " surfaces (cell data Surface): connect MyelinSurface's port " + port);
    }
    std::vector<Run>& runs = runsOf[static_cast<int>(fibreId->GetComponent(cell, 0))];
    if (runs.empty() || runs.back().end != cell)
    {
      runs.push_back({ cell, cell });
    }
    ++runs.back().end;
  }
  auto surfaces = std::make_shared<std::vector<std::vector<Run>>>();
  for (auto& entry : runsOf)
  {
    if (entry.first < 1)
    {
      throw InvalidInput(port + " has a FibreId below 1 in cell " + std::to_string(entry.second[0].begin) + ": ids count from 1");
    }
    result.fibreIds.push_back(entry.first);
    result.bundleIds.push_back(bundleId ? static_cast<int>(bundleId->GetComponent(entry.second[0].begin, 0)) : 1);
    surfaces->push_back(std::move(entry.second));
  }

  result.mesh = [surfaces, triangles, points = input->GetPoints()](std::size_t index)
  {
    TriangleMesh mesh;
    std::vector<vtkIdType> ids;
    vtkNew<vtkIdList> corners; // with a list of its own, reading a cell is safe in several threads
    for (const Run& run : (*surfaces)[index])
    {
      for (vtkIdType cell = run.begin; cell < run.end; ++cell)
      {
        triangles->GetCellAtId(cell, corners);
        ids.insert(ids.end(), { corners->GetId(0), corners->GetId(1), corners->GetId(2) });
      }
    }
    std::vector<vtkIdType> used = ids;
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    mesh.points.resize(used.size());
    for (std::size_t i = 0; i < used.size(); ++i)
    {
      points->GetPoint(used[i], mesh.points[i].data());
    }
    mesh.triangles.resize(ids.size() / 3);
    for (std::size_t i = 0; i < ids.size(); ++i)
    {
      const auto place = std::lower_bound(used.begin(), used.end(), ids[i]) - used.begin();
      mesh.triangles[i / 3][i % 3] = static_cast<std::int32_t>(place);
    }
    return mesh;
  };
  return result;
}

void toPolyData(std::vector<NamedSurface> surfaces, int surface, vtkPolyData* output)
{
  std::size_t pointCount = 0;
  std::size_t triangleCount = 0;
  for (const NamedSurface& named : surfaces)
  {
    pointCount += named.mesh.points.size();
    triangleCount += named.mesh.triangles.size();
  }
  if (std::max(pointCount, 3 * triangleCount) > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
  {
    throw OutOfMemory(std::to_string(triangleCount) +
                      " triangles are more than one surface can hold: choose a larger VoxelSize or "
                      "DecimationError, or a smaller domain");
  }
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(static_cast<vtkIdType>(pointCount));
  auto* coordinates = static_cast<double*>(points->GetVoidPointer(0));
  vtkNew<vtkTypeInt32Array> offsets;
  offsets->SetNumberOfValues(static_cast<vtkIdType>(triangleCount + 1));
  vtkNew<vtkTypeInt32Array> corners;
  corners->SetNumberOfValues(static_cast<vtkIdType>(3 * triangleCount));
  const char* names[] = { "FibreId", "BundleId", "Surface" };
  vtkNew<vtkIntArray> columns[3];
  for (int column = 0; column < 3; ++column)
  {
    columns[column]->SetName(names[column]);
    columns[column]->SetNumberOfValues(static_cast<vtkIdType>(triangleCount));
  }
  vtkIdType point = 0;
  vtkIdType triangle = 0;
  for (NamedSurface& named : surfaces)
  {
    const auto first = static_cast<std::int32_t>(point);
    for (const Eigen::Vector3d& p : named.mesh.points)
    {
      std::copy(p.data(), p.data() + 3, coordinates + 3 * point++);
    }
    for (const auto& t : named.mesh.triangles)
    {
      for (int i = 0; i < 3; ++i)
      {
        corners->SetValue(3 * triangle + i, first + t[static_cast<std::size_t>(i)]);
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
    offsets->SetValue(i, static_cast<std::int32_t>(3 * i));
  }
  vtkNew<vtkCellArray> triangles;
  triangles->SetData(offsets, corners);
  output->SetPoints(points);
  output->SetPolys(triangles);
  for (const auto& column : columns)
  {
    output->GetCellData()->AddArray(column);
  }
}

void requireSameDomain(const Domain& domain, vtkPolyData* surfaces, const std::string& port)
{
  if (surfaces == nullptr || !hasDomain(surfaces))
  {
    return;
  }
  const Domain other = domainFrom(surfaces);
  if ((other.lower - domain.lower).cwiseAbs().maxCoeff() > 1e-6 || (other.upper - domain.upper).cwiseAbs().maxCoeff() > 1e-6)
  {
    throw InvalidInput(port + " has another Domain than the other inputs: connect fibres and surfaces of one substrate");
  }
}

} // namespace cactus
