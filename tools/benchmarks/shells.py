# SPDX-License-Identifier: BSD-3-Clause
"""Prints how much of a substrate is filled in shells beside its faces, as a Markdown table: mean and standard error over seeds, in per cent.

    ./cactus pvpython tools/benchmarks/shells.py --side 24 --seeds 6 --fractions 0.6 0.9

A shell is all that lies from one distance to the next from the nearest face, or, with --along z, from the nearest of the two faces across z. Counted
here: voxels of FibreRadialGrowth's label image that belong to a fibre.
"""

import argparse

import numpy as np
from paraview import servermanager
from paraview.simple import *
from vtkmodules.util.numpy_support import vtk_to_numpy

EDGES = (0, 0.15, 0.45, 0.9, 1.8, 3)  # µm; the last shell is all that lies farther inside


def shells(side, seed, dispersion, fraction, border, voxel, along):
    """The parts filled of each shell, from the outermost to the middle."""
    bundle = BundleInitializer(Side=side, Seed=seed, MeanDispersion=dispersion, Border=border, FibreVolumeFraction=min(0.6, fraction - 0.15),
                               GrownFibreVolumeFraction=fraction)
    image = servermanager.Fetch(FibreRadialGrowth(Input=OutputPort(CapsuleOptimizer(Input=bundle), 0), VoxelSize=voxel))
    size = image.GetDimensions()
    filled = vtk_to_numpy(image.GetPointData().GetArray("FibreId")).reshape(size[::-1]) > 0
    places = [origin + spacing * np.arange(count) for origin, spacing, count in zip(image.GetOrigin(), image.GetSpacing(), size)]
    depths = [side / 2 - abs(axis) for axis in places]
    deep = depths[2][:, None, None] + 0 * filled
    if along == "all":
        deep = np.minimum(deep, np.minimum(depths[1][None, :, None], depths[0][None, None, :]))
    shell = np.digitize(deep, EDGES) - 1
    inside = shell >= 0
    return np.bincount(shell[inside], weights=filled[inside], minlength=len(EDGES)) / np.bincount(shell[inside], minlength=len(EDGES))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--side", type=float, default=24, metavar="MICROMETRES")
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--fractions", type=float, nargs="+", default=[0.6, 0.9], help="after growth")
    parser.add_argument("--dispersion", type=float, default=5, metavar="DEGREES")
    parser.add_argument("--border", default="Cut", choices=["Cut", "Walls"])
    parser.add_argument("--voxel-size", type=float, default=0.15, metavar="MICROMETRES")
    parser.add_argument("--along", default="all", choices=["all", "z"])
    options = parser.parse_args()
    names = [f"{low:g} to {high:g}" for low, high in zip(EDGES, EDGES[1:])] + [f"from {EDGES[-1]:g}"]
    print("| filled | " + " | ".join(names) + " |\n" + "|---" * (len(names) + 1) + "|")
    for fraction in options.fractions:
        found = 100 * np.array([shells(options.side, seed, options.dispersion, fraction, options.border, options.voxel_size, options.along)
                                for seed in range(1, options.seeds + 1)])
        errors = found.std(axis=0, ddof=1) / np.sqrt(len(found)) if len(found) > 1 else 0 * found[0]
        print(f"| {fraction:g} | " + " | ".join(f"{mean:.1f} ± {error:.1f}" for mean, error in zip(found.mean(axis=0), errors)) + " |", flush=True)


main()
