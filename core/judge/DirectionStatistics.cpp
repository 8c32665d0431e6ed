// SPDX-License-Identifier: BSD-3-Clause
#include "judge/DirectionStatistics.h"

#include "base/Constants.h"
#include "base/SphericalHarmonics.h"
#include "bundle/DirectionDistribution.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>

namespace cactus
{

namespace
{

/// Distance (µm) of neighbours whose directions are compared.
constexpr double neighbourhood = 10.0;

/// The directions of one bundle's fibres.
struct BundleDirections
{
  std::vector<FibrePlace> middles; ///< of the fibres that have one
  std::size_t places = 0;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero(); ///< sum over places, then their mean
  // Sums of direction ⊗ direction over places, and weighted with the axons' areas there.
  Eigen::Matrix3d byLength = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d byVolume = Eigen::Matrix3d::Zero();
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
  // Sums for the twist.
  double turned = 0.0;
  double most = 0.0;

  void addTwist(const FibrePlace& place)
  {
    const double along = place.direction.dot(this->axis);
    const Eigen::Vector3d across = (along < 0.0 ? -1.0 : 1.0) * (place.direction - along * this->axis);
    Eigen::Vector3d arm = place.point - this->centre;
    arm -= arm.dot(this->axis) * this->axis;
    this->turned += arm.cross(across).dot(this->axis);
    this->most += arm.norm() * across.norm();
  }
};

/// Means over places, each with a weight.
struct WeightedMean
{
  double sum = 0.0;
  double weights = 0.0;

