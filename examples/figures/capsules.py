# SPDX-License-Identifier: BSD-3-Clause
"""Figure 2: a capsule, and a fibre as a chain of capsules, on an optimised fibre."""

from matplotlib import pyplot
from paper_figure import Figure, image, place, polyline, producer, servermanager, simple
from picture import show, white_view
from vtkmodules.vtkCommonCore import vtkDoubleArray

TUBE, BALL, AXIS = [0.55, 0.68, 0.85], [0.80, 0.20, 0.18], [0.0, 0.0, 0.0]


def capsules(points, radii):
    """Control points with their radii, connected, as a pipeline source."""
    data, radius = polyline(points), vtkDoubleArray()
    radius.SetName("Radius")
    for value in radii:
        radius.InsertNextValue(value)
    data.GetPointData().AddArray(radius)
    return producer(data)


def drawn(points, radii):
    """The capsules' walls translucent, around the balls at their control points and the axis through these."""
    chain, view = capsules(points, radii), white_view(700, 450)
    show(simple.Tube(Input=chain, Scalars=["POINTS", "Radius"], VaryRadius="By Absolute Scalar", NumberofSides=40, Capping=0), view, TUBE).Opacity = 0.45
    for point, radius in zip(points, radii):
        ball = simple.Sphere(Center=list(point), Radius=radius, ThetaResolution=40, PhiResolution=40)
        show(ball, view, BALL).Opacity = 0.25
    axis = show(chain, view, AXIS, flat=True)
    axis.LineWidth, axis.RenderPointsAsSpheres, axis.PointSize = 3.0, 1, 12.0
    axis.SetRepresentationType("Wireframe")
    view.CameraParallelProjection = 1
    view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = [0, -50, 0], [0, 0, 0], [-1, 0, 0]
    simple.ResetCamera(view)
    view.CameraParallelScale *= 0.75
    return image(view, 700, 450)


figure = Figure(__file__, __doc__, side=12)
canvas, axes = pyplot.subplots(1, 2, figsize=(8, 2.8), layout="constrained")
bundle = simple.BundleInitializer(Side=figure.options.side, MeanDispersion=15, DispersionModel="Watson", Seed=figure.options.seed)
fibres = servermanager.Fetch(simple.OutputPort(simple.CapsuleOptimizer(Input=bundle), 0))
radii = fibres.GetPointData().GetArray("Radius")


def bend(cell):
    """How much longer a fibre is than straight."""
    one = fibres.GetCell(cell)
    ids = [one.GetPointId(k) for k in range(one.GetNumberOfPoints())]
    points = [fibres.GetPoint(i) for i in ids]
    length = sum(sum((a - b) ** 2 for a, b in zip(p, q)) ** 0.5 for p, q in zip(points, points[1:]))
    return length - sum((a - b) ** 2 for a, b in zip(points[0], points[-1])) ** 0.5, ids, points


# The most bent of the ten thickest.
thickest = sorted(range(fibres.GetNumberOfCells()), key=lambda cell: -fibres.GetCellData().GetArray("TargetRadius").GetValue(cell))[:10]
_, ids, points = max(bend(cell) for cell in thickest)
figure.row(control_points=len(ids), capsules=len(ids) - 1, radius_um=radii.GetValue(ids[0]))
place(axes[0], drawn([(0, 0, 0), (0, 0, 3.2)], [0.9, 0.6]), "a) a capsule: two points, a radius at each")
place(axes[1], drawn(points, [radii.GetValue(i) for i in ids]), "b) a fibre: a chain of capsules")
figure.save(canvas)
