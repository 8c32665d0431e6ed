# SPDX-License-Identifier: BSD-3-Clause
"""Prints how the final surfaces of CurvedBundles run beside what was asked for, as rows of Markdown tables.

    ./cactus pvpython tools/benchmarks/curved_bundles.py --side 15 -- bend=15 bend=20 bend=40 fan=15 fan=30 fan=60 fan=90 kiss=5 kiss=7.5

A fibre's middle at a height is the centroid of the cut of its outer surface by a plane across z; cuts that a side face of the domain touches are
left out. From these middles alone:

- bend: one axis for all fibres, each at a distance of its own, by least squares; the radius is the distance from the axis to the origin.
- fan: each fibre's angle to z at the lowest and at the highest z, by a parabola through its nearest 6 µm; a straight line through the
  angles over x, from edge to edge of the fan.
- kiss: the mean x of each of the two bundles, by the areas of its cuts; their smallest distance over all heights. The axis of each as for a bend.
  KissDistance has to be less than half of the side, so that the side faces cut none.

The fractions are those of the grown image: in the domain, and in the lowest and the highest 2 µm, of a fan between its edges.
"""

import argparse
import time

import numpy as np
from paraview import servermanager
from paraview.simple import *
from vtkmodules.util.numpy_support import vtk_to_numpy

RADIUS = 20.0  # µm, of bundles that kiss


def cut(corners, fibres, height):
    """{fibre: (x, y, area)} of closed oriented triangles (n, 3, 3) at a height."""
    above = corners[:, :, 2] > height
    crossed = (above.any(axis=1)) & (~above.all(axis=1))
    corners, above, fibres = corners[crossed], above[crossed], fibres[crossed]
    ends = np.zeros((len(corners), 2, 2))
    for i in range(3):
        a, b = corners[:, i], corners[:, (i + 1) % 3]
        for up, place in ((True, 0), (False, 1)):
            edge = (above[:, i] != above[:, (i + 1) % 3]) & (above[:, i] == up)
            share = (height - a[edge, 2]) / (b[edge, 2] - a[edge, 2])
            ends[edge, place] = a[edge, :2] + share[:, None] * (b[edge, :2] - a[edge, :2])
    p, q = ends[:, 0], ends[:, 1]
    twice = p[:, 0] * q[:, 1] - p[:, 1] * q[:, 0]
    found = {}
    for fibre in np.unique(fibres):
        own = fibres == fibre
        area = twice[own].sum() / 2
        if abs(area) > 1e-3:
            x, y = ((p[own] + q[own]) * twice[own, None]).sum(axis=0) / (6 * area)
            found[fibre] = (x, y, abs(area), np.abs(ends[own]).max())
    return found


