// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkFibreSurfaceRepresentation
 * @brief Surfaces of fibres whose inner surfaces are visible in the faces of the domain.
 *
 * The caps of an axon lie slightly inside of those of its outer surface, in the faces of the domain. With LiftCaps they are drawn
 * a thousandth of the domain outside, so that these faces show the axons within their myelin, as in a cut. The camera of a render
 * view is turned, if nobody has moved it yet, so that fibres along z are not seen end-on.
 */
#ifndef vtkFibreSurfaceRepresentation_h
#define vtkFibreSurfaceRepresentation_h

#include "CactusViewsModule.h"

#include "vtkGeometryRepresentationWithFaces.h"

#include <vtkNew.h>

class vtkTrivialProducer;

class CACTUSVIEWS_EXPORT vtkFibreSurfaceRepresentation : public vtkGeometryRepresentationWithFaces
{
public:
  static vtkFibreSurfaceRepresentation* New();
  vtkTypeMacro(vtkFibreSurfaceRepresentation, vtkGeometryRepresentationWithFaces);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /** Whether caps in the faces of the domain are drawn over others there; off by default. */
  vtkSetMacro(LiftCaps, bool);
  vtkGetMacro(LiftCaps, bool);
  ///@}

  /** Returns the drawn part of the input. */
  using vtkGeometryRepresentationWithFaces::GetInternalOutputPort;
  vtkAlgorithmOutput* GetInternalOutputPort(int port, int connection) override;

protected:
  vtkFibreSurfaceRepresentation();
  ~vtkFibreSurfaceRepresentation() override;

  bool AddToView(vtkView* view) override;
  void UpdateColoringParameters() override;

private:
  vtkFibreSurfaceRepresentation(const vtkFibreSurfaceRepresentation&) = delete;
  void operator=(const vtkFibreSurfaceRepresentation&) = delete;

  bool LiftCaps = false;
  vtkNew<vtkTrivialProducer> Lifted;
};

#endif
