// SPDX-License-Identifier: BSD-3-Clause
#include "bundle/BundleInitializer.h"

#include "BundleBetweenWalls.h"
#include "base/Constants.h"
#include "base/Error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

using namespace cactus;

namespace
{

using cactus::degree;

/// First (end 0) or last control point of a fibre.
Eigen::Vector3d endPoint(const Fibres& fibres, std::size_t f, int end)
{
  return fibres.points[end == 0 ? fibres.offsets[f] : fibres.offsets[f + 1] - 1];
}

/// Options of fibres that start with the drawn radii, so that circles touch at these radii.
struct DrawnRadii : BundleBetweenWalls
{
  DrawnRadii() { this->grownFibreVolumeFraction = 0.0; }
};

/// Returns the mean angle (degrees) of a bundle's fibres to a given axis, computed from the end points alone.
double meanAngleTo(const Fibres& fibres, const Eigen::Vector3d& axis, int bundle)
{
  double sum = 0.0;
  int count = 0;
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    if (fibres.bundleIds[f] == bundle)
    {
      sum += std::acos(std::min(1.0, (endPoint(fibres, f, 1) - endPoint(fibres, f, 0)).normalized().dot(axis)));
      ++count;
    }
  }
  return sum / count / degree;
}

/// Checks every pair of one bundle's circles on the face at one end, by brute force, with lengths along the face.
void expectNoOverlap(const Fibres& fibres, int end)
{
  for (std::size_t i = 0; i < fibres.size(); ++i)
  {
    for (std::size_t j = 0; j < i; ++j)
    {
      if (fibres.bundleIds[i] == fibres.bundleIds[j])
      {
        const double distance = (endPoint(fibres, i, end) - endPoint(fibres, j, end)).norm();
        ASSERT_GE(distance, (fibres.targetRadii[i] + fibres.targetRadii[j]) * (1.0 - 1e-9)) << i << " " << j;
      }
    }
  }
}

double circleArea(const Fibres& fibres)
{
  double area = 0.0;
  for (const double r : fibres.targetRadii)
  {
    area += cactus::pi * r * r;
  }
  return area;
}

std::string errorOf(const std::function<void(BundleInitializerOptions&)>& change)
{
  DrawnRadii options;
  change(options);
  try
  {
    initialiseBundles(options);
  }
  catch (const Error& error)
  {
    return error.what();
  }
  return "no error";
}

TEST(BundleInitializer, MakesFibresThinnerThatAreToGrow)
{
  for (const int bundles : { 1, 2 })
  {
    DrawnRadii options;
    options.side = 20.0;
    options.numberOfBundles = bundles;
    options.fibreVolumeFraction = 0.6;
    options.grownFibreVolumeFraction = 0.9;
    BundleInitializerReport report;
    const Fibres fibres = initialiseBundles(options, {}, &report);
    EXPECT_NEAR(report.fibreVolumeFraction, 0.6, 0.01);
    for (std::size_t f = 0; f < fibres.size(); ++f)
    {
      EXPECT_NEAR(fibres.radii[fibres.offsets[f]], fibres.targetRadii[f] * std::sqrt(0.6 / 0.9), 1e-12);
      EXPECT_GE(fibres.targetRadii[f], options.radius.minimum * (1.0 - 1e-12));
      EXPECT_LE(fibres.targetRadii[f], options.radius.maximum * (1.0 + 1e-12));
    }
    // Thinner fibres fill as much only if there are more.
    options.grownFibreVolumeFraction = 0.0;
    const Fibres plain = initialiseBundles(options);
    EXPECT_GT(fibres.size(), plain.size());
  }
  DrawnRadii options;
  options.grownFibreVolumeFraction = 0.5;
  EXPECT_THROW(options.validate(), InvalidInput);
}

} // namespace

