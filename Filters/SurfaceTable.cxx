// SPDX-License-Identifier: BSD-3-Clause
#include "SurfaceTable.h"

#include "Columns.h"

#include <vtkDoubleArray.h>
#include <vtkIntArray.h>
#include <vtkTable.h>

namespace cactus
{

void fillSurfaceTable(vtkTable* table, const std::vector<FibreSurfacePair>& fibres)
{
  using Fibre = FibreSurfacePair;
  const auto number = [&](const char* name, double (*value)(const Fibre&))
  { addColumn<vtkDoubleArray>(table, name, fibres.size(), [&](std::size_t row) { return value(fibres[row]); }); };
  const auto integer = [&](const char* name, long (*value)(const Fibre&))
  { addColumn<vtkIntArray>(table, name, fibres.size(), [&](std::size_t row) { return value(fibres[row]); }); };
  integer("FibreId", [](const Fibre& f) { return long(f.fibreId); });
  integer("BundleId", [](const Fibre& f) { return long(f.bundleId); });
  number("TargetRadius_um", [](const Fibre& f) { return f.targetRadius; });
  number("OuterVolume_um3", [](const Fibre& f) { return f.outerReport.volume; });
  number("InnerVolume_um3", [](const Fibre& f) { return f.innerReport.volume; });
  number("OuterArea_um2", [](const Fibre& f) { return f.outerReport.area; });
  number("InnerArea_um2", [](const Fibre& f) { return f.innerReport.area; });
  number("Thickness_um", [](const Fibre& f) { return f.thickness; });
  number("TargetGRatio", [](const Fibre& f) { return f.targetGRatio; });
  number("GRatio", [](const Fibre& f) { return f.gRatio; });
  integer("Nodes", [](const Fibre& f) { return long(f.nodes); });
  number("InternodeLength_um", [](const Fibre& f) { return f.internodeLength; });
  number("LostMyelin", [](const Fibre& f) { return f.lostMyelin(); });
  integer("Myelin", [](const Fibre& f) { return long(f.state); });
  integer("OuterTriangles", [](const Fibre& f) { return long(f.outerReport.triangles); });
  integer("InnerTriangles", [](const Fibre& f) { return long(f.innerReport.triangles); });
  integer("OuterClosed", [](const Fibre& f) { return long(f.outerReport.closedManifold() && f.outerReport.outward()); });
  integer("InnerClosed", [](const Fibre& f) { return long(f.innerReport.closedManifold() && f.innerReport.outward()); });
  number("OuterSquaredEdgeRatio", [](const Fibre& f) { return f.outerReport.largestSquaredEdgeRatio; });
  number("InnerSquaredEdgeRatio", [](const Fibre& f) { return f.innerReport.largestSquaredEdgeRatio; });
  integer("Flawed", [](const Fibre& f) { return long(f.isFlawed); });
  number("LargestMove_um", [](const Fibre& f) { return f.largestMove(); });
  number("DroppedVolume_um3", [](const Fibre& f) { return f.droppedVolume(); });
}

} // namespace cactus
