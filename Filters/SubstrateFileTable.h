// SPDX-License-Identifier: BSD-3-Clause
// The table of the surfaces' files that filters which write a substrate folder give.
#pragma once

#include "io/SubstrateContents.h"

#include <vector>

class vtkTable;

namespace cactus
{

/// A row for each file.
void fillFileTable(vtkTable* table, const std::vector<SubstrateFile>& files);

} // namespace cactus
