// SPDX-License-Identifier: BSD-3-Clause
#include "bundle/BundleInitializerOptions.h"

#include "base/Error.h"
#include "base/Limits.h"
#include "base/Numbers.h"

#include <algorithm>
#include <cmath>

namespace cactus
{

void BundleInitializerOptions::validate() const
{
  requireWithin("Side", side, limits::side);
  requireWithin("FibreVolumeFraction", fibreVolumeFraction, limits::fraction);
  requireWithin("GrownFibreVolumeFraction", grownFibreVolumeFraction, { fibreVolumeFraction, limits::fraction.highest, "", true },
    " (no less than FibreVolumeFraction)");
  radius.validate();
  if (radius.minimum * this->thinning() < limits::radius.lowest)
  {
    throw InvalidInput(
      text("MinimumRadius ", radius.minimum, " µm makes capsules of less than ", limits::radius.lowest, " µm where they fill ",
        fibreVolumeFraction, " to be grown to ", grownFibreVolumeFraction, ": enlarge MinimumRadius or FibreVolumeFraction"));
  }
  requireWithin("MeanDispersion", meanDispersion, limits::meanDispersion);
  if (dispersionModel != DispersionModel::Watson && dispersionModel != DispersionModel::Cone &&
      dispersionModel != DispersionModel::Coherent)
  {
    throw InvalidInput("DispersionModel has no such choice: use Watson (0), Cone (1) or Coherent (2)");
  }
  requireWithin("CorrelationLength", correlationLength, limits::correlationLength);
  requireWithin(
    "NumberOfBundles", numberOfBundles, { 1.0, 2.0 }, "; append several sources for more bundles or other directions");
  requireWithin("CrossingAngle", crossingAngle, limits::crossingAngle);
  if (crossingStyle != CrossingStyle::Interwoven && crossingStyle != CrossingStyle::Sheets)
  {
    throw InvalidInput("CrossingStyle has no such choice: use Interwoven (0) or Sheets (1)");
  }
  requireWithin("SheetThickness", sheetThickness, limits::sheetThickness);
  requireWithin("Margin", margin, limits::bundleMargin);
  requireWithin("SpacingFactor", spacingFactor, limits::spacingFactor);
  requireWithin("MinimumSpacing", minimumSpacing, limits::spacing);
  requireWithin("MaximumSpacing", maximumSpacing, limits::spacing);
  if (minimumSpacing > maximumSpacing)
  {
    throw InvalidInput(text("MaximumSpacing ", maximumSpacing, " is below MinimumSpacing ", minimumSpacing, ": exchange them"));
  }
}

double BundleInitializerOptions::thinning() const
{
  return grownFibreVolumeFraction > 0.0 ? std::sqrt(fibreVolumeFraction / grownFibreVolumeFraction) : 1.0;
}

std::string BundleInitializerOptions::describe() const
{
  TextStream text;
  text.precision(12);
  text << "Side=" << side << " FibreVolumeFraction=" << fibreVolumeFraction
       << " GrownFibreVolumeFraction=" << grownFibreVolumeFraction;
  switch (radius.model)
  {
  case RadiusModel::Gamma:
    text << " RadiusDistribution=Gamma GammaShape=" << radius.gammaShape << " GammaScale=" << radius.gammaScale;
    break;
  case RadiusModel::Lognormal:
    text << " RadiusDistribution=Lognormal LognormalMean=" << radius.lognormalMean
         << " LognormalDeviation=" << radius.lognormalDeviation;
    break;
  case RadiusModel::Table:
    text << " RadiusDistribution=Table RadiusTable=";
    for (std::size_t i = 0; i < radius.table.size(); ++i)
    {
      text << (i > 0 ? "," : "") << radius.table[i];
    }
    break;
  }
  text << " MinimumRadius=" << radius.minimum << " MaximumRadius=" << radius.maximum << " MeanDispersion=" << meanDispersion
       << " DispersionModel="
       << (dispersionModel == DispersionModel::Coherent ? "Coherent"
            : dispersionModel == DispersionModel::Cone  ? "Cone"
                                                        : "Watson");
  if (isCoherent(*this))
  {
    text << " CorrelationLength=" << correlationLength;
  }
  text << " NumberOfBundles=" << numberOfBundles;
  if (numberOfBundles == 2)
  {
    text << " CrossingAngle=" << crossingAngle
         << " CrossingStyle=" << (crossingStyle == CrossingStyle::Interwoven ? "Interwoven" : "Sheets");
    if (crossingStyle == CrossingStyle::Sheets)
    {
      text << " SheetThickness=" << sheetThickness;
    }
  }
  text << " Margin=" << margin << " SpacingFactor=" << spacingFactor << " MinimumSpacing=" << minimumSpacing
       << " MaximumSpacing=" << maximumSpacing << " Seed=" << seed;
  return text.str();
}

bool isCoherent(const BundleInitializerOptions& options)
{
  return options.dispersionModel == DispersionModel::Coherent && options.numberOfBundles == 1;
}

} // namespace cactus
