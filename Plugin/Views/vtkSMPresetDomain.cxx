// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSMPresetDomain.h"

#include "stages/Presets.h"

#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPVXMLElement.h>
#include <vtkSMIntVectorProperty.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMSourceProxy.h>
#include <vtkSMUncheckedPropertyHelper.h>
#include <vtkSMVectorProperty.h>
#include <vtkSmartPointer.h>

#include <algorithm>
#include <cstdint>
#include <type_traits>

vtkStandardNewMacro(vtkSMPresetDomain);

namespace
{

const cactus::Preset* presetOf(int number)
{
  const std::vector<cactus::Preset>& all = cactus::presets();
  return number > 0 && static_cast<std::size_t>(number) <= all.size() ? &all[static_cast<std::size_t>(number) - 1] : nullptr;
}

/// Returns a number or a choice as a number; presets set nothing else.
double numberOf(const cactus::PropertyValue& value)
{
  const auto* choice = std::get_if<std::int64_t>(&value);
  return choice != nullptr ? static_cast<double>(*choice) : std::get<double>(value);
}

double checkedOf(vtkSMProperty* property)
{
  return vtkSMPropertyHelper(property).GetAsDouble();
}

double uncheckedOf(vtkSMProperty* property)
{
  return vtkSMUncheckedPropertyHelper(property).GetAsDouble();
}

/// Sets a property's value and its unchecked value, which a panel shows.
void setChecked(vtkSMProperty* property, double value)
{
  if (checkedOf(property) != value)
  {
    vtkSMPropertyHelper(property).Set(value);
  }
  if (uncheckedOf(property) != value)
  {
    vtkSMUncheckedPropertyHelper(property).Set(value);
  }
}

/// Returns all properties of a proxy's XML that hold values, in the form of a domain's required properties, each by its name.
vtkSmartPointer<vtkPVXMLElement> requiredProperties(vtkPVXMLElement* proxy)
{
  auto required = vtkSmartPointer<vtkPVXMLElement>::New();
  required->SetName("RequiredProperties");
  for (unsigned int i = 0; i < proxy->GetNumberOfNestedElements(); ++i)
  {
    vtkPVXMLElement* property = proxy->GetNestedElement(i);
    const std::string name = property->GetAttributeOrEmpty("name");
    if (name != "Preset" && std::string(property->GetName()).find("VectorProperty") != std::string::npos)
    {
      vtkNew<vtkPVXMLElement> one;
      one->SetName("Property");
      one->AddAttribute("name", name.c_str());
      one->AddAttribute("function", name.c_str());
      required->AddNestedElement(one);
    }
  }
  return required;
}

} // namespace

vtkSMPresetDomain::vtkSMPresetDomain() = default;
vtkSMPresetDomain::~vtkSMPresetDomain() = default;

vtkSMPresetDomain* vtkSMPresetDomain::Of(vtkSMProxy* proxy)
{
  vtkSMProperty* choice = proxy != nullptr ? proxy->GetProperty("Preset") : nullptr;
  return choice != nullptr ? choice->FindDomain<vtkSMPresetDomain>() : nullptr;
}

vtkSMIntVectorProperty* vtkSMPresetDomain::choice()
{
  return vtkSMIntVectorProperty::SafeDownCast(this->GetProperty());
}

int vtkSMPresetDomain::Applied()
{
  return this->choice()->GetElement(0);
}

std::vector<vtkSMPresetDomain::Value> vtkSMPresetDomain::valuesOf(int preset)
{
  std::vector<Value> values;
  if (const cactus::Preset* found = presetOf(preset))
  {
    for (const auto& [name, value] : cactus::presetValues(*found, this->Stage))
    {
      values.push_back({ this->GetRequiredProperty(name.c_str()), numberOf(value) });
    }
  }
  else if (this->IsInherited)
  {
    values = this->Defaults;
  }
  return values;
}

