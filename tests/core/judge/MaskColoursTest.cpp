// SPDX-License-Identifier: BSD-3-Clause
// Guarantee: a mask's colours are those that a person sees, and one that does not fit is refused by the name of its colour.
#include "judge/MaskColours.h"

#include "base/Error.h"
#include "judge/HistologyRadii.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace
{

using cactus::MaskColour;
using cactus::MaskReader;
using cactus::Tissue;
using Pixels = std::vector<std::vector<double>>;

std::vector<Tissue> tissues(const Pixels& pixels, MaskColour axon = MaskColour::White, MaskColour myelin = MaskColour::Grey)
{
  MaskReader reader(axon, myelin);
  std::vector<Tissue> all;
  for (const std::vector<double>& pixel : pixels)
  {
    all.push_back(reader.tissueOf(pixel.data(), pixel.size()));
  }
  reader.finish();
  return all;
}

std::string refusal(const Pixels& pixels, MaskColour axon = MaskColour::White, MaskColour myelin = MaskColour::Grey)
{
  try
  {
    tissues(pixels, axon, myelin);
  }
  catch (const cactus::InvalidInput& error)
  {
    return error.what();
  }
  return "";
}

TEST(MaskColours, AreNamedBrightOrDark)
{
  const auto name = [](double r, double g, double b) { return cactus::maskColourOf(r, g, b); };
  EXPECT_EQ(name(255, 0, 0), MaskColour::Red);
  EXPECT_EQ(name(90, 20, 30), MaskColour::Red);
  EXPECT_EQ(name(255, 180, 180), MaskColour::Red);
  EXPECT_EQ(name(30, 200, 40), MaskColour::Green);
  EXPECT_EQ(name(0, 0, 255), MaskColour::Blue);
  EXPECT_EQ(name(255, 255, 0), MaskColour::Yellow);
  EXPECT_EQ(name(0, 128, 128), MaskColour::Cyan);
  EXPECT_EQ(name(200, 0, 200), MaskColour::Magenta);
  EXPECT_EQ(name(0, 0, 40), MaskColour::Black);
  EXPECT_EQ(name(63, 63, 63), MaskColour::Black);
  EXPECT_EQ(name(64, 64, 64), MaskColour::Grey);
  EXPECT_EQ(name(130, 120, 128), MaskColour::Grey);
  EXPECT_EQ(name(191, 191, 191), MaskColour::White);
}

TEST(MaskColours, GreyIsReadInAnyForm)
{
  const std::vector<Tissue> wanted{ Tissue::Background, Tissue::Myelin, Tissue::Axon };
  EXPECT_EQ(tissues({ { 0 }, { 127 }, { 255 } }), wanted);
  EXPECT_EQ(tissues({ { 0, 0, 0 }, { 127, 127, 127 }, { 255, 255, 255 } }), wanted);
  EXPECT_EQ(tissues({ { 255, 0 }, { 127, 255 }, { 255, 1 } }), wanted) << "alpha 0 is background";
  EXPECT_EQ(tissues({ { 255, 255, 255, 0 }, { 127, 127, 127, 255 }, { 255, 255, 255, 255 } }), wanted);
  EXPECT_EQ(tissues({ { 255, 0, 0, 0 } }), std::vector<Tissue>{ Tissue::Background }) << "a colour that nobody sees";
}

TEST(MaskColours, OtherColoursAreChosenOrRefusedByName)
{
  const Pixels overlay{ { 0, 0, 255 }, { 255, 0, 0 }, { 140, 140, 140 }, { 255, 255, 255 } };
  EXPECT_EQ(tissues(overlay, MaskColour::Blue, MaskColour::Red),
    (std::vector<Tissue>{ Tissue::Axon, Tissue::Myelin, Tissue::Background, Tissue::Background }));
  EXPECT_EQ(
    tissues({ { 255 }, { 127 } }, MaskColour::Grey, MaskColour::White), (std::vector<Tissue>{ Tissue::Myelin, Tissue::Axon }));
  EXPECT_NE(refusal(overlay).find("Red (1 of 4 pixels), Blue (1 of 4 pixels). Choose AxonColour"), std::string::npos)
    << refusal(overlay);
  EXPECT_NE(refusal({ { 255 } }, MaskColour::Cyan).find("no pixel of AxonColour Cyan"), std::string::npos);
  EXPECT_NE(refusal({ { 255 } }, MaskColour::Red, MaskColour::Red).find("are the same"), std::string::npos);
  EXPECT_NE(refusal({ { 65535 } }).find("divided by 257"), std::string::npos);
  EXPECT_NE(refusal({ { 1, 2, 3, 4, 5 } }).find("has 5 numbers for each pixel"), std::string::npos);
}

TEST(HistologyRadii, AxonsThatTouchAtACornerAreTwo)
{
  cactus::HistologyMask mask;
  mask.count = { { 4, 4 } };
  mask.pixels.assign(16, Tissue::Myelin);
  for (const std::size_t pixel : { 0, 1, 6, 10 })
  {
    mask.pixels[pixel] = Tissue::Axon;
  }
  const cactus::MaskAxons found = cactus::measureMask(mask);
  ASSERT_EQ(found.axons.size(), 2u);
  EXPECT_EQ(found.axons[0].axonArea, 2.0);
  EXPECT_EQ(found.axons[1].axonArea, 2.0);
  EXPECT_EQ(found.axons[0].myelinArea + found.axons[1].myelinArea, 12.0);
}

} // namespace
