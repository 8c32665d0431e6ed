// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSMConvergenceChartHelper.h"

#include <vtkObjectFactory.h>
#include <vtkSMProperty.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMProxy.h>

#include <algorithm>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkSMConvergenceChartHelper);

namespace
{

const std::string penetration = "MaximumPenetration";
const std::string pairs = "OverlappingPairs";
constexpr int bottomRight = 1; ///< a plot's axes, as ParaView numbers them

/// The columns that a representation can show.
std::vector<std::string> columnsOf(vtkSMProxy* chart)
{
  const vtkSMPropertyHelper visibility(chart, "SeriesVisibility");
  std::vector<std::string> columns;
  for (unsigned int i = 0; i + 1 < visibility.GetNumberOfElements(); i += 2)
  {
    columns.emplace_back(visibility.GetAsString(i));
  }
  return columns;
}

} // namespace

vtkSMConvergenceChartHelper::vtkSMConvergenceChartHelper() = default;
vtkSMConvergenceChartHelper::~vtkSMConvergenceChartHelper() = default;

void vtkSMConvergenceChartHelper::PostInitializeProxy(vtkSMProxy* proxy, vtkPVXMLElement*, vtkMTimeType)
{
  // ParaView sets its defaults after this, but for what is set here: that the columns are those of a table's rows, and one for
  // each.
  for (const char* name : { "AttributeType", "SeriesVisibility", "SeriesPlotCorner", "SeriesLabel" })
  {
    proxy->GetProperty(name)->ResetToDomainDefaults();
  }
  const std::vector<std::string> columns = columnsOf(proxy);
  for (const std::string& needed : { penetration, pairs })
  {
    if (std::find(columns.begin(), columns.end(), needed) == columns.end())
    {
      return;
    }
  }
  for (const std::string& column : columns)
  {
    vtkSMPropertyHelper(proxy, "SeriesVisibility").SetStatus(column.c_str(), column == penetration || column == pairs ? 1 : 0);
  }
  vtkSMPropertyHelper(proxy, "SeriesPlotCorner").SetStatus(pairs.c_str(), bottomRight);
  vtkSMPropertyHelper(proxy, "SeriesLabel").SetStatus(penetration.c_str(), "largest penetration");
  vtkSMPropertyHelper(proxy, "SeriesLabel").SetStatus(pairs.c_str(), "overlapping pairs");
  vtkSMPropertyHelper(proxy, "UseIndexForXAxis").Set(0);
  vtkSMPropertyHelper(proxy, "XArrayName").Set("Iteration");
  proxy->UpdateVTKObjects();
}

void vtkSMConvergenceChartHelper::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
