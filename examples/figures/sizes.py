# SPDX-License-Identifier: BSD-3-Clause
"""Figure 6: substrates of four sizes, and how near their radii come to the target the larger they are."""

import json
import math

from matplotlib import pyplot
from paper_figure import Figure, place, servermanager, solid
from picture import AXON, below
from report_facts import AskedRadii, ks_distance

PAPER = {50: 341, 100: 1316, 200: 4859, 500: 33478}  # side: fibres
SIZES = (0.2, 0.4, 0.6, 1.0)  # of --side; in the paper's proportions the first would be smaller than a fibre


def asked_radii(fibres):
    """[(radius, density)] that the bundle's radii were drawn from, as the fibres' provenance says."""
    stages = servermanager.Fetch(fibres).GetFieldData().GetAbstractArray("Provenance")
    return AskedRadii({"provenance": [json.loads(stages.GetValue(i)) for i in range(stages.GetNumberOfValues())]}).density


figure = Figure(__file__, __doc__, side=25)
canvas, axes = pyplot.subplots(2, len(PAPER), figsize=(9, 4.4), layout="constrained")
for i, (paper_side, paper_fibres) in enumerate(PAPER.items()):
    side = figure.options.side * SIZES[i]
    with figure.substrate("radii-0.9", side, MeanDispersion=1) as made:
        known = [(radius, length) for radius, length in zip(made.fibre["OuterRadius_um"], made.fibre["Length_um"]) if math.isfinite(radius) and length > 0]
        radii = [radius for radius, _ in known]
        density = asked_radii(made.fibres)
        figure.row(
            paper_side_um=paper_side, paper_fibres=paper_fibres, side_um=side, fibres=int(made.whole["OuterSurfaces"]), FVF=made.whole["FVF"],
            mean_radius_um=sum(r * w for r, w in known) / sum(w for _, w in known), asked_mean_radius_um=sum(r * w for r, w in density) / sum(w for _, w in density),
            KS_distance=ks_distance(radii, density), certified="yes" if made.whole["Certified"] else "no",
        )
        place(axes[0, i], solid([(below(made.outer, 0.3 * side), [0.45] * 3), (made.inner, AXON)], side), f"{'abcd'[i]}) ({side:g} µm)³, {made.whole['OuterSurfaces']:.0f} fibres")
        axes[1, i].hist(radii, bins=[0.1 * k for k in range(21)], density=True, color="#8fb0d0", label="reached")
        axes[1, i].plot(*zip(*density), color="#c8553d", label="target")
        axes[1, i].set(xlabel="mean radius of a fibre (µm)", xlim=(0, 2), title=f"KS distance {ks_distance(radii, density):.3f}")
axes[1, 0].set_ylabel("density")
axes[1, 0].legend(frameon=False)
figure.save(canvas)
