# SPDX-License-Identifier: BSD-3-Clause
"""Beside Figure 7: growth from the whole capsules, and from random seed points in them as in the paper: cuts across a bundle, and one of its fibres."""

from matplotlib import pyplot
from paper_figure import BLACK, LIGHT, Figure, bar_for, columns, place, section, simple, solid
from picture import AXON

SEEDS = {0: "whole capsules", 30: "30 points per µm³", 10: "10 points per µm³"}
RED = [0.80, 0.20, 0.18]


def mean(values):
    """Over fibres that have a value."""
    known = [value for value in values if value == value]
    return sum(known) / len(known)


figure = Figure(__file__, __doc__, side=12)
canvas, axes = pyplot.subplots(2, len(SEEDS), figsize=(7.5, 5.4), layout="constrained")
for pictures, (density, title) in zip(axes.T, SEEDS.items()):
    # Sections are as growth makes them, and fibres as thick along their whole length before it.
    with figure.substrate("histology-1", growth={"SeedDensity": density, "SurfaceRoughness": 0}, SectionAxisRatio=1, CalibreVariation=0) as made:
        statistics = simple.SubstrateStatistics(Fibres=made.fibres, Outer=made.outer, Inner=made.inner, CutSpacing=1)
        fibre, whole = columns(statistics, 1), made.whole
        figure.row(
            points_per_um3=density, FVF=whole["FVF"], certified="yes" if whole["Certified"] else "no", mean_radius_um=mean(fibre["OuterRadius_um"]),
            axis_ratio=mean(fibre["OuterAxisRatio"]), circularity=mean(fibre["OuterCircularity"]), variation=mean(fibre["OuterCalibreVariation"]),
        )
        # The thickest of the fibres that reach from face to face.
        long = [i for i, cuts in enumerate(fibre["OuterCuts"]) if cuts > 0.9 * max(fibre["OuterCuts"])]
        number = fibre["FibreId"][max(long, key=lambda i: fibre["TargetRadius_um"][i])]
        one = simple.Threshold(Input=made.outer, Scalars=["CELLS", "FibreId"], LowerThreshold=number, UpperThreshold=number)
        place(pictures[0], section([(made.outer, BLACK), (made.inner, LIGHT)], made.side), title, (bar_for(made.side), made.side))
        place(pictures[1], solid([(one, RED)], made.side))
        for proxy in (one, statistics):
            simple.Delete(proxy)
figure.save(canvas)
