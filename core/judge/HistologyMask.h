// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Context.h"
#include "base/Domain.h"
#include "base/Properties.h"
#include "mesh/FibreSurfaces.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace cactus
{

/// Pixels as fine as light and electron microscopes have them, up to those of whole slides.
constexpr Range maskPixel{ 1e-3, 1e3, " µm" };

/// The axis that a cut is perpendicular to.
enum class SectionNormal
{
  X,
  Y,
  Z
};

struct HistologyMaskOptions
{
  SectionNormal normal = SectionNormal::Z;
  double position = 0.0;  ///< µm, of the cut along its normal
  double pixelSize = 0.1; ///< µm

  static const PropertyList<HistologyMaskOptions>& properties();
};

/// What a pixel of histology is of.
enum class Tissue : std::uint8_t
{
  Background,
  Myelin,
  Axon
};

/// The grey values that AxonDeepSeg's masks have for each.
constexpr std::array<std::uint8_t, 3> greyOfTissue{ { 0, 127, 255 } };

/// A cut through a substrate or a tissue, pixel by pixel; lists go row by row.
struct HistologyMask
{
  std::array<int, 2> axes{ { 0, 1 } };              ///< along which columns and rows count
  std::array<int, 2> count{ { 0, 0 } };             ///< columns, rows
  double pixelSize = 1.0;                           ///< µm
  Eigen::Vector3d origin = Eigen::Vector3d::Zero(); ///< µm, middle of the first pixel
  std::vector<Tissue> pixels;
  std::vector<std::int32_t> fibreIds; ///< 0 in the background; empty where they are not known
  std::size_t openSurfaces = 0;       ///< of those that were cut: of these the outlines need not be closed

  std::size_t size() const { return std::size_t(count[0]) * std::size_t(count[1]); }
};

/// The grid of a cut, whose pixels have yet to be filled in. Throws InvalidInput for options out of range and a cut beside the
/// domain.
HistologyMask maskGrid(const Domain& domain, const HistologyMaskOptions& options);

/// Cuts the domain: a pixel is what its middle lies in. The cut of a closed surface is closed to the bit, as the pieces of
/// neighbouring triangles end in the same numbers. The same bits on any number of threads.
///
/// Throws InvalidInput for options out of range, a cut beside the domain and no surfaces, OutOfMemory, and Cancelled.
HistologyMask cutMask(const Domain& domain, const FibreSurfaces& outer, const FibreSurfaces& inner,
  const HistologyMaskOptions& options, const Context& context = {});

} // namespace cactus
