// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkSMPresetDomain
 * @brief the presets to choose from, and what a choice does: it gives the properties of its proxy their values
 *
 * For an integer property that is called Preset and has neither a command nor a default. In XML, `stage` names the stage whose
 * values are meant (see core/stages/Presets.h, where all of them stand). Value 0 is "None".
 *
 * A preset that is chosen in a panel shows in the panel at once, and becomes the proxy's with Apply. As soon as one of its values
 * is another one, the choice is None: it never names what is not so. When another preset is applied, the stages that follow in
 * the pipeline take it as well, where they had the former one or nobody has touched their values.
 *
 * None leaves values as they are, but where a stage has its preset from the stages before it: there they become defaults. A
 * Python state of ParaView's makes stages anew, names their choices, and then what differs from defaults.
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

  /**
   * For a new proxy: applies a preset, unless it is 0 or a choice was made since that time, to all properties that were given no
   * value since; it is named where none was.
   */
  void Start(int preset, vtkMTimeType since);

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
  std::vector<Value> Defaults;
  int Former = 0;           ///< the preset that was chosen last
  bool IsGiven = false;     ///< a value was given when the proxy was made
  bool IsInherited = false; ///< the preset is that of the stages before, and nobody has chosen it here or changed a value
  bool IsBusy = false;
};

#endif
