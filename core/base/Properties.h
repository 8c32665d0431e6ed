// SPDX-License-Identifier: BSD-3-Clause
// One description of each parameter, which gives its checks, its printed form, its record, its panel and its row in the docs'
// table.
#pragma once

#include "base/Limits.h"

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace cactus
{

/// The value of any property. A choice is stored as its index among the choices.
using PropertyValue = std::variant<bool, std::int64_t, double, std::string, std::vector<double>>;

/// What a property is for.
enum class PropertyUse
{
  Result, ///< the result depends on it
  Run,    ///< only how the work is done: threads, checkpoints, where files go
  Code    ///< a C++ option that no stage shows to users
};

/// A condition for a property to have an effect: another property has one of `values` (choices by index) or, if `values` is
/// empty, is not 0, off or empty.
struct PropertyCondition
{
  std::string property;
  std::vector<double> values;
};

/// The description of a property.
struct PropertyFacts
{
  std::string name;    ///< the property's name in ParaView
  std::string meaning; ///< its help in panels and docs: sentences, with the unit
  std::optional<Range> range;
  std::vector<std::string> choices;
  std::string advice; ///< ends the message for a value out of range
  PropertyUse use = PropertyUse::Result;
  std::vector<PropertyCondition> conditions; ///< all have to hold
};

/// A property and its value in some options.
struct PropertyState
{
  const PropertyFacts* facts;
  PropertyValue value;
};

/// Throws InvalidInput, naming the property, for the first number that is out of range, infinite or NaN, and for the first
/// unknown choice. Properties without effect are not checked.
void validate(const std::vector<PropertyState>& states);

/// Tells whether a property has an effect: all its conditions hold, and the properties that they name have an effect, too.
bool hasEffect(const PropertyFacts& facts, const std::vector<PropertyState>& states);

/// Returns the value as people read it: choices and switches in words, numbers with all their digits.
std::string valueText(const PropertyFacts& facts, const PropertyValue& value);

/// The properties of a struct of options, each with access to its member. Its properties() makes the list once.
template <typename Options>
class PropertyList
{
public:
  struct Property
  {
    PropertyFacts facts;
    std::function<PropertyValue(const Options&)> get;
    std::function<void(Options&, const PropertyValue&)> set;
  };

  /// Adds a number, whole if the member is.
  template <typename Number>
  PropertyList& add(const char* name, Number Options::*member, const Range& range, const char* meaning)
  {
    static_assert(std::is_arithmetic_v<Number> && !std::is_same_v<Number, bool>);
    return this->insert<std::conditional_t<std::is_integral_v<Number>, std::int64_t, double>>(
      { name, meaning, range, {}, {}, {}, {} }, member);
  }

  /// Adds a choice; the member is an enumeration that counts from 0.
  template <typename Choice>
  PropertyList& add(const char* name, Choice Options::*member, std::vector<std::string> choices, const char* meaning)
  {
    static_assert(std::is_enum_v<Choice>);
    return this->insert<std::int64_t>({ name, meaning, {}, std::move(choices), {}, {}, {} }, member);
  }

  /// Adds a switch, a text, or a list of numbers, none of which has a range.
  template <typename Value>
  PropertyList& add(const char* name, Value Options::*member, const char* meaning)
  {
    static_assert(
      std::is_same_v<Value, bool> || std::is_same_v<Value, std::string> || std::is_same_v<Value, std::vector<double>>);
    return this->insert<Value>({ name, meaning, {}, {}, {}, {}, {} }, member);
  }

  /// Adds a vector of three numbers, which have no range.
  PropertyList& add(const char* name, Eigen::Vector3d Options::*member, const char* meaning)
  {
    this->place({ { name, meaning, {}, {}, {}, {}, {} },
      [member](const Options& options) -> PropertyValue
      { return std::vector<double>((options.*member).data(), (options.*member).data() + 3); },
      [member](Options& options, const PropertyValue& value)
      { options.*member = Eigen::Map<const Eigen::Vector3d>(std::get<std::vector<double>>(value).data()); } });
    return *this;
  }

  /// Adds all properties of options that are a member of these.
  template <typename Part>
  PropertyList& include(Part Options::*part, const PropertyList<Part>& list)
  {
    for (const typename PropertyList<Part>::Property& one : list.all())
    {
      this->place({ one.facts, [part, get = one.get](const Options& options) { return get(options.*part); },
        [part, set = one.set](Options& options, const PropertyValue& value) { set(options.*part, value); } });
    }
    return *this;
  }

  /// Selects the included property of this name, in place of the last one, for the calls that follow.
  PropertyList& at(const std::string& name)
  {
    this->Last = this->placeOf(name);
    return *this;
  }
  /// Limits the effect of the last property to options in which `property` has one of these values.
  PropertyList& where(const char* property, std::vector<double> values)
  {
    this->Properties[this->Last].facts.conditions.push_back({ property, std::move(values) });
    return *this;
  }
  /// Limits the effect of the last property to options in which `property` is not 0, off or empty.
  PropertyList& whereGiven(const char* property) { return this->where(property, {}); }
  /// Sets the end of messages about the last property.
  PropertyList& advise(const char* advice)
  {
    this->Properties[this->Last].facts.advice = advice;
    return *this;
  }
  /// Sets the meaning of the last property, for an included one that means more here.
  PropertyList& means(const char* meaning)
  {
    this->Properties[this->Last].facts.meaning = meaning;
    return *this;
  }
  /// Sets the use of the last property, if it is not the result.
  PropertyList& use(PropertyUse use)
  {
    this->Properties[this->Last].facts.use = use;
    return *this;
  }

  const std::vector<Property>& all() const { return this->Properties; }

  /// Returns null for an unknown name.
  const Property* find(const std::string& name) const
  {
    const std::size_t place = this->placeOf(name);
    return place < this->Properties.size() ? &this->Properties[place] : nullptr;
  }

  std::vector<PropertyState> states(const Options& options) const
  {
    std::vector<PropertyState> states;
    states.reserve(this->Properties.size());
    for (const Property& property : this->Properties)
    {
      states.push_back({ &property.facts, property.get(options) });
    }
    return states;
  }

private:
  std::size_t placeOf(const std::string& name) const
  {
    const auto found = std::find_if(
      this->Properties.begin(), this->Properties.end(), [&](const Property& property) { return property.facts.name == name; });
    return static_cast<std::size_t>(found - this->Properties.begin());
  }

  /// Adds a member of any type that can be cast to `Value` and back. (Seeds are unsigned; the cast returns the same value.)
  template <typename Value, typename Member>
  PropertyList& insert(PropertyFacts facts, Member Options::*member)
  {
    this->place({ std::move(facts), [member](const Options& options) -> PropertyValue { return Value(options.*member); },
      [member](Options& options, const PropertyValue& value) { options.*member = Member(std::get<Value>(value)); } });
    return *this;
  }

  /// Adds a property at the end, or replaces the included one of the same name.
  void place(Property property)
  {
    this->Last = this->placeOf(property.facts.name);
    if (this->Last < this->Properties.size())
    {
      this->Properties[this->Last] = std::move(property);
      return;
    }
    this->Properties.push_back(std::move(property));
  }

  std::vector<Property> Properties;
  std::size_t Last = 0; ///< the one that was added last
};

/// Calls validate() with the properties of `options`.
template <typename Options>
void validateProperties(const Options& options)
{
  validate(Options::properties().states(options));
}

} // namespace cactus
