// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Domain.h"
#include "fibres/Capsules.h"
#include "fibres/Fibres.h"

#include <Eigen/Geometry>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace cactus
{

/// Calls use(shift) for all shifts (µm) by whole periods along x and y that bring a box to overlap or touch the region, 0 among
/// them; where the domain is not periodic, for 0 alone. A fibre that is periodic along z needs no images there: it is given with
/// a part beyond both faces, see FibrePeriod.
template <typename Use>
void forEachImage(const Domain& domain, const Eigen::AlignedBox3d& body, const Eigen::AlignedBox3d& region, Use&& use)
{
  int first[2] = { 0, 0 };
  int last[2] = { 0, 0 };
  for (int axis = 0; axis < 2; ++axis)
  {
    if (domain.periodic[std::size_t(axis)])
    {
      const double period = domain.size()[axis];
      first[axis] = static_cast<int>(std::ceil((region.min()[axis] - body.max()[axis]) / period));
      last[axis] = static_cast<int>(std::floor((region.max()[axis] - body.min()[axis]) / period));
    }
  }
  for (int y = first[1]; y <= last[1]; ++y)
  {
    for (int x = first[0]; x <= last[0]; ++x)
    {
      use(Eigen::Vector3d(x * domain.size()[0], y * domain.size()[1], 0.0));
    }
  }
}

/// An image of a capsule: the same, shifted by whole periods.
struct CapsuleImage
{
  std::uint32_t capsule;
  Eigen::Vector3d shift; ///< µm
};

/// Returns the images of capsules that come within reach of one of them in place, but these themselves: of two capsules, if the
/// distance of their surfaces is below the sum of their reaches (µm, one per capsule; radii taken at their larger end). Returns
/// some others near them, too. In the order of shifts, and of capsules.
std::vector<CapsuleImage> imagesWithin(const Domain& domain, const Capsules& capsules, const std::vector<float>& reach);

/// Puts the image in its place.
void placeImage(const Capsule& of, const Eigen::Vector3d& shift, Capsule& image);

/// Appends images to the capsules; each is a run of its own, of its capsule's fibre.
void addImages(const std::vector<CapsuleImage>& images, Capsules& capsules);

} // namespace cactus
