# SPDX-License-Identifier: BSD-3-Clause
"""Draws convergence tables that ./cactus bench quality --convergence FILE.csv has written: overlap cost and overlapping pairs by
iteration, one curve per table, as SVG on standard output.

    python3 tools/benchmarks/plot_convergence.py LABEL=FILE.csv... > docs/images/convergence.svg
"""

import math
import sys

WIDTH, HEIGHT, LEFT, BOTTOM, TOP = 420, 300, 60, 40, 30
COLOURS = ["#1b6ca8", "#c8553d", "#4f772d", "#6d597a"]


def read(path):
    """Iterations, costs and pairs of a table."""
    with open(path, encoding="utf-8") as file:
        rows = [line.rstrip("\n").split(",") for line in file if not line.startswith("State,")]
    return [int(row[1]) for row in rows], [float(row[2]) for row in rows], [float(row[4]) for row in rows]


def panel(offset, title, curves, last):
    """One set of axes, logarithmic upwards."""
    values = [y for _, _, ys in curves for y in ys if y > 0]
    low, high = math.floor(math.log10(min(values))), math.ceil(math.log10(max(values)))

    def place(x, y):
        right = offset + LEFT + x / last * (WIDTH - LEFT - 20)
        up = HEIGHT - BOTTOM - (math.log10(y) - low) / (high - low) * (HEIGHT - BOTTOM - TOP)
        return f"{right:.1f},{up:.1f}"

    parts = [f'<text x="{offset + LEFT}" y="18" font-weight="bold">{title}</text>']
    for power in range(low, high + 1, max(1, (high - low) // 5)):
        x, y = place(0, 10.0**power).split(",")
        parts.append(f'<line x1="{x}" y1="{y}" x2="{offset + WIDTH - 20}" y2="{y}" stroke="#ddd"/>')
        parts.append(f'<text x="{float(x) - 6}" y="{float(y) + 4}" text-anchor="end">10<tspan dy="-4" font-size="8">{power}</tspan></text>')
    for k in range(6):
        x, y = place(last * k / 5, 10.0**low).split(",")
        parts.append(f'<text x="{x}" y="{float(y) + 16}" text-anchor="middle">{last * k // 5}</text>')
    parts.append(f'<text x="{offset + LEFT + (WIDTH - LEFT - 20) / 2}" y="{HEIGHT - 6}" text-anchor="middle">iteration</text>')
    for index, (label, xs, ys) in enumerate(curves):
        colour = COLOURS[index % len(COLOURS)]
        points = " ".join(place(x, y) for x, y in zip(xs, ys) if y > 0)
        parts.append(f'<polyline points="{points}" fill="none" stroke="{colour}" stroke-width="1.6"/>')
        parts.append(f'<text x="{offset + WIDTH - 24}" y="{TOP + 14 + 14 * index}" text-anchor="end" fill="{colour}">{label}</text>')
    return parts


def main(arguments):
    if not arguments or any("=" not in argument for argument in arguments):
        sys.exit(__doc__)
    tables = [(label, *read(path)) for label, path in (argument.split("=", 1) for argument in arguments)]
    last = max(max(xs) for _, xs, _, _ in tables)
    lines = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{2 * WIDTH}" height="{HEIGHT}" font-family="sans-serif" font-size="11">',
             '<rect width="100%" height="100%" fill="white"/>']
    lines += panel(0, "overlap cost (µm⁴)", [(label, xs, cost) for label, xs, cost, _ in tables], last)
    lines += panel(WIDTH, "overlapping pairs", [(label, xs, pairs) for label, xs, _, pairs in tables], last)
    print("\n".join(lines + ["</svg>"]))


if __name__ == "__main__":
    main(sys.argv[1:])
