# SPDX-License-Identifier: BSD-3-Clause
"""Prints what axons of substrates are like beside those of tissue, as a Markdown table (docs/tissue.md).

    ./cactus pvpython tools/benchmarks/tissue.py --side 24 --seeds 5

Final surfaces are cut every 0.25 µm, and measured as the tissue's segmentations were: over axons of which whole cuts span at least three quarters of
the side, each of which counts once. Every number is the mean over substrates of different seeds and its standard deviation.
"""

import argparse

import numpy as np
from paraview import servermanager
from paraview.simple import *
from vtkmodules.util.numpy_support import vtk_to_numpy

SPACING = 0.25
NEIGHBOURHOOD = 40  # cuts over which the correlation of ln r is looked at

# Measured on public segmentations by equal-area radii of cuts across the axons: 227 axons × 18 µm (Lee et al. 2019), 76 × 104 µm (Lee et al. 2023),
# 53 × 192 µm (Andersson et al. 2020).
TISSUE = {
    "Mouse genu": ["0.510 ± 0.143", "0.285", "0.390", "0.738", "1.1 to 1.4", "1.5", "2.8", "5.1", "1.022", "0.32", "0.755", "−0.29", "0.811, 0.674"],
    "Human subcortical": ["0.866 ± 0.192", "0.240", "0.247", "0.786", "0.71", "1.2", "3.6", "4.1", "1.121", "2.03", "0.63 (tilted cuts)", "", ""],
    "Monkey callosum, thick axons": ["1.19 ± 0.21", "0.145", "0.092", "0.917", "", "", "2.2", "", "1.029", "3.0", "0.84", "−0.38", ""],
}
QUANTITIES = [
    "inner radius, mean ± deviation between axons (µm)", "variation of the radius along an axon (deviation over mean)", "variance of the area over its mean",
    "D∞/D₀ along axons by their calibre", "Γ(2π/L) of the area (µm)", "correlation of ln r falls to one half at (µm)", "largest over smallest radius, median",
    "distance of beads (µm)", "sinuosity", "undulation: distance from the straight line (µm)", "axis ratio of cuts", "correlation of variation and mean radius",
    "effective radius of all cuts, of axons' means (µm)",
]
OURS = {"Default": {}, "Preset Mouse genu": {"Preset": "Mouse genu (Lee 2019)"}, "Default, 0.7": {"FibreVolumeFraction": 0.55, "GrownFibreVolumeFraction": 0.7}}


def column(table, name):
    return vtk_to_numpy(table.GetColumnByName(name))


def effective(radii):
    return (np.mean(radii**6) / np.mean(radii**2)) ** 0.25


def half_distance(lines):
    """Where the correlation of ln r falls to one half, as measured on the segmentations: about each axon's mean."""
    sums, pairs = np.zeros(NEIGHBOURHOOD), np.zeros(NEIGHBOURHOOD)
    for line in lines:
        values = line - np.nanmean(line)
        for step in range(min(NEIGHBOURHOOD, len(values))):
            products = values[step:] * values[: len(values) - step]
            sums[step] += np.nansum(products)
            pairs[step] += np.isfinite(products).sum()
    correlation = sums / np.maximum(pairs, 1)
    correlation /= correlation[0]
    beyond = int(np.argmax(correlation < 0.5))
    return SPACING * (beyond - 1 + (correlation[beyond - 1] - 0.5) / (correlation[beyond - 1] - correlation[beyond]))


def measure(side, seed, properties):
    """The quantities of one substrate, numbers or pairs of numbers."""
    bundle = BundleInitializer(**properties, Side=side, Seed=seed)
    fibres = OutputPort(CapsuleOptimizer(Input=bundle), 0)
    surfaces = MyelinSurface(Input=FibreRadialGrowth(Input=fibres))
    statistics = SubstrateStatistics(Fibres=OutputPort(surfaces, 0), CutSpacing=SPACING)
    table, profiles = (servermanager.Fetch(statistics, idx=port) for port in (1, 3))
    ids, arc, radii = column(profiles, "FibreId"), column(profiles, "ArcLength_um"), 0.5 * column(profiles, "InnerDiameter_um")
    lines, rows = [], []
    for row, fibre in enumerate(column(table, "FibreId")):
        mine = (ids == fibre) & np.isfinite(radii)
        if mine.sum() * SPACING < 0.75 * side:
            continue
        places = np.round(arc[mine] / SPACING - 0.5).astype(int)
        line = np.full(places.max() - places.min() + 1, np.nan)
        line[places - places.min()] = radii[mine]
        lines.append(line)
        rows.append(row)
    of = lambda name: column(table, name)[rows]
    means = np.array([np.nanmean(line) for line in lines])
    variations = np.array([np.nanstd(line) for line in lines]) / means
    numbers = [
        (means.mean(), means.std()), variations.mean(), of("AxonAreaVariance").mean(), of("AxonDiffusivityRatio").mean(), of("AxonAreaFluctuation_um").mean(),
        half_distance([np.log(line) for line in lines]), np.median([np.nanmax(line) / np.nanmin(line) for line in lines]), np.nanmean(of("BeadSpacing_um")),
        of("Sinuosity").mean(), of("Undulation_um").mean(), of("InnerAxisRatio").mean(), np.corrcoef(means, variations)[0, 1],
        (effective(np.concatenate([line[np.isfinite(line)] for line in lines])), effective(means)),
    ]
    for proxy in (statistics, surfaces.Input, surfaces, bundle):
        Delete(proxy)
    return len(lines), numbers


def cell(values):
    """Mean and deviation over seeds; of pairs, both."""
    values = np.array(values)
    if values.ndim == 2:
        return ", ".join(cell(values[:, i]) for i in range(2))
    return f"{values.mean():.3f} ± {values.std(ddof=1):.3f}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--side", type=float, default=24.0, metavar="MICROMETRES")
    parser.add_argument("--seeds", type=int, default=5, help="at least 2")
    options = parser.parse_args()
    columns = dict(TISSUE)
    for name, properties in OURS.items():
        found = [measure(options.side, seed, properties) for seed in range(1, options.seeds + 1)]
        numbers = [[substrate[1][i] for substrate in found] for i in range(len(QUANTITIES))]
        columns[f"{name} ({sum(substrate[0] for substrate in found)} axons)"] = [cell(values) for values in numbers]
    print("| | " + " | ".join(columns) + " |")
    print("|---" * (len(columns) + 1) + "|")
    for i, quantity in enumerate(QUANTITIES):
        print(f"| {quantity} | " + " | ".join(values[i] for values in columns.values()) + " |")


main()
