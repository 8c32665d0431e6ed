// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSMConvergenceChartHelper.h"

#include "ChartColumns.h"

#include <vtkObjectFactory.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMProxy.h>

#include <string>
#include <vector>

vtkStandardNewMacro(vtkSMConvergenceChartHelper);

namespace
{

const std::string penetration = "MaximumPenetration";
const std::string pairs = "OverlappingPairs";
constexpr int bottomRight = 1; ///< ParaView's number of a plot's axes

} // namespace

vtkSMConvergenceChartHelper::vtkSMConvergenceChartHelper() = default;
vtkSMConvergenceChartHelper::~vtkSMConvergenceChartHelper() = default;

void vtkSMConvergenceChartHelper::PostInitializeProxy(vtkSMProxy* proxy, vtkPVXMLElement*, vtkMTimeType)
{
  const std::vector<std::string> columns = cactus::chartColumns(proxy);
  if (!cactus::hasColumns(columns, { penetration, pairs }))
  {
    return;
  }
  cactus::showColumns(proxy, columns, { penetration, pairs }, "Iteration");
  vtkSMPropertyHelper(proxy, "SeriesPlotCorner").SetStatus(pairs.c_str(), bottomRight);
  vtkSMPropertyHelper(proxy, "SeriesLabel").SetStatus(penetration.c_str(), "largest penetration");
  vtkSMPropertyHelper(proxy, "SeriesLabel").SetStatus(pairs.c_str(), "overlapping pairs");
  proxy->UpdateVTKObjects();
}

void vtkSMConvergenceChartHelper::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
