// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Domain.h"
#include "fibres/Fibres.h"
#include "judge/CertificateFindings.h"
#include "judge/OuterSurfaces.h"
#include "mesh/FibreSurfaces.h"

#include <cstddef>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

namespace cactus
{

/// Determines the certificate's findings on single fibres. Thread-safe.
class FibreExamination
{
public:
  /// `fibres` may be null. All arguments passed by reference have to outlive the object.
  FibreExamination(
    const Domain& domain, const FibreSurfaces& outer, const FibreSurfaces& inner, const Fibres* fibres, double cutSpacing);

  /// Fills in the findings on the fibre of the given id, except those that depend on other fibres, and raises `reach` to the
  /// distance (µm) by which its surfaces reach out of the domain. Returns the outer surface, or null if there is none. Throws
  /// InvalidInput for a damaged surface, which it names.
  std::unique_ptr<TreedSurface> examine(FibreCertificate& fibre, double& reach) const;

  /// Returns the outer surface of a fibre that has one.
  std::unique_ptr<TreedSurface> outerOf(int fibreId) const;

private:
  using Index = std::unordered_map<int, std::size_t>;
  static Index indexOf(const std::vector<int>& ids);

  /// The measures of one outer or inner surface.
  struct Findings
  {
    SurfaceReport& report;
    std::size_t& selfIntersections;
    bool& selfNested;
    RadiusAlongFibre& radius;
  };
  std::unique_ptr<TreedSurface> measure(TriangleMesh mesh, int fibreId, const std::string& name, Findings findings) const;

  const Domain& Box;
  const FibreSurfaces& Outer;
  const FibreSurfaces& Inner;
  const Fibres* Lines;
  double CutSpacing;
  Index OuterIndex;
  Index InnerIndex;
  Index LineIndex;
};

} // namespace cactus
