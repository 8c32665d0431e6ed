// SPDX-License-Identifier: BSD-3-Clause
// Guarantee: a list of properties is checked as it says, and every property reaches the member that it names.
#include "base/Properties.h"

#include "base/Error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace
{

using cactus::PropertyList;

enum class Shape
{
  Round,
  Square,
  Flat
};

struct Part
{
  double width = 2.0;
  std::vector<double> table;

  static const PropertyList<Part>& properties()
  {
    static const auto list = PropertyList<Part>()
                               .add("Width", &Part::width, { 1.0, 3.0, " µm", 0.0 }, "How wide it is")
                               .add("Table", &Part::table, "What else there is");
    return list;
  }
};

struct Options
{
  Part part;
  Shape shape = Shape::Round;
  int count = 4;
  std::uint64_t seed = 1;
  bool isOn = false;
  std::string name;
  double thickness = 0.5;
  double colour = 0.5;
  double gloss = 0.5;

  static const PropertyList<Options>& properties()
  {
    static const auto list = PropertyList<Options>()
                               .include(&Options::part, Part::properties())
                               .add("Shape", &Options::shape, { "Round", "Square", "Flat" }, "What it looks like")
                               .add("Count", &Options::count, { 1.0, 5.0 }, "How many there are")
                               .where("Shape", { 0, 1 })
                               .advise("; take more of them")
                               .add("Seed", &Options::seed, { 0.0, 2147483647.0 }, "What is drawn")
                               .add("IsOn", &Options::isOn, "Whether it is")
                               .use(cactus::PropertyUse::Run)
                               .add("Name", &Options::name, "What it is called")
                               .add("Thickness", &Options::thickness, { 0.0, 1.0 }, "How thick it is")
                               .where("Count", { 3 })
                               .add("Colour", &Options::colour, { 0.0, 1.0 }, "How dark it is")
                               .whereGiven("Name")
                               .add("Gloss", &Options::gloss, { 0.0, 1.0 }, "How bright it is")
                               .whereGiven("Colour");
    return list;
  }
};

std::string messageFor(const char* name, const cactus::PropertyValue& value, Options options = {})
{
  Options::properties().find(name)->set(options, value);
  try
  {
    cactus::validateProperties(options);
  }
  catch (const cactus::InvalidInput& error)
  {
    return error.what();
  }
  return "";
}

TEST(Properties, ReachTheirMembers)
{
  Options options;
  const auto set = [&](const char* name, const cactus::PropertyValue& value)
  {
    const auto* property = Options::properties().find(name);
    ASSERT_NE(property, nullptr) << name;
    property->set(options, value);
    EXPECT_TRUE(property->get(options) == value) << name;
  };
  set("Width", 2.5);
  set("Table", std::vector<double>{ 1.0, 2.0 });
  set("Shape", std::int64_t(2));
  set("Count", std::int64_t(3));
  set("Seed", std::int64_t(-1)); // as it was given, so that it can be refused
  set("IsOn", true);
  set("Name", std::string("one"));
  EXPECT_EQ(options.part.width, 2.5);
  EXPECT_EQ(options.part.table.size(), 2u);
  EXPECT_EQ(options.shape, Shape::Flat);
  EXPECT_EQ(options.count, 3);
  EXPECT_TRUE(options.isOn);
  EXPECT_EQ(options.name, "one");
  EXPECT_EQ(Options::properties().find("Length"), nullptr);
}

TEST(Properties, OutOfRangeAreNamed)
{
  EXPECT_EQ(messageFor("Width", 2.0), "");
  EXPECT_EQ(messageFor("Width", 0.0), "");
  EXPECT_EQ(messageFor("Width", 0.5), "Width is 0.5: give 0 or 1 to 3 µm");
  EXPECT_EQ(messageFor("Width", std::nan("")), "Width is nan: give 0 or 1 to 3 µm");
  EXPECT_NE(messageFor("Width", std::numeric_limits<double>::infinity()), "");
  EXPECT_EQ(messageFor("Count", std::int64_t(6)), "Count is 6: give 1 to 5; take more of them");
  EXPECT_EQ(messageFor("Seed", std::int64_t(-1)), "Seed is -1: give 0 to 2147483647");
  for (const std::int64_t none : { -1, 3 })
  {
    EXPECT_EQ(
      messageFor("Shape", none), "Shape has no choice " + std::to_string(none) + ": use Round (0), Square (1) or Flat (2)");
  }
}

TEST(Properties, WithoutEffectAreNotLookedAt)
{
  Options flat;
  flat.shape = Shape::Flat;
  EXPECT_EQ(messageFor("Count", std::int64_t(6), flat), "");
  Options thick;
  thick.count = 3;
  EXPECT_NE(messageFor("Thickness", 2.0, thick), "");
  EXPECT_EQ(messageFor("Thickness", 2.0), "");
  // The property that it depends on has no effect itself.
  thick.shape = Shape::Flat;
  EXPECT_EQ(messageFor("Thickness", 2.0, thick), "");
}

TEST(Properties, ThatNeedAnotherAreLookedAtWhereItIsGiven)
{
  Options named;
  named.name = "one";
  EXPECT_NE(messageFor("Colour", 2.0, named), "");
  EXPECT_EQ(messageFor("Colour", 2.0), "");
  EXPECT_NE(messageFor("Gloss", 2.0, named), "");
  named.colour = 0.0;
  EXPECT_EQ(messageFor("Gloss", 2.0, named), "");
}

TEST(Properties, AreReadable)
{
  const auto read = [](const char* name, const cactus::PropertyValue& value)
  { return cactus::valueText(Options::properties().find(name)->facts, value); };
  EXPECT_EQ(read("Shape", std::int64_t(1)), "Square");
  EXPECT_EQ(read("Shape", std::int64_t(7)), "7");
  EXPECT_EQ(read("Width", 0.1), "0.1");
  EXPECT_EQ(read("Count", std::int64_t(2147483647)), "2147483647");
  EXPECT_EQ(read("IsOn", true), "on");
  EXPECT_EQ(read("Name", std::string()), "(none)");
  EXPECT_EQ(read("Table", std::vector<double>{ 0.1, 2.0 }), "0.1 2");
}

TEST(Properties, OfTheSameNameReplaceIncludedOnes)
{
  const auto list = PropertyList<Options>()
                      .include(&Options::part, Part::properties())
                      .add("Width", &Options::name, "How wide it is, in words")
                      .use(cactus::PropertyUse::Run)
                      .at("Table")
                      .where("Width", { 1 });
  ASSERT_EQ(list.all().size(), 2u);
  EXPECT_EQ(list.all()[0].facts.use, cactus::PropertyUse::Run);
  EXPECT_FALSE(list.all()[0].facts.range.has_value());
  EXPECT_EQ(list.all()[1].facts.conditions.size(), 1u);
}

} // namespace
