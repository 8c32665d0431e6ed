// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkSMSubstrateDataDomain
 * @brief The kind of substrate data that an input accepts, so that ParaView offers each filter exactly where it can be applied.
 *
 * ParaView's own domains check types of data and numbers of components, but not the names of arrays. In XML, `kinds` lists the
 * accepted kinds, one of which the data must have:
 *
 * ParaView's menu of filters asks the input whose name comes first in the alphabet, although it connects the selection to the one
 * that comes first in XML. So an input may name the latter as required property `First`: while nothing is connected there, its
 * kinds count.
 */
#ifndef vtkSMSubstrateDataDomain_h
#define vtkSMSubstrateDataDomain_h

#include "CactusViewsModule.h"

#include "vtkSMDomain.h"

#include <string>
#include <vector>

class CACTUSVIEWS_EXPORT vtkSMSubstrateDataDomain : public vtkSMDomain
{
public:
  static vtkSMSubstrateDataDomain* New();
  vtkTypeMacro(vtkSMSubstrateDataDomain, vtkSMDomain);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** Tells whether each connection of an input property holds one of the kinds. */
  int IsInDomain(vtkSMProperty* property) override;

protected:
  vtkSMSubstrateDataDomain();
  ~vtkSMSubstrateDataDomain() override;

  int ReadXMLAttributes(vtkSMProperty* property, vtkPVXMLElement* element) override;

private:
  vtkSMSubstrateDataDomain(const vtkSMSubstrateDataDomain&) = delete;
  void operator=(const vtkSMSubstrateDataDomain&) = delete;

  std::vector<std::string> Kinds;
};

#endif
