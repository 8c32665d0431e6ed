// SPDX-License-Identifier: BSD-3-Clause
// One description of each parameter, from which come its checks, what is printed and kept of it, and the docs' table.
#pragma once

#include "base/Limits.h"

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

/// The value of any property. A choice is a whole number, its place among the choices.
using PropertyValue = std::variant<bool, std::int64_t, double, std::string, std::vector<double>>;

/// What a property is for.
enum class PropertyUse
{
  Result, ///< the result depends on it
  Run,    ///< only how the work is done: threads, checkpoints, where files go
  Code    ///< of the options in C++; no stage shows it to users
};

/// A property has an effect only where another one has one of these values (choices by number), or, where there are none, any
/// but 0, off and the empty text.
struct PropertyCondition
{
  std::string property;
  std::vector<double> values;
};

/// All there is to say of a property.
struct PropertyFacts
{
  std::string name;    ///< that of the property in ParaView
  std::string meaning; ///< one sentence, with the unit where `range` has none
  std::optional<Range> range;
  std::vector<std::string> choices;
  std::string advice; ///< ends the message for a value out of range
  PropertyUse use = PropertyUse::Result;
  std::vector<PropertyCondition> conditions; ///< all have to hold
};

/// A property with the value that it has in some options.
struct PropertyState
{
  const PropertyFacts* facts;
  PropertyValue value;
};

/// Throws InvalidInput, naming the property, for the first number out of its range, infinite or NaN, and for the first choice
/// that there is not. Properties without effect are not looked at.
void validate(const std::vector<PropertyState>& states);

/// Whether a property has an effect: all that it depends on has the values for that, and has an effect, too.
bool hasEffect(const PropertyFacts& facts, const std::vector<PropertyState>& states);

/// The value as people read it: choices and switches in words, numbers with all their digits.
std::string valueText(const PropertyFacts& facts, const PropertyValue& value);

/// The properties of a struct of options, each with the way to its member. Made once for each struct, by its properties().
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

  /// A number, whole where the member is.
  template <typename Number>
  PropertyList& add(const char* name, Number Options::*member, const Range& range, const char* meaning)
  {
    static_assert(std::is_arithmetic_v<Number> && !std::is_same_v<Number, bool>);
    return this->insert<std::conditional_t<std::is_integral_v<Number>, std::int64_t, double>>(
      { name, meaning, range, {}, {}, {}, {} }, member);
  }

  /// One of several choices; the member is an enumeration that counts them from 0.
  template <typename Choice>
  PropertyList& add(const char* name, Choice Options::*member, std::vector<std::string> choices, const char* meaning)
  {
    static_assert(std::is_enum_v<Choice>);
    return this->insert<std::int64_t>({ name, meaning, {}, std::move(choices), {}, {}, {} }, member);
  }

  /// A switch, a text, or a list of numbers, none of which has a range.
  template <typename Value>
  PropertyList& add(const char* name, Value Options::*member, const char* meaning)
  {
    static_assert(
      std::is_same_v<Value, bool> || std::is_same_v<Value, std::string> || std::is_same_v<Value, std::vector<double>>);
    return this->insert<Value>({ name, meaning, {}, {}, {}, {}, {} }, member);
  }

  /// All properties of options that are a part of these.
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

  /// What follows is of the property of this name, which was included, instead of the last one.
  PropertyList& at(const std::string& name)
  {
    this->Last = this->placeOf(name);
    return *this;
  }
  /// The last property has an effect only where `property` has one of these values.
  PropertyList& where(const char* property, std::vector<double> values)
  {
    this->Properties[this->Last].facts.conditions.push_back({ property, std::move(values) });
    return *this;
  }
  /// The last property has an effect only where `property` is not 0, off or empty.
  PropertyList& whereGiven(const char* property) { return this->where(property, {}); }
  /// How messages about the last property end.
  PropertyList& advise(const char* advice)
  {
    this->Properties[this->Last].facts.advice = advice;
    return *this;
  }
  /// What the last property means, where it was included and is for more here.
  PropertyList& means(const char* meaning)
  {
    this->Properties[this->Last].facts.meaning = meaning;
    return *this;
  }
  /// What the last property is for, where that is not the result.
  PropertyList& use(PropertyUse use)
  {
    this->Properties[this->Last].facts.use = use;
    return *this;
  }

  const std::vector<Property>& all() const { return this->Properties; }

  /// Null for a name that there is not.
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

  /// A member of any type that can be cast to `Value` and back. (Seeds are unsigned and come back as what was given.)
  template <typename Value, typename Member>
  PropertyList& insert(PropertyFacts facts, Member Options::*member)
  {
    this->place({ std::move(facts), [member](const Options& options) -> PropertyValue { return Value(options.*member); },
      [member](Options& options, const PropertyValue& value) { options.*member = Member(std::get<Value>(value)); } });
    return *this;
  }

  /// Adds a property at the end, or in the place of one of the same name, which was included.
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

/// The same as for states, for the properties of `options`.
template <typename Options>
void validateProperties(const Options& options)
{
  validate(Options::properties().states(options));
}

} // namespace cactus
