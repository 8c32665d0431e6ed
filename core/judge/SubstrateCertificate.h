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

/// Criteria of the certificate.
struct SubstrateCertificateOptions
{
  /// Distance (µm) that the outer surfaces of any two fibres have to keep from each other. 0 requires only that they do not meet,
  /// -1 the promise of the outer surfaces (FibreSurfaces::promisedGap), which is nothing for foreign surfaces.
  double minimumGap = -1.0;
  /// Distance (µm) between two cross-sections along a fibre's centre line.
  double cutSpacing = 1.0;

  static const PropertyList<SubstrateCertificateOptions>& properties();
  /// Throws InvalidInput naming the property.
  void validate() const;
};

/// Judges all surfaces of a substrate. `fibres` may be null, and then radii along the fibres are NaN. Fibres that were to have a
/// surface are those whose centre lines run through the domain, and those that the surfaces themselves name (wantedIds).
/// Fractions of empty sets of surfaces are 0, those of sets that are not given NaN.
///
/// The most recently used outer surfaces are held in memory, 1 GiB of them in all processes together but at least 256 MiB in
/// each, with about 100 bytes per triangle; inner ones one per thread. Pairs of fibres are selected by their boxes, and triangles
/// by trees of boxes. The result does not depend on the number of threads, nor of processes, which share the work and all get it.
/// Results in the cache `known`, for the same surfaces, domain, centre lines and distance of cuts, are not computed again. Throws
/// InvalidInput (a damaged surface, which is named) and Cancelled.
SubstrateCertificate certify(const Domain& domain, const FibreSurfaces& outer, const FibreSurfaces& inner, const Fibres* fibres,
  const SubstrateCertificateOptions& options = {}, const Context& context = {}, const Sharing& sharing = Sharing(),
  const Recollection& known = {});

} // namespace cactus
