// SPDX-License-Identifier: BSD-3-Clause
// The table of files that filters give which write a substrate folder.
#pragma once

#include "io/SubstrateContents.h"

#include <vector>

class vtkTable;

namespace cactus
{

/// Fills the table with a row for each file.
void fillFileTable(vtkTable* table, const std::vector<SubstrateFile>& files);

} // namespace cactus
