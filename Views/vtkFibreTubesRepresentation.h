// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkFibreTubesRepresentation
 * @brief fibres as tubes of their own radius, in the box of their domain
 *
 * Polylines with point data `Radius` (µm) are drawn as tubes of that radius, with fewer sides the more points there are, and in
 * many points as lines. Where the data carry field data `Domain` (xmin xmax ymin ymax zmin zmax, µm) its box is drawn around
 * them. Other data, composite ones among them, are shown as by vtkGeometryRepresentation. Arrays of red, green and blue
 * (unsigned char) are shown as the colours they are; where no array is chosen, point data `Direction` is one, unless
 * DirectionColors is off. (Chosen as an array it would get a scalar bar, of its magnitude.) A render view whose camera nobody
 * has moved yet is turned, so that fibres along z are not seen end-on.
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

  /** What is drawn of the input. */
  using vtkGeometryRepresentationWithFaces::GetInternalOutputPort;
  vtkAlgorithmOutput* GetInternalOutputPort(int port, int connection) override;

  /** Colours fibres by their direction where no array is chosen. On by default. */
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
  vtkNew<vtkTrivialProducer> Tubes;
};

#endif
