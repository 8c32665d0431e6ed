// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkMyelinSurface
 * @brief Closed outer and inner surfaces of all fibres of a label image, with myelin of the requested thickness.
 *
 * Input: the image that vtkFibreRadialGrowth makes, with its field data. Output 0 `Outer` and 1 `Inner`: triangles with cell data
 * `FibreId`, `BundleId` and `Surface` (0 outer, 1 inner), in increasing order of fibres, which share no points, and
 * `Radius`, `GRatio` and `Direction` (a colour) of their fibre; field data `Domain` and `Provenance`, none of the image's.
 * Output 2 `Fibre statistics`: a table with one row per fibre of the image's FibreTable.
 *
 * Each surface is a closed, outward 2-manifold, cut off flat at the faces of the domain; inner caps lie a little inside the outer
 * ones. The method, its guarantees and its limits are in core/surface/MyelinSurface.h; the contouring is core/mesh/Isosurface.h,
 * since marching cubes does not guarantee a manifold.
 *
 * The column `Myelin` is the result for a fibre: 0 as asked; 1 thinner than asked, since the axon would break; 2 thicker than
 * asked, since myelin is at least MinimumGap thick; 3 without an inner surface, since the fibre is too thin for both; 4 without
 * any surface, since too few voxels of the image, or none, belong to the fibre. `Flawed` is 1 if a fault could not be repaired.
 * One warning counts the deviations. Field data `WantedFibres` of output 0, the ids of the fibres that were to have a surface,
 * and `MinimumGap` of both (µm) let a certificate detect missing surfaces.
 *
 * Without nodes of Ranvier, outer surfaces do not depend on g-ratios. They are kept, and not made again if only GRatioModel,
 * GRatio, GRatioDeviation, TargetAxonVolumeFraction, MyelinFollowsAxon, SwellingAmplitude, SwellingSpacing, SwellingLength or
 * Seed changes.
 *
 * On several ranks each makes the surfaces of its fibres from the whole image, which all need. They then have all surfaces, the
 * same as on one rank. If each is asked for its piece, it gives consecutive fibres with about the same number of triangles, and
 * the first gives the table; if each is asked for everything, as by the filters that judge and write, it gives all.
 */
#ifndef vtkMyelinSurface_h
#define vtkMyelinSurface_h

#include "CactusFiltersModule.h"
#include "OptionProperties.h"

#include <vtkDataObject.h>
#include <vtkPolyDataAlgorithm.h>
#include <vtkSmartPointer.h>

#include <memory>
#include <vector>

namespace cactus
{
class Sharing;
class SurfaceMaker;
struct FibreSurfacePair;
} // namespace cactus

class CACTUSFILTERS_EXPORT vtkMyelinSurface : public vtkPolyDataAlgorithm
{
public:
  static vtkMyelinSurface* New();
  vtkTypeMacro(vtkMyelinSurface, vtkPolyDataAlgorithm);
  CACTUS_PRINTS_PROPERTIES

  /** Values of GRatioModel. */
  enum
  {
    CONSTANT = 0,
    LOG_LINEAR = 1,
    DISTRIBUTED = 2,
    TARGET_AXON_VOLUME_FRACTION = 3
  };

  CACTUS_MYELIN_SURFACE_PROPERTIES
  CACTUS_WHOLE_PROPERTY(Seed)

  /** Values of Meshing. */
  enum
  {
    CACTUS_MESHING = 0,
    VTK_MESHING = 1
  };

  CACTUS_WHOLE_PROPERTY(Meshing)
  CACTUS_WHOLE_PROPERTY(SincIterations)
  CACTUS_NUMBER_PROPERTY(SincPassBand)
  CACTUS_NUMBER_PROPERTY(TargetReduction)
  CACTUS_SWITCH_PROPERTY(ReleaseInput)
  CACTUS_WHOLE_PROPERTY(NumberOfThreads)

  /** Returns the fibres from which the label image was grown, as they were then; null unless it comes directly from growth. */
  vtkDataObject* GrownFibres() const { return this->Fibres; }

  CACTUS_COUNTS_AS_CHANGED_ONCE_STOPPED
  CACTUS_ABORT_IS_NO_CHANGE

protected:
  vtkMyelinSurface();
  ~vtkMyelinSurface() override;
  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkMyelinSurface(const vtkMyelinSurface&) = delete;
  void operator=(const vtkMyelinSurface&) = delete;

  /// Outer surfaces of an earlier run, and their inputs.
  struct KeptOuter;
  /// All surfaces, and what they were made for.
  struct Result;

  /// Makes `Made`. Collective.
  void make(vtkDataObject* input, const cactus::Sharing& sharing);
  /// Makes all surfaces, or reuses the outer ones that are kept, of another g-ratio only if they do not follow the inner ones.
  /// Puts the outer ones into `output`, and returns the inner ones.
  std::vector<cactus::FibreSurfacePair> makeSurfaces(cactus::SurfaceMaker& maker, vtkMTimeType inputTime, bool outerFollowsInner,
    vtkPolyData* output, const cactus::Sharing& sharing);

  std::unique_ptr<cactus::FilterProperties> Properties;
  std::unique_ptr<KeptOuter> Kept;
  std::unique_ptr<Result> Made;
  vtkSmartPointer<vtkDataObject> Fibres;
};

#endif
