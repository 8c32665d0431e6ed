// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkSMConvergenceChartHelper
 * @brief which columns of CapsuleOptimizer's table a chart of its convergence shows at first
 *
 * ParaView's charts show every column on one axis. Of a table with MaximumPenetration and OverlappingPairs these two are shown,
 * over Iteration, the second on an axis of its own at the right. Other tables are shown as ever. It is called when the
 * representation that names it in its Hints is made; what is chosen by hand afterwards stays.
 */
#ifndef vtkSMConvergenceChartHelper_h
#define vtkSMConvergenceChartHelper_h

#include "CactusViewsModule.h"

#include "vtkSMProxyInitializationHelper.h"

class CACTUSVIEWS_EXPORT vtkSMConvergenceChartHelper : public vtkSMProxyInitializationHelper
{
public:
  static vtkSMConvergenceChartHelper* New();
  vtkTypeMacro(vtkSMConvergenceChartHelper, vtkSMProxyInitializationHelper);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** Chooses the columns of a chart's representation. */
  void PostInitializeProxy(vtkSMProxy* proxy, vtkPVXMLElement* xml, vtkMTimeType initializationTimeStamp) override;

protected:
  vtkSMConvergenceChartHelper();
  ~vtkSMConvergenceChartHelper() override;

private:
  vtkSMConvergenceChartHelper(const vtkSMConvergenceChartHelper&) = delete;
  void operator=(const vtkSMConvergenceChartHelper&) = delete;
};

#endif
