// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkSMConvergenceChartHelper
 * @brief Initial columns in a chart of CapsuleOptimizer's convergence table.
 *
 * ParaView's charts show every column on one axis. For a table with MaximumPenetration and OverlappingPairs, only these two are
 * shown, over Iteration, the second with its own axis on the right. Other tables are shown as usual. ParaView calls this helper
 * when it makes the representation that names it in its Hints; later choices of the user stay.
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
