// SPDX-License-Identifier: BSD-3-Clause
// Guarantee: a panel has what the description says of each property, once, and what xml/ adds; nothing is left out in silence.
#include "PanelXml.h"

#include "base/Error.h"

#include <gtest/gtest.h>

namespace
{

using cactus::PropertyFacts;

const PropertyFacts size{ "Size", "Size in µm & \"more\".", cactus::Range{ 0.5, 1e7, " µm", -1.0 }, {}, {}, {}, {} };
const PropertyFacts kind{ "Kind", "Kind.", {}, { "A", "B<C" }, {}, {}, { { "Size", {} } } };
const PropertyFacts file{ "File", "File.", {}, {}, {}, {}, { { "Kind", { 0, 1 } }, { "IsOn", { 1 } } } };
const PropertyFacts isOn{ "IsOn", "Switch.", {}, {}, {}, {}, { { "File", {} } } };
const PropertyFacts way{ "Way", "Way.", {}, {}, {}, {}, {} };
const PropertyFacts count{ "Count", "Count.", cactus::Range{ 0.0, 1e7 }, {}, {}, {}, {} };

const std::vector<cactus::StageDescription> stages{ { "Thing",
  { { &size, 1e-6 }, { &kind, std::int64_t(1) }, { &file, std::string() }, { &isOn, true },
    { &way, std::vector<double>{ 0.0, 0.5, 1.0 } }, { &count, std::int64_t(10000000) } } } };

std::string inProxy(const std::string& properties, const std::string& name = "Thing")
{
  return "<SourceProxy name=\"" + name + "\" class=\"vtkThing\">" + properties + "</SourceProxy>";
}

std::string panel(const std::string& properties)
{
  return cactus::panelXml(inProxy(properties, "Saving"), stages);
}

TEST(PanelXml, NumbersHaveTheirRangeAndASliderOnlyIfAsked)
{
  EXPECT_EQ(panel("<StageProperty name=\"Size\"/>"),
    inProxy("<DoubleVectorProperty name=\"Size\" command=\"SetSize\" number_of_elements=\"1\" default_values=\"1e-06\">"
            "<DoubleRangeDomain name=\"limits\" min=\"-1\" max=\"10000000\"/><DoubleRangeDomain name=\"range\" min=\"-1\"/>"
            "<Documentation>Size in µm &amp; &quot;more&quot;.</Documentation></DoubleVectorProperty>",
      "Saving"));
  EXPECT_EQ(panel("<StageProperty name=\"Count\" slider=\"1\" panel_visibility=\"advanced\"/>"),
    inProxy("<IntVectorProperty name=\"Count\" command=\"SetCount\" number_of_elements=\"1\" default_values=\"10000000\" "
            "panel_visibility=\"advanced\"><IntRangeDomain name=\"range\" min=\"0\" max=\"10000000\"/>"
            "<Documentation>Count.</Documentation></IntVectorProperty>",
      "Saving"));
}

TEST(PanelXml, VectorsHaveAsManyFieldsAsTheirDefault)
{
  EXPECT_EQ(panel("<StageProperty name=\"Way\"/>"),
    inProxy("<DoubleVectorProperty name=\"Way\" command=\"SetWay\" number_of_elements=\"3\" default_values=\"0 0.5 1\">"
            "<Documentation>Way.</Documentation></DoubleVectorProperty>",
      "Saving"));
}

TEST(PanelXml, ConditionsHideAPropertyBesideTheHintsOfTheFile)
{
  EXPECT_EQ(panel("<StageProperty name=\"Kind\"/>"),
    inProxy("<IntVectorProperty name=\"Kind\" command=\"SetKind\" number_of_elements=\"1\" default_values=\"1\">"
            "<EnumerationDomain name=\"enum\"><Entry value=\"0\" text=\"A\"/><Entry value=\"1\" text=\"B&lt;C\"/>"
            "</EnumerationDomain><Documentation>Kind.</Documentation><Hints><PropertyWidgetDecorator "
            "type=\"GenericDecorator\" mode=\"visibility\" property=\"Size\" value=\"0\" inverse=\"1\"/></Hints>"
            "</IntVectorProperty>",
      "Saving"));
  EXPECT_EQ(panel("<StageProperty name=\"File\"><FileListDomain name=\"files\"/><Hints><AcceptAnyFile/></Hints></StageProperty>"),
    inProxy("<StringVectorProperty name=\"File\" command=\"SetFile\" number_of_elements=\"1\" default_values=\"\">"
            "<Documentation>File.</Documentation><FileListDomain name=\"files\"/><Hints>"
            "<PropertyWidgetDecorator type=\"CompositeDecorator\"><Expression type=\"and\"><PropertyWidgetDecorator "
            "type=\"GenericDecorator\" mode=\"visibility\" property=\"Kind\" values=\"0 1\"/><PropertyWidgetDecorator "
            "type=\"GenericDecorator\" mode=\"visibility\" property=\"IsOn\" value=\"1\"/></Expression>"
            "</PropertyWidgetDecorator><AcceptAnyFile/></Hints></StringVectorProperty>",
      "Saving"));
  EXPECT_NE(panel("<StageProperty name=\"IsOn\"/>").find("<BooleanDomain name=\"bool\"/>"), std::string::npos);
  EXPECT_NE(panel("<StageProperty name=\"IsOn\"/>").find("property=\"File\" value=\"\" inverse=\"1\""), std::string::npos);
}

TEST(PanelXml, WhatStandsInAGroupComesBeforeIt)
{
  const auto bare = [](const std::string& properties)
  {
    const std::string whole = panel(properties);
    const std::size_t begin = whole.find('>') + 1;
    return whole.substr(begin, whole.rfind('<') - begin);
  };
  const std::string first = "<StageProperty name=\"Size\"/>";
  const std::string button = "<Property name=\"Run\" command=\"Run\"><Documentation>Runs.</Documentation></Property>";
  const std::string last = "<StageProperty name=\"Count\"/>";
  EXPECT_EQ(bare("<PropertyGroup label=\"L\">" + first + button + "</PropertyGroup>" + last),
    bare(first) + '\n' + button +
      "\n<PropertyGroup label=\"L\"><Property name=\"Size\"/><Property name=\"Run\"/></PropertyGroup>" + bare(last));
  EXPECT_EQ(bare(button + "<PropertyGroup><Property name=\"Run\"/></PropertyGroup>"),
    button + "<PropertyGroup><Property name=\"Run\"/></PropertyGroup>");
}

void expectError(const std::string& xml, const std::string& words)
{
  try
  {
    cactus::panelXml(xml, stages);
    FAIL() << "no error for " << xml;
  }
  catch (const cactus::InvalidInput& error)
  {
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
  }
}

TEST(PanelXml, EveryPropertyIsThereOnceAndUnderstood)
{
  const std::string all =
    "<StageProperty name=\"Size\"/><StageProperty name=\"Kind\"/><StageProperty name=\"Way\"/><StageProperty name=\"File\"/>"
    "<StageProperty name=\"IsOn\"/>";
  const std::string last = "<StageProperty name=\"Count\"/>";
  EXPECT_NO_THROW(cactus::panelXml(inProxy(all + last), stages));
  expectError(inProxy(all), "Thing lacks <StageProperty name=\"Count\"/>");
  expectError(inProxy(all + all), "Size twice");
  expectError(inProxy("<StageProperty name=\"Sise\"/>"), "Thing has no property Sise");
  expectError(inProxy("<StageProperty panel_visibility=\"advanced\" name=\"Size\"/>", "Saving"), "give the name first");
  expectError(
    "<SourceProxy name=\"Other\" class=\"vtkOther\"><StageProperty name=\"Size\"/></SourceProxy>", "Size is in no proxy");
  expectError(inProxy("", "Saving") + "<StageProperty name=\"Size\"/>", "Size is in no proxy");
}

} // namespace
