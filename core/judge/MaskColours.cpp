// SPDX-License-Identifier: BSD-3-Clause
#include "judge/MaskColours.h"

#include "base/Error.h"

#include <algorithm>
#include <sstream>
#include <string>

namespace cactus
{

namespace
{

constexpr double leastMyelin = 64.0;
constexpr double leastAxon = 191.0;
constexpr double mostGrey = 255.0;
constexpr double leastDifference = 32.0;

bool isColoured(MaskColour colour)
{
  return colour != MaskColour::White && colour != MaskColour::Grey && colour != MaskColour::Black;
}

} // namespace

MaskColour maskColourOf(double red, double green, double blue)
{
  const auto [least, most] = std::minmax({ red, green, blue });
  if (most - least < leastDifference)
  {
    const double grey = (red + green + blue) / 3.0;
    return grey >= leastAxon ? MaskColour::White : grey >= leastMyelin ? MaskColour::Grey : MaskColour::Black;
  }
  if (most < leastMyelin)
  {
    return MaskColour::Black;
  }
  const double middle = 0.5 * (least + most);
  constexpr std::array<MaskColour, 8> byChannels{ { MaskColour::Black, MaskColour::Red, MaskColour::Green, MaskColour::Yellow,
    MaskColour::Blue, MaskColour::Magenta, MaskColour::Cyan, MaskColour::White } };
  return byChannels[std::size_t(red > middle ? 1 : 0) + std::size_t(green > middle ? 2 : 0) + std::size_t(blue > middle ? 4 : 0)];
}

MaskReader::MaskReader(MaskColour axon, MaskColour myelin)
  : Axon(axon)
  , Myelin(myelin)
{
  require(axon != myelin, "AxonColour and MyelinColour are the same: choose two");
}

Tissue MaskReader::tissueOf(const double* components, std::size_t count)
{
  if (count < 1 || count > 4)
  {
    throw InvalidInput(text("the mask has ", count, " numbers for each pixel: give grey values, or red, green and blue"));
  }
  if (!std::all_of(components, components + count, [](double value) { return value <= mostGrey; }))
  {
    throw InvalidInput(
      "the mask has grey values above 255, and 0 background, 127 myelin and 255 axon are expected: make these of "
      "them; those of 16 bits are to be divided by 257, by Calculator, say");
  }
  ++this->Pixels;
  if (count % 2 == 0 && components[count - 1] <= 0.0)
  {
    return Tissue::Background;
  }
  const std::size_t other = count < 3 ? 0 : 1;
  const MaskColour colour = maskColourOf(components[0], components[other], components[2 * other]);
  ++this->Counts[std::size_t(colour)];
  return colour == this->Axon ? Tissue::Axon : colour == this->Myelin ? Tissue::Myelin : Tissue::Background;
}

void MaskReader::finish() const
{
  if (!isColoured(this->Axon) && !isColoured(this->Myelin))
  {
    std::ostringstream found;
    for (std::size_t i = 0; i < maskColourNames.size(); ++i)
    {
      if (isColoured(MaskColour(i)) && this->Counts[i] > 0)
      {
        found << (found.tellp() > 0 ? ", " : "") << maskColourNames[i] << " (" << this->Counts[i] << " of " << this->Pixels
              << " pixels)";
      }
    }
    if (found.tellp() > 0)
    {
      throw InvalidInput("the mask has colours that are not grey: " + found.str() +
                         ". Choose AxonColour and MyelinColour, or give a mask of grey values");
    }
  }
  if (isColoured(this->Axon) && this->Counts[std::size_t(this->Axon)] == 0)
  {
    throw InvalidInput(
      text("the mask has no pixel of AxonColour ", maskColourNames[std::size_t(this->Axon)], ": choose the colour of its axons"));
  }
}

} // namespace cactus
