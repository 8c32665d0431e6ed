// SPDX-License-Identifier: BSD-3-Clause
#include "bundle/UnmyelinatedAxons.h"

#include "base/Limits.h"

namespace cactus
{

const PropertyList<UnmyelinatedAxons>& UnmyelinatedAxons::properties()
{
  using Options = UnmyelinatedAxons;
  static const auto list =
    PropertyList<Options>()
      .add("UnmyelinatedFraction", &Options::fraction, limits::unmyelinatedFraction,
        "Fraction of the domain that axons without myelin fill once fibres are grown: a part of GrownFibreVolumeFraction. One "
        "surface bounds such an axon: MyelinSurface gives it as the outer and as the inner one. 0: all fibres have myelin. The "
        "corpus callosum of humans has about 0.05, that of mice 0.12. They are thin, so choose a VoxelSize of at most half of "
        "their radius in FibreRadialGrowth. Not with bundles in layers.")
      .add("UnmyelinatedRadius", &Options::radius, limits::unmyelinatedRadius,
        "Mean radius in µm of the axons without myelin. Their radii are lognormal, from half to twice the mean.")
      .where("UnmyelinatedFraction", {})
      .add("UnmyelinatedRadiusDeviation", &Options::deviation, limits::unmyelinatedDeviation,
        "Standard deviation in µm of the radii of axons without myelin. 0: all have the same.")
      .where("UnmyelinatedFraction", {})
      .add("UnmyelinatedCluster", &Options::cluster, limits::unmyelinatedCluster,
        "Number of axons without myelin that lie together. 1: each lies by itself, anywhere.")
      .where("UnmyelinatedFraction", {});
  return list;
}

RadiusDistributionOptions UnmyelinatedAxons::radii() const
{
  constexpr double widest = 2.0;
  RadiusDistributionOptions drawn;
  drawn.model = RadiusModel::Lognormal;
  drawn.lognormalMean = radius;
  drawn.lognormalDeviation = deviation;
  drawn.minimum = deviation > 0.0 ? radius / widest : radius;
  drawn.maximum = deviation > 0.0 ? radius * widest : radius;
  return drawn;
}

UnmyelinatedAxons UnmyelinatedAxons::scaled(double factor) const
{
  UnmyelinatedAxons result = *this;
  result.radius *= factor;
  result.deviation *= factor;
  return result;
}

} // namespace cactus
