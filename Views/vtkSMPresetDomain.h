// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkSMPresetDomain
 * @brief the presets to choose from, and what a choice does: it gives the properties of its proxy their values
 *
 * For an integer property that is called Preset and has no command. In XML, `stage` names the stage whose values are meant (see
 * core/stages/Presets.h, where all of them stand). Value 0 is "None".
 *
 * A preset that is chosen in a panel shows in the panel at once, and becomes the proxy's with Apply. As soon as one of its values
 * is another one, the choice is None: it never names what is not so. When another preset is applied, the stages that follow in
 * the pipeline take it as well, where they had the former one or nobody has touched their values.
 */
#ifndef vtkSMPresetDomain_h
#define vtkSMPresetDomain_h

#include "CactusViewsModule.h"

#include "vtkSMEnumerationDomain.h"

#include <string>
#include <vector>

class vtkSMIntVectorProperty;
class vtkSMProxy;

class CACTUSVIEWS_EXPORT vtkSMPresetDomain : public vtkSMEnumerationDomain
{
public:
  static vtkSMPresetDomain* New();
  vtkTypeMacro(vtkSMPresetDomain, vtkSMEnumerationDomain);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** That of a proxy; null where it has none. */
  static vtkSMPresetDomain* Of(vtkSMProxy* proxy);

  /** The preset that is applied, by its number. */
  int Applied();

  /** The preset that was chosen last, also where one of its values has been changed since: what follows starts with it. */
  int Chosen() const { return this->Former; }

  /** Applies a preset to all properties that have not been changed since that time; it is named where none had been. */
  void Take(int preset, vtkMTimeType since);

  /** Keeps the preset and its values together after a change of any of them. */
  void Update(vtkSMProperty* changed) override;

protected:
  vtkSMPresetDomain();
  ~vtkSMPresetDomain() override;

  int ReadXMLAttributes(vtkSMProperty* property, vtkPVXMLElement* element) override;

private:
  vtkSMPresetDomain(const vtkSMPresetDomain&) = delete;
  void operator=(const vtkSMPresetDomain&) = delete;

  struct Value
  {
    vtkSMProperty* property;
    double number;
  };

  vtkSMIntVectorProperty* choice();
  std::vector<Value> valuesOf(int preset);
  void applyChoice();
  void dropChoice(vtkSMProperty* changed);
  bool isUntouched();
  void leadOthers(int former, int preset);

  std::string Stage;
  int Former = 0; ///< the preset that was chosen last
  bool IsBusy = false;
};

#endif