TEST(BundleInitializer, FacesHoldAllCirclesApartAndInside)
{
  for (const double density : { 0.3, 0.7, 0.78 })
  {
    for (const double margin : { 0.0, 3.0 })
    {
      DrawnRadii options;
      options.fibreVolumeFraction = density;
      options.meanDispersion = 10.0;
      options.margin = margin;
      const Fibres fibres = initialiseBundles(options);
      validate(fibres);
      const double face = options.side + 2.0 * margin;
      EXPECT_NEAR(circleArea(fibres) / (face * face), density, 0.005);
      for (const int end : { 0, 1 })
      {
        expectNoOverlap(fibres, end);
        for (std::size_t f = 0; f < fibres.size(); ++f)
        {
          const Eigen::Vector3d p = endPoint(fibres, f, end);
          EXPECT_EQ(p.z(), end == 0 ? -15.0 : 15.0);
          EXPECT_LE(std::max(std::abs(p.x()), std::abs(p.y())) + fibres.targetRadii[f], 0.5 * face + 1e-9);
        }
      }
      EXPECT_EQ(fibres.domain.upper, Eigen::Vector3d::Constant(15.0));
    }
  }
}

TEST(BundleInitializer, MeanDispersionIsTheOneAsked)
{
  for (const DispersionModel model : { DispersionModel::Watson, DispersionModel::Cone, DispersionModel::Coherent })
  {
    for (const double asked : { 0.0, 2.0, 5.0, 10.0, 15.0, 20.0, 25.0 })
    {
      DrawnRadii options;
      options.meanDispersion = asked;
      options.dispersionModel = model;
      BundleInitializerReport report;
      const Fibres fibres = initialiseBundles(options, {}, &report);
      EXPECT_NEAR(meanAngleTo(fibres, Eigen::Vector3d::UnitZ(), 1), asked, 0.1);
      EXPECT_NEAR(meanDispersion(fibres, 1), asked, 0.25);
      EXPECT_NEAR(report.meanDispersion, meanAngleTo(fibres, Eigen::Vector3d::UnitZ(), 1), 1e-6);
      expectNoOverlap(fibres, 1);
    }
  }
}

TEST(BundleInitializer, NeighboursPointAlikeWhereCoherentAndNotWhereDrawnEachForItself)
{
  const auto likeness = [](DispersionModel model, double length)
  {
    DrawnRadii options;
    options.meanDispersion = 10.0;
    options.dispersionModel = model;
    options.correlationLength = length;
    const Fibres fibres = initialiseBundles(options);
    double products = 0.0;
    double squares = 0.0;
    for (std::size_t i = 0; i < fibres.size(); ++i)
    {
      const Eigen::Vector2d one = (endPoint(fibres, i, 1) - endPoint(fibres, i, 0)).head<2>();
      for (std::size_t j = 0; j < i; ++j)
      {
        const Eigen::Vector2d other = (endPoint(fibres, j, 1) - endPoint(fibres, j, 0)).head<2>();
        if ((endPoint(fibres, i, 0) - endPoint(fibres, j, 0)).norm() < 2.0)
        {
          products += one.dot(other);
          squares += 0.5 * (one.squaredNorm() + other.squaredNorm());
        }
      }
    }
    return products / squares;
  };
  const double byDefault = likeness(DispersionModel::Coherent, 0.0);
  EXPECT_GT(byDefault, 0.9);
  EXPECT_LT(likeness(DispersionModel::Coherent, 6.0), byDefault - 0.1);
  EXPECT_LT(std::abs(likeness(DispersionModel::Watson, 0.0)), 0.2);
  EXPECT_LT(std::abs(likeness(DispersionModel::Cone, 0.0)), 0.2);
}

TEST(BundleInitializer, CrossingBundlesTakeWatsonForCoherent)
{
  DrawnRadii options;
  options.numberOfBundles = 2;
  const Fibres fibres = initialiseBundles(options);
  options.dispersionModel = DispersionModel::Watson;
  EXPECT_EQ(initialiseBundles(options).points, fibres.points);
}

TEST(BundleInitializer, WithoutDispersionEndsLieOppositeEachOther)
{
  DrawnRadii options;
  options.meanDispersion = 0.0;
  const Fibres fibres = initialiseBundles(options);
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    EXPECT_EQ(endPoint(fibres, f, 1).head<2>(), endPoint(fibres, f, 0).head<2>());
  }
}

