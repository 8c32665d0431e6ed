// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkSubstrateCertificate
 * @brief Checks whether a simulator can rely on a substrate's surfaces.
 *
 * Input 0 `Outer`, input 1 `Inner` (optional): triangle surfaces with cell data `FibreId`. Input 2 `Fibres` (optional): their
 * centre lines, for radii along them.
 *
 * Output 0 `Certificate`: one row; the verdict `Certified` (0 or 1), how many surfaces or pairs have each fault, the smallest gap
 * between two fibres, the thinnest myelin, the worst triangles, and volume fractions. Output 1 `Fibres`: one row per fibre.
 * Unmeasurable values are NaN. Output 2 `Verdict`: output 0 as readable text, a row per column (`Finding`, `Value`), the verdict
 * in words first. A warning says why a substrate is not certified.
 *
 * A substrate is certified if every surface is a closed, outward 2-manifold that does not meet itself, no two outer surfaces meet
 * or lie inside one another, every inner surface lies strictly inside its outer one, and no two fibres are nearer than
 * MinimumGap. All of this is decided by exact predicates (Shewchuk 1997); touching counts as meeting.
 *
 * Ranks that were given the same surfaces share the work, and the first gives the tables.
 */
#ifndef vtkSubstrateCertificate_h
#define vtkSubstrateCertificate_h

#include "CactusFiltersModule.h"
#include "FilterProperties.h"

#include <vtkTableAlgorithm.h>

namespace cactus
{
class Sharing;
}

class CACTUSFILTERS_EXPORT vtkSubstrateCertificate : public vtkTableAlgorithm
{
public:
  static vtkSubstrateCertificate* New();
  vtkTypeMacro(vtkSubstrateCertificate, vtkTableAlgorithm);
  CACTUS_PRINTS_PROPERTIES

  CACTUS_NUMBER_PROPERTY(MinimumGap)
  CACTUS_NUMBER_PROPERTY(CutSpacing)
  CACTUS_WHOLE_PROPERTY(NumberOfThreads)

  CACTUS_COUNTS_AS_CHANGED_ONCE_STOPPED
  CACTUS_ABORT_IS_NO_CHANGE

protected:
  vtkSubstrateCertificate();
  ~vtkSubstrateCertificate() override = default;
  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkSubstrateCertificate(const vtkSubstrateCertificate&) = delete;
  void operator=(const vtkSubstrateCertificate&) = delete;

  /// Judges the surfaces, and fills the tables where they are asked for. Collective.
  void judge(const cactus::Sharing& all, bool isAsked, vtkInformationVector* outputs);

  std::unique_ptr<cactus::FilterProperties> Properties;
};

#endif
