# SPDX-License-Identifier: BSD-3-Clause
"""Prints how water along axons slows down with time, as a Markdown table (docs/tissue.md).

    ./cactus pvpython tools/benchmarks/axial_diffusion.py --seeds 3
    ./cactus pvpython tools/benchmarks/axial_diffusion.py --seeds 1 --walkers 4000

Areas of final inner surfaces are cut every 0.25 µm across long axons. Along each piece without a gap of more than 1 µm the Fick-Jacobs equation is
solved exactly, by eigenvectors. Each piece goes on as its mirror image, again and again, so that its ends do not count and its D∞/D0 is 1/<1/α>.
Walkers start everywhere in the axon. Figures are means over pieces, with standard errors by bootstrap over them. The last column is of radii drawn
from a lognormal distribution with the correlation of the same length: what a fit over these times finds if fluctuations have no longer range.

With --walkers, surfaces of the whole axons of the first seed and case are walked in by cactus_random_walk, from which D(t) = <z²>/(2t) is printed
beside that of the same equation between their closed ends.
"""

import argparse
import json
import os
import shutil
import subprocess
import tempfile

import numpy as np
from paraview import servermanager
from paraview.simple import *
from vtkmodules.util.numpy_support import vtk_to_numpy

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
SPACING = 0.25
LARGEST_GAP = 4  # cuts that may be missing
SHORTEST = 150.0  # µm of a piece
D0 = 2.0  # µm²/ms
TIMES = np.array([1, 2, 5, 10, 14, 20, 30, 50, 70, 100.0])  # ms
LATE = TIMES >= 10
STEP = 0.2  # µm, of walkers
WALKED = (1.0, 2.0, 10.0, 20.0, 50.0, 100.0)  # ms: half and whole of three walks
WAVELENGTHS = ((10, 20), (20, 50), (50, 150))  # µm, between which Γ is averaged
STRAIGHT = {"MeanDispersion": 0, "Sinuosity": 1, "Length": 200}
CASES = {
    "`CalibreVariation` 0.27, straight": {**STRAIGHT, "CalibreVariation": 0.27},
    "Default 0.25, straight": STRAIGHT,
    "0.27, undulating": {"MeanDispersion": 0, "Length": 300, "CalibreVariation": 0.27},
}


def column(table, name):
    return vtk_to_numpy(table.GetColumnByName(name))


def grow(side, seed, properties):
    fibres = OutputPort(CapsuleOptimizer(Input=BundleInitializer(Side=side, Seed=seed, **properties)), 0)
    return MyelinSurface(Input=FibreRadialGrowth(Input=fibres))


def pieces(surfaces):
    """(FibreId, areas at every SPACING along it) of the pieces of axons that are long enough."""
    profiles = servermanager.Fetch(SubstrateStatistics(Fibres=OutputPort(surfaces, 0), CutSpacing=SPACING), idx=3)
    ids, arc, diameters = (column(profiles, name) for name in ("FibreId", "ArcLength_um", "InnerDiameter_um"))
    found = []
    for fibre in np.unique(ids):
        mine = (ids == fibre) & np.isfinite(diameters)
        places, logarithms = np.round(arc[mine] / SPACING - 0.5).astype(int), np.log(diameters[mine])
        breaks = np.flatnonzero(np.diff(places) > LARGEST_GAP) + 1
        for where, values in zip(np.split(places, breaks), np.split(logarithms, breaks)):
            if len(where) > 1 and (where[-1] - where[0]) * SPACING >= SHORTEST:
                all_places = np.arange(where[0], where[-1] + 1)
                found.append((int(fibre), np.pi / 4 * np.exp(2 * np.interp(all_places, where, values))))
    return found


def drawn(random, variation=0.25, correlation=1.3, length=200.0):
    """Areas of an endless axon whose ln r is normal, with a Matérn-3/2 correlation."""
    count = int(length / SPACING)
    distances = np.sqrt(3) * SPACING / correlation * np.minimum(np.arange(count), count - np.arange(count))
    spectrum = np.fft.rfft((1 + distances) * np.exp(-distances)).real.clip(0)
    return np.exp(2 * variation * np.fft.irfft(np.sqrt(spectrum) * np.fft.rfft(random.standard_normal(count)), count))


def modes(areas, at_ends):
    """Rates (1/ms) and eigenvectors of the symmetrised Fick-Jacobs operator, with flux through the ends as into an odd (2) or even (0) mirror image."""
    between = 2 * areas[1:] * areas[:-1] / (areas[1:] + areas[:-1])
    around = np.concatenate([[at_ends * areas[0]], between, [at_ends * areas[-1]]])
    operator = np.diag(around[1:] + around[:-1]) - np.diag(between, 1) - np.diag(between, -1)
    return np.linalg.eigh(operator * (D0 / SPACING**2) / np.sqrt(np.outer(areas, areas)))


def endless(areas):
    """D∞, D(t) - D∞ = <x²>/(2t) - D∞ and half the derivative of <x²> less D∞, all over D0, at TIMES."""
    areas = areas / areas.mean()
    limit = 1 / np.mean(1 / areas)
    # Where diffusion is stationary, χ' = D∞/(D0 α) - 1 solves Hχ = v for the drift v = D0 α'/α, and D(t) - D∞ = <χ (1 - exp(-Ht)) χ>/t.
    between = 2 * areas[1:] * areas[:-1] / (areas[1:] + areas[:-1])
    corrector = SPACING * np.cumsum(np.concatenate([[0.5 * (limit / areas[0] - 1)], limit / between - 1]))
    rates, vectors = modes(areas, 2)
    weights = (vectors.T @ (np.sqrt(areas) * corrector)) ** 2 / (len(areas) * D0)
    decay = np.exp(-np.outer(TIMES, rates))
    return limit, (1 - decay) @ weights / TIMES, decay @ (rates * weights)


