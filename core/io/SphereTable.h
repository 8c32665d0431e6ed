// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/FibresOfFile.h"

#include <istream>
#include <string>

namespace cactus
{

/// Reads the axons of a table that CATERPillar has written (github.com/jazz031195/CATERPillar; Nguyen-Duc et al. 2025): a line of
/// column names, then a sphere per line, lengths in µm. Columns are found by name, as its versions call them:
///
///   cell_type cell_id … X Y Z inner_radius outer_radius      id_cell (or id_ax) … Type X Y Z Rin Rout (or R)
///
/// Blanks or commas part them, and columns of other names are passed over. Consecutive spheres of one axon are the control points
/// of a fibre, with their outer radii; its FibreId is the axon's number plus one. Spheres of other cells are left out, and so are
/// axons of a single sphere and spheres that coincide with the one before.
///
/// The table does not say which voxel it fills: that is the cube from the origin to `side`, or where that is 0 to the largest
/// coordinate of the axons' spheres.
///
/// Throws FileError with the line, and InvalidInput as `validate` does.
FibresOfFile readSphereTable(std::istream& stream, const std::string& name, double side = 0.0);

/// Whether a table with this first line, without byte order mark, is one.
bool isSphereTable(const std::string& firstLine);

/// The side of the voxel ("Voxel Size", µm) that CATERPillar has written beside such a table: in NAME_growth_info.txt or
/// NAME_info.txt for NAME.csv, and in NAME_growth_info_2.txt for NAME_2.csv. 0 where there is no such file, or none with a side.
double sideBesideTable(const std::string& path);

} // namespace cactus
