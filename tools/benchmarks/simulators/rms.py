# SPDX-License-Identifier: BSD-3-Clause
"""Runs RMS on folders for it, and our own walk on their surfaces: diffusion outside the fibres over the free one, as rows of a table.

    git clone https://github.com/NYU-DiffusionMRI/monte-carlo-simulation-3D-RMS
    ./cactus pvpython tools/benchmarks/simulators/rms.py --side 8 --gaps 0.02 0.1 0.2 --voxels 0.1 0.05 -- .../hpc_code/lib/main.cu

RMS's main.cu is for a GPU: it is compiled for a processor, with rms_processor.h in place of CUDA's headers and nothing else changed.
Ratios are the growth of the mean squared displacement over the second half of the run, over that of free walkers, radial and axial;
errors are standard errors. Where the writer leaves extra/ out, its warning says why. Without main.cu there is no run, only what the labels hold.
"""

import argparse
import math
import os
import re
import shutil
import subprocess
import tempfile

import numpy as np
from paraview import servermanager
from paraview.simple import *

HERE = os.path.dirname(os.path.abspath(__file__))


def compiled(source, folder):
    """The program made of main.cu."""
    with open(source, encoding="latin-1") as file:
        text = file.read()
    text = re.sub(r"#include <(?:cuda|curand|thrust)[^>]*>", "", text)
    text = re.sub(r"__device__ double atomAdd.*?(?=__global__)", "", text, flags=re.DOTALL)
    text = re.sub(r"(\w+)<<<([^,>]+),([^>]+)>>>\(", r"launch(\1, \2, \3, ", text)
    path = os.path.join(folder, "main.cpp")
    with open(path, "w") as file:
        file.write('#include "rms_processor.h"\n' + text)
    program = os.path.join(folder, "main")
    subprocess.run(["g++", "-O2", "-w", "-I", HERE, path, "-o", program], check=True)
    return program


def ratios(folder, program, walkers, distance):
    """Radial and axial diffusivity over the free one, each with its error, of a run in a folder for RMS."""
    with open(os.path.join(folder, "simParamInput.txt")) as file:
        words = file.read().split()
    free = np.loadtxt(os.path.join(folder, "diffusivity.txt"))[1]
    words[1] = str(1000 * math.ceil(distance**2 / (2 * free * float(words[0])) / 1000))  # steps, of which it saves a thousand moments
    words[2], words[3] = str(walkers), "1"  # signals are not looked at
    with open(os.path.join(folder, "simParamInput.txt"), "w") as file:
        file.write("\n".join(words) + "\n")
    subprocess.run([program], cwd=folder, check=True, stdout=subprocess.DEVNULL)
    squares = np.loadtxt(os.path.join(folder, "dx2.txt"))[:, [0, 3, 5]] / walkers
    fourths = np.loadtxt(os.path.join(folder, "dx4.txt"))[-1, [0, 10, 14]] / walkers
    times = np.loadtxt(os.path.join(folder, "diff_time.txt"))
    growth = 2.0 * free * (times[-1] - times[len(times) // 2])
    found = (squares[-1] - squares[len(times) // 2]) / growth
    error = np.sqrt((fourths - squares[-1] ** 2) / walkers) / growth
    return (found[:2].mean(), np.hypot(*error[:2]) / 2, found[2], error[2])


def own(outer, distance, walkers):
    """The same by our walk between the surfaces, which the domain's faces mirror as RMS's do."""
    table = servermanager.Fetch(SubstrateStatistics(Outer=outer, ExtraAxonalWalkers=walkers, WalkDistance=distance, WalkStep=0.05))
    ratio, error = ([table.GetColumnByName(f"ExtraAxonalDiffusivity{what}{axis}").GetValue(0) for axis in "XYZ"] for what in ("Ratio", "Error"))
    return 0.5 * (ratio[0] + ratio[1]), 0.5 * math.hypot(*error[:2]), ratio[2], error[2]


def labels(outer, inner, voxel, folder):
    """Writes a folder for RMS. Pieces outside, per cent connected, fraction of the domain by labels and by surfaces; and the folder of the run."""
    SubstrateWriter(Outer=outer, Inner=inner, FolderName=folder, Format="RMS", VoxelSize=voxel).UpdatePipeline()
    with open(os.path.join(folder, "README.txt")) as file:
        found = re.search(r"voxels outside fall into (\d+) pieces, (\S+) % of them connected, and fill (\S+) of the domain, where the surfaces have ([\d.]+\d)", file.read())
    extra = os.path.join(folder, "extra")
    return list(found.groups()), extra if os.path.isdir(extra) else None


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--side", type=float, default=8)
    parser.add_argument("--fraction", type=float, default=0.7, help="TargetFibreVolumeFraction")
    parser.add_argument("--gaps", type=float, nargs="+", default=[0.02, 0.1, 0.2])
    parser.add_argument("--voxels", type=float, nargs="+", default=[0.1])
    parser.add_argument("--walkers", type=int, default=1000)
    parser.add_argument("--distance", type=float, default=6, help="µm that a free walker has moved along an axis in the end (root mean square)")
    parser.add_argument("source", nargs="?", help="RMS's main.cu")
    arguments = parser.parse_args()
    print("| MinimumGap | VoxelSize | FVF | pieces | connected | fraction outside, labels | surfaces | extra/ | radial | axial |")
    print("|" + 10 * "---|")
    bundle = OutputPort(CapsuleOptimizer(Input=BundleInitializer(Side=arguments.side)), 0)
    with tempfile.TemporaryDirectory() as folder:
        program = compiled(arguments.source, folder) if arguments.source else None
        for gap in arguments.gaps:
            grown = FibreRadialGrowth(Input=bundle, MinimumGap=gap, TargetFibreVolumeFraction=arguments.fraction)
            made = MyelinSurface(Input=grown)
            outer, inner = OutputPort(made, 0), OutputPort(made, 1)
            for voxel in arguments.voxels:
                target = os.path.join(folder, f"gap{gap}-voxel{voxel}")
                (pieces, connected, fraction, exact), extra = labels(outer, inner, voxel, target)
                run = ratios(extra, program, arguments.walkers, arguments.distance) if extra and program else 4 * (math.nan,)
                row = [gap, voxel, 1 - float(exact), pieces, connected + " %", fraction, exact, "yes" if extra else "no"]
                print("|", " | ".join(str(cell) for cell in row), "| {:.3f} ± {:.3f} | {:.3f} ± {:.3f} |".format(*run), flush=True)
                shutil.rmtree(target)
            if program:
                print("| {} | our walk | | | | | | | {:.3f} ± {:.3f} | {:.3f} ± {:.3f} |".format(gap, *own(outer, arguments.distance, arguments.walkers)), flush=True)


if __name__ == "__main__":
    main()