/// Returns the standard deviation of the circles' area fraction over squares of 10 µm, at places given for the fibres, by brute
/// force.
double unevenness(const Fibres& fibres, double face, const std::function<Eigen::Vector2d(std::size_t)>& placeOf)
{
  constexpr double pixel = 0.1;
  constexpr int squarePixels = 100;
  const int squares = static_cast<int>(face / (pixel * squarePixels));
  const int pixels = squares * squarePixels;
  std::vector<char> isFilled(std::size_t(pixels) * std::size_t(pixels), 0);
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    const double r = fibres.targetRadii[f];
    const Eigen::Vector2d centre = placeOf(f).array() + 0.5 * face;
    for (int y = std::max(0, int((centre.y() - r) / pixel)); y < std::min(pixels, int((centre.y() + r) / pixel) + 1); ++y)
    {
      for (int x = std::max(0, int((centre.x() - r) / pixel)); x < std::min(pixels, int((centre.x() + r) / pixel) + 1); ++x)
      {
        const Eigen::Vector2d at(pixel * (x + 0.5), pixel * (y + 0.5));
        char& filled = isFilled[std::size_t(y) * std::size_t(pixels) + std::size_t(x)];
        filled = filled != 0 || (at - centre).norm() < r;
      }
    }
  }
  std::vector<double> densities(std::size_t(squares) * std::size_t(squares), 0.0);
  for (std::size_t i = 0; i < isFilled.size(); ++i)
  {
    const std::size_t row = i / std::size_t(pixels) / squarePixels;
    const std::size_t column = i % std::size_t(pixels) / squarePixels;
    densities[row * std::size_t(squares) + column] += isFilled[i] / double(squarePixels * squarePixels);
  }
  const Eigen::Map<const Eigen::ArrayXd> all(densities.data(), Eigen::Index(densities.size()));
  return std::sqrt((all - all.mean()).square().mean());
}

TEST(BundleInitializer, FibresThatFollowAFlowAreAsDenseAmidAsAtTheFaces)
{
  DrawnRadii options;
  options.side = 80.0;
  options.meanDispersion = 12.0;
  options.spacing.minimum = options.spacing.maximum = 40.0;
  for (const std::uint64_t seed : { 1, 2 })
  {
    options.seed = seed;
    const Fibres fibres = initialiseBundles(options);
    const auto atFace = [&](std::size_t f) -> Eigen::Vector2d { return endPoint(fibres, f, 0).head<2>(); };
    const auto amid = [&](std::size_t f) -> Eigen::Vector2d
    {
      EXPECT_EQ(fibres.pointCount(f), 3u);
      EXPECT_EQ(fibres.points[fibres.offsets[f] + 1].z(), 0.0);
      return fibres.points[fibres.offsets[f] + 1].head<2>();
    };
    const auto onStraightLine = [&](std::size_t f) -> Eigen::Vector2d
    { return 0.5 * (endPoint(fibres, f, 0) + endPoint(fibres, f, 1)).head<2>(); };
    const double asAtFace = unevenness(fibres, options.side, atFace);
    const double asStraight = unevenness(fibres, options.side, onStraightLine);
    EXPECT_GT(asStraight, 2.0 * asAtFace);
    EXPECT_LT(unevenness(fibres, options.side, amid), asAtFace + 0.25 * (asStraight - asAtFace));
  }
}

/// Returns the area of the fibres' straight capsules in the domain over the domain's, in planes across z.
std::vector<double> densitiesAlong(const Fibres& fibres)
{
  std::vector<double> densities;
  for (const double share : { 0.0, 0.1, 0.3, 0.5, 0.7, 0.9, 1.0 })
  {
    const double z = fibres.domain.lower[2] + share * fibres.domain.size()[2];
    double area = 0.0;
    for (std::size_t f = 0; f < fibres.size(); ++f)
    {
      const Eigen::Vector3d first = endPoint(fibres, f, 0);
      const Eigen::Vector3d along = endPoint(fibres, f, 1) - first;
      const Eigen::Vector3d p = first + (z - first[2]) / along[2] * along;
      const double radius = fibres.radii[fibres.offsets[f]];
      area += fibres.domain.depth({ p[0], p[1], 0.0 }) > 0.0 ? pi * radius * radius * along.norm() / along[2] : 0.0;
    }
    densities.push_back(area / (fibres.domain.size()[0] * fibres.domain.size()[1]));
  }
  return densities;
}

