// SPDX-License-Identifier: BSD-3-Clause
#include "bundle/BundleLayout.h"

#include "base/Constants.h"
#include "base/Error.h"
#include "base/Random.h"
#include "bundle/CirclePlacement.h"
#include "bundle/RadiusDistribution.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace cactus
{

namespace
{

/// Throws unless every circle has room in its rectangle.
void requireFit(const Circles& circles, const char* property)
{
  for (std::size_t i = 0; i < circles.size(); ++i)
  {
    if (2.0 * circles.radii[i] > circles.frame(i).size().minCoeff())
    {
      TextStream message;
      message << property << " gives a face or layer only " << circles.frame(i).size().minCoeff()
              << " µm wide, and a fibre of radius " << circles.radii[i] << " µm does not fit into it: enlarge " << property
              << " or lower MaximumRadius";
      throw InvalidInput(message.str());
    }
  }
}

/// Returns the two bundles of a crossing, without radii and frames, each long enough for its fibres to pass through the whole
/// region.
std::vector<Bundle> crossingBundles(const BundleInitializerOptions& options, double density)
{
  const double half = 0.5 * options.crossingAngle * degree;
  const Eigen::Vector3d region = regionSize(options);
  const double square = std::min(region.x(), region.z());
  std::vector<Bundle> bundles(2);
  for (int b = 0; b < 2; ++b)
  {
    Bundle& bundle = bundles[static_cast<std::size_t>(b)];
    bundle.id = b + 1;
    bundle.density = density;
    const double cosine = std::cos(half);
    const double sine = std::sin(half);
    const double tilt = b == 0 ? sine : -sine;
    bundle.turn << cosine, 0.0, tilt, 0.0, 1.0, 0.0, -tilt, 0.0, cosine;
    // The region's rectangle rotated by the half angle fits into one of this length and width.
    const Eigen::Vector2d rest(region.x() - square, region.z() - square);
    bundle.length = square * (cosine + sine) + rest.x() * sine + rest.y() * cosine;
    bundle.width = square * (cosine + sine) + rest.x() * cosine + rest.y() * sine;
  }
  return bundles;
}

/// Returns a layer of a crossing bundle.
Rectangle layerFrame(const Bundle& bundle, double low, double high)
{
  Rectangle frame;
  frame.lower = Eigen::Vector2d(-0.5 * bundle.width, low);
  frame.upper = Eigen::Vector2d(0.5 * bundle.width, high);
  return frame;
}

/// Divides a bundle's circles among thin layers: each receives the largest circles left, with room to spare, and then others in
/// the order of drawing, up to a thickness drawn around `wanted` (µm). Returns the layers' thicknesses, which give each layer
/// exactly the requested density.
std::vector<double> weave(Bundle& bundle, const BundleInitializerOptions& options, double wanted)
{
  Circles& circles = bundle.bottom;
  circles.frameOf.assign(circles.size(), -1);
  const double areaPerThickness = bundle.density * bundle.width;
  double left = 0.0;
  for (const double r : circles.radii)
  {
    left += pi * r * r;
  }
  const std::vector<std::size_t> largest = largestFirst(circles.radii);
  RandomEngine engine = randomStream(options.seed, RandomStage::Packing, itemOf(0, bundle.id + 16));
  std::vector<double> thicknesses;
  std::size_t nextLargest = 0;
  std::size_t nextDrawn = 0;
  while (left > 0.0)
  {
    while (nextLargest < circles.size() && circles.frameOf[largest[nextLargest]] >= 0)
    {
      ++nextLargest;
    }
    if (nextLargest == circles.size())
    {
      break;
    }
    const double room = 1.05 * 2.0 * circles.radii[largest[nextLargest]];
    const double thickness = std::max(room, wanted * (0.75 + 0.5 * uniform(engine)));
    const bool last = left < areaPerThickness * thickness;
    // A rest that does not fill a layer thickens the previous one.
    const bool merge = last && !thicknesses.empty();
    const int layer = static_cast<int>(thicknesses.size()) - (merge ? 1 : 0);
    double taken = 0.0;
    const auto take = [&](std::size_t i)
    {
      circles.frameOf[i] = layer;
      taken += pi * circles.radii[i] * circles.radii[i];
    };
    // Large circles are collected in few thick layers, so that the others can be thin.
    for (; nextLargest < circles.size() && taken < 0.6 * areaPerThickness * thickness; ++nextLargest)
    {
      if (circles.frameOf[largest[nextLargest]] < 0)
      {
        take(largest[nextLargest]);
      }
    }
    for (; nextDrawn < circles.size() && (last || taken < areaPerThickness * thickness); ++nextDrawn)
    {
      if (circles.frameOf[nextDrawn] < 0)
      {
        take(nextDrawn);
      }
    }
    left -= taken;
    if (merge)
    {
      thicknesses.back() += taken / areaPerThickness;
    }
    else
    {
      thicknesses.push_back(taken / areaPerThickness);
    }
  }
  return thicknesses;
}

} // namespace

Bundle layOutSingle(const BundleInitializerOptions& options, double density, double bareSurplus)
{
  const Eigen::Vector3d region = regionSize(options);
  Bundle bundle;
  bundle.length = region.z();
  bundle.turn = options.turn();
  bundle.density = density;
  Rectangle frame;
  frame.upper = 0.5 * region.head<2>();
  frame.lower = -frame.upper;
  frame.repeats = options.isPeriodic();
  bundle.bottom.frames = { frame };
  const double share = options.unmyelinatedShare();
  const double area = density * frame.area();
  std::vector<double>& radii = bundle.bottom.radii;
  radii = drawRadii(options.radius, options.seed, (1.0 - share) * area, itemOf(0, bundle.id));
  bundle.myelinated = radii.size();
  if (options.unmyelinated.any())
  {
    const std::vector<double> bare = drawRadii(
      options.unmyelinated.radii(), options.seed, bareSurplus * share * area, itemOf(UnmyelinatedAxons::firstItem, bundle.id));
    radii.insert(radii.end(), bare.begin(), bare.end());
  }
  bundle.bottom.frameOf.assign(bundle.bottom.radii.size(), 0);
  requireFit(bundle.bottom, "Side");
  return bundle;
}

std::vector<Bundle> layOutSheets(const BundleInitializerOptions& options, double density)
{
  const double height = regionSize(options).y();
  // By default every possible fibre has room.
  const double wanted =
    options.sheetThickness > 0.0 ? options.sheetThickness : std::max(height / 6.0, 1.05 * 2.0 * options.radius.maximum);
  const int layers = std::max(2, static_cast<int>(std::min(height / wanted + 1e-9, 1e6)));
  std::vector<Bundle> bundles = crossingBundles(options, density);
  for (int k = 0; k < layers; ++k)
  {
    Bundle& bundle = bundles[static_cast<std::size_t>(k % 2)];
    bundle.bottom.frames.push_back(layerFrame(bundle, height * (double(k) / layers - 0.5), height * ((k + 1.0) / layers - 0.5)));
  }
  for (Bundle& bundle : bundles)
  {
    Circles& circles = bundle.bottom;
    const double capacity = density * circles.frames.front().area();
    const auto count = circles.frames.size();
    circles.radii = drawRadii(options.radius, options.seed, capacity * static_cast<double>(count), itemOf(0, bundle.id));
    circles.frameOf.assign(circles.size(), 0);
    requireFit(circles, "SheetThickness");
    std::vector<double> left(count, capacity);
    for (const std::size_t i : largestFirst(circles.radii))
    {
      const auto layer = std::max_element(left.begin(), left.end());
      circles.frameOf[i] = static_cast<int>(layer - left.begin());
      *layer -= pi * circles.radii[i] * circles.radii[i];
    }
  }
  return bundles;
}

std::vector<Bundle> layOutInterwoven(const BundleInitializerOptions& options, double density, double thicknessInDiameters)
{
  const double height = regionSize(options).y();
  std::vector<Bundle> bundles = crossingBundles(options, density);
  double radiusSum = 0.0;
  std::size_t count = 0;
  for (Bundle& bundle : bundles)
  {
    bundle.bottom.radii = drawRadii(options.radius, options.seed, 0.5 * density * bundle.width * height, itemOf(0, bundle.id));
    radiusSum = std::accumulate(bundle.bottom.radii.begin(), bundle.bottom.radii.end(), radiusSum);
    count += bundle.bottom.size();
  }
  const double wanted = thicknessInDiameters * 2.0 * radiusSum / static_cast<double>(count);
  std::vector<std::vector<double>> thicknesses;
  std::vector<std::vector<std::size_t>> order;
  double total = 0.0;
  for (Bundle& bundle : bundles)
  {
    thicknesses.push_back(weave(bundle, options, wanted));
    total = std::accumulate(thicknesses.back().begin(), thicknesses.back().end(), total);
    order.emplace_back(thicknesses.back().size());
    std::vector<std::size_t>& shuffled = order.back();
    std::iota(shuffled.begin(), shuffled.end(), std::size_t(0));
    RandomEngine engine = randomStream(options.seed, RandomStage::Packing, itemOf(1, bundle.id + 16));
    for (std::size_t k = shuffled.size(); k > 1; --k)
    {
      std::swap(shuffled[k - 1], shuffled[std::min(k - 1, static_cast<std::size_t>(uniform(engine) * static_cast<double>(k)))]);
    }
    bundle.bottom.frames.resize(shuffled.size());
  }
  // The drawn areas miss their half by less than a circle; the layers share the difference.
  const double stretch = height / total;
  double level = -0.5 * height;
  std::array<double, 2> filled{ { 0.0, 0.0 } };
  std::array<std::size_t, 2> next{ { 0, 0 } };
  while (next[0] < order[0].size() || next[1] < order[1].size())
  {
    const bool second = next[0] == order[0].size() || (next[1] < order[1].size() && filled[1] < filled[0]);
    const std::size_t b = second ? 1 : 0;
    const std::size_t layer = order[b][next[b]++];
    const double thickness = stretch * thicknesses[b][layer];
    bundles[b].bottom.frames[layer] = layerFrame(bundles[b], level, level + thickness);
    level += thickness;
    filled[b] += thickness;
  }
  for (const Bundle& bundle : bundles)
  {
    requireFit(bundle.bottom, "Side");
  }
  return bundles;
}

} // namespace cactus
