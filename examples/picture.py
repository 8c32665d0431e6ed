# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of substrates: cuts across them, filled in the colours asked for, and views in three dimensions."""

from paraview import servermanager, simple
from vtkmodules.vtkCommonCore import vtkLogger
from vtkmodules.vtkCommonTransforms import vtkTransform
from vtkmodules.vtkFiltersGeneral import vtkContourTriangulator, vtkTransformPolyDataFilter

MYELIN = [0.80, 0.20, 0.18]
AXON = [0.26, 0.45, 0.80]
EXTRA_AXONAL = [1.0, 1.0, 1.0]


def moved(algorithm, offset):
    """The polygons that a VTK algorithm makes, moved by `offset` (µm), as a pipeline source. Not the property of representations for
    this, which is Position up to ParaView 5.12, and Translation from 5.13 on."""
    transform = vtkTransform()
    transform.Translate(offset)
    mover = vtkTransformPolyDataFilter()
    mover.SetTransform(transform)
    mover.SetInputConnection(algorithm.GetOutputPort())
    mover.Update()
    source = simple.TrivialProducer()
    source.GetClientSideObject().SetOutput(mover.GetOutput())
    return source


def _filled_cut(surface, normal, lift):
    """The cross-section of closed surfaces through the origin, as filled polygons, moved along the normal by `lift` (µm)."""
    vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_WARNING)  # VTK's cutter says that it cuts, each time
    cut = simple.Slice(Input=surface)
    cut.SliceType.Origin = [0.0, 0.0, 0.0]
    cut.SliceType.Normal = list(normal)
    cut.UpdatePipeline()
    triangulator = vtkContourTriangulator()
    triangulator.SetInputData(servermanager.Fetch(cut))
    filled = moved(triangulator, [lift * part for part in normal])
    simple.Delete(cut)
    return filled


def show(source, view, colour, flat=False):
    """In one colour; `flat` is without light and shadow."""
    display = simple.Show(source, view)
    display.ColorArrayName = ["POINTS", ""]
    display.DiffuseColor = colour
    display.AmbientColor = colour
    # Myelin Surface's outputs have colours of their own, by which their caps are told apart.
    for name in ("MyelinColor", "AxonColor"):
        if name in display.ListProperties():
            setattr(display, name, colour)
    if flat:
        display.Ambient, display.Diffuse = 1.0, 0.0
    else:
        display.Ambient, display.Diffuse = 0.3, 0.9
        display.Specular, display.SpecularPower = 0.2, 30.0
    return display


def white_view(width, height):
    view = simple.CreateRenderView()
    view.ViewSize = [width, height]
    view.UseColorPaletteForBackground = 0
    view.BackgroundColorMode = "Single Color"
    view.Background = EXTRA_AXONAL
    view.OrientationAxesVisibility = 0
    return view


def section_view(layers, window, pixels, normal=(0.0, 0.0, 1.0), up=(0.0, 1.0, 0.0)):
    """The cut through the origin across `normal` (a unit vector), in a square of `window` µm. `layers` are (surfaces, colour), each drawn
    over those before it; what none of them covers is white."""
    filled = [(_filled_cut(surfaces, normal, lift=0.01 * window * i), colour) for i, (surfaces, colour) in enumerate(layers)]
    return flat_view(filled, window, pixels, normal, up)


def flat_view(layers, window, pixels, normal=(0.0, 0.0, 1.0), up=(0.0, 1.0, 0.0)):
    """The same of what is flat already: `layers` are (polygons, colour)."""
    view = white_view(pixels, pixels)
    for polygons, colour in layers:
        show(polygons, view, colour, flat=True)
    view.CameraParallelProjection = 1
    view.CameraPosition = [2.0 * window * part for part in normal]
    view.CameraFocalPoint = [0.0, 0.0, 0.0]
    view.CameraViewUp = list(up)
    view.CameraParallelScale = 0.5 * window
    return view


def solid_view(layers, side, pixels):
    """Surfaces in three dimensions, seen at an angle: `layers` are (surfaces, colour)."""
    view = white_view(pixels, pixels)
    for surfaces, colour in layers:
        show(surfaces, view, colour)
    view.CameraPosition = [2.2 * side, -1.7 * side, 1.6 * side]
    view.CameraFocalPoint = [0.0, 0.0, 0.0]
    view.CameraViewUp = [0.0, 0.0, 1.0]
    simple.ResetCamera(view)
    view.GetActiveCamera().Zoom(1.0)
    return view


def below(surfaces, height):
    """What lies below z = height (µm), so that what is inside stands out."""
    clipped = simple.Clip(Input=surfaces, ClipType="Plane")
    clipped.ClipType.Origin = [0.0, 0.0, height]
    clipped.ClipType.Normal = [0.0, 0.0, 1.0]
    clipped.Invert = 1
    return clipped


def draw_substrate(outer, inner, side, filename, pixels=900, flat=()):
    """Writes a PNG, 2 × `pixels` wide: left the cut at z = 0 (axon blue, myelin red, extra-axonal space white), right the fibres, of
    which the axons stand out of the myelin at the top. `outer` and `inner` (or None) are pipeline ports, `side` the domain's side in µm.
    `flat` is the cut where that is at hand, as (polygons, colour)."""
    axons = [] if inner is None else [(inner, AXON)]
    cut = flat_view(flat, 1.02 * side, pixels) if flat else section_view([(outer, MYELIN), *axons], 1.02 * side, pixels)
    solid = solid_view([(below(outer, 0.22 * side), MYELIN), *axons], side, pixels)
    layout = simple.CreateLayout("Substrate")
    simple.AssignViewToLayout(view=cut, layout=layout, hint=0)
    layout.SplitHorizontal(0, 0.5)
    simple.AssignViewToLayout(view=solid, layout=layout, hint=2)
    layout.SetSize(2 * pixels, pixels)
    simple.SaveScreenshot(filename, layout, ImageResolution=[2 * pixels, pixels], CompressionLevel="9")
    # A render window that lives until Python ends takes the process down with it.
    for view in (cut, solid):
        simple.Delete(view)
