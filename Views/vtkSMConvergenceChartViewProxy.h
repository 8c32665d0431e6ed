// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkSMConvergenceChartViewProxy
 * @brief a chart view whose left and right axes keep ranges that logarithms have
 *
 * ParaView's window lets go of the ranges of all axes when the first data are shown, and by Reset. A logarithmic axis then takes
 * its range from the data, which end at zero overlapping pairs, and has a warning across the chart instead. Here these two axes
 * go back to the ranges of the view's XML.
 */
#ifndef vtkSMConvergenceChartViewProxy_h
#define vtkSMConvergenceChartViewProxy_h

#include "CactusViewsModule.h"

#include "vtkSMContextViewProxy.h"

class CACTUSVIEWS_EXPORT vtkSMConvergenceChartViewProxy : public vtkSMContextViewProxy
{
public:
  static vtkSMConvergenceChartViewProxy* New();
  vtkTypeMacro(vtkSMConvergenceChartViewProxy, vtkSMContextViewProxy);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** The bottom axis takes its range from the data, left and right those of the XML. */
  void ResetDisplay() override;

protected:
  vtkSMConvergenceChartViewProxy();
  ~vtkSMConvergenceChartViewProxy() override;

private:
  vtkSMConvergenceChartViewProxy(const vtkSMConvergenceChartViewProxy&) = delete;
  void operator=(const vtkSMConvergenceChartViewProxy&) = delete;
};

#endif