TEST(BundleInitializer, DefaultFibresUndulateAndRunOutThroughAllFaces)
{
  BundleInitializerOptions options;
  options.side = 20.0;
  BundleInitializerReport report;
  const Fibres fibres = initialiseBundles(options, {}, &report);
  EXPECT_NEAR(report.fibreVolumeFraction, 0.6, 0.01);
  EXPECT_NEAR(capsuleVolumeInDomain(fibres) / fibres.domain.volume(), report.fibreVolumeFraction, 1e-9);
  EXPECT_NEAR(report.meanDispersion, 5.0, 0.01);
  EXPECT_NEAR(report.sinuosity, 1.03, 0.001);
  std::array<int, 4> crossing{}; // fibres with points on both sides of each lateral face
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    EXPECT_LT(endPoint(fibres, f, 0)[2], -10.0);
    EXPECT_GT(endPoint(fibres, f, 1)[2], 10.0);
    for (std::size_t face = 0; face < 4; ++face)
    {
      const auto isBeyond = [&](const Eigen::Vector3d& p)
      { return (face % 2 == 0 ? 1.0 : -1.0) * p[Eigen::Index(face / 2)] > 10.0; };
      const auto begin = fibres.points.begin() + std::ptrdiff_t(fibres.offsets[f]);
      const auto beyond = std::count_if(begin, begin + std::ptrdiff_t(fibres.pointCount(f)), isBeyond);
      crossing[face] += beyond > 0 && beyond < std::ptrdiff_t(fibres.pointCount(f)) ? 1 : 0;
    }
  }
  EXPECT_GT(*std::min_element(crossing.begin(), crossing.end()), 10);
}

TEST(BundleInitializer, ADomainCutFromTheMiddleHasNoBorder)
{
  BundleInitializerOptions options = ofPipes();
  options.side = 40.0;
  options.meanDispersion = 25.0;
  options.dispersionModel = DispersionModel::Watson;
  options.spacing.minimum = options.spacing.maximum = 40.0;
  const auto ratio = [](const std::vector<double>& densities)
  { return *std::max_element(densities.begin(), densities.end()) / *std::min_element(densities.begin(), densities.end()); };
  // Fibres that start and end within the faces of a wider bundle crowd in the middle of it.
  options.border = Border::Walls;
  options.margin = 10.0;
  EXPECT_GT(ratio(densitiesAlong(initialiseBundles(options))), 1.3);
  options.border = Border::Cut;
  options.margin = -1.0;
  std::vector<double> mean(7, 0.0);
  for (const std::uint64_t seed : { 1, 2, 3 })
  {
    options.seed = seed;
    const Fibres fibres = initialiseBundles(options);
    EXPECT_EQ(fibres.domain.size()[0], 40.0);
    EXPECT_NEAR(capsuleVolumeInDomain(fibres) / fibres.domain.volume(), options.fibreVolumeFraction, 0.011 * 0.7);
    EXPECT_NEAR(meanDispersion(fibres), 25.0, 0.2); // about their mean direction
    const std::vector<double> densities = densitiesAlong(fibres);
    std::transform(mean.begin(), mean.end(), densities.begin(), mean.begin(), [](double a, double b) { return a + b / 3.0; });
    for (std::size_t f = 0; f < fibres.size(); ++f)
    {
      EXPECT_LT(endPoint(fibres, f, 0)[2], -20.0);
      EXPECT_GT(endPoint(fibres, f, 1)[2], 20.0);
    }
  }
  EXPECT_LT(ratio(mean), 1.15);
  // The more they are dispersed, the farther out those begin that come in.
  EXPECT_EQ(surroundings(options).sides, 2.0 + 22.0 * std::tan(50.0 * degree));
  options.meanDispersion = 0.0;
  EXPECT_EQ(surroundings(options).sides, 2.0);
}

