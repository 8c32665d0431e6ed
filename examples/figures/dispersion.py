# SPDX-License-Identifier: BSD-3-Clause
"""Figure 3 and the upper half of Table 1: single bundles with mean dispersions of 0 to 25 degrees, as dense as can be."""

from matplotlib import pyplot
from paper_figure import BLACK, LIGHT, Figure, bar_for, paper, place, section, solid
from picture import AXON, below

SHOWN = (0, 5, 10, 20)

figure = Figure(__file__, __doc__, side=20)
canvas, axes = pyplot.subplots(3, len(SHOWN), figsize=(9, 7.2), layout="constrained")
for angle, reported in paper.DISPERSION.items():
    with figure.substrate(f"dispersion-{angle}") as made:
        figure.fraction_row("dispersion_deg", angle, reported, made)
        if angle not in SHOWN:
            continue
        # Myelin black, axons grey on top of it, the space outside the fibres white; the bundle upright, and across.
        column = axes[:, SHOWN.index(angle)]
        layers = [(made.outer, BLACK), (made.inner, LIGHT)]
        bar = (bar_for(made.side), made.side)
        place(column[0], section(layers, made.side, normal=(0, -1, 0), up=(0, 0, 1)), f"{'abcd'[SHOWN.index(angle)]}) {angle}°, along", bar)
        place(column[1], section(layers, made.side), "across", bar)
        place(column[2], solid([(below(made.outer, 0.3 * made.side), [0.25] * 3), (made.inner, AXON)], made.side))
figure.save(canvas)
