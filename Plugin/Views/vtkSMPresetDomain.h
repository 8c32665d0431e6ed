// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkSMPresetDomain
 * @brief The list of presets, and the effect of a choice: it sets the properties of its proxy.
 *
 * For an integer property named Preset that has neither a command nor a default. In XML, `stage` names the stage whose values are
 * set (see core/stages/Presets.h, which has all of them). Value 0 is "None".
 *
 * A preset chosen in a panel shows in the panel at once, and reaches the proxy with Apply. As soon as one of its values is
 * changed, the choice becomes None: it never names a preset that does not hold. When another preset is applied, later stages in
 * the pipeline take it as well, if they had the former one or if their values are untouched.
 *
 * None leaves values as they are, except if a stage has its preset from earlier stages: then it sets defaults. A Python state of
 * ParaView makes stages anew, sets their choices, and then the values that differ from defaults.
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

  /** Returns that of a proxy; null if it has none. */
  static vtkSMPresetDomain* Of(vtkSMProxy* proxy);

  /** Returns the number of the applied preset. */
  int Applied();

  /** Returns the preset that was chosen last, even if one of its values has been changed since: later stages start with it. */
  int Chosen() const { return this->Former; }

  /**
   * For a new proxy: applies a preset, unless it is 0 or another was chosen since that time, to all properties without a value
   * since; it is also chosen by name if none was.
   */
  void Start(int preset, vtkMTimeType since);

  /** Keeps the preset and its values consistent after a change of any of them. */
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
  int Former = 0;           ///< the last preset chosen
  bool IsGiven = false;     ///< a value was set when the proxy was made
  bool IsInherited = false; ///< the preset is that of earlier stages, and the user has neither chosen one here nor changed a
                            ///< value
  bool IsBusy = false;
};

#endif
