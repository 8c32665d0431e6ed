// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSMHistogramChartHelper.h"

#include "ChartColumns.h"

#include <vtkObjectFactory.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMProxy.h>

#include <array>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkSMHistogramChartHelper);

namespace
{

struct Bars
{
  std::string column;
  std::string label;
  std::array<double, 3> colour; ///< red, green, blue
};

/// Targets are grey, myelin and axons have the colours of their surfaces.
const std::vector<Bars>& radii()
{
  static const std::vector<Bars> all = { { "TargetRadiusFibres", "outer, asked for", { { 0.6, 0.6, 0.6 } } },
    { "OuterRadiusFibres", "outer", { { 0.80, 0.20, 0.18 } } }, { "InnerRadiusFibres", "inner", { { 0.26, 0.45, 0.80 } } } };
  return all;
}

} // namespace

vtkSMHistogramChartHelper::vtkSMHistogramChartHelper() = default;
vtkSMHistogramChartHelper::~vtkSMHistogramChartHelper() = default;

void vtkSMHistogramChartHelper::PostInitializeProxy(vtkSMProxy* proxy, vtkPVXMLElement*, vtkMTimeType)
{
  std::vector<std::string> wanted;
  for (const Bars& bars : radii())
  {
    wanted.push_back(bars.column);
  }
  const std::string middle = "RadiusMiddle_um";
  const std::vector<std::string> columns = cactus::chartColumns(proxy);
  if (!cactus::hasColumns(columns, wanted) || !cactus::hasColumns(columns, { middle }))
  {
    return;
  }
  cactus::showColumns(proxy, columns, wanted, middle);
  for (Bars bars : radii()) // ParaView needs modifiable colours
  {
    vtkSMPropertyHelper(proxy, "SeriesLabel").SetStatus(bars.column.c_str(), bars.label.c_str());
    vtkSMPropertyHelper(proxy, "SeriesColor").SetStatus(bars.column.c_str(), bars.colour.data(), 3);
  }
  proxy->UpdateVTKObjects();
}

void vtkSMHistogramChartHelper::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
