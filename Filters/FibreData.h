// SPDX-License-Identifier: BSD-3-Clause
// Conversion of fibres between VTK and core.
#pragma once

#include "base/Domain.h"
#include "base/Placement.h"
#include "fibres/Fibres.h"

#include <vtkType.h>

#include <Eigen/Core>

#include <array>
#include <optional>
#include <string>
#include <vector>

class vtkDataArray;
class vtkDataObject;
class vtkFieldData;
class vtkPolyData;

namespace cactus
{

/// Converts polylines with point data `Radius`, cell data `FibreId`, `BundleId`, `TargetRadius` and field data `Domain` to
/// validated core fibres. Several blocks (a composite data set) are one substrate, and joined like several inputs.
///
/// Fibres that are placed in an image's space (field data `Placement`) are moved back into the substrate's space.
///
/// Point data `MyelinFraction`, if there, is the part of the myelin's thickness, from 0 (none) to 1 (all of it).
///
/// Field data `GrownFibreVolumeFraction` is the fraction that they were made for; those of several blocks are added, if all
/// blocks have it. It is for fibres that fill `GrownTargetVolume` (µm³) of the domain with their TargetRadius: where some of them
/// were picked, or others put to them, the fraction changes in proportion.
///
/// Defaults for missing cell arrays: ids from 1 in cell order, bundle 1, and the mean of the radii as target radius; without
/// field data `Domain` the domain is the bounding box of the points. Throws InvalidInput for anything else, for ids that are not
/// whole numbers from 1 to 2147483647, and if blocks have different domains.
Fibres fibresFrom(vtkDataObject* input);

/// The same for what need not be a substrate, as a tractogram that was read: the domain may have no volume or be larger than
/// limits are, and so may the fibres; radii are NaN where there are none. Data without a placement of their own are moved back
/// from `unlessPlaced`, if given.
Fibres tractFrom(vtkDataObject* input, const std::optional<Placement>& unlessPlaced = std::nullopt);

/// Point data of polylines, see fibresFrom().
constexpr const char* myelinFractionName = "MyelinFraction";

/// Tells whether polylines have point data `MyelinFraction`, which says how much of their myelin there is.
bool hasMyelinFractions(vtkDataObject* input);
/// Field data of a label image whose fibres have them.
constexpr const char* saysMyelinName = "FibresHaveMyelinFraction";

/// The fibres of several inputs in their order. Ids stay where they are free; the bundles or fibres of an input or block that
/// share one with an earlier one all move above the largest. Throws InvalidInput where the inputs have different domains.
Fibres joinedFibres(const std::vector<vtkDataObject*>& inputs);

/// Returns an array's value as a whole number from 1 to 2147483647. Throws InvalidInput, naming array and cell, for any other
/// value.
int idFrom(vtkDataArray* array, vtkIdType cell);

/// Converts core fibres to polylines; replaces everything in `output` but its field data, in which it sets `Domain` and, if
/// known, `GrownFibreVolumeFraction` and `GrownTargetVolume`.
void toPolyData(const Fibres& fibres, vtkPolyData* output);

/// Adds the columns that the fibres have (see fibreColumns()), their names after this prefix.
void addColumns(const Fibres& fibres, const std::string& prefix, vtkFieldData* data);

/// Returns the colour of a direction of length 1: red, green and blue are its parts along x, y and z.
std::array<unsigned char, 3> directionColour(const Eigen::Vector3d& direction);

/// Read and write field data `OrientationHarmonics`, see Fibres::orientationHarmonics; none, if there are none that can be.
std::vector<double> orientationHarmonicsOf(vtkFieldData* data);
void setOrientationHarmonics(const std::vector<double>& coefficients, vtkFieldData* data);

/// Adds the colours `Direction` to polylines (red, green and blue are the parts of the tangent along x, y and z, as in diffusion
/// imaging), which views show if no array is chosen.
void addDirectionColours(vtkPolyData* fibres);

/// Read field data `Domain` (xmin xmax ymin ymax zmin zmax, µm) of a data set, or of the first block that has it. domainFrom()
/// throws InvalidInput if it is missing or has not six finite numbers, or if blocks differ in it.
bool hasDomain(vtkDataObject* data);
Domain domainFrom(vtkDataObject* data);
/// Sets it; the data then lie in the substrate's space, wherever the input lay.
void setDomain(vtkDataObject* data, const Domain& domain);

} // namespace cactus
