// SPDX-License-Identifier: BSD-3-Clause
#include "SurfaceData.h"

#include "Error.h"
#include "FibreData.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <map>
#include <memory>

namespace cactus
{

namespace
{

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

  std::map<int, std::vector<vtkIdType>> cellsOf;
  for (vtkIdType cell = 0; cell < input->GetNumberOfCells(); ++cell)
  {
    if (kind != nullptr && static_cast<int>(kind->GetComponent(cell, 0)) != surface)
    {
      const std::string other = surface == 0 ? "inner" : "outer";
      throw InvalidInput(port + " holds " + other + " surfaces (cell data Surface): connect MyelinSurface's port " + port);
    }
    cellsOf[static_cast<int>(fibreId->GetComponent(cell, 0))].push_back(cell);
  }
  auto cells = std::make_shared<std::vector<std::vector<vtkIdType>>>();
  for (auto& entry : cellsOf)
  {
    if (entry.first < 1)
    {
      throw InvalidInput(port + " has a FibreId below 1 in cell " + std::to_string(entry.second[0]) + ": ids count from 1");
    }
    result.fibreIds.push_back(entry.first);
    result.bundleIds.push_back(bundleId ? static_cast<int>(bundleId->GetComponent(entry.second[0], 0)) : 1);
    cells->push_back(std::move(entry.second));
  }

  result.mesh = [cells, triangles, points = input->GetPoints()](std::size_t index)
  {
    TriangleMesh mesh;
    std::vector<vtkIdType> ids;
    ids.reserve(3 * (*cells)[index].size());
    vtkNew<vtkIdList> corners; // with a list of its own, reading a cell is safe in several threads
    for (const vtkIdType cell : (*cells)[index])
    {
      triangles->GetCellAtId(cell, corners);
      ids.insert(ids.end(), { corners->GetId(0), corners->GetId(1), corners->GetId(2) });
    }
    std::vector<vtkIdType> used = ids;
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    mesh.points.resize(used.size());
    for (std::size_t i = 0; i < used.size(); ++i)
    {
      points->GetPoint(used[i], mesh.points[i].data());
    }
    mesh.triangles.resize((*cells)[index].size());
    for (std::size_t i = 0; i < ids.size(); ++i)
    {
      const auto place = std::lower_bound(used.begin(), used.end(), ids[i]) - used.begin();
      mesh.triangles[i / 3][i % 3] = static_cast<std::int32_t>(place);
    }
    return mesh;
  };
  return result;
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
