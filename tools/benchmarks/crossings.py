# SPDX-License-Identifier: BSD-3-Clause
"""Prints what crossings of BundleInitializer reach, as rows of a Markdown table: two bundles at an angle, "three" along x, y and z, "peaks", three
with shares of 0.5, 0.3 and 0.2 of one source (DispersionModel Peaks), and "fod", the same with κ = 8 as spherical harmonics.

    ./cactus pvpython tools/benchmarks/crossings.py --side 20 --fraction 0.6 -- three 90 60
    ./cactus pvpython tools/benchmarks/crossings.py --side 20 --fraction 0.4 -- peaks
    ./cactus pvpython tools/benchmarks/crossings.py --side 30 --fraction 0.5 --parted -- fod

Measured here: the deviation of tangents from their bundle's axis, least and most by azimuth, their ratio, and how far that axis
is from the one asked for; the angular correlation of the harmonics
(degrees up to 8) of tangents by volume with those asked for, before and after CapsuleOptimizer; without --parted also each bundle's volume fraction,
and the Kolmogorov-Smirnov distance of outer radii to those asked for.
"""

import argparse
from math import factorial

import numpy as np
from paraview import servermanager
from paraview.simple import *
from vtkmodules.util.numpy_support import vtk_to_numpy

ORDER = 8
PEAKS = np.array([[1, 2, 2], [2, 1, -2], [-2, 2, -1]]) / 3
SHARES = (0.5, 0.3, 0.2)


def harmonics(directions):
    """Real spherical harmonics in MRtrix's basis, by the recursion of Legendre's functions."""
    x, y, z = directions.T
    azimuth, sine = np.arctan2(y, x), np.sqrt(np.maximum(0, 1 - z * z))
    legendre = {(0, 0): np.ones_like(z)}
    for m in range(1, ORDER + 1):
        legendre[m, m] = -(2 * m - 1) * sine * legendre[m - 1, m - 1]
    for m in range(ORDER):
        legendre[m + 1, m] = (2 * m + 1) * z * legendre[m, m]
        for l in range(m + 2, ORDER + 1):
            legendre[l, m] = ((2 * l - 1) * z * legendre[l - 1, m] - (l + m - 1) * legendre[l - 2, m]) / (l - m)
    columns = []
    for l in range(0, ORDER + 1, 2):
        for m in range(-l, l + 1):
            norm = np.sqrt((2 * l + 1) / (4 * np.pi) * factorial(l - abs(m)) / factorial(l + abs(m)))
            wave = 1 if m == 0 else np.sqrt(2) * (np.cos(m * azimuth) if m > 0 else np.sin(-m * azimuth))
            columns.append(norm * legendre[l, abs(m)] * wave)
    return np.array(columns).T


def peaks_as_harmonics():
    count = 20000
    z = 1 - (2 * np.arange(count) + 1) / count
    angle = np.pi * (3 - np.sqrt(5)) * np.arange(count)
    sphere = np.stack([np.sqrt(1 - z * z) * np.cos(angle), np.sqrt(1 - z * z) * np.sin(angle), z], axis=1)
    density = sum(share * np.exp(8 * ((sphere @ peak) ** 2 - 1)) for share, peak in zip(SHARES, PEAKS))
    return harmonics(sphere).T @ density / count


def tangents(data, side):
    """Unit tangents of the segments in the domain, their volumes and their bundles."""
    points = vtk_to_numpy(data.GetPoints().GetData()).astype(float)
    ends = vtk_to_numpy(data.GetLines().GetOffsetsArray())
    first = np.setdiff1d(np.arange(len(points)), ends[1:] - 1)
    steps = points[first + 1] - points[first]
    lengths = np.linalg.norm(steps, axis=1)
    inside = (abs(points[first] + 0.5 * steps) < side / 2).all(axis=1) & (lengths > 0)
    radii = vtk_to_numpy(data.GetPointData().GetArray("Radius"))[first]
    bundles = vtk_to_numpy(data.GetCellData().GetArray("BundleId"))[np.searchsorted(ends, first, side="right") - 1]
    return steps[inside] / lengths[inside, None], (radii**2 * lengths)[inside], bundles[inside]


def deviations(data, side):
    """Least and most deviation from the axis (degrees, root mean square) of each bundle, and the axis."""
    ways, volumes, bundles = tangents(data, side)
    found, axes = [], []
    for bundle in np.unique(bundles):
        mine = bundles == bundle
        moments, vectors = np.linalg.eigh((ways[mine] * volumes[mine, None]).T @ ways[mine] / volumes[mine].sum())
        found.append(np.degrees(np.arcsin(np.sqrt(moments[:2]))))
        axes.append(vectors[:, 2])
    return np.array(found), np.array(axes)


