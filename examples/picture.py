# SPDX-License-Identifier: BSD-3-Clause
"""Draws a substrate: a cut across it in the colours of the paper's cross-sections, beside a view in three dimensions."""

from paraview import servermanager, simple
from vtkmodules.vtkCommonTransforms import vtkTransform
from vtkmodules.vtkFiltersGeneral import vtkContourTriangulator, vtkTransformPolyDataFilter

MYELIN = [0.80, 0.20, 0.18]
AXON = [0.26, 0.45, 0.80]
EXTRA_AXONAL = [1.0, 1.0, 1.0]


def _filled_cut(surface, height, lift=0.0):
    """The cross-section of closed surfaces at z = height, as filled polygons, shown higher by `lift` (µm)."""
    cut = simple.Slice(Input=surface)
    cut.SliceType.Origin = [0.0, 0.0, height]
    cut.SliceType.Normal = [0.0, 0.0, 1.0]
    cut.UpdatePipeline()
    triangulator = vtkContourTriangulator()
    triangulator.SetInputData(servermanager.Fetch(cut))
    # Not the representation's property for this, which is Position up to ParaView 5.12, and Translation from 5.13 on.
    transform = vtkTransform()
    transform.Translate(0.0, 0.0, lift)
    lifted = vtkTransformPolyDataFilter()
    lifted.SetTransform(transform)
    lifted.SetInputConnection(triangulator.GetOutputPort())
    lifted.Update()
    filled = simple.TrivialProducer()
    filled.GetClientSideObject().SetOutput(lifted.GetOutput())
    simple.Delete(cut)
    return filled


def _show(source, view, colour, flat):
    display = simple.Show(source, view)
    display.ColorArrayName = ["POINTS", ""]
    display.DiffuseColor = colour
    display.AmbientColor = colour
    if flat:
        display.Ambient, display.Diffuse = 1.0, 0.0
    else:
        display.Ambient, display.Diffuse = 0.3, 0.9
        display.Specular, display.SpecularPower = 0.2, 30.0
    return display


def _view(pixels):
    view = simple.CreateRenderView()
    view.ViewSize = [pixels, pixels]
    view.UseColorPaletteForBackground = 0
    view.BackgroundColorMode = "Single Color"
    view.Background = EXTRA_AXONAL
    view.OrientationAxesVisibility = 0
    return view


def draw_substrate(outer, inner, side, filename, pixels=900):
    """Writes a PNG, 2 × `pixels` wide: left the cut at z = 0 (axon blue, myelin red, extra-axonal space white), right the fibres, of
    which the axons stand out of the myelin at the top. `outer` and `inner` (or None) are pipeline ports, `side` the domain's side in µm."""
    cut = _view(pixels)
    _show(_filled_cut(outer, 0.0), cut, MYELIN, flat=True)
    if inner is not None:
        # A little above, so that it covers.
        _show(_filled_cut(inner, 0.0, lift=0.01 * side), cut, AXON, flat=True)
    cut.CameraParallelProjection = 1
    cut.CameraPosition = [0.0, 0.0, 2.0 * side]
    cut.CameraFocalPoint = [0.0, 0.0, 0.0]
    cut.CameraViewUp = [0.0, 1.0, 0.0]
    cut.CameraParallelScale = 0.51 * side

    solid = _view(pixels)
    stripped = simple.Clip(Input=outer, ClipType="Plane")
    stripped.ClipType.Origin = [0.0, 0.0, 0.22 * side]
    stripped.ClipType.Normal = [0.0, 0.0, 1.0]
    stripped.Invert = 1
    _show(stripped, solid, MYELIN, flat=False)
    if inner is not None:
        _show(inner, solid, AXON, flat=False)
    solid.CameraPosition = [2.2 * side, -1.7 * side, 1.6 * side]
    solid.CameraFocalPoint = [0.0, 0.0, 0.0]
    solid.CameraViewUp = [0.0, 0.0, 1.0]
    simple.ResetCamera(solid)
    solid.GetActiveCamera().Zoom(1.0)

    layout = simple.CreateLayout("Substrate")
    simple.AssignViewToLayout(view=cut, layout=layout, hint=0)
    layout.SplitHorizontal(0, 0.5)
    simple.AssignViewToLayout(view=solid, layout=layout, hint=2)
    layout.SetSize(2 * pixels, pixels)
    simple.SaveScreenshot(filename, layout, ImageResolution=[2 * pixels, pixels], CompressionLevel="9")
    # A render window that lives until Python ends takes the process down with it.
    for view in (cut, solid):
        simple.Delete(view)
