# SPDX-License-Identifier: BSD-3-Clause
"""Makes surfaces of single fibres with ParaView's own filters, asks the certificate of them, and draws why fields of their own are needed.

    ./cactus pvpython examples/vtk_meshing.py [PICTURE]

All lengths are in µm. The page docs/vtk-meshing.md tells more.
"""

import sys

from paraview import servermanager, simple


def label_image():
    """A bundle grown until its fibres meet."""
    bundle = simple.BundleInitializer(Side=6, GrownFibreVolumeFraction=0.8, MeanDispersion=8)
    fibres = simple.OutputPort(simple.CapsuleOptimizer(Input=bundle), 0)
    return simple.FibreRadialGrowth(Input=fibres, VoxelSize=0.1)


def surfaces_of(field, level=0.0):
    """Contour, Smooth and Decimate, as they are in ParaView's menu. Each block stays one fibre's, with its FibreId."""
    contour = simple.Contour(Input=field, ContourBy=["POINTS", "Field"], Isosurfaces=[level])
    smooth = simple.Smooth(Input=contour, NumberofIterations=20)
    return simple.Decimate(Input=smooth, TargetReduction=0.8)


def describe(title, surfaces):
    """What the certificate finds. It says on the console, too, why it does not certify."""
    certificate = simple.SubstrateCertificate(Outer=surfaces, MinimumGap=0)
    certificate.UpdatePipeline()
    row = servermanager.Fetch(certificate, idx=0)
    value = lambda name: row.GetColumnByName(name).GetValue(0)
    print(
        f"{title}: {value('OuterSurfaces'):.0f} surfaces, {value('Triangles'):.0f} triangles, {value('NotClosed'):.0f} not closed, "
        f"{value('OuterPairsMeeting'):.0f} pairs that meet, {'certified' if value('Certified') else 'not certified'}"
    )


def view():
    one = simple.CreateRenderView()
    one.ViewSize = [500, 500]
    one.UseColorPaletteForBackground = 0
    one.BackgroundColorMode = "Single Color"
    one.Background = [1.0, 1.0, 1.0]
    one.OrientationAxesVisibility = 0
    one.CameraPosition = [9.0, -13.0, 13.0]
    one.CameraFocalPoint = [0.0, 0.0, 0.0]
    one.CameraViewUp = [0.0, 0.0, 1.0]
    one.CameraParallelProjection = 1
    one.CameraParallelScale = 4.9
    return one


def show(source, where, colour):
    display = simple.Show(source, where)
    display.ColorArrayName = ["POINTS", ""]
    display.DiffuseColor = display.AmbientColor = colour
    display.Ambient, display.Diffuse = 0.25, 0.85


def draw(image, fields, picture):
    """Left the contour of the label image's Depth at 0, right those of the fibres' own fields."""
    fused = simple.Contour(Input=image, ContourBy=["POINTS", "Depth"], Isosurfaces=[0.0])
    left, right = view(), view()
    show(fused, left, [0.80, 0.20, 0.18])
    surfaces = simple.Contour(Input=fields, ContourBy=["POINTS", "Field"], Isosurfaces=[0.0])
    display = simple.Show(surfaces, right)
    simple.ColorBy(display, ("FIELD", "vtkBlockColors"))
    display.SetScalarBarVisibility(right, False)
    layout = simple.CreateLayout()
    layout.SplitHorizontal(0, 0.5)
    layout.AssignView(1, left)
    layout.AssignView(2, right)
    layout.SetSize(1000, 500)
    simple.SaveScreenshot(picture, layout, ImageResolution=[1000, 500], CompressionLevel="9")


image = label_image()

one = simple.FibreField(Input=image, Select="One fibre", FibreId=3)
describe("one fibre", surfaces_of(one))

# Its axon, were the myelin 0.15 µm thick: the contour at that depth, and the field's caps made for that level.
axon = simple.FibreField(Input=image, Select="One fibre", FibreId=3, Level=0.15)
describe("its axon", surfaces_of(axon, 0.15))

bundle = simple.FibreField(Input=image, Select="One bundle", BundleId=1)
describe("a bundle", surfaces_of(bundle))

if len(sys.argv) > 1:
    draw(image, bundle, sys.argv[1])