TEST(BundleInitializer, FibresThatFollowAFlowStayInTheFrameAndBendGently)
{
  DrawnRadii options;
  for (const double length : { 0.0, 10.0 })
  {
    options.correlationLength = length;
    options.meanDispersion = length > 0.0 ? 10.0 : 20.0;
    const Fibres fibres = initialiseBundles(options);
    double furthest = 0.0;
    for (std::size_t f = 0; f < fibres.size(); ++f)
    {
      const Eigen::Vector3d* points = fibres.points.data() + fibres.offsets[f];
      const std::size_t last = fibres.pointCount(f) - 1;
      for (std::size_t k = 0; k <= last; ++k)
      {
        const double share = double(k) / double(last);
        EXPECT_NEAR(points[k].z(), options.side * (share - 0.5), 1e-9); // evenly apart along the axis
        EXPECT_LE(points[k].head<2>().cwiseAbs().maxCoeff() + fibres.targetRadii[f], 0.5 * options.side + 1e-9);
        furthest = std::max(furthest, (points[k] - points[0] - share * (points[last] - points[0])).norm());
        if (k > 0 && k < last)
        {
          const double turn = (points[k + 1] - points[k]).normalized().dot((points[k] - points[k - 1]).normalized());
          EXPECT_GT(turn, std::cos(20.0 * degree)) << f << " " << k;
        }
      }
    }
    EXPECT_GT(furthest, 0.3);
    EXPECT_LT(furthest, 0.15 * options.side);
  }
}

TEST(BundleInitializer, OtherFibresAreStraightAndEvenlySpaced)
{
  DrawnRadii options;
  options.meanDispersion = 10.0;
  options.dispersionModel = DispersionModel::Watson;
  const Fibres fibres = initialiseBundles(options);
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    const double wanted = std::clamp(1.25 * fibres.targetRadii[f], 0.8, 2.0);
    const Eigen::Vector3d first = endPoint(fibres, f, 0);
    const Eigen::Vector3d chord = endPoint(fibres, f, 1) - first;
    ASSERT_GE(fibres.pointCount(f), 3u);
    const double segments = static_cast<double>(fibres.pointCount(f) - 1);
    EXPECT_NEAR(chord.norm() / segments, wanted, 0.05 * wanted);
    for (std::size_t k = 0; k < fibres.pointCount(f); ++k)
    {
      const Eigen::Vector3d expected = first + chord * (static_cast<double>(k) / segments);
      EXPECT_LT((fibres.points[fibres.offsets[f] + k] - expected).norm(), 1e-9);
      EXPECT_EQ(fibres.radii[fibres.offsets[f] + k], fibres.targetRadii[f]);
    }
  }
}

TEST(BundleInitializer, SameSeedSameBitsOnAnyNumberOfThreads)
{
  DrawnRadii options;
  options.side = 130.0; // more circles than the relaxation treats serially
  options.spacing.minimum = options.spacing.maximum = 65.0;
  options.spacing.factor = 100.0;
  Context context;
  context.threads = 1;
  const Fibres one = initialiseBundles(options, context);
  ASSERT_GT(one.size(), 4096u);
  context.threads = 2;
  const Fibres two = initialiseBundles(options, context);
  EXPECT_EQ(one.points, two.points);
  EXPECT_EQ(one.radii, two.radii);
  options.seed = 2;
  EXPECT_NE(initialiseBundles(options, context).points, one.points);
}

TEST(BundleInitializer, WhatCannotBeReachedSaysWhatCan)
{
  const auto reached = [](const char* before, double density, double dispersion)
  {
    DrawnRadii options;
    options.side = 15.0;
    options.fibreVolumeFraction = density;
    options.meanDispersion = dispersion;
    try
    {
      initialiseBundles(options);
    }
    catch (const Infeasible& error)
    {
      const std::string message = error.what();
      const auto at = message.find(before);
      return at == std::string::npos ? -1.0 : std::atof(message.c_str() + at + std::string(before).size());
    }
    return 0.0;
  };
  const double density = reached("come apart only at ", 0.95, 5.0);
  EXPECT_GT(density, 0.75);
  EXPECT_LT(density, 0.88);
  const double dispersion = reached("faces came to ", 0.7, 45.0);
  EXPECT_GT(dispersion, 30.0);
  EXPECT_LT(dispersion, 45.0);
}

TEST(BundleInitializer, StopsWhenAsked)
{
  Context context;
  context.cancelled = [] { return true; };
  EXPECT_THROW(initialiseBundles({}, context), Cancelled);
}

