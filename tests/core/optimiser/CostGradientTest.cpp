// SPDX-License-Identifier: BSD-3-Clause
#include "optimiser/FibreCosts.h"

#include "RandomBundle.h"
#include "fibres/SegmentDistance.h"
#include "optimiser/OverlapCost.h"

#include <Eigen/Geometry>

#include <gtest/gtest.h>

#include <functional>

namespace
{

using cactus::Fibres;

struct Gradient
{
  std::vector<Eigen::Vector3d> points;
  std::vector<double> radii;
};

constexpr double margin = 1.05;

/// Computes the paper's cost independently, over all pairs.
double overlapCost(const Fibres& fibres)
{
  double cost = 0.0;
  const cactus::Capsules capsules = cactus::capsulesOf(fibres);
  for (std::size_t k = 0; k < capsules.size(); ++k)
  {
    for (std::size_t l = k + 1; l < capsules.size(); ++l)
    {
      if (capsules.fibre[k] == capsules.fibre[l])
      {
        continue;
      }
      const std::size_t i = capsules.first[k];
      const std::size_t j = capsules.first[l];
      const auto pair = cactus::closestPoints(fibres.points[i], fibres.points[i + 1], fibres.points[j], fibres.points[j + 1]);
      const double rp = (1.0 - pair.s) * fibres.radii[i] + pair.s * fibres.radii[i + 1];
      const double rq = (1.0 - pair.t) * fibres.radii[j] + pair.t * fibres.radii[j + 1];
      const double D = margin - pair.distance / (rp + rq);
      if (D > 0.0)
      {
        cost +=
          D * D * (fibres.points[i + 1] - fibres.points[i]).norm() * (fibres.points[j + 1] - fibres.points[j]).norm() * rp * rq;
      }
    }
  }
  return cost;
}

Gradient overlapGradient(const Fibres& fibres, double& cost)
{
  const cactus::Capsules capsules = cactus::capsulesOf(fibres);
  cactus::NeighbourList neighbours;
  cactus::findNeighbours(capsules, 0.5, 2, neighbours);
  std::vector<cactus::CapsuleOverlap> parts;
  cost = cactus::evaluateOverlap(capsules, neighbours, margin, 0.0, 2, parts).cost;
  Gradient gradient{ std::vector<Eigen::Vector3d>(fibres.points.size(), Eigen::Vector3d::Zero()),
    std::vector<double>(fibres.points.size(), 0.0) };
  for (std::size_t k = 0; k < capsules.size(); ++k)
  {
    gradient.points[capsules.first[k]] += Eigen::Vector3d::Map(parts[k].gradient0);
    gradient.points[capsules.first[k] + 1] += Eigen::Vector3d::Map(parts[k].gradient1);
    gradient.radii[capsules.first[k]] += parts[k].radius0;
    gradient.radii[capsules.first[k] + 1] += parts[k].radius1;
  }
  return gradient;
}

void compareWithDifferences(Fibres fibres, const Gradient& gradient, const std::function<double(const Fibres&)>& cost)
{
  constexpr double h = 1e-6;
  double largest = 0.0;
  for (std::size_t i = 0; i < fibres.points.size(); ++i)
  {
    for (int coordinate = 0; coordinate < 4; ++coordinate)
    {
      double& value = coordinate < 3 ? fibres.points[i][coordinate] : fibres.radii[i];
      const double analytic = coordinate < 3 ? gradient.points[i][coordinate] : gradient.radii[i];
      const double before = value;
      value = before + h;
      const double above = cost(fibres);
      value = before - h;
      const double below = cost(fibres);
      value = before;
      const double difference = (above - below) / (2.0 * h);
      ASSERT_NEAR(analytic, difference, 1e-5 * (1.0 + std::abs(difference))) << "point " << i << ", coordinate " << coordinate;
      largest = std::max(largest, std::abs(difference));
    }
  }
  EXPECT_GT(largest, 1e-3);
}

} // namespace

// Guarantee: the overlap cost is the paper's, and its gradient is exact, also for radii that vary along capsules.
TEST(CostGradient, Overlap)
{
  const Fibres fibres = randomBundle(5, 8, 6, 3.0, 0.4);
  double cost = 0.0;
  const Gradient gradient = overlapGradient(fibres, cost);
  EXPECT_GT(cost, 0.1);
  EXPECT_NEAR(cost, overlapCost(fibres), 1e-9 * cost);
  compareWithDifferences(fibres, gradient, overlapCost);
}

// Guarantee: each term that shapes a fibre has the exact gradient of its own cost, and so have the limits of bends and lengths,
// which remain when the terms have faded.
TEST(CostGradient, ShapeTerms)
{
  const Fibres reference = randomBundle(6, 6, 8, 3.0, 0.3);
  Fibres bent = randomBundle(7, 6, 8, 3.6, 0.5);
  bent.domain = reference.domain;
  for (int round = 0; round < 6; ++round)
  {
    const int term = round % 4;
    const double relaxation = round < 4 ? 0.5 : 0.0;
    cactus::FibreCostWeights weights{ 0.0, 0.0, 0.0, 0.0 };
    (term == 0 ? weights.curvature : term == 1 ? weights.length : term == 2 ? weights.radius : weights.compactness) = 2.0;
    const cactus::FibreCosts costs(reference, weights, 0.7);
    const auto evaluate = [&](const Fibres& fibres, Gradient& gradient)
    {
      gradient.points.assign(fibres.points.size(), Eigen::Vector3d::Zero());
      gradient.radii.assign(fibres.points.size(), 0.0);
      std::vector<double> stiffness(fibres.points.size(), 0.0);
      double total = 0.0;
      for (std::size_t f = 0; f < fibres.size(); ++f)
      {
        const cactus::FibreCostTotals part = costs.add(fibres, f, relaxation, { gradient.points, gradient.radii, stiffness });
        total += part.curvature + part.length + part.radius + part.compactness;
      }
      return total;
    };
    Gradient gradient;
    evaluate(bent, gradient);
    SCOPED_TRACE("term " + std::to_string(term) + ", relaxation " + std::to_string(relaxation));
    compareWithDifferences(bent, gradient,
      [&](const Fibres& fibres)
      {
        Gradient ignored;
        return evaluate(fibres, ignored);
      });
  }
}

// Guarantee: the cost does not depend on absolute position, orientation or order of fibres.
TEST(CostGradient, OverlapIsInvariant)
{
  const Fibres fibres = randomBundle(8, 10, 6, 3.0, 0.3);
  double cost = 0.0;
  overlapGradient(fibres, cost);
  Fibres moved = fibres;
  const Eigen::Matrix3d rotation = (Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized())).toRotationMatrix();
  for (auto& point : moved.points)
  {
    point = rotation * point + Eigen::Vector3d(100, -50, 7);
  }
  double movedCost = 0.0;
  overlapGradient(moved, movedCost);
  EXPECT_NEAR(cost, movedCost, 1e-9 * cost);

  Fibres reversed;
  reversed.domain = fibres.domain;
  for (std::size_t f = fibres.size(); f-- > 0;)
  {
    reversed.addFibre(fibres.fibreIds[f], 1, fibres.targetRadii[f]);
    for (std::size_t i = fibres.offsets[f + 1]; i-- > fibres.offsets[f];)
    {
      reversed.addPoint(fibres.points[i], fibres.radii[i]);
    }
  }
  double reversedCost = 0.0;
  overlapGradient(reversed, reversedCost);
  EXPECT_NEAR(cost, reversedCost, 1e-9 * cost);
}
