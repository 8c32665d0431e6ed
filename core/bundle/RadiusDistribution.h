// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Properties.h"
#include "bundle/RadiusHistogram.h"

#include <cstdint>
#include <istream>
#include <string>
#include <vector>

namespace cactus
{

/// How a fibre's outer radius is distributed.
enum class RadiusModel
{
  Gamma,     ///< gamma with a shape and a scale
  Lognormal, ///< lognormal with a mean and a standard deviation of the radius itself
  Table,     ///< one of the given radii, each as likely as the others, with replacement
  Histogram  ///< as the axons of a tissue are, as it was published
};

/// Parameters of the outer radius (µm). All but a table are cut to [minimum, maximum] by rejection; with minimum = maximum all
/// radii are equal.
struct RadiusDistributionOptions
{
  RadiusModel model = RadiusModel::Gamma;
  double gammaShape = 2.4;          ///< dimensionless
  double gammaScale = 0.25;         ///< µm
  double lognormalMean = 0.6;       ///< µm, mean of the radius before it is cut
  double lognormalDeviation = 0.39; ///< µm, standard deviation of the radius before it is cut
  std::vector<double> table;        ///< µm, for RadiusModel::Table
  double minimum = 0.2;             ///< µm
  double maximum = 2.0;             ///< µm
  /// Of RadiusModel::Histogram: axons without their myelin.
  PublishedRadii histogram = PublishedRadii::HumanGenu;
  double histogramFactor = 1.0; ///< what its diameters are multiplied by, such as to make the tissue's shrinkage good
  double histogramGRatio = 0.7; ///< inner radius over the outer one that is made of it; 0: see base/MyelinThickness.h
  double histogramScale = 1.0;  ///< what these outer radii are multiplied by; see scaled()

  static const PropertyList<RadiusDistributionOptions>& properties();
  /// Throws InvalidInput, naming the property, unless all that the model uses is within its range, minimum ≤
  /// maximum, and the table, where it is used, is not empty and within [minimum, maximum].
  void validate() const;
  /// The distribution of what this one's radii become when all are multiplied by `factor`.
  RadiusDistributionOptions scaled(double factor) const;
};

/// One outer radius (µm) of the distribution: the same for the same seed and index, whatever else is drawn. Throws InvalidInput
/// where hardly any of the distribution lies between minimum and maximum.
double sampleRadius(const RadiusDistributionOptions& options, std::uint64_t seed, std::uint64_t index);

/// Radii (µm) whose circles together have the area asked for (µm²): drawn one after the other (indices from `firstIndex`) until
/// the next would pass it. That last one is drawn again a few dozen times, and the draw that comes nearest, or none, is kept, so
/// the areas' sum misses `area` by far less than a circle. There is always at least one radius.
std::vector<double> drawRadii(
  const RadiusDistributionOptions& options, std::uint64_t seed, double area, std::uint64_t firstIndex = 0);

/// Throws InvalidInput where less than about one in ten thousand of the draws lies between minimum and maximum, unless these
/// are as good as equal: radii could then not be drawn in reasonable time.
void requireShareWithinLimits(const RadiusDistributionOptions& options);

/// Mean area (µm²) of a circle of the distribution, to within some per cent. Throws as requireShareWithinLimits() does.
double meanCircleArea(const RadiusDistributionOptions& options);

/// The numbers of a text (see takeNumber()), separated by white space, commas or semicolons. Throws InvalidInput, naming
/// RadiusTable and the word that is no number.
std::vector<double> parseRadiusTable(const std::string& text);

/// The same for a file's content, at least one number; throws FileError, naming the line, where that is something else, and where
/// the file cannot be read.
std::vector<double> readRadiusTable(const std::string& path);

/// The same from a stream; `name` is what messages call it.
std::vector<double> readRadiusTable(std::istream& stream, const std::string& name);

/// The options with the radii of a table that is given as text or as a file (an empty path for none), where the model is one.
/// Throws InvalidInput where both are given, and as the two above do.
RadiusDistributionOptions withTable(const RadiusDistributionOptions& options, const std::string& text, const std::string& path);

} // namespace cactus