TEST(BundleInitializer, BadParametersAreNamed)
{
  const auto names = [](const char* property, const std::function<void(BundleInitializerOptions&)>& change)
  {
    const std::string message = errorOf(change);
    EXPECT_NE(message.find(property), std::string::npos) << message;
  };
  const auto sheets = [&](const char* property, const std::function<void(BundleInitializerOptions&)>& change)
  {
    names(property,
      [&](auto& o)
      {
        o.numberOfBundles = 2;
        o.crossingStyle = CrossingStyle::Sheets;
        change(o);
      });
    // With one bundle the property has no effect.
    EXPECT_EQ(errorOf(change).find(property), std::string::npos);
  };
  for (const double bad : { 0.0, -1.0, static_cast<double>(NAN), static_cast<double>(INFINITY) })
  {
    names("Side", [&](auto& o) { o.side = bad; });
    names("FibreVolumeFraction", [&](auto& o) { o.fibreVolumeFraction = bad; });
    names("GammaScale", [&](auto& o) { o.radius.gammaScale = bad; });
    sheets("CrossingAngle", [&](auto& o) { o.crossingAngle = bad; });
    names("SpacingFactor", [&](auto& o) { o.spacing.factor = bad; });
    names("MinimumSpacing", [&](auto& o) { o.spacing.minimum = bad; });
    names("MaximumSpacing", [&](auto& o) { o.spacing.maximum = bad; });
  }
  names("FibreVolumeFraction", [](auto& o) { o.fibreVolumeFraction = 1.0; });
  names("MeanDispersion", [](auto& o) { o.meanDispersion = -1.0; });
  names("MeanDispersion", [](auto& o) { o.meanDispersion = 46.0; });
  names("NumberOfBundles", [](auto& o) { o.numberOfBundles = 3; });
  names("NumberOfBundles", [](auto& o) { o.numberOfBundles = 0; });
  sheets("CrossingAngle", [](auto& o) { o.crossingAngle = 91.0; });
  names("Margin", [](auto& o) { o.margin = -0.5; });
  sheets("SheetThickness", [](auto& o) { o.sheetThickness = -1.0; });
  names("DispersionModel", [](auto& o) { o.dispersionModel = static_cast<DispersionModel>(3); });
  names("CorrelationLength", [](auto& o) { o.correlationLength = -1.0; });
  names("CorrelationLength is 0: give a length", [](auto& o) { o.border = Border::Cut; });
  names("Sinuosity",
    [](auto& o)
    {
      o.border = Border::Cut;
      o.correlationLength = 8.0;
      o.sinuosity = 0.9;
    });
  names("CorrelationLength", [](auto& o) { o.correlationLength = 0.01; });
  names("RadiusDistribution", [](auto& o) { o.radius.model = static_cast<RadiusModel>(4); });
  const auto histogram = [&](const char* property, const std::function<void(RadiusDistributionOptions&)>& change)
  {
    names(property,
      [&](auto& o)
      {
        o.radius.model = RadiusModel::Histogram;
        change(o.radius);
      });
    // With other distributions the property has no effect.
    EXPECT_EQ(errorOf([&](auto& o) { change(o.radius); }).find(property), std::string::npos);
  };
  histogram("RadiusHistogram has no choice 10", [](auto& r) { r.histogram = static_cast<PublishedRadii>(10); });
  histogram("RadiusHistogram has no choice -1", [](auto& r) { r.histogram = static_cast<PublishedRadii>(-1); });
  histogram("RadiusHistogramFactor is 0", [](auto& r) { r.histogramFactor = 0.0; });
  histogram("RadiusHistogramGRatio is 1.5", [](auto& r) { r.histogramGRatio = 1.5; });
  histogram("RadiusHistogramGRatio is nan", [](auto& r) { r.histogramGRatio = std::nan(""); });
  sheets("CrossingStyle", [](auto& o) { o.crossingStyle = static_cast<CrossingStyle>(2); });
  for (const double large : { 1e7, 1e300 })
  {
    names("Side is", [&](auto& o) { o.side = large; });
    names("Margin is", [&](auto& o) { o.margin = large; });
    names("MinimumRadius is", [&](auto& o) { o.radius.minimum = large; });
    names("MaximumRadius is", [&](auto& o) { o.radius.maximum = large; });
    names("GammaShape is", [&](auto& o) { o.radius.gammaShape = large; });
    names("GammaScale is", [&](auto& o) { o.radius.gammaScale = large; });
    names("CorrelationLength is", [&](auto& o) { o.correlationLength = large; });
    sheets("SheetThickness is", [&](auto& o) { o.sheetThickness = large; });
    names("SpacingFactor is", [&](auto& o) { o.spacing.factor = large; });
    names("MaximumSpacing is", [&](auto& o) { o.spacing.maximum = large; });
  }
  for (const double small : { 1e-300, 1e-6 })
  {
    names("Side is", [&](auto& o) { o.side = small; });
    names("FibreVolumeFraction is", [&](auto& o) { o.fibreVolumeFraction = small; });
    names("MinimumRadius is", [&](auto& o) { o.radius.minimum = small; });
    names("GammaScale is", [&](auto& o) { o.radius.gammaScale = small; });
    names("MeanDispersion is", [&](auto& o) { o.meanDispersion = small; });
    names("CorrelationLength is", [&](auto& o) { o.correlationLength = small; });
    sheets("CrossingAngle is", [&](auto& o) { o.crossingAngle = small; });
    sheets("SheetThickness is", [&](auto& o) { o.sheetThickness = small; });
    names("MinimumSpacing is", [&](auto& o) { o.spacing.minimum = small; });
  }
  names("MinimumRadius 0.001 µm makes capsules",
    [](auto& o)
    {
      o.radius.minimum = 0.001;
      o.grownFibreVolumeFraction = 0.9;
    });
  names("hardly any",
    [](auto& o)
    {
      o.radius.minimum = 6.0;
      o.radius.maximum = 7.0;
    });
  names("Side gives", [](auto& o) { o.side = 0.3; });
}

