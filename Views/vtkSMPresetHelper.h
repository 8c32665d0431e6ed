// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkSMPresetHelper
 * @brief lets a new stage start with the preset of what it is connected to
 *
 * Where all sources before a new filter that have presets have the same one, the filter starts with its values, but for those
 * that a script gives it.
 */
#ifndef vtkSMPresetHelper_h
#define vtkSMPresetHelper_h

#include "CactusViewsModule.h"

#include "vtkSMProxyInitializationHelper.h"

class CACTUSVIEWS_EXPORT vtkSMPresetHelper : public vtkSMProxyInitializationHelper
{
public:
  static vtkSMPresetHelper* New();
  vtkTypeMacro(vtkSMPresetHelper, vtkSMProxyInitializationHelper);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** Takes the preset over, unless the filter was given one. */
  void PostInitializeProxy(vtkSMProxy* proxy, vtkPVXMLElement* xml, vtkMTimeType initializationTimeStamp) override;

protected:
  vtkSMPresetHelper();
  ~vtkSMPresetHelper() override;

private:
  vtkSMPresetHelper(const vtkSMPresetHelper&) = delete;
  void operator=(const vtkSMPresetHelper&) = delete;
};

#endif
