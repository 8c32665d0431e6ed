// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkSMSubstrateDataDomain
 * @brief what of a substrate an input can take, so that ParaView offers each filter where it can be applied, and only there
 *
 * ParaView's own domains know of types of data and of numbers of components, not of the names of arrays. In XML, `kinds` lists
 * what is taken, one of which the data have to be:
 * - `fibres`: point data Radius;
 * - `surfaces`: cell data FibreId, or field data FibreId as a block of one fibre has it, and no Radius;
 * - `labels`: point data FibreId and Depth;
 * - `lines`: what is not `surfaces`. (What cells the data have, ParaView does not tell.)
 *
 * ParaView's menu of filters asks the input whose name comes first in the alphabet, although it connects what is selected to the
 * one that comes first in XML. So an input may name the latter as required property `First`: as long as nothing is connected
 * there, what it takes is what counts.
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

  /** Whether each connection of an input property holds one of the kinds. */
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
