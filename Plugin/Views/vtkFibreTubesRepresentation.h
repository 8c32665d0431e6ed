// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkFibreTubesRepresentation
 * @brief Fibres as tubes of their own radius, in the box of their domain.
 *
 * Polylines with point data `Radius` (µm) are drawn as tubes of that radius, with fewer sides the more points there are, and
 * above a limit as lines. If the data have field data `Domain` (xmin xmax ymin ymax zmin zmax, µm), its box is drawn around them.
 * Images are drawn as slices, see cactus::imageSections(); other data are shown as by vtkGeometryRepresentation. Arrays of red,
 * green and blue (unsigned char) are shown as colours. Without a chosen array, several bundles have a colour each (cell data
 * `BundleId`), and fibres of one those of their directions (point data `Direction`), a little lighter, unless DirectionColors is
 * off. The camera of a render view is turned, if nobody has moved it yet, so that fibres along z are not seen end-on.
 */
#ifndef vtkFibreTubesRepresentation_h
#define vtkFibreTubesRepresentation_h

#include "CactusViewsModule.h"

#include "vtkGeometryRepresentationWithFaces.h"

#include <vtkNew.h>

class vtkTrivialProducer;

class CACTUSVIEWS_EXPORT vtkFibreTubesRepresentation : public vtkGeometryRepresentationWithFaces
{
public:
  static vtkFibreTubesRepresentation* New();
  vtkTypeMacro(vtkFibreTubesRepresentation, vtkGeometryRepresentationWithFaces);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** Returns the drawn part of the input. */
  using vtkGeometryRepresentationWithFaces::GetInternalOutputPort;
  vtkAlgorithmOutput* GetInternalOutputPort(int port, int connection) override;

  /** Colours fibres by bundle or direction if no array is chosen. On by default. */
  vtkSetMacro(DirectionColors, bool);
  vtkGetMacro(DirectionColors, bool);

protected:
  vtkFibreTubesRepresentation();
  ~vtkFibreTubesRepresentation() override;

  bool AddToView(vtkView* view) override;
  void UpdateColoringParameters() override;

private:
  vtkFibreTubesRepresentation(const vtkFibreTubesRepresentation&) = delete;
  void operator=(const vtkFibreTubesRepresentation&) = delete;

  bool DirectionColors = true;
  vtkNew<vtkTrivialProducer> Shape;
};

#endif
