// SPDX-License-Identifier: BSD-3-Clause
#include "base/EvenParts.h"

#include <numeric>

namespace cactus
{

std::vector<std::size_t> evenParts(const std::vector<double>& weights, std::size_t parts)
{
  const double all = std::accumulate(weights.begin(), weights.end(), 0.0);
  std::vector<std::size_t> begins{ 0 };
  double before = 0.0;
  for (std::size_t i = 0; i < weights.size(); ++i)
  {
    const double middle = before + 0.5 * weights[i];
    while (begins.size() < parts && middle * double(parts) >= all * double(begins.size()) && all > 0.0)
    {
      begins.push_back(i);
    }
    before += weights[i];
  }
  begins.resize(parts + 1, weights.size());
  return begins;
}

} // namespace cactus
