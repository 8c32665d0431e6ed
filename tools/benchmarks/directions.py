# SPDX-License-Identifier: BSD-3-Clause
"""Prints how fibres of BundleInitializer are directed after CapsuleOptimizer, as rows of a Markdown table.

    ./cactus pvpython tools/benchmarks/directions.py --side 30 --seeds 5 -- 5 10 15 20 25
    ./cactus pvpython tools/benchmarks/directions.py --sides 15 30 60 100 -- 5

All is measured here, on the fibres inside the domain: the distance of whole fibres' angles from end to end to Watson's distribution of the same
mean (and the distance that would be significant), twist and azimuths over all tangents, the angle between fibres within 10 µm, sinuosity by length.
"""

import argparse
import time

import numpy as np
from paraview import servermanager
from paraview.simple import *
from vtkmodules.util.numpy_support import vtk_to_numpy

ANGLES = np.linspace(0, np.pi / 2, 5001)


def watson(mean):
    """Distribution function of the angles (at ANGLES) of a Watson distribution with this mean angle."""
    low, high = np.log(1e-3), np.log(1e6)
    for _ in range(80):
        kappa = np.exp(0.5 * (low + high))
        weight = np.exp(-kappa * np.sin(ANGLES) ** 2) * np.sin(ANGLES)
        if (ANGLES * weight).sum() / weight.sum() > mean:
            low = np.log(kappa)
        else:
            high = np.log(kappa)
    return np.cumsum(weight) / weight.sum()


def distance_to_watson(angles):
    angles = np.sort(angles)
    expected = np.interp(angles, ANGLES, watson(angles.mean()))
    steps = np.arange(len(angles) + 1) / len(angles)
    return max((expected - steps[:-1]).max(), (steps[1:] - expected).max())


def parts_inside(data, side):
    points = vtk_to_numpy(data.GetPoints().GetData()).astype(float)
    ends = vtk_to_numpy(data.GetLines().GetOffsetsArray())
    for begin, end in zip(ends[:-1], ends[1:]):
        inside = np.flatnonzero((abs(points[begin:end]) <= side / 2 * (1 + 1e-9)).all(axis=1))
        if len(inside) >= 3:
            yield points[begin + inside[0] : begin + inside[-1] + 1]


def measure(data, side):
    angles, lengths, chords, middles, tangents = [], [], [], [], []
    turned = most = 0.0
    squares = np.zeros((2, 2))
    for line in parts_inside(data, side):
        steps = np.diff(line, axis=0)
        chord = line[-1] - line[0]
        lengths.append(np.linalg.norm(steps, axis=1).sum())
        chords.append(np.linalg.norm(chord))
        if abs(chord[2]) > 0.93 * side:
            angles.append(np.arctan2(np.hypot(*chord[:2]), abs(chord[2])))
        place = 0.5 * (line[1:] + line[:-1])
        turned += (place[:, 0] * steps[:, 1] - place[:, 1] * steps[:, 0]).sum()
        most += (np.hypot(place[:, 0], place[:, 1]) * np.hypot(steps[:, 0], steps[:, 1])).sum()
        squares += steps[:, :2].T @ steps[:, :2]
        half = len(steps) // 2
        middles.append(place[half])
        tangents.append(steps[half] / np.linalg.norm(steps[half]))
    middles, tangents = np.array(middles), np.array(tangents)
    spread = []
    for i in range(len(middles)):
        near = np.flatnonzero(np.linalg.norm(middles[:i] - middles[i], axis=1) <= 10)
        spread.extend(np.arccos(np.clip(abs(tangents[near] @ tangents[i]), 0, 1)))
    angles = np.array(angles)
    moments = np.linalg.eigvalsh(squares)
    return {
        "fibres": len(angles),
        "ends": np.degrees(angles.mean()),
        "distance": distance_to_watson(angles),
        "significant": 1.36 / np.sqrt(len(angles)),
        "twist": abs(turned / most),
        "azimuths": moments[1] / moments[0],
        "spread": np.degrees(np.mean(spread)),
        "sinuosity": sum(lengths) / sum(chords),
    }


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("dispersions", nargs="+", type=float)
    parser.add_argument("--sides", nargs="+", type=float, default=[30.0], metavar="MICROMETRES")
    parser.add_argument("--seeds", type=int, default=5)
    parser.add_argument("--set", nargs="*", default=[], metavar="PROPERTY=VALUE", help="for BundleInitializer")
    options = parser.parse_args()
    more = {name: float(value) for name, value in (entry.split("=") for entry in options.set)}
    names = ["fibres", "ends", "distance", "significant", "twist", "azimuths", "spread", "sinuosity"]
    print("| side (µm) | asked | converged | " + " | ".join(names) + " | seconds |")
    print("|---" * (len(names) + 4) + "|")
    for side in options.sides:
        for dispersion in options.dispersions:
            rows, converged, start = [], 0, time.time()
            for seed in range(1, options.seeds + 1):
                bundle = BundleInitializer(Side=side, MeanDispersion=dispersion, Seed=seed, **more)
                optimised = CapsuleOptimizer(Input=bundle)
                data = servermanager.Fetch(optimised)
                converged += int(data.GetFieldData().GetArray("Converged").GetValue(0))
                rows.append(measure(data, side))
                Delete(optimised)
                Delete(bundle)
            cells = [f"{np.mean([row[name] for row in rows]):.4g} ({min(row[name] for row in rows):.4g} to {max(row[name] for row in rows):.4g})" for name in names]
            print(f"| {side:g} | {dispersion:g}° | {converged} of {options.seeds} | " + " | ".join(cells) + f" | {(time.time() - start) / options.seeds:.1f} |", flush=True)


main()
