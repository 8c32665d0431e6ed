// SPDX-License-Identifier: BSD-3-Clause
#include "judge/DirectionStatistics.h"

#include "base/Constants.h"

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

/// The direction of a fibre at one place.
struct Tangent
{
  std::size_t number = 0; ///< of the place along the fibre, see FibreCut
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
};

/// The directions of one bundle's fibres.
struct BundleTangents
{
  std::vector<std::size_t> fibres;
  std::vector<Tangent> middles; ///< of each of these fibres, if it has one
  Eigen::Matrix3d dyadic = Eigen::Matrix3d::Zero();
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
};

std::vector<Tangent> tangentsOf(const Fibres& fibres, std::size_t fibre, double spacing)
{
  std::vector<Tangent> tangents;
  double begin = 0.0; // length before the segment
  std::size_t number = 0;
  for (std::size_t i = fibres.offsets[fibre]; i + 1 < fibres.offsets[fibre + 1]; ++i)
  {
    const Eigen::Vector3d along = fibres.points[i + 1] - fibres.points[i];
    const double length = along.norm();
    for (double at = (static_cast<double>(number) + 0.5) * spacing; at < begin + length;
         at = (static_cast<double>(++number) + 0.5) * spacing)
    {
      const Eigen::Vector3d place = fibres.points[i] + (at - begin) / length * along;
      if (fibres.domain.depth(place) >= 0.0)
      {
        tangents.push_back({ number, place, along / length });
      }
    }
    begin += length;
  }
  return tangents;
}

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

/// ∫ sin²θ w / ∫ w with the Watson weight w = exp(-κ sin²θ) sin θ on [0, π/2], by Simpson's rule.
double meanSquaredSine(double kappa)
{
  const double end = std::min(0.5 * pi, 9.0 / std::sqrt(kappa));
  constexpr int intervals = 2000;
  WeightedMean mean;
  for (int i = 0; i <= intervals; ++i)
  {
    const double sine = std::sin(end * i / intervals);
    const double simpson = i == 0 || i == intervals ? 1.0 : (i % 2 == 1 ? 4.0 : 2.0);
    mean.add(sine * sine, simpson * std::exp(-kappa * sine * sine) * sine);
  }
  return mean.value();
}

/// Adds the angles between the middles of neighbouring fibres.
void addSpread(const std::vector<Tangent>& middles, WeightedMean& spread)
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
    const Cell own = cellOf(middles[i].place);
    for (int k = 0; k < 27; ++k)
    {
      const auto cell = cells.find({ own[0] + k % 3 - 1, own[1] + k / 3 % 3 - 1, own[2] + k / 9 - 1 });
      if (cell == cells.end())
      {
        continue;
      }
      for (const std::size_t j : cell->second)
      {
        if ((middles[i].place - middles[j].place).norm() <= neighbourhood)
        {
          const Eigen::Vector3d& a = middles[i].direction;
          const Eigen::Vector3d& b = middles[j].direction;
          spread.add(radian * std::atan2(a.cross(b).norm(), std::abs(a.dot(b))), 1.0);
        }
      }
    }
    cells[own].push_back(i);
  }
}

/// Adds the twist and the evenness of azimuths of a bundle, weighted by its fibres.
void addShape(const BundleTangents& bundle, WeightedMean& twist, WeightedMean& azimuths)
{
  const auto count = static_cast<double>(bundle.middles.size());
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  std::vector<Eigen::Vector3d> across;
  for (const Tangent& tangent : bundle.middles)
  {
    const double along = tangent.direction.dot(bundle.axis);
    across.emplace_back((along < 0.0 ? -1.0 : 1.0) * (tangent.direction - along * bundle.axis));
    middle += tangent.place / count;
    mean += across.back() / count;
  }
  double turned = 0.0;
  double most = 0.0;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < across.size(); ++i)
  {
    Eigen::Vector3d arm = bundle.middles[i].place - middle;
    arm -= arm.dot(bundle.axis) * bundle.axis;
    turned += arm.cross(across[i]).dot(bundle.axis);
    most += arm.norm() * across[i].norm();
    covariance += (across[i] - mean) * (across[i] - mean).transpose();
  }
  if (most > 0.0)
  {
    twist.add(turned / most, count);
  }
  const Eigen::Vector3d values = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvalues();
  if (values[1] > 0.0)
  {
    azimuths.add(values[2] / values[1], count);
  }
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
    (meanSquaredSine(std::exp(middle)) > wanted ? low : high) = middle;
  }
  return std::exp(0.5 * (low + high));
}

DirectionStatistics measureDirections(
  const Fibres& fibres, const std::vector<const std::vector<FibreCut>*>& innerCuts, double spacing)
{
  std::map<int, BundleTangents> bundles;
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    BundleTangents& bundle = bundles[fibres.bundleIds[f]];
    bundle.fibres.push_back(f);
    const std::vector<Tangent> tangents = tangentsOf(fibres, f, spacing);
    for (const Tangent& tangent : tangents)
    {
      bundle.dyadic += tangent.direction * tangent.direction.transpose();
    }
    if (!tangents.empty())
    {
      bundle.middles.push_back(tangents[tangents.size() / 2]);
    }
  }
  WeightedMean byLength; // of cos²θ
  WeightedMean byVolume;
  WeightedMean spread;
  WeightedMean twist;
  WeightedMean azimuths;
  for (auto& entry : bundles)
  {
    BundleTangents& bundle = entry.second;
    bundle.axis = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(bundle.dyadic).eigenvectors().col(2);
    for (const std::size_t f : bundle.fibres)
    {
      auto cut = innerCuts[f]->begin();
      for (const Tangent& tangent : tangentsOf(fibres, f, spacing))
      {
        const double cosine = tangent.direction.dot(bundle.axis);
        byLength.add(cosine * cosine, 1.0);
        cut = std::find_if(cut, innerCuts[f]->end(), [&](const FibreCut& c) { return c.number >= tangent.number; });
        if (cut != innerCuts[f]->end() && cut->number == tangent.number)
        {
          byVolume.add(cosine * cosine, cut->area);
        }
      }
    }
    addSpread(bundle.middles, spread);
    addShape(bundle, twist, azimuths);
  }
  const auto p2 = [](const WeightedMean& mean) { return 0.5 * (3.0 * mean.value() - 1.0); };
  DirectionStatistics result;
  result.p2 = p2(byLength);
  result.p2ByAxonVolume = p2(byVolume);
  result.kappa = byLength.weights > 0.0 ? watsonConcentration(byLength.value()) : notANumber;
  result.odi = 2.0 / pi * std::atan2(1.0, result.kappa);
  result.localSpread = spread.value();
  result.twist = twist.value();
  result.azimuthRatio = azimuths.value();
  return result;
}

} // namespace cactus
