// SPDX-License-Identifier: BSD-3-Clause
// The columns of a table that a chart shows.
#pragma once

#include <string>
#include <vector>

class vtkSMProxy;

namespace cactus
{

/// Returns the columns that a representation can show, after setting ParaView's defaults for its table. ParaView sets these only
/// after an initialisation helper, and keeps what the helper has set: here, that columns are those of a table's rows, one for
/// each.
std::vector<std::string> chartColumns(vtkSMProxy* chart);

/// Tells whether all needed columns exist.
bool hasColumns(const std::vector<std::string>& columns, const std::vector<std::string>& needed);

/// Shows only the given columns, over the column `bottom`.
void showColumns(
  vtkSMProxy* chart, const std::vector<std::string>& columns, const std::vector<std::string>& shown, const std::string& bottom);

} // namespace cactus
