// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Context.h"
#include "base/Domain.h"
#include "base/Properties.h"
#include "base/Recollection.h"
#include "base/Sharing.h"
#include "fibres/Fibres.h"
#include "judge/CertificateFindings.h"
#include "mesh/FibreSurfaces.h"

namespace cactus
{

/// What a substrate is certified for.
struct SubstrateCertificateOptions
{
  /// µm that the outer surfaces of any two fibres have to keep from each other. 0 asks only that they do not meet, -1 for what
  /// the outer surfaces promise (FibreSurfaces::promisedGap), which is nothing for those that were not made here.
  double minimumGap = -1.0;
  /// µm between two cross-sections along a fibre's centre line.
  double cutSpacing = 1.0;

  static const PropertyList<SubstrateCertificateOptions>& properties();
  /// Throws InvalidInput naming the property.
  void validate() const;
};

/// Looks at all surfaces of a substrate. `fibres` may be null, and then radii along the fibres are NaN. Fibres that were to have
/// a surface are those whose centre lines run through the domain, and those that the surfaces themselves name (wantedIds).
/// Fractions of no surfaces are 0, those of surfaces that are not given NaN.
///
/// The outer surfaces used last are held in memory, 1 GiB of them in all processes together but 256 MiB in each at least, with
/// about 100 bytes a triangle; inner ones one per thread. Pairs of fibres are sorted out by their boxes, and triangles by trees
/// of boxes. The result does not depend on the number of threads, nor of processes, which share the work and all get it. What is
/// `known` of these very surfaces, domain, centre lines and distance of cuts is not looked for again. Throws InvalidInput (a
/// surface that is damaged, which is named) and Cancelled.
SubstrateCertificate certify(const Domain& domain, const FibreSurfaces& outer, const FibreSurfaces& inner, const Fibres* fibres,
  const SubstrateCertificateOptions& options = {}, const Context& context = {}, const Sharing& sharing = Sharing(),
  const Recollection& known = {});

} // namespace cactus
