// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkSMHistogramChartHelper
 * @brief which columns of SubstrateStatistics' histograms a chart shows at first
 *
 * ParaView's charts show every column. Of a table with counts of fibres by their radii these are shown: asked for, outer and
 * inner, each in a colour of its own, over the middles of the bins. Other tables are shown as ever. It is called when the
 * representation that names it in its Hints is made; what is chosen by hand afterwards stays.
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
