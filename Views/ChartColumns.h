// SPDX-License-Identifier: BSD-3-Clause
// The columns of a table that a chart's representation shows.
#pragma once

#include <string>
#include <vector>

class vtkSMProxy;

namespace cactus
{

/// The columns that a representation can show, once it has ParaView's defaults for the table that it is given. ParaView sets its
/// defaults after an initialisation helper, but for what that has set: that the columns are those of a table's rows, and one for
/// each.
std::vector<std::string> chartColumns(vtkSMProxy* chart);

/// Whether all those that are needed are among the columns.
bool hasColumns(const std::vector<std::string>& columns, const std::vector<std::string>& needed);

/// Shows these of the columns, and no others, over the column `bottom`.
void showColumns(
  vtkSMProxy* chart, const std::vector<std::string>& columns, const std::vector<std::string>& shown, const std::string& bottom);

} // namespace cactus
