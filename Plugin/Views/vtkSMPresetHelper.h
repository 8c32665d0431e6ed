// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkSMPresetHelper
 * @brief Lets a new stage start with the preset of its inputs.
 *
 * If all sources with presets before a new filter have the same one, the filter starts with its values, except those that a
 * script sets.
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

  /** Applies the preset, unless the filter was given one. */
  void PostInitializeProxy(vtkSMProxy* proxy, vtkPVXMLElement* xml, vtkMTimeType initializationTimeStamp) override;

protected:
  vtkSMPresetHelper();
  ~vtkSMPresetHelper() override;

private:
  vtkSMPresetHelper(const vtkSMPresetHelper&) = delete;
  void operator=(const vtkSMPresetHelper&) = delete;
};

#endif
