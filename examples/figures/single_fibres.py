# SPDX-License-Identifier: BSD-3-Clause
"""Figure 7: three fibres of about one calibre, from the straightest to the most tortuous, with their diameters along them."""

import math

import numpy
from matplotlib import pyplot
from paper_figure import Figure, columns, image, place, polyline, producer, servermanager, simple
from picture import show, white_view
from vtkmodules.vtkCommonDataModel import vtkPlane
from vtkmodules.vtkFiltersCore import vtkAppendPolyData, vtkCutter

RED, BLUE, BLACK = [0.80, 0.20, 0.18], [0.15, 0.30, 0.80], [0.0, 0.0, 0.0]
TARGET = 1.5  # outer diameter of the paper's three fibres, µm; their inner one is 1.1


def chosen(fibre, side):
    """Places of three fibres whose target is nearest to the paper's and which reach from face to face: least, middle, most tortuous."""
    whole = [i for i, cuts in enumerate(fibre["OuterCuts"]) if cuts > 0.8 * side and math.isfinite(fibre["Sinuosity"][i])]
    alike = sorted(whole, key=lambda i: abs(2 * fibre["TargetRadius_um"][i] - TARGET))[:12]
    alike.sort(key=lambda i: fibre["Sinuosity"][i])
    return alike[0], alike[len(alike) // 2], alike[-1]


def part(surfaces, fibre):
    """The surface of one fibre."""
    return simple.ExtractSurface(Input=simple.Threshold(Input=surfaces, Scalars=["CELLS", "FibreId"], LowerThreshold=fibre, UpperThreshold=fibre))


def centre_line(fibres, fibre):
    """Points and directions every µm along a fibre, within its cube."""
    data = servermanager.Fetch(fibres)
    ids = data.GetCellData().GetArray("FibreId")
    cell = data.GetCell(next(i for i in range(data.GetNumberOfCells()) if ids.GetValue(i) == fibre))
    points = numpy.array([data.GetPoint(cell.GetPointId(k)) for k in range(cell.GetNumberOfPoints())])
    arc = numpy.concatenate([[0.0], numpy.cumsum(numpy.linalg.norm(numpy.diff(points, axis=0), axis=1))])
    stations = numpy.arange(0.5, arc[-1], 1.0)
    line = numpy.stack([numpy.interp(stations, arc, points[:, axis]) for axis in range(3)], axis=1)
    return line, numpy.gradient(line, axis=0)


def outlines(surface, line, directions):
    """The surface's cross-sections at the points of a line, orthogonal to it."""
    together = vtkAppendPolyData()
    data = servermanager.Fetch(surface)
    for origin, normal in zip(line, directions):
        plane, cutter = vtkPlane(), vtkCutter()
        plane.SetOrigin(*origin)
        plane.SetNormal(*normal)
        cutter.SetCutFunction(plane)
        cutter.SetInputData(data)
        cutter.Update()
        together.AddInputData(cutter.GetOutput())
    together.Update()
    return producer(together.GetOutput())


def portrait(made, fibre):
    """A fibre upright: its outer surface red and translucent, the inner one blue, its centre line and cross-sections."""
    width, height = 240, 700
    line, directions = centre_line(made.fibres, fibre)
    view = white_view(width, height)
    for surfaces, colour, opacity in ((made.outer, RED, 0.25), (made.inner, BLUE, 0.35)):
        surface = part(surfaces, fibre)
        show(surface, view, colour).Opacity = opacity
        drawn = show(outlines(surface, line, directions), view, colour, flat=True)
        drawn.LineWidth = 1.5
    show(producer(polyline(line)), view, BLACK, flat=True).LineWidth = 2.0
    middle = [float(value) for value in 0.5 * (line.min(axis=0) + line.max(axis=0))]
    view.CameraParallelProjection = 1
    view.CameraFocalPoint = middle
    # From a little above, so that cross-sections are seen as such.
    view.CameraPosition = [middle[0], middle[1] - 2.0 * made.side, middle[2] + 0.7 * made.side]
    view.CameraViewUp = [0.0, 0.0, 1.0]
    view.CameraParallelScale = 0.6 * made.side
    return image(view, width, height)


figure = Figure(__file__, __doc__, side=20)
canvas = pyplot.figure(figsize=(7, 8), layout="constrained")
axes = canvas.subplot_mosaic([["left", "middle", "right"]] * 5 + [["along"] * 3] * 2 + [["violins"] * 3] * 2)
diameters, marks = [], []
# Each fibre has a direction for itself, and so some wind around others, as the paper's do.
with figure.substrate("histology-4", DispersionModel="Watson", MeanDispersion=10) as made:
    statistics = simple.SubstrateStatistics(Fibres=made.fibres, Outer=made.outer, Inner=made.inner, CutSpacing=1)
    fibre, profile = columns(statistics, 1), columns(statistics, 3)
    for name, i in zip(("left", "middle", "right"), chosen(fibre, made.side)):
        number = int(fibre["FibreId"][i])
        rows = [k for k, one in enumerate(profile["FibreId"]) if one == number]
        outer, inner = ([profile[f"{kind}Diameter_um"][k] for k in rows] for kind in ("Outer", "Inner"))
        target = 2 * fibre["TargetRadius_um"][i]
        measured = [[value for value in values if math.isfinite(value)] for values in (outer, inner)]
        figure.row(
            fibre=name, sinuosity=f"{fibre['Sinuosity'][i]:.4f}", paper_outer_diameter_um=1.5, paper_inner_diameter_um=1.1, target_outer_diameter_um=target,
            target_inner_diameter_um=target * made.whole["AggregateGRatio"],
            **{f"{kind}_diameter_um": float(numpy.mean(values)) for kind, values in zip(("outer", "inner"), measured)},
            **{f"{kind}_deviation_um": float(numpy.std(values)) for kind, values in zip(("outer", "inner"), measured)},
        )
        place(axes[name], portrait(made, number), f"sinuosity {fibre['Sinuosity'][i]:.3f}")
        style = {"left": "-", "middle": "--", "right": ":"}[name]
        for values, colour, label in ((outer, RED, "outer"), (inner, BLUE, "inner")):
            axes["along"].plot([profile["ArcLength_um"][k] for k in rows], values, style, color=colour, label=f"{label}, {name}")
        diameters += measured
        marks += [(target, RED), (target * made.whole["AggregateGRatio"], BLUE)]
    simple.Delete(statistics)

axes["along"].set(xlabel="length along the fibre (µm)", ylabel="diameter (µm)")
axes["along"].legend(frameon=False, ncol=3, fontsize=6)
violins = axes["violins"].violinplot(diameters, positions=range(6), showmeans=True, widths=0.8)
for body, (_, colour) in zip(violins["bodies"], marks):
    body.set_facecolor(colour)
for bar in ("cmeans", "cmins", "cmaxes", "cbars"):
    violins[bar].set_color("grey")
for position, (target, colour) in enumerate(marks):
    axes["violins"].plot([position - 0.45, position + 0.45], [target] * 2, ":", color=colour)
axes["violins"].set(ylabel="diameter (µm)", xticks=[0.5, 2.5, 4.5], xticklabels=["left", "middle", "right"], title="dotted: target")
figure.save(canvas)
