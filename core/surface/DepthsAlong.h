// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "surface/FibreLine.h"
#include "surface/SmoothedField.h"

#include <cstddef>
#include <functional>
#include <vector>

namespace cactus
{

/// A number for each place along a fibre's centre line.
using AlongLine = std::function<double(double along)>;

/// The depths of a fibre's samples, by their places along its centre line: cross-section by cross-section.
class DepthsAlong
{
public:
  /// The line and the field have to outlive the object.
  DepthsAlong(const SmoothedField& field, const FibreLine& line);

  /// Returns the first and the last place (µm along the line) of the fibre's samples; twice 0 if it has none.
  double first() const { return this->From; }
  double last() const { return this->To; }

  /// Returns the depth (µm), by place, below which lies this part of each cross-section's area above `outer` (µm).
  ///
  /// Depths are found for slices two voxels thick and smoothed over a few of these. Slices that a face of the box cuts have the
  /// depth of the nearest whole one.
  AlongLine depthOfPart(double part, double outer) const;
  /// Returns the one depth below which lies this part of the fibre's volume above `outer` (µm), without slices that a face cuts.
  double levelOfPart(double part, double outer) const;
  /// Returns the depth that leaves this part of what lies below `depth`.
  AlongLine depthOfPartBelow(double part, const AlongLine& depth) const;
  /// Returns the depth below which lies the same volume as below `depth`, with each cross-section's area multiplied by a number
  /// in proportion to `weight`, which is at least 1. Depths are at least `shallowest` (µm), or those given where these are less;
  /// what does not fit there goes to the other cross-sections.
  AlongLine redistributed(const AlongLine& depth, const AlongLine& weight, double shallowest) const;
  /// Returns the mean over the fibre's length.
  double mean(const AlongLine& of) const;
  /// Returns the least value at the middles of all slices with samples.
  double least(const AlongLine& of) const;

  /// Returns the field minus a number for each node, by its place along the line.
  SmoothedField lowered(const AlongLine& by) const;

private:
  /// A sample's share in a slice.
  struct Share
  {
    float depth;
    float weight;
  };
  struct Slice
  {
    std::vector<Share> shares;
    double widest = 0.0; ///< µm, largest distance of a sample inside from the line
    bool isWhole = true;
  };
  void addSample(const LinePlace& place, float depth);
  void findWholeSlices();
  double areaBelow(const Slice& slice, double depth) const;
  double depthFor(const Slice& slice, double area, double from) const;
  double placeOf(std::size_t slice) const { return this->Start + (double(slice) + 0.5) * this->Thickness; }
  double sliceAt(double along) const;
  std::vector<std::size_t> nearestWhole() const;
  AlongLine smooth(const std::function<double(const Slice&, double along)>& depth, bool isLocal = false) const;

  const SmoothedField& Field;
  const FibreLine& Line;
  double Spacing;   ///< µm, of samples
  double Thickness; ///< µm, of slices
  double Start = 0.0;
  double From = 0.0;
  double To = 0.0;
  std::vector<Slice> Slices;
  SmoothedField::NodeNumbers Places; ///< µm along the line
};

} // namespace cactus