TEST(BundleInitializer, EqualLimitsGiveEqualRadii)
{
  for (const RadiusModel model : { RadiusModel::Gamma, RadiusModel::Lognormal })
  {
    DrawnRadii options;
    options.side = 10.0;
    options.fibreVolumeFraction = 0.5;
    options.radius.model = model;
    options.radius.minimum = options.radius.maximum = 0.7;
    const Fibres fibres = initialiseBundles(options);
    EXPECT_NEAR(static_cast<double>(fibres.size()), 0.5 * 100.0 / (cactus::pi * 0.49), 1.0);
    EXPECT_TRUE(std::all_of(fibres.radii.begin(), fibres.radii.end(), [](double r) { return r == 0.7; }));
    EXPECT_TRUE(std::all_of(fibres.targetRadii.begin(), fibres.targetRadii.end(), [](double r) { return r == 0.7; }));
  }
}

TEST(BundleInitializer, BundlesCrossAtTheAngleAsked)
{
  for (const CrossingStyle style : { CrossingStyle::Interwoven, CrossingStyle::Sheets })
  {
    for (const double asked : { 15.0, 30.0, 60.0, 90.0 })
    {
      DrawnRadii options;
      options.numberOfBundles = 2;
      options.crossingAngle = asked;
      options.crossingStyle = style;
      const Fibres fibres = initialiseBundles(options);
      validate(fibres);
      const double half = 0.5 * asked * degree;
      const Eigen::Vector3d first(std::sin(half), 0.0, std::cos(half));
      const Eigen::Vector3d second(-std::sin(half), 0.0, std::cos(half));
      EXPECT_NEAR(meanAngleTo(fibres, first, 1), options.meanDispersion, 0.1);
      EXPECT_NEAR(meanAngleTo(fibres, second, 2), options.meanDispersion, 0.1);
      const auto axes = bundleAxes(fibres);
      EXPECT_NEAR(std::acos(axes.at(1).dot(axes.at(2))) / degree, asked, 0.25);
      expectNoOverlap(fibres, 0);
      expectNoOverlap(fibres, 1);
    }
  }
}