def axes_of(kind):
    """The axes asked for, of each bundle."""
    if kind in ("three", "peaks"):
        return np.eye(3) if kind == "three" else PEAKS
    half = np.radians(float(kind) / 2)
    return np.array([[np.sin(half), 0, np.cos(half)], [-np.sin(half), 0, np.cos(half)]])


def correlation(data, side, asked):
    ways, volumes, _ = tangents(data, side)
    reached = harmonics(ways).T @ volumes
    return reached[1:] @ asked[1:] / np.linalg.norm(reached[1:]) / np.linalg.norm(asked[1:])


def sources(kind, side, fraction, grown, seed):
    common = {"Side": side, "Seed": seed}
    if kind == "three":
        return [BundleInitializer(Direction=way, FibreVolumeFraction=fraction / 3, GrownFibreVolumeFraction=grown / 3, **common) for way in np.eye(3)]
    common.update(FibreVolumeFraction=fraction, GrownFibreVolumeFraction=grown)
    if kind == "peaks":
        peaks = PEAKS * np.array(SHARES)[:, None]
        return [BundleInitializer(DispersionModel="Peaks", OrientationPeaks=" ".join(map(repr, peaks.ravel().tolist())), **common)]
    if kind == "fod":
        return [BundleInitializer(DispersionModel="Harmonics", OrientationHarmonics=" ".join(map(repr, peaks_as_harmonics().tolist())), **common)]
    return [BundleInitializer(NumberOfBundles=2, CrossingAngle=float(kind), **common)]


def distance(values, others):
    places = np.concatenate([values, others])
    return abs(np.searchsorted(np.sort(values), places, side="right") / len(values) - np.searchsorted(np.sort(others), places, side="right") / len(others)).max()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("kinds", nargs="+")
    parser.add_argument("--side", type=float, default=20.0, metavar="MICROMETRES")
    parser.add_argument("--fraction", type=float, default=0.6, help="before growth")
    parser.add_argument("--grown", type=float, default=0.9)
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--parted", action="store_true", help="end after CapsuleOptimizer")
    options = parser.parse_args()
    print("| kind | seed | iterations, pairs left | longer by | deviations (°) | ratio before, after | axes off by (°) | correlation before, after | volume fractions | KS |")
    print("|---" * 10 + "|")
    for kind in options.kinds:
        for seed in range(1, options.seeds + 1):
            bundles = sources(kind, options.side, options.fraction, options.grown, seed)
            optimised = CapsuleOptimizer(Input=bundles)
            fibres = OutputPort(optimised, 0)
            convergence = servermanager.Fetch(optimised, idx=1)
            before, after = [servermanager.Fetch(bundle) for bundle in bundles], servermanager.Fetch(fibres)
            spread, axes = deviations(after, options.side)
            start = np.concatenate([deviations(data, options.side)[0] for data in before])
            ratios = [parts[:, 1] / parts[:, 0] for parts in (start, spread)]
            cells = [
                kind,
                str(seed),
                f"{convergence.GetNumberOfRows()}, {convergence.GetColumnByName('OverlappingPairs').GetTuple1(convergence.GetNumberOfRows() - 1):g}",
                f"{100 * after.GetFieldData().GetArray('LengthIncrease').GetValue(0):.1f} %",
                f"{spread[:, 0].min():.1f} to {spread[:, 1].max():.1f}",
                ", ".join(f"{part.min():.2f} to {part.max():.2f}" for part in ratios),
                "" if kind == "fod" else ", ".join(f"{np.degrees(np.arcsin(np.linalg.norm(np.cross(a, b)))):.1f}" for a, b in zip(axes, axes_of(kind))),
                ", ".join(f"{correlation(data, options.side, peaks_as_harmonics()):.3f}" for data in (before[0], after)) if kind == "fod" else "",
            ]
            if not options.parted:
                surfaces = MyelinSurface(Input=FibreRadialGrowth(Input=fibres))
                statistics = SubstrateStatistics(Fibres=fibres, Outer=OutputPort(surfaces, 0), Inner=OutputPort(surfaces, 1))
                table = servermanager.Fetch(statistics, idx=1)
                column = {name: vtk_to_numpy(table.GetColumnByName(name)) for name in ("BundleId", "OuterVolume_um3", "OuterRadius_um", "OuterRadiusDeviation_um", "TargetRadius_um")}
                shares = np.bincount(column["BundleId"], weights=column["OuterVolume_um3"])[1:] / options.side**3
                measured = np.isfinite(column["OuterRadius_um"])
                cells.append(", ".join(f"{share:.3f}" for share in shares))
                radii = np.hypot(column["OuterRadius_um"], np.nan_to_num(column["OuterRadiusDeviation_um"]))  # root mean square, as TargetRadius
                cells.append(f"{distance(radii[measured], column['TargetRadius_um'][measured]):.3f}")
            print("| " + " | ".join(cells) + " |", flush=True)


main()
