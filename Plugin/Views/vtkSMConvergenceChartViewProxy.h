// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkSMConvergenceChartViewProxy
 * @brief A chart view whose left and right axes keep ranges that suit logarithms.
 *
 * ParaView's window resets the ranges of all axes when the first data are shown, and by Reset. A logarithmic axis then takes its
 * range from the data, which end at zero overlapping pairs, and shows a warning across the chart instead. Here these two axes
 * return to the ranges in the view's XML.
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

  /** Takes the range of the bottom axis from the data, those of left and right from the XML. */
  void ResetDisplay() override;

protected:
  vtkSMConvergenceChartViewProxy();
  ~vtkSMConvergenceChartViewProxy() override;

private:
  vtkSMConvergenceChartViewProxy(const vtkSMConvergenceChartViewProxy&) = delete;
  void operator=(const vtkSMConvergenceChartViewProxy&) = delete;
};

#endif