int vtkSMPresetDomain::ReadXMLAttributes(vtkSMProperty* property, vtkPVXMLElement* element)
{
  this->Stage = element->GetAttributeOrEmpty("stage");
  const auto values = cactus::presetValues(cactus::presets().front(), this->Stage);
  // The presets replace the description of required properties in XML. These are made here, before their turn, so all others have
  // to be as well: a panel shows properties in the order of their creation.
  vtkNew<vtkPVXMLElement> described;
  element->CopyTo(described);
  described->AddNestedElement(requiredProperties(element->GetParent()->GetParent()));
  if (values.empty() || !this->Superclass::ReadXMLAttributes(property, described))
  {
    vtkErrorMacro("there are no presets for a stage '" << this->Stage << "'");
    return 0;
  }
  this->AddRequiredProperty(property, "Preset");
  this->AddEntry("None", 0);
  int number = 0;
  for (const cactus::Preset& preset : cactus::presets())
  {
    this->AddEntry(preset.name.c_str(), ++number);
  }
  for (const Value& value : this->valuesOf(1))
  {
    this->Defaults.push_back({ value.property, checkedOf(value.property) });
    // A temporary other size marks it as never set, so that setting its own value also changes its time. For the same reason
    // Preset itself has no default.
    auto* property = vtkSMVectorProperty::SafeDownCast(value.property);
    property->SetNumberOfElements(2);
    property->SetNumberOfElements(1);
  }
  return 1;
}

void vtkSMPresetDomain::Update(vtkSMProperty* changed)
{
  if (this->IsBusy)
  {
    return;
  }
  this->IsBusy = true;
  if (changed == this->GetProperty())
  {
    this->applyChoice();
  }
  else
  {
    this->dropChoice(changed);
  }
  this->IsBusy = false;
}

void vtkSMPresetDomain::applyChoice()
{
  const int preset = this->choice()->GetUncheckedElement(0);
  const bool isApplied = this->Applied() == preset;
  for (const Value& value : this->valuesOf(preset))
  {
    if (isApplied)
    {
      setChecked(value.property, value.number);
    }
    else if (uncheckedOf(value.property) != value.number)
    {
      vtkSMUncheckedPropertyHelper(value.property).Set(value.number);
    }
  }
  this->IsInherited = this->IsInherited && preset == this->Former;
  if (isApplied && preset != this->Former)
  {
    const int former = this->Former;
    this->Former = preset;
    if (presetOf(preset) != nullptr)
    {
      this->leadOthers(former, preset);
    }
  }
}

void vtkSMPresetDomain::dropChoice(vtkSMProperty* changed)
{
  const std::vector<Value> values = this->valuesOf(this->choice()->GetUncheckedElement(0));
  if (std::all_of(values.begin(), values.end(), [](const Value& value) { return uncheckedOf(value.property) == value.number; }))
  {
    return;
  }
  this->IsInherited = false;
  if (checkedOf(changed) == uncheckedOf(changed))
  {
    this->choice()->SetElement(0, 0);
  }
  this->choice()->SetUncheckedElement(0, 0);
}

void vtkSMPresetDomain::Start(int preset, vtkMTimeType since)
{
  this->IsBusy = true;
  const bool takes = preset != 0 && this->choice()->GetMTime() <= since;
  this->IsInherited = takes;
  for (const Value& value : takes ? this->valuesOf(preset) : this->Defaults)
  {
    const bool isGiven = value.property->GetMTime() > since;
    vtkSMPropertyHelper(value.property).Set(takes && !isGiven ? value.number : checkedOf(value.property));
    this->IsGiven = this->IsGiven || isGiven;
    this->IsInherited = this->IsInherited && checkedOf(value.property) == value.number;
  }
  this->choice()->SetElement(0, this->IsInherited ? preset : this->Applied());
  this->Former = takes ? preset : this->Former;
  this->IsBusy = false;
}

bool vtkSMPresetDomain::isUntouched()
{
  return !this->IsGiven && std::all_of(this->Defaults.begin(), this->Defaults.end(),
                             [](const Value& value) { return value.property->IsValueDefault(); });
}

void vtkSMPresetDomain::leadOthers(int former, int preset)
{
  std::vector<vtkSMProxy*> sources{ this->choice()->GetParent() };
  while (!sources.empty())
  {
    vtkSMProxy* source = sources.back();
    sources.pop_back();
    for (unsigned int i = 0; i < source->GetNumberOfConsumers(); ++i)
    {
      vtkSMProxy* other = vtkSMSourceProxy::SafeDownCast(source->GetConsumerProxy(i));
      if (other == nullptr)
      {
        continue;
      }
      sources.push_back(other);
      vtkSMPresetDomain* domain = vtkSMPresetDomain::Of(other);
      if (domain != nullptr && (domain->Applied() == 0 ? domain->isUntouched() : domain->Applied() == former))
      {
        domain->choice()->SetElement(0, preset);
        domain->IsInherited = true;
        other->UpdateVTKObjects();
      }
    }
  }
}

void vtkSMPresetDomain::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Stage: " << this->Stage << '\n';
}
