// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "judge/HistologyMask.h"

#include <array>
#include <cstddef>

namespace cactus
{

/// The colours that a mask can have for a tissue, and black.
enum class MaskColour
{
  White,
  Grey,
  Red,
  Green,
  Blue,
  Yellow,
  Cyan,
  Magenta,
  Black
};

/// The names of all but black, which is what no tissue has.
constexpr std::array<const char*, 8> maskColourNames{ { "White", "Grey", "Red", "Green", "Blue", "Yellow", "Cyan", "Magenta" } };

/// Names a colour of 8 bits: where red, green and blue differ by less than 32, their mean is black (below 64), grey (below 191)
/// or white, half way between AxonDeepSeg's values. Else it is that of the channels above the middle between the smallest and the
/// largest, dark or bright; below 64 it is black.
MaskColour maskColourOf(double red, double green, double blue);

/// Tells the tissues of a mask's pixels.
class MaskReader
{
public:
  /// Takes pixels of `axon` colour for axons, of `myelin` colour for myelin, and all others for background. Throws InvalidInput
  /// if the two are the same.
  MaskReader(MaskColour axon, MaskColour myelin);

  /// Returns the tissue of a pixel: a grey value, grey and alpha, red green blue, or these and alpha. Alpha 0 is background.
  /// Throws InvalidInput for values above 255 and other numbers of components.
  Tissue tissueOf(const double* components, std::size_t count);

  /// Throws InvalidInput if pixels had colours that were not asked for where grey values were, or none had the axons' colour.
  void finish() const;

private:
  MaskColour Axon;
  MaskColour Myelin;
  std::array<std::size_t, 9> Counts{}; ///< pixels of each colour that are not transparent
  std::size_t Pixels = 0;
};

} // namespace cactus
