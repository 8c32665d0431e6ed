// SPDX-License-Identifier: BSD-3-Clause
// The one place that converts fibres between VTK and core.
#pragma once

#include "base/Domain.h"
#include "fibres/Fibres.h"

#include <vtkType.h>

#include <string>
#include <vector>

class vtkDataArray;
class vtkDataObject;
class vtkPolyData;

namespace cactus
{

/// Polylines with point data `Radius`, cell data `FibreId`, `BundleId`, `TargetRadius` and field data `Domain`, as core fibres,
/// validated. Several blocks (a composite data set) are one substrate, and joined as several inputs are.
///
/// Fibres that are placed in an image's space (field data `Placement`) are taken back into the substrate's own.
///
/// Field data `GrownFibreVolumeFraction` is what they were made for; that of several blocks adds up, as far as all have it.
///
/// Where the cell arrays are missing, ids count from 1 in cell order, the bundle is 1 and the target radius is the mean of
/// the radii; without field data `Domain` the domain is the bounding box of the points. Throws InvalidInput for anything else,
/// for ids that are not whole numbers from 1 to 2147483647, and where blocks have different domains.
Fibres fibresFrom(vtkDataObject* input);

/// The same for what need not be a substrate, as a tractogram that was read: the domain may have no volume or be larger than
/// limits are, and so may the fibres.
Fibres tractFrom(vtkDataObject* input);

/// The fibres of several inputs in their order. Ids stay where they are free; the bundles or fibres of an input or block that
/// share one with an earlier one all move above the largest. Throws InvalidInput where the inputs have different domains.
Fibres joinedFibres(const std::vector<vtkDataObject*>& inputs);

/// A whole number from 1 to 2147483647 out of an array of any type. Throws InvalidInput, naming array and cell, for any other.
int idFrom(vtkDataArray* array, vtkIdType cell);

/// The reverse; replaces everything in `output` but its field data, in which it sets `Domain` and, where it is known,
/// `GrownFibreVolumeFraction`.
void toPolyData(const Fibres& fibres, vtkPolyData* output);

/// Adds the colours `Direction` to polylines (red, green and blue are the parts of the tangent along x, y and z, as diffusion
/// imaging has them), which views show where no array is chosen.
void addDirectionColours(vtkPolyData* fibres);

/// Field data `Domain` (xmin xmax ymin ymax zmin zmax, µm) of a data set, or of the first block that has it. Reading throws
/// InvalidInput where it is missing or has not six finite numbers, or where blocks differ in it.
bool hasDomain(vtkDataObject* data);
Domain domainFrom(vtkDataObject* data);
/// The data lie in the substrate's own space then, wherever those that came in lay.
void setDomain(vtkDataObject* data, const Domain& domain);

} // namespace cactus
