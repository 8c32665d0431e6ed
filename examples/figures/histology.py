# SPDX-License-Identifier: BSD-3-Clause
"""Table 2 and Figure 5: substrates with the axon and myelin volume fractions that histology has found in four places."""

from matplotlib import pyplot
from paper_figure import BLACK, LIGHT, Figure, bar_for, paper, place, section
from picture import AXON, MYELIN

NAMES = ("AVF", "MVF", "FVF", "g")

figure = Figure(__file__, __doc__, side=25)
canvas, axes = pyplot.subplots(2, len(paper.HISTOLOGY), figsize=(9, 5), layout="constrained")
for i, (target, reached) in enumerate(paper.HISTOLOGY):
    with figure.substrate(f"histology-{i + 1}") as made:
        ours = [made.whole["AVF"], made.whole["FVF"] - made.whole["AVF"], made.whole["FVF"], made.whole["AggregateGRatio"]]
        figure.row(
            substrate="abcd"[i], **{f"target_{name}": value for name, value in zip(NAMES, target)},
            **{f"paper_{name}": value for name, value in zip(NAMES, reached)}, **dict(zip(NAMES, ours)),
            fibres=int(made.whole["OuterSurfaces"]), certified="yes" if made.whole["Certified"] else "no",
        )
        # The paper's colours for these, axons blue and myelin red; below, as electron micrographs show them, myelin dark.
        bar = (bar_for(made.side), made.side)
        title = f"{'abcd'[i]}) AVF {target[0]:.0%}, MVF {target[1]:.0%}".replace("%", " %")
        place(axes[0, i], section([(made.outer, MYELIN), (made.inner, AXON)], made.side), title, bar)
        place(axes[1, i], section([(made.outer, BLACK), (made.inner, LIGHT)], made.side), bar=bar)
figure.save(canvas)
