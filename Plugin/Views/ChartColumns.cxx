// SPDX-License-Identifier: BSD-3-Clause
#include "ChartColumns.h"

#include <vtkSMProperty.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMProxy.h>

#include <algorithm>

namespace cactus
{

std::vector<std::string> chartColumns(vtkSMProxy* chart)
{
  for (const char* name : { "AttributeType", "SeriesVisibility", "SeriesPlotCorner", "SeriesLabel", "SeriesColor" })
  {
    chart->GetProperty(name)->ResetToDomainDefaults();
  }
  const vtkSMPropertyHelper visibility(chart, "SeriesVisibility");
  std::vector<std::string> columns;
  for (unsigned int i = 0; i + 1 < visibility.GetNumberOfElements(); i += 2)
  {
    columns.emplace_back(visibility.GetAsString(i));
  }
  return columns;
}

bool hasColumns(const std::vector<std::string>& columns, const std::vector<std::string>& needed)
{
  return std::all_of(needed.begin(), needed.end(),
    [&](const std::string& name) { return std::find(columns.begin(), columns.end(), name) != columns.end(); });
}

void showColumns(
  vtkSMProxy* chart, const std::vector<std::string>& columns, const std::vector<std::string>& shown, const std::string& bottom)
{
  for (const std::string& column : columns)
  {
    const bool isShown = std::find(shown.begin(), shown.end(), column) != shown.end();
    vtkSMPropertyHelper(chart, "SeriesVisibility").SetStatus(column.c_str(), isShown ? 1 : 0);
  }
  vtkSMPropertyHelper(chart, "UseIndexForXAxis").Set(0);
  vtkSMPropertyHelper(chart, "XArrayName").Set(bottom.c_str());
}

} // namespace cactus
