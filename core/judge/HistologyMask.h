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

/// Pixel sizes: from those of electron and light microscopes to those of whole slides.
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
  double position = 0.0;  ///< µm, position of the cut along its normal
  double pixelSize = 0.1; ///< µm

  static const PropertyList<HistologyMaskOptions>& properties();
};

/// The tissue of a pixel in histology.
enum class Tissue : std::uint8_t
{
  Background,
  Myelin,
  Axon
};

/// The grey values of the tissues in AxonDeepSeg's masks.
constexpr std::array<std::uint8_t, 3> greyOfTissue{ { 0, 127, 255 } };

/// A cut through a substrate or a tissue, pixel by pixel; lists go row by row.
struct HistologyMask
{
  std::array<int, 2> axes{ { 0, 1 } };              ///< axes of columns and rows
  std::array<int, 2> count{ { 0, 0 } };             ///< columns, rows
  double pixelSize = 1.0;                           ///< µm
  Eigen::Vector3d origin = Eigen::Vector3d::Zero(); ///< µm, middle of the first pixel
  std::vector<Tissue> pixels;
  std::vector<std::int32_t> fibreIds; ///< 0 in the background; empty if unknown
  std::size_t openSurfaces = 0;       ///< number of cut surfaces that are open: their outlines need not be closed

  std::size_t size() const { return std::size_t(count[0]) * std::size_t(count[1]); }
};

/// Returns the grid of a cut, with empty pixels. Throws InvalidInput for options out of range and for a cut outside the domain.
HistologyMask maskGrid(const Domain& domain, const HistologyMaskOptions& options);

/// Cuts the domain: a pixel has the tissue at its middle. The cut of a closed surface is exactly closed, since the pieces of
/// neighbouring triangles end in the same numbers. Gives the same bits on any number of threads.
///
/// Throws InvalidInput for options out of range, a cut outside the domain and no surfaces, OutOfMemory, and Cancelled.
HistologyMask cutMask(const Domain& domain, const FibreSurfaces& outer, const FibreSurfaces& inner,
  const HistologyMaskOptions& options, const Context& context = {});

} // namespace cactus
