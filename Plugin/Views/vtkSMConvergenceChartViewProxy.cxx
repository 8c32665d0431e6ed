// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSMConvergenceChartViewProxy.h"

#include <vtkObjectFactory.h>
#include <vtkSMProperty.h>

vtkStandardNewMacro(vtkSMConvergenceChartViewProxy);

vtkSMConvergenceChartViewProxy::vtkSMConvergenceChartViewProxy() = default;
vtkSMConvergenceChartViewProxy::~vtkSMConvergenceChartViewProxy() = default;

void vtkSMConvergenceChartViewProxy::ResetDisplay()
{
  this->Superclass::ResetDisplay();
  for (const char* name : { "LeftAxisUseCustomRange", "LeftAxisRangeMinimum", "LeftAxisRangeMaximum", "RightAxisUseCustomRange",
         "RightAxisRangeMinimum", "RightAxisRangeMaximum" })
  {
    if (vtkSMProperty* property = this->GetProperty(name))
    {
      property->ResetToXMLDefaults();
    }
  }
  this->UpdateVTKObjects();
}

void vtkSMConvergenceChartViewProxy::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
