# SPDX-License-Identifier: BSD-3-Clause
"""Figure 1: the three steps of the method, for one bundle of 15 degrees and for two that cross."""

from matplotlib import pyplot
from paper_figure import PIXELS, Figure, columns, image, place, simple, solid
from picture import AXON, MYELIN, below, white_view


def tubes(fibres):
    """Fibres as the window shows them: tubes of their radius in the colours of their direction."""
    view = white_view(PIXELS, PIXELS)
    simple.Show(fibres, view)
    view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = [2.2, -1.7, 1.6], [0, 0, 0], [0, 0, 1]
    simple.ResetCamera(view)
    return image(view)


figure = Figure(__file__, __doc__, side=15)
canvas, axes = pyplot.subplots(2, 3, figsize=(8, 5.4), layout="constrained")
figure.options.fraction = min(0.9, figure.options.fraction)  # not the densest, so that myelin is seen apart
for line, name in zip(axes, ("dispersion-15", "crossing-90")):
    with figure.substrate(name) as made:
        optimiser, initial = made.proxies[-2:]
        left = columns(optimiser, 1)
        figure.row(
            substrate=name, fibres=int(made.whole["OuterSurfaces"]), iterations=int(left["Iteration"][-1]), overlapping_pairs_before=int(left["OverlappingPairs"][0]),
            overlapping_pairs_after=int(left["OverlappingPairs"][-1]), FVF=made.whole["FVF"],
        )
        place(line[0], tubes(initial))
        place(line[1], tubes(made.fibres))
        place(line[2], solid([(below(made.outer, 0.25 * made.side), MYELIN), (made.inner, AXON)], made.side))
for axis, title in zip(axes[0], ("a) substrate initialisation", "b) joint fibre optimisation", "c) fibre radial growth")):
    axis.set_title(title)
figure.save(canvas)