def middles(outer, side, levels):
    """{fibre: rows of (x, y, z, area)}, and their bundles."""
    points = vtk_to_numpy(outer.GetPoints().GetData()).astype(float)
    triangles = vtk_to_numpy(outer.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    ids = vtk_to_numpy(outer.GetCellData().GetArray("FibreId"))
    bundles = dict(zip(ids, vtk_to_numpy(outer.GetCellData().GetArray("BundleId"))))
    rows = {}
    for height in np.linspace(-side / 2 + 0.15, side / 2 - 0.15, levels):
        for fibre, (x, y, area, far) in cut(points[triangles], ids, height).items():
            if far < side / 2 - 0.02:
                rows.setdefault(fibre, []).append((x, y, height, area))
    return {fibre: np.array(one) for fibre, one in rows.items() if len(one) >= 8}, bundles


def axis_of(rows):
    """(x, z) of the axis of arcs, each with a radius of its own: the mean squared distance of the middles from their arcs is least."""
    at = [one[:, [0, 2]] for one in rows]
    axis = np.array([100.0 * np.sign(sum(np.polyfit(one[:, 1], one[:, 0], 2)[0] * len(one) for one in at)), 0.0])
    for _ in range(100):
        slopes, errors = [], []
        for one in at:
            apart = one - axis
            distance = np.linalg.norm(apart, axis=1)
            slope = -apart / distance[:, None]
            slopes.append(slope - slope.mean(axis=0))
            errors.append(distance - distance.mean())
        step = np.linalg.lstsq(np.concatenate(slopes), -np.concatenate(errors), rcond=None)[0]
        axis += step * min(1.0, 0.5 * np.linalg.norm(axis) / np.linalg.norm(step))
        if np.linalg.norm(step) < 1e-6:
            break
    return axis


def angles_at(rows, height):
    """x at a height and the angle to z (degrees) there, for each fibre that is whole there."""
    found = []
    for one in rows:
        near = one[abs(one[:, 2] - height) < 6]
        if len(near) >= 8 and abs(near[:, 2] - height).min() < 0.4:
            fit = np.polyfit(near[:, 2] - height, near[:, 0], 2)
            found.append((fit[2], np.degrees(np.arctan(fit[1]))))
    return np.array(found)


def between_edges(rows, height, width):
    x, angle = angles_at(rows, height).T
    x, angle = x[abs(x) < width / 2 + 1], angle[abs(x) < width / 2 + 1]
    return width * np.polyfit(x, angle, 1)[0]


def fractions(grown, side, edge):
    """Of the domain, and of its lowest and highest 2 µm where |x| is below edge(z)."""
    data = servermanager.Fetch(grown)
    size = data.GetDimensions()
    filled = vtk_to_numpy(data.GetPointData().GetArray("FibreId")).reshape(size[::-1]) > 0
    x, y, z = (data.GetOrigin()[i] + data.GetSpacing()[i] * np.arange(size[i]) for i in range(3))
    inside = [abs(one) <= side / 2 for one in (z, y, x)]
    filled = filled[np.ix_(*inside)]
    x, z = x[inside[2]], z[inside[0]]
    within = abs(x)[None, :] <= np.array([edge(one) for one in z])[:, None]
    return filled.mean(), *(filled.swapaxes(1, 2)[ends[:, None] & within].mean() for ends in (z < -side / 2 + 2, z > side / 2 - 2))


def make(kind, value, side, target, seed):
    shape = {"bend": {"BendRadius": value}, "fan": {"FanAngle": value}, "kiss": {"KissDistance": value, "BendRadius": RADIUS}}[kind]
    fibres = CurvedBundles(Shape=kind.capitalize(), Side=side, Seed=seed, **shape)
    grown = FibreRadialGrowth(Input=OutputPort(CapsuleOptimizer(Input=fibres), 0), TargetFibreVolumeFraction=target)
    surfaces = MyelinSurface(Input=grown)
    judged = SubstrateCertificate(Outer=OutputPort(surfaces, 0), Inner=OutputPort(surfaces, 1))
    certified = servermanager.Fetch(judged, idx=0).GetValueByName(0, "Certified").ToInt() == 1
    return grown, servermanager.Fetch(surfaces, idx=0), certified, fibres


def one_substrate(kind, value, side, target, seed, levels):
    """What was measured: the numbers in the order of the table."""
    grown, outer, certified, fibres = make(kind, value, side, target, seed)
    rows, bundles = middles(outer, side, levels)
    aim = servermanager.Fetch(fibres).GetFieldData().GetArray("GrownFibreVolumeFraction").GetValue(0) if target < 0 else target
    edge = lambda z: np.inf
    if kind == "bend":
        measured = np.hypot(*axis_of(list(rows.values()))), np.nan
    elif kind == "fan":
        entry = side * (1 - 2 * np.tan(np.radians(value) / 4))
        radius = side / np.sin(np.radians(value) / 2)
        edge = lambda z: entry / 2 + radius - np.sqrt(radius**2 - (z + side / 2) ** 2)
        measured = [between_edges(list(rows.values()), *at) for at in ((side / 2, side), (-side / 2, entry))]
    else:
        parts = [[one for fibre, one in rows.items() if bundles[fibre] == bundle] for bundle in (1, 2)]
        distances = []
        for height in np.unique(np.concatenate([one[:, 2] for one in rows.values()])):
            at = [np.concatenate([one[one[:, 2] == height] for one in part]) for part in parts]
            if min(map(len, at)) > 10:
                left, right = (np.average(one[:, 0], weights=one[:, 3]) for one in at)
                distances.append(right - left)
        axes = [axis_of(part) for part in parts]
        measured = min(distances), (axes[1][0] - axes[0][0] - value) / 2
    return [*measured, aim, *fractions(grown, side, edge), certified]


def row(kind, value, options):
    begin = time.monotonic()
    found = np.array([one_substrate(kind, value, options.side, options.target, 1 + i, options.levels) for i in range(options.seeds)], dtype=float)
    seconds = (time.monotonic() - begin) / options.seeds
    mean, spread = found.mean(axis=0), found.std(axis=0, ddof=min(1, options.seeds - 1))
    digits = 1 if kind == "fan" else 2
    other = {"bend": "", "fan": f"; enters with {mean[1]:.1f} ± {spread[1]:.1f}°", "kiss": f"; bends with {mean[1]:.1f} ± {spread[1]:.1f} µm"}[kind]
    asked = f"{value:g}{'°' if kind == 'fan' else ' µm'}"
    print(f"| {kind} | {asked} | {mean[0]:.{digits}f} ± {spread[0]:.{digits}f}{other} | "
          + " | ".join(f"{one:.3f}" for one in mean[2:6]) + f" | {int(found[:, 6].sum())} of {options.seeds} | {seconds:.0f} |", flush=True)


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--side", type=float, default=15.0)
    parser.add_argument("--target", type=float, default=-1.0, help="TargetFibreVolumeFraction of growth; -1: that of the fibres")
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--levels", type=int, default=50)
    parser.add_argument("cases", nargs="+", help="bend=RADIUS, fan=ANGLE or kiss=DISTANCE")
    options = parser.parse_args()
    print("| shape | asked | measured | FVF aimed at | reached | in the lowest 2 µm | in the highest 2 µm | certified | s |")
    print("|---|---|---|---|---|---|---|---|---|")
    for case in options.cases:
        kind, value = case.split("=")
        row(kind, float(value), options)
