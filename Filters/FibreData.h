// SPDX-License-Identifier: BSD-3-Clause
// The one place that converts fibres between VTK and core.
#pragma once

#include "Domain.h"
#include "Fibres.h"

#include <string>

class vtkDataObject;
class vtkPolyData;

namespace cactus
{

/// Polylines with point data `Radius`, cell data `FibreId`, `BundleId`, `TargetRadius` and field data `Domain`, as core fibres,
/// validated.
///
/// Where the cell arrays are missing, ids count from 1 in cell order, the bundle is 1 and the target radius is the mean of
/// the radii; without field data `Domain` the domain is the bounding box of the points. Throws InvalidInput for anything else.
Fibres fibresFrom(vtkPolyData* input);

/// The reverse; replaces everything in `output` but its field data, in which it sets `Domain`.
void toPolyData(const Fibres& fibres, vtkPolyData* output);

/// Field data `Domain` (xmin xmax ymin ymax zmin zmax, µm). Reading throws InvalidInput where it is missing or has not six finite
/// numbers.
bool hasDomain(vtkDataObject* data);
Domain domainFrom(vtkDataObject* data);
void setDomain(vtkDataObject* data, const Domain& domain);

/// Copies the provenance (field data `Provenance`, one string per stage so far) of `from`, if any, and appends
/// "stage version: parameters" to it.
void addProvenance(vtkDataObject* from, vtkDataObject* to, const std::string& stage, const std::string& parameters);

} // namespace cactus
