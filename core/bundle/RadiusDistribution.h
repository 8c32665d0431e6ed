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
  Table,     ///< one of the given radii, all equally likely, with replacement
  Histogram  ///< as published for the axons of a tissue
};

/// Parameters of the outer radius (µm). All models but Table are truncated to [minimum, maximum] by rejection; with minimum =
/// maximum all radii are equal.
struct RadiusDistributionOptions
{
  RadiusModel model = RadiusModel::Gamma;
  double gammaShape = 2.4;          ///< dimensionless
  double gammaScale = 0.25;         ///< µm
  double lognormalMean = 0.6;       ///< µm, mean of the radius before truncation
  double lognormalDeviation = 0.39; ///< µm, standard deviation of the radius before truncation
  std::vector<double> table;        ///< µm, for RadiusModel::Table
  double minimum = 0.2;             ///< µm
  double maximum = 2.0;             ///< µm
  /// For RadiusModel::Histogram: axons without their myelin.
  PublishedRadii histogram = PublishedRadii::HumanGenu;
  double histogramFactor = 1.0; ///< factor on the histogram's diameters, such as to correct the tissue's shrinkage
  double histogramGRatio = 0.7; ///< inner radius over the outer one computed from it; 0: see base/MyelinThickness.h
  double histogramScale = 1.0;  ///< factor on these outer radii; see scaled()

  static const PropertyList<RadiusDistributionOptions>& properties();
  /// Throws InvalidInput, naming the property, unless every value that the model uses is within its range, minimum ≤ maximum, and
  /// the table, if used, is not empty and within [minimum, maximum].
  void validate() const;
  /// Returns the distribution of this one's radii multiplied by `factor`.
  RadiusDistributionOptions scaled(double factor) const;
};

/// Draws one outer radius (µm): the same for the same seed and index, whatever else is drawn. Throws InvalidInput if hardly any
/// of the distribution lies between minimum and maximum.
double sampleRadius(const RadiusDistributionOptions& options, std::uint64_t seed, std::uint64_t index);

/// Draws radii (µm) whose circles together have `area` (µm²): one after the other (indices from `firstIndex`) until the next
/// would exceed it. That last one is drawn again a few dozen times, and the draw that comes nearest, or none, is kept, so the sum
/// misses `area` by far less than a circle. There is always at least one radius.
std::vector<double> drawRadii(
  const RadiusDistributionOptions& options, std::uint64_t seed, double area, std::uint64_t firstIndex = 0);

/// Throws InvalidInput if less than about one in ten thousand of the draws lies between minimum and maximum, unless these are
/// nearly equal: drawing radii would take too long.
void requireShareWithinLimits(const RadiusDistributionOptions& options);

/// Returns the mean area (µm²) of a circle of the distribution, to within some per cent. Throws as requireShareWithinLimits()
/// does.
double meanCircleArea(const RadiusDistributionOptions& options);

/// Reads the numbers of a text (see takeNumber()), separated by white space, commas or semicolons. Throws InvalidInput, naming
/// RadiusTable and the word that is no number.
std::vector<double> parseRadiusTable(const std::string& text);

/// Does the same with a file, which has at least one number; throws FileError, naming the line, for anything else, or if the file
/// cannot be read.
std::vector<double> readRadiusTable(const std::string& path);

/// Does the same with a stream; `name` is its name in messages.
std::vector<double> readRadiusTable(std::istream& stream, const std::string& name);

/// Returns the options with the radii of a table, given as text or as a file (an empty path for none), if the model is Table.
/// Throws InvalidInput if both are given, and as the two functions above do.
RadiusDistributionOptions withTable(const RadiusDistributionOptions& options, const std::string& text, const std::string& path);

} // namespace cactus
