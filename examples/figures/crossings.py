# SPDX-License-Identifier: BSD-3-Clause
"""Figure 4 and the lower half of Table 1: two bundles that cross at 30 to 90 degrees, as dense as can be."""

import math

import numpy
from matplotlib import pyplot
from paper_figure import BLACK, DARK, LIGHT, Figure, bar_for, paper, place, section, solid

# The bundles run in layers of one or two fibres. A cut that contains the dark bundle's axis and is turned about it by so much goes
# through many of them.
TILT = math.radians(35)


def plane(angle):
    """Normal and upward direction of that cut, in which the dark bundle runs to the right: it is BundleInitializer's second one, with its
    axis in the x-z plane, at half the angle to z."""
    sine, cosine = math.sin(math.radians(angle / 2)), math.cos(math.radians(angle / 2))
    right = (-sine, 0.0, cosine)
    up = (math.cos(TILT) * cosine, math.sin(TILT), math.cos(TILT) * sine)
    return [float(part) for part in numpy.cross(right, up)], up


figure = Figure(__file__, __doc__, side=20)
canvas, axes = pyplot.subplots(2, len(paper.CROSSING), figsize=(9, 4.2), layout="constrained", squeeze=False)
for i, (angle, reported) in enumerate(paper.CROSSING.items()):
    with figure.substrate(f"crossing-{angle}") as made:
        figure.fraction_row("crossing_deg", angle, reported, made)
        # Myelin black, axons light grey in one bundle and dark grey in the other.
        normal, up = plane(angle)
        window = 0.7 * made.side  # a square that fits into the cube however it is turned
        layers = [(made.outer, BLACK), (made.bundle(made.inner, 1), LIGHT), (made.bundle(made.inner, 2), DARK)]
        place(axes[0, i], section(layers, window, normal=normal, up=up), f"{'abcde'[i]}) {angle}°", (bar_for(window), window))
        place(axes[1, i], solid([(made.bundle(made.outer, 1), LIGHT), (made.bundle(made.outer, 2), [0.35] * 3)], made.side))
figure.save(canvas)
