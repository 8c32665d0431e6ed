// SPDX-License-Identifier: BSD-3-Clause
#include "surface/SampledVolumeKernels.h"

#include "base/Vector.h"

namespace cactus
{

namespace
{

void sum(const float* depths, const float* volumes, std::size_t count, float level, float perWidth, SampledSums& sums)
{
  const Floats one = Floats{} + 1.0f;
  for (int lane = 0; lane < SampledSums::lanes; lane += floats)
  {
    Floats volume = {};
    Floats slope = {};
    Floats bend = {};
    for (std::size_t n = std::size_t(lane); n < count; n += SampledSums::lanes)
    {
      const Floats box = load(volumes + n);
      const Floats t = larger(smaller((load(depths + n) - level) * perWidth, one), -one);
      const Floats square = t * t;
      const Floats rest = one - square;
      volume += box * (0.5f + t * (15.0f - square * (10.0f - 3.0f * square)) * 0.0625f);
      slope += box * rest * rest;
      bend -= box * t * rest;
    }
    store(sums.volume + lane, volume);
    store(sums.slope + lane, slope);
    store(sums.bend + lane, bend);
  }
}

} // namespace

const SampledVolumeKernels CACTUS_KERNELS_OF_UNIT(SampledVolumeKernels) = { sum };

} // namespace cactus
