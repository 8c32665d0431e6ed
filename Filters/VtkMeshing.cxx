// SPDX-License-Identifier: BSD-3-Clause
#include "VtkMeshing.h"

#include "base/Error.h"
#include "base/Limits.h"

#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkFlyingEdges3D.h>
#include <vtkIdList.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkQuadricDecimation.h>
#include <vtkSmartPointer.h>
#include <vtkWindowedSincPolyDataFilter.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace cactus
{

namespace
{

/// Distances (in voxels) from a face of the box within which a point belongs to it: for a contour, which is exact up to rounding,
/// and after decimation, which moves points to minima of quadrics.
constexpr double contourTolerance = 1e-3;
constexpr double decimationTolerance = 0.05;

TriangleMesh meshFrom(vtkPolyData* data)
{
  TriangleMesh mesh;
  mesh.points.resize(static_cast<std::size_t>(data->GetNumberOfPoints()));
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
  {
    data->GetPoint(static_cast<vtkIdType>(i), mesh.points[i].data());
  }
  vtkNew<vtkIdList> corners;
  vtkCellArray* polys = data->GetPolys();
  mesh.triangles.reserve(static_cast<std::size_t>(polys->GetNumberOfCells()));
  for (vtkIdType cell = 0; cell < polys->GetNumberOfCells(); ++cell)
  {
    polys->GetCellAtId(cell, corners);
    mesh.triangles.push_back({ static_cast<std::int32_t>(corners->GetId(0)), static_cast<std::int32_t>(corners->GetId(1)),
      static_cast<std::int32_t>(corners->GetId(2)) });
  }
  return mesh;
}

vtkSmartPointer<vtkPolyData> polyDataFrom(const TriangleMesh& mesh)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(static_cast<vtkIdType>(mesh.points.size()));
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
  {
    points->SetPoint(static_cast<vtkIdType>(i), mesh.points[i].data());
  }
  vtkNew<vtkCellArray> polys;
  for (const auto& t : mesh.triangles)
  {
    const vtkIdType corners[3] = { t[0], t[1], t[2] };
    polys->InsertNextCell(3, corners);
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetPolys(polys);
  return data;
}

/// Puts points within `tolerance` (µm) of a face of the box into it, and marks them.
void putOnFaces(CappedSurface& surface, double tolerance)
{
  surface.faces.assign(surface.mesh.points.size(), 0);
  for (std::size_t i = 0; i < surface.mesh.points.size(); ++i)
  {
    Eigen::Vector3d& p = surface.mesh.points[i];
    for (Eigen::Index axis = 0; axis < 3; ++axis)
    {
      for (int upper = 0; upper < 2; ++upper)
      {
        const double face = upper == 1 ? surface.box.max()[axis] : surface.box.min()[axis];
        if (std::abs(p[axis] - face) <= tolerance)
        {
          p[axis] = face;
          surface.faces[i] = static_cast<std::uint8_t>(surface.faces[i] | (1 << (2 * axis + upper)));
        }
      }
    }
  }
}

void smooth(CappedSurface& surface, const VtkMeshingOptions& options)
{
  vtkNew<vtkWindowedSincPolyDataFilter> sinc;
  sinc->SetInputData(polyDataFrom(surface.mesh));
  sinc->SetNumberOfIterations(options.sincIterations);
  sinc->SetPassBand(options.sincPassBand);
  sinc->NormalizeCoordinatesOn();
  sinc->FeatureEdgeSmoothingOff();
  sinc->BoundarySmoothingOff();
  sinc->Update();
  for (std::size_t i = 0; i < surface.mesh.points.size(); ++i)
  {
    Eigen::Vector3d to;
    sinc->GetOutput()->GetPoint(static_cast<vtkIdType>(i), to.data());
    if (!((to - surface.mesh.points[i]).norm() <= surface.box.diagonal().norm()))
    {
      throw InvalidInput(text("SincPassBand ", options.sincPassBand, " is too small for SincIterations ", options.sincIterations,
        ": VTK's filter throws points out of the domain; choose a larger pass band, or more iterations"));
    }
    Eigen::Vector3d& p = surface.mesh.points[i];
    to = keptInside(surface.box, p, to, 0.0);
    for (Eigen::Index axis = 0; axis < 3; ++axis)
    {
      const bool isOnFace = (surface.faces[i] & (3 << (2 * axis))) != 0;
      p[axis] = isOnFace ? p[axis] : to[axis];
    }
  }
}

void coarsen(CappedSurface& surface, const VtkMeshingOptions& options, double spacing)
{
  vtkNew<vtkQuadricDecimation> decimation;
  decimation->SetInputData(polyDataFrom(surface.mesh));
  decimation->SetTargetReduction(options.targetReduction);
  decimation->VolumePreservationOn();
  decimation->Update();
  TriangleMesh coarse = meshFrom(decimation->GetOutput());
  const bool isFinite =
    std::all_of(coarse.points.begin(), coarse.points.end(), [](const Eigen::Vector3d& p) { return p.allFinite(); });
  if (!isFinite)
  {
    return;
  }
  surface.mesh = std::move(coarse);
  for (Eigen::Vector3d& p : surface.mesh.points)
  {
    p = p.cwiseMax(surface.box.min()).cwiseMin(surface.box.max());
  }
  putOnFaces(surface, decimationTolerance * spacing);
}

} // namespace

CappedSurface contourByVtk(const FibreImage& image, double level, const Eigen::AlignedBox3d& box)
{
  const VoxelGrid& grid = image.grid;
  vtkNew<vtkFloatArray> field;
  field->SetNumberOfValues(static_cast<vtkIdType>(image.values.size()));
  std::copy(image.values.begin(), image.values.end(), field->GetPointer(0));
  const Eigen::Vector3d origin = grid.position(grid.lower[0], grid.lower[1], grid.lower[2]);
  vtkNew<vtkImageData> data;
  data->SetDimensions(grid.count[0], grid.count[1], grid.count[2]);
  data->SetSpacing(grid.spacing, grid.spacing, grid.spacing);
  data->SetOrigin(0.0, 0.0, 0.0); // the contour is in single precision, which is finest there
  data->GetPointData()->SetScalars(field);

  vtkNew<vtkFlyingEdges3D> contour;
  contour->SetInputData(data);
  contour->SetValue(0, level);
  contour->ComputeNormalsOff();
  contour->ComputeGradientsOff();
  contour->ComputeScalarsOff();
  contour->Update();

  CappedSurface surface;
  surface.box = box;
  surface.mesh = meshFrom(contour->GetOutput());
  for (Eigen::Vector3d& p : surface.mesh.points)
  {
    p += origin;
  }
  putOnFaces(surface, contourTolerance * grid.spacing);
  if (measure(surface).volume < 0.0)
  {
    for (auto& t : surface.mesh.triangles)
    {
      std::swap(t[1], t[2]);
    }
  }
  return surface;
}

void finishByVtk(CappedSurface& surface, const VtkMeshingOptions& options, double spacing)
{
  if (surface.mesh.triangles.empty())
  {
    return; // the filters would report it as an error
  }
  if (options.sincIterations > 0)
  {
    smooth(surface, options);
  }
  if (options.targetReduction > 0.0)
  {
    coarsen(surface, options, spacing);
  }
}

SurfaceFilters surfaceFiltersOfVtk(const VtkMeshingOptions& options, double spacing)
{
  validate(options);
  SurfaceFilters filters;
  filters.contour = contourByVtk;
  filters.finish = [options, spacing](CappedSurface& surface) { finishByVtk(surface, options, spacing); };
  return filters;
}

} // namespace cactus
