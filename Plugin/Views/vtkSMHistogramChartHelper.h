// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkSMHistogramChartHelper
 * @brief Initial columns in a chart of SubstrateStatistics' histograms.
 *
 * ParaView's charts show every column. For a table with counts of fibres by radius, only these are shown: target, outer and
 * inner, each in its own colour, over the middles of the bins. Other tables are shown as usual. ParaView calls this helper when
 * it makes the representation that names it in its Hints; later choices of the user stay.
 */
#ifndef vtkSMHistogramChartHelper_h
#define vtkSMHistogramChartHelper_h

#include "CactusViewsModule.h"

#include "vtkSMProxyInitializationHelper.h"

class CACTUSVIEWS_EXPORT vtkSMHistogramChartHelper : public vtkSMProxyInitializationHelper
{
public:
  static vtkSMHistogramChartHelper* New();
  vtkTypeMacro(vtkSMHistogramChartHelper, vtkSMProxyInitializationHelper);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** Chooses the columns of a chart's representation. */
  void PostInitializeProxy(vtkSMProxy* proxy, vtkPVXMLElement* xml, vtkMTimeType initializationTimeStamp) override;

protected:
  vtkSMHistogramChartHelper();
  ~vtkSMHistogramChartHelper() override;

private:
  vtkSMHistogramChartHelper(const vtkSMHistogramChartHelper&) = delete;
  void operator=(const vtkSMHistogramChartHelper&) = delete;
};

#endif