def closed(areas, times):
    """<x²> (µm²) of walkers that start everywhere between two closed ends."""
    places = SPACING * (np.arange(len(areas)) - 0.5 * len(areas))
    rates, vectors = modes(areas, 0)
    weights = (vectors.T @ (np.sqrt(areas) * places)) ** 2 / areas.sum()
    return 2 * (1 - np.exp(-np.outer(times, np.maximum(rates, 0)))) @ weights


def fluctuation(areas, shortest, longest):
    """Γ(k) of the area (docs/statistics.md) in µm, the mean over some wavelengths."""
    waves = np.exp(2j * np.pi * np.outer(1 / np.geomspace(shortest, longest, 12), SPACING * np.arange(len(areas))))
    return np.mean(np.abs(waves @ (areas / areas.mean() - 1)) ** 2) * SPACING / len(areas)


def exponent(values):
    return -np.polyfit(np.log(TIMES[LATE]), np.log(values[LATE]), 1)[0]


def cells(found):
    """Of the areas along each piece: D(t) and Dinst(t) at TIMES, D∞, the exponents of both, and Γ at WAVELENGTHS."""
    limits, *excesses = (np.array(values) for values in zip(*map(endless, found)))
    powers = [np.array([fluctuation(areas, *between) for areas in found]) for between in WAVELENGTHS]
    random = np.random.default_rng(1)
    draws = [random.integers(len(found), size=len(found)) for _ in range(1000)]
    with_error = lambda of: f"{of(slice(None)):.3f} ± {np.std([of(draw) for draw in draws]):.3f}"
    values = [", ".join(f"{limits.mean() + excess[:, i].mean():.3f}" for excess in excesses) for i in range(len(TIMES))]
    means = [with_error(lambda draw, m=m: m[draw].mean()) for m in (limits, *powers)]
    exponents = [with_error(lambda draw, e=e: exponent(e[draw].mean(axis=0))) for e in excesses]
    return values + means[:1] + exponents + means[1:]


def walk(surfaces, found, options):
    """Prints D(t)/D0 of walkers in the surfaces and by the equation."""
    with tempfile.TemporaryDirectory() as scratch:
        folder = os.path.join(scratch, "all")
        SubstrateWriter(Outer=OutputPort(surfaces, 0), Inner=OutputPort(surfaces, 1), FolderName=folder).UpdatePipeline()
        os.makedirs(os.path.join(scratch, "axons/outer"))
        for fibre, _ in found:
            shutil.copy(os.path.join(folder, f"inner/fibre_{fibre:05d}.ply"), os.path.join(scratch, "axons/outer"))
        print("| t (ms) | walkers, D(t)/D₀ | equation |\n|---|---|---|")
        volumes = [areas.sum() for _, areas in found]
        ours = np.average([closed(areas, np.array(WALKED)) for _, areas in found], axis=0, weights=volumes)
        for i in range(0, len(WALKED), 2):
            steps = 2 * round(3 * D0 * WALKED[i + 1] / STEP**2)
            command = [options.walk, "--walkers", str(options.walkers), "--steps", str(steps), "--step", str(STEP), os.path.join(scratch, "axons")]
            inside = json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)["myelin"]
            z = inside["squared_displacement_um2"][2]
            for time, square, other in zip(WALKED[i:], (z - inside["second_half_um2"][2], z), ours[i:]):
                value, error = square / (2 * D0 * time), np.sqrt(2 / options.walkers)
                print(f"| {time:g} | {value:.3f} ± {value * error:.3f} | {other / (2 * D0 * time):.3f} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--side", type=float, default=10.0, metavar="MICROMETRES")
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--walkers", type=int, default=0, help="walk in the surfaces of the first case, and print nothing else")
    parser.add_argument("--walk", default=os.path.join(ROOT, "build/release/bin/cactus_random_walk"), help="where that program is")
    options = parser.parse_args()
    if options.walkers:
        properties = next(iter(CASES.values()))
        surfaces = grow(options.side, 1, properties)
        return walk(surfaces, [piece for piece in pieces(surfaces) if len(piece[1]) * SPACING > properties["Length"] - 2], options)
    columns = {}
    for name, properties in CASES.items():
        found = [areas for seed in range(1, options.seeds + 1) for _, areas in pieces(grow(options.side, seed, properties))]
        columns[f"{name} ({len(found)} pieces, {sum(map(len, found)) * SPACING / 1000:.1f} mm)"] = cells(found)
    random = np.random.default_rng(1)
    columns["drawn (60 × 200 µm)"] = cells([drawn(random) for _ in range(60)])
    print("| | " + " | ".join(columns) + " |")
    print("|---" * (len(columns) + 1) + "|")
    rows = [f"D(t)/D₀, Dinst(t)/D₀ at {time:g} ms" for time in TIMES]
    rows += ["D∞/D₀ = 1/⟨1/α⟩", "exponent of D(t) − D∞, 10 to 100 ms", "exponent of Dinst(t) − D∞, 10 to 100 ms"]
    rows += [f"Γ of the area at wavelengths of {shortest} to {longest} µm (µm)" for shortest, longest in WAVELENGTHS]
    for i, row in enumerate(rows):
        print(f"| {row} | " + " | ".join(values[i] for values in columns.values()) + " |")


main()