TEST(BundleInitializer, CrossingBundlesKeepToTheirLayers)
{
  for (const CrossingStyle style : { CrossingStyle::Interwoven, CrossingStyle::Sheets })
  {
    for (const std::uint64_t seed : { 1, 2, 3 })
    {
      DrawnRadii options;
      options.numberOfBundles = 2;
      options.crossingStyle = style;
      options.meanDispersion = 10.0;
      options.seed = seed;
      const Fibres fibres = initialiseBundles(options);
      // A straight fibre covers the interval of y between its end circles. Fibres of different bundles must not share any of it.
      std::size_t changes = 0;
      const auto interval = [&](std::size_t f)
      {
        const double a = endPoint(fibres, f, 0).y();
        const double b = endPoint(fibres, f, 1).y();
        const double r = fibres.targetRadii[f];
        return std::make_pair(std::min(a, b) - r, std::max(a, b) + r);
      };
      std::vector<std::pair<double, int>> levels;
      for (std::size_t i = 0; i < fibres.size(); ++i)
      {
        const auto [low, high] = interval(i);
        EXPECT_GE(low, -15.0 - 1e-9);
        EXPECT_LE(high, 15.0 + 1e-9);
        levels.emplace_back(0.5 * (low + high), fibres.bundleIds[i]);
        for (std::size_t j = 0; j < i; ++j)
        {
          const auto [otherLow, otherHigh] = interval(j);
          ASSERT_TRUE(fibres.bundleIds[i] == fibres.bundleIds[j] || low > otherHigh - 1e-9 || high < otherLow + 1e-9);
        }
      }
      std::sort(levels.begin(), levels.end());
      for (std::size_t i = 1; i < levels.size(); ++i)
      {
        changes += levels[i].second != levels[i - 1].second ? 1 : 0;
      }
      if (style == CrossingStyle::Sheets)
      {
        EXPECT_EQ(changes, 5u); // six sheets
      }
      else
      {
        EXPECT_GT(changes, 6u);
        EXPECT_LT(changes, 16u);
      }
    }
  }
}

TEST(BundleInitializer, CrossingBundlesFillTheDomainAsAsked)
{
  for (const CrossingStyle style : { CrossingStyle::Interwoven, CrossingStyle::Sheets })
  {
    for (const double dispersion : { 0.0, 5.0, 20.0 })
    {
      DrawnRadii options;
      options.numberOfBundles = 2;
      options.crossingStyle = style;
      options.crossingAngle = 60.0;
      options.meanDispersion = dispersion;
      BundleInitializerReport report;
      const Fibres fibres = initialiseBundles(options, {}, &report);
      EXPECT_NEAR(report.fibreVolumeFraction, options.fibreVolumeFraction, 0.005);
      // Counted independently: random points of the domain, and all fibres' axes at each.
      RandomEngine engine = randomStream(9, RandomStage::Packing);
      constexpr int samples = 20000;
      double covered = 0.0;
      for (int s = 0; s < samples; ++s)
      {
        const double x = uniform(engine);
        const double y = uniform(engine);
        const double z = uniform(engine);
        const Eigen::Vector3d p = 30.0 * (Eigen::Vector3d(x, y, z).array() - 0.5);
        for (std::size_t f = 0; f < fibres.size(); ++f)
        {
          const Eigen::Vector3d a = endPoint(fibres, f, 0);
          const Eigen::Vector3d direction = (endPoint(fibres, f, 1) - a).normalized();
          const Eigen::Vector3d apart = p - a - (p - a).dot(direction) * direction;
          covered += apart.squaredNorm() < fibres.targetRadii[f] * fibres.targetRadii[f] ? 1.0 : 0.0;
        }
      }
      EXPECT_NEAR(covered / samples, options.fibreVolumeFraction, 0.03);
    }
  }
}

TEST(BundleInitializer, FewCrossingFibresAreAsManyAsAsked)
{
  DrawnRadii options;
  options.numberOfBundles = 2;
  options.fibreVolumeFraction = 0.05;
  for (options.seed = 1; options.seed <= 30; ++options.seed)
  {
    BundleInitializerReport report;
    EXPECT_NO_THROW(initialiseBundles(options, {}, &report)) << options.seed;
    EXPECT_NEAR(report.fibreVolumeFraction, 0.05, 0.0025) << options.seed;
  }
}

TEST(BundleInitializer, SheetsTooThinForAFibreAreRefused)
{
  EXPECT_EQ(errorOf(
              [](auto& o)
              {
                o.side = 20.0;
                o.numberOfBundles = 2;
                o.crossingStyle = CrossingStyle::Sheets;
              }),
    "no error"); // the default thickness holds any fibre
  const std::string message = errorOf(
    [](auto& o)
    {
      o.numberOfBundles = 2;
      o.crossingStyle = CrossingStyle::Sheets;
      o.sheetThickness = 1.0;
    });
  EXPECT_NE(message.find("SheetThickness"), std::string::npos) << message;
}
