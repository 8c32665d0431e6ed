// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkSMLabelImageHelper
 * @brief Proposes FibreId to a writer of a label image, whose active array is Depth, by which it is seen.
 */
#ifndef vtkSMLabelImageHelper_h
#define vtkSMLabelImageHelper_h

#include "CactusViewsModule.h"

#include "vtkSMProxyInitializationHelper.h"

class CACTUSVIEWS_EXPORT vtkSMLabelImageHelper : public vtkSMProxyInitializationHelper
{
public:
  static vtkSMLabelImageHelper* New();
  vtkTypeMacro(vtkSMLabelImageHelper, vtkSMProxyInitializationHelper);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** Chooses FibreId where Depth would be written; what a script chooses comes later. */
  void PostInitializeProxy(vtkSMProxy* proxy, vtkPVXMLElement* xml, vtkMTimeType initializationTimeStamp) override;

protected:
  vtkSMLabelImageHelper();
  ~vtkSMLabelImageHelper() override;

private:
  vtkSMLabelImageHelper(const vtkSMLabelImageHelper&) = delete;
  void operator=(const vtkSMLabelImageHelper&) = delete;
};

#endif
