# SPDX-License-Identifier: BSD-3-Clause
"""Charts of a report as SVG texts: no file, no script and no library is needed to show them."""

import html
import math

WIDTH, HEIGHT, LEFT, RIGHT, TOP, BOTTOM = 230, 180, 28, 8, 22, 34
GRID, INK = "#dddddd", "#222222"


def _text(x, y, words, anchor="middle", more=""):
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" {more}>{html.escape(words)}</text>'


def _frame(title, parts):
    return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" role="img" aria-label="{html.escape(title, quote=True)}" '
            f'font-family="sans-serif" font-size="9" fill="{INK}">' + _text(WIDTH / 2, 12, title, more='font-weight="bold" font-size="10"') + "".join(parts) + "</svg>")


def nice_step(span, count=5):
    """1, 2 or 5 times a power of ten, `count` of which cover about `span`."""
    raw = span / count
    power = 10.0 ** math.floor(math.log10(raw))
    return next(factor * power for factor in (1, 2, 5, 10) if factor * power >= raw * 0.999)


def counted(values, low, high, bins):
    """How many values lie in each of `bins` equal parts of [low, high]; those outside count in the outermost."""
    counts = [0] * bins
    for value in values:
        counts[min(bins - 1, max(0, int((value - low) / (high - low) * bins)))] += 1
    return counts


def histograms(title, label, series, low, high, bins=25, curve=None):
    """Counts of values over [low, high]. `series` = [(name, values, colour)]; `curve` = (name, [(x, y)], colour), y in counts."""
    all_counts = [(name, counted(values, low, high, bins), colour) for name, values, colour in series]
    top = max([1] + [count for _, counts, _ in all_counts for count in counts] + [y for _, y in (curve[1] if curve else [])])
    wide, tall = WIDTH - LEFT - RIGHT, HEIGHT - TOP - BOTTOM

    def place(x, y):
        return LEFT + (x - low) / (high - low) * wide, TOP + tall * (1 - y / top)

    parts = []
    step = max(1, nice_step(top, 4))
    for k in range(int(top / step) + 1):
        y = place(low, k * step)[1]
        parts.append(f'<line x1="{LEFT}" x2="{WIDTH - RIGHT}" y1="{y:.1f}" y2="{y:.1f}" stroke="{GRID}"/>' + _text(LEFT - 4, y + 3, f"{k * step:g}", "end"))
    step = nice_step(high - low)
    for k in range(math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9) + 1):
        parts.append(_text(place(k * step, 0)[0], HEIGHT - BOTTOM + 12, f"{k * step:.10g}"))
    for _, counts, colour in all_counts:
        for i, count in enumerate(counts):
            x, y = place(low + i * (high - low) / bins, count)
            parts.append(f'<rect x="{x:.1f}" y="{y:.1f}" width="{wide / bins:.1f}" height="{TOP + tall - y:.1f}" fill="{colour}" fill-opacity="0.55"/>')
    if curve:
        points = " ".join("{:.1f},{:.1f}".format(*place(x, y)) for x, y in curve[1])
        parts.append(f'<polyline points="{points}" fill="none" stroke="{curve[2]}" stroke-width="1.5"/>')
    parts.append(_text(LEFT + wide / 2, HEIGHT - 6, label))
    names = [(name, colour) for name, _, colour in all_counts] + ([(curve[0], curve[2])] if curve else [])
    for i, (name, colour) in enumerate(names):
        parts.append(_text(WIDTH - RIGHT - 2, TOP + 10 + 11 * i, name, "end", f'style="fill:{colour}" font-weight="bold"'))
    return _frame(title, parts)


def curves(title, label, series, right, top):
    """Lines over [0, right] and [0, top]. `series` = [(name, [(x, y)], colour)]; a y of NaN is a gap."""
    wide, tall = WIDTH - LEFT - RIGHT, HEIGHT - TOP - BOTTOM
    parts = []
    step = nice_step(top, 4)
    for k in range(math.floor(top / step + 1e-9) + 1):
        y = TOP + tall * (1 - k * step / top)
        parts.append(f'<line x1="{LEFT}" x2="{WIDTH - RIGHT}" y1="{y:.1f}" y2="{y:.1f}" stroke="{GRID}"/>' + _text(LEFT - 4, y + 3, f"{k * step:.10g}", "end"))
    step = nice_step(right)
    for k in range(math.floor(right / step + 1e-9) + 1):
        parts.append(_text(LEFT + wide * k * step / right, HEIGHT - BOTTOM + 12, f"{k * step:.10g}"))
    for i, (name, points, colour) in enumerate(series):
        pieces = [[]]
        for x, y in points:
            if math.isfinite(y):
                pieces[-1].append(f"{LEFT + wide * x / right:.1f},{TOP + tall * (1 - y / top):.1f}")
            elif pieces[-1]:
                pieces.append([])
        parts += [f'<polyline points="{" ".join(piece)}" fill="none" stroke="{colour}" stroke-width="1.5"/>' for piece in pieces if piece]
        parts.append(_text(WIDTH - RIGHT - 2, TOP + 10 + 11 * i, name, "end", f'style="fill:{colour}" font-weight="bold"'))
    parts.append(_text(LEFT + wide / 2, HEIGHT - 6, label))
    return _frame(title, parts)


def rose(title, directions, note):
    """Directions (unit vectors) as points by their angle from the z axis and around it, each axis once, with rings in degrees."""
    middle, reach = (WIDTH / 2, TOP + 68), 56
    angles = []
    for x, y, z in directions:
        if z < 0:
            x, y, z = -x, -y, -z
        angles.append((math.degrees(math.acos(min(1.0, z))), math.atan2(y, x)))
    step = nice_step(max([1.0] + [angle for angle, _ in angles]), 2)
    rings = max(1, math.ceil(max([1.0] + [angle for angle, _ in angles]) / step))
    parts = []
    for k in range(1, rings + 1):
        r = reach * k / rings
        parts.append(f'<circle cx="{middle[0]}" cy="{middle[1]}" r="{r:.1f}" fill="none" stroke="{GRID}"/>')
        parts.append(_text(middle[0] + r * math.cos(0.8) + 3, middle[1] - r * math.sin(0.8), f"{k * step:g}°", "start"))
    for label, x, y in (("x", reach + 6, 3), ("y", 0, -reach - 3)):
        parts.append(_text(middle[0] + x, middle[1] + y, label))
    for angle, around in angles:
        r = reach * angle / (rings * step)
        parts.append(f'<circle cx="{middle[0] + r * math.cos(around):.1f}" cy="{middle[1] - r * math.sin(around):.1f}" r="1.6" fill="#1b6ca8" fill-opacity="0.6"/>')
    parts.append(_text(WIDTH / 2, HEIGHT - 6, note))
    return _frame(title, parts)