  void add(double value, double weight)
  {
    this->sum += weight * value;
    this->weights += weight;
  }
  double value() const { return this->weights > 0.0 ? this->sum / this->weights : notANumber; }
};

/// Adds the angles between the middles of neighbouring fibres.
void addSpread(const std::vector<FibrePlace>& middles, WeightedMean& spread)
{
  using Cell = std::array<long, 3>;
  std::map<Cell, std::vector<std::size_t>> cells;
  const auto cellOf = [](const Eigen::Vector3d& p)
  {
    return Cell{ std::lround(std::floor(p[0] / neighbourhood)), std::lround(std::floor(p[1] / neighbourhood)),
      std::lround(std::floor(p[2] / neighbourhood)) };
  };
  for (std::size_t i = 0; i < middles.size(); ++i)
  {
    const Cell own = cellOf(middles[i].point);
    for (int k = 0; k < 27; ++k)
    {
      const auto cell = cells.find({ own[0] + k % 3 - 1, own[1] + k / 3 % 3 - 1, own[2] + k / 9 - 1 });
      if (cell == cells.end())
      {
        continue;
      }
      for (const std::size_t j : cell->second)
      {
        if ((middles[i].point - middles[j].point).norm() <= neighbourhood)
        {
          spread.add(angleBetweenLines(middles[i].direction, middles[j].direction), 1.0);
        }
      }
    }
    cells[own].push_back(i);
  }
}

/// Correlation of two functions on the sphere, each about its mean, by their coefficients.
double correlationOf(const std::vector<double>& a, const std::vector<double>& b)
{
  double product = 0.0;
  double squareOfA = 0.0;
  double squareOfB = 0.0;
  for (std::size_t i = 1; i < a.size(); ++i)
  {
    product += a[i] * b[i];
    squareOfA += a[i] * a[i];
    squareOfB += b[i] * b[i];
  }
  return squareOfA > 0.0 && squareOfB > 0.0 ? product / std::sqrt(squareOfA * squareOfB) : notANumber;
}

} // namespace

double watsonConcentration(double meanSquaredCosine)
{
  const double wanted = 1.0 - meanSquaredCosine;
  constexpr double largest = 1e14;
  if (wanted >= 2.0 / 3.0)
  {
    return 0.0;
  }
  double low = std::log(1e-6);
  double high = std::log(largest);
  for (int i = 0; i < 100; ++i)
  {
    const double middle = 0.5 * (low + high);
    const double found = watsonMean(std::exp(middle), [](double angle) { return std::sin(angle) * std::sin(angle); });
    (found > wanted ? low : high) = middle;
  }
  return std::exp(0.5 * (low + high));
}

DirectionStatistics measureDirections(const Fibres& fibres, const std::vector<AxonSections>& axons, double spacing)
{
  std::map<int, BundleDirections> bundles;
  const int order = orderOfHarmonics(fibres.orientationHarmonics.size());
  std::vector<double> harmonics(fibres.orientationHarmonics.size(), 0.0); // of directions by volume
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    BundleDirections& bundle = bundles[fibres.bundleIds[f]];
    const std::vector<FibrePlace> places = placesAlongFibre(fibres, f, spacing);
    const std::vector<FibreCut>& cuts = *axons[f].cuts;
    const double usualArea = std::isfinite(axons[f].radius) ? pi * axons[f].radius * axons[f].radius : 0.0;
    auto cut = cuts.begin();
    for (const FibrePlace& place : places)
    {
      const Eigen::Matrix3d dyad = place.direction * place.direction.transpose();
      bundle.byLength += dyad;
      bundle.centre += place.point;
      ++bundle.places;
      cut = std::find_if(cut, cuts.end(), [&](const FibreCut& c) { return c.number >= place.number; });
      const double area = cut != cuts.end() && cut->number == place.number ? cut->area : usualArea;
      bundle.byVolume += area * dyad;
      const std::vector<double> values = order > 0 ? harmonicsAt(place.direction, order) : std::vector<double>();
      std::transform(values.begin(), values.end(), harmonics.begin(), harmonics.begin(),
        [&](double value, double sum) { return sum + area * value; });
    }
    if (!places.empty())
    {
      bundle.middles.push_back(places[places.size() / 2]);
    }
  }
  WeightedMean byLength; // of cos²θ
  WeightedMean byVolume;
  WeightedMean spread;
  WeightedMean twist;
  WeightedMean azimuths;
  const auto add = [](const Eigen::Matrix3d& dyads, const Eigen::Vector3d& axis, WeightedMean& mean)
  {
    mean.sum += axis.dot(dyads * axis);
    mean.weights += dyads.trace();
  };
  for (auto& entry : bundles)
  {
    BundleDirections& bundle = entry.second;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(bundle.byLength);
    bundle.axis = solver.eigenvectors().col(2);
    bundle.centre /= static_cast<double>(std::max<std::size_t>(bundle.places, 1));
    add(bundle.byLength, bundle.axis, byLength);
    add(bundle.byVolume, bundle.axis, byVolume);
    addSpread(bundle.middles, spread);
    const auto& moments = solver.eigenvalues();
    if (moments[0] > 0.0)
    {
      azimuths.add(moments[1] / moments[0], static_cast<double>(bundle.places));
    }
  }
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    for (const FibrePlace& place : placesAlongFibre(fibres, f, spacing))
    {
      bundles[fibres.bundleIds[f]].addTwist(place);
    }
  }
  for (const auto& entry : bundles)
  {
    const BundleDirections& bundle = entry.second;
    if (bundle.most > 0.0)
    {
      twist.add(bundle.turned / bundle.most, static_cast<double>(bundle.places));
    }
  }
  const auto p2 = [](const WeightedMean& mean) { return 0.5 * (3.0 * mean.value() - 1.0); };
  DirectionStatistics result;
  result.p2 = p2(byLength);
  result.p2ByAxonVolume = p2(byVolume);
  result.kappa = byLength.weights > 0.0 ? watsonConcentration(byLength.value()) : notANumber;
  result.odi = odiOfKappa(result.kappa);
  result.localSpread = spread.value();
  result.twist = twist.value();
  result.azimuthRatio = azimuths.value();
  result.angularCorrelation = correlationOf(harmonics, fibres.orientationHarmonics);
  return result;
}

} // namespace cactus
