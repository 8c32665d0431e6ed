// SPDX-License-Identifier: BSD-3-Clause
#include "bundle/RadiusHistogram.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace cactus
{

namespace
{

/// Three groups have read the five histograms off the figure independently: N. Stikov (github.com/rfdougherty/dSim, 2009), the
/// authors of github.com/guruucsd/CallosalData, and H.-H. Lee (github.com/NYU-DiffusionMRI/monte-carlo-simulation-recipes, 2018),
/// who takes the diameters as those of axons without myelin. A share here, in per cent, is the median of the three, each scaled
/// to a sum of 100; values of one bar differ by at most 1.4. Bars stand at multiples of 0.2 µm.
RadiusHistogram aboitiz(const std::string& region, std::vector<double> shares)
{
  constexpr double width = 0.2;
  return { "Human " + region + " (Aboitiz 1992)",
    "Aboitiz et al. 1992 (Brain Res 598:143), Fig. 4: inner diameters in electron micrographs; median of three readings of the "
    "figure",
    0.5 * width, width, std::move(shares) };
}

/// Read off the curves by the authors of CallosalData, minus the height of a curve's own line where it is empty. The curves count
/// axons by conduction velocity in steps of 2 m/s; the velocity is 5.5 d / 0.7 for an axon of d µm without its myelin.
RadiusHistogram caminiti(const std::string& area, std::vector<double> shares)
{
  return { "Human " + area + " (Caminiti 2009)",
    "Caminiti et al. 2009 (PNAS 106:19551), Fig. S5: conduction velocities of callosal axons, as inner diameters by 5.5 m/s for "
    "each µm of outer diameter and a g-ratio of 0.7",
    0.0, 2.0 * 0.7 / 5.5, std::move(shares) };
}

/// Measured for this project on the 227 axons that come with the programs of Lee et al. 2020 (doi:10.1038/s42003-020-1050-x): the
/// mean, over 180 cuts 0.1 µm apart, of the diameter of a circle of the cut's area. Shares are numbers of axons.
RadiusHistogram lee()
{
  return { "Mouse genu (Lee 2019)",
    "Lee et al. 2019 (doi:10.1007/s00429-019-01844-6): 227 axons in serial electron micrographs; mean inner diameter of each "
    "over 18 µm, measured in the authors' segmentation",
    0.4, 0.2, { 7, 43, 70, 61, 29, 9, 3, 2, 3 } };
}

} // namespace

const std::vector<RadiusHistogram>& radiusHistograms()
{
  static const std::vector<RadiusHistogram> all = {
    aboitiz("genu", { 2.2, 13.3, 26.3, 18.3, 13.1, 7.8, 4.3, 6.8, 1.9, 1.3, 1.3, 1.1, 0.7, 0.7, 0.5, 0, 0, 0.5 }),
    aboitiz("anterior body", { 2.3, 18.7, 21.5, 17.5, 13.6, 6.9, 3.8, 3.4, 2.3, 1.4, 0.8, 0.6, 0, 1.8, 1, 0.7, 0.7, 0.7, 0, 0.8,
                               0, 0, 0, 0, 0, 0.7, 0, 0, 0.8 }),
    aboitiz("mid-body", { 1.8, 12.8, 16.4, 19.4, 10.8, 10.2, 5.3, 2.7, 3.4, 1.7, 2, 0.6, 2.8, 0.8, 0.7, 0.9, 0, 1.2, 0, 1.6, 0,
                          0.5, 0.9, 0, 0, 0, 0.7, 0, 0, 0.7, 0.7, 0, 0, 0.7, 0, 0, 0, 0, 0, 0, 0, 0, 0.5 }),
    aboitiz("posterior body", { 1, 5.3, 11.7, 17.6, 13.7, 10.1, 8.5, 6, 5.7, 4, 2.5, 1.7, 2.1, 1.5, 0.6, 0.6, 1, 0, 1.3, 0.7, 1.5,
                                0.6, 0, 1.1, 0.6, 0, 0, 0, 0, 0.7 }),
    aboitiz("splenium",
      { 1.9, 6.9, 15.4, 15.6, 17.2, 14.7, 4.4, 6.1, 4.3, 2.8, 4.2, 1.9, 1.5, 0, 1.1, 0, 0, 0.6, 0, 0.6, 0, 0, 0, 0, 0, 0.8 }),
    caminiti("prefrontal", { 0.4, 1.5, 24.1, 42.9, 19.5, 6.9, 2.6, 1.2, 0.4, 0.2, 0.2 }),
    caminiti("motor", { 0.1, 1.4, 12.4, 27.7, 22.4, 15.5, 8.7, 4.6, 2.4, 2, 0.8, 0.4, 0.5, 0.3, 0.2, 0.2, 0.1, 0.2, 0.2 }),
    caminiti("parietal", { 0, 1.6, 34.8, 34.5, 15.4, 6.6, 3.6, 1.6, 0.7, 0.3, 0.1, 0.1, 0.1, 0, 0.1, 0.1, 0, 0.1, 0.1 }),
    caminiti("visual", { 0.1, 0.6, 11.1, 27.3, 25.6, 14.1, 9.1, 5.1, 3.1, 1.8, 1.1, 0.5, 0.1, 0.2 }), lee()
  };
  return all;
}

const RadiusHistogram& radiusHistogram(PublishedRadii which)
{
  return radiusHistograms().at(static_cast<std::size_t>(which));
}

std::vector<std::string> radiusHistogramNames()
{
  std::vector<std::string> names;
  for (const RadiusHistogram& histogram : radiusHistograms())
  {
    names.push_back(histogram.name);
  }
  return names;
}

double RadiusHistogram::meanPower(int power) const
{
  double sum = 0.0;
  for (std::size_t i = 0; i < this->shares.size(); ++i)
  {
    const double radius = 0.5 * (this->begin + this->width * (static_cast<double>(i) + 0.5));
    sum += this->shares[i] * std::pow(radius, power);
  }
  return sum / std::accumulate(this->shares.begin(), this->shares.end(), 0.0);
}

double RadiusHistogram::deviation() const
{
  const double mean = this->meanRadius();
  return std::sqrt(this->meanPower(2) - mean * mean);
}

double RadiusHistogram::effectiveRadius() const
{
  return std::sqrt(std::sqrt(this->meanPower(6) / this->meanPower(2)));
}

double RadiusHistogram::smallestRadius() const
{
  const auto first = std::find_if(this->shares.begin(), this->shares.end(), [](double share) { return share > 0.0; });
  return 0.5 * (this->begin + this->width * static_cast<double>(first - this->shares.begin()));
}

double RadiusHistogram::largestRadius() const
{
  return 0.5 * (this->begin + this->width * static_cast<double>(this->shares.size()));
}

double sampleDiameter(const RadiusHistogram& histogram, RandomEngine& engine)
{
  const std::vector<double>& shares = histogram.shares;
  double left = uniform(engine) * std::accumulate(shares.begin(), shares.end(), 0.0);
  std::size_t bin = 0;
  while (bin + 1 < shares.size() && left >= shares[bin])
  {
    left -= shares[bin++];
  }
  const double within = shares[bin] > 0.0 ? std::min(1.0, left / shares[bin]) : 0.0;
  return histogram.begin + histogram.width * (static_cast<double>(bin) + within);
}

} // namespace cactus
