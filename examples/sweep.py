# SPDX-License-Identifier: BSD-3-Clause
"""Makes a substrate of every combination of dispersions, fractions and seeds, and a table of what came out.

    ./cactus pvpython examples/sweep.py --dispersions 0 10 20 --fractions 0.7 0.9 --seeds 1 2 3
    ./cactus pvbatch -np 4 --sym examples/sweep.py --dispersions 0 10 20 --fractions 0.7 0.9 --seeds 1 2 3

Each becomes a folder in the folder --output, with sweep.csv beside them. What is there is not made again: a sweep that was stopped goes on, in
the middle of a case, too, and one that asks for more makes what is missing. Several ranks share the cases. To vary something else, give it
to sweep(), and take it in make().
"""

import argparse

from paraview import simple
from cactus_sweep import sweep  # which the plugin holds

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("--dispersions", type=float, nargs="+", default=[5.0, 15.0], help="mean dispersions, degrees (default: 5 15)")
parser.add_argument("--fractions", type=float, nargs="+", default=[0.7, 0.9], help="fibre volume fractions (default: 0.7 0.9)")
parser.add_argument("--seeds", type=int, nargs="+", default=[1, 2, 3], help="(default: 1 2 3)")
parser.add_argument("--side", type=float, default=20.0, help="side of the domain, µm (default: 20)")
parser.add_argument("--voxel-size", type=float, default=0.1, help="µm (default: 0.1)")
parser.add_argument("--output", default="cactus-sweep", metavar="DIR", help="(default: cactus-sweep)")
wanted = parser.parse_args()


def make(folder, dispersion_deg, fraction, seed, side_um, voxel_um):
    """One substrate, from nothing to its folder."""
    bundle = simple.BundleInitializer(Side=side_um, MeanDispersion=dispersion_deg, FibreVolumeFraction=min(0.6, 0.9 * fraction), GrownFibreVolumeFraction=fraction, Seed=seed)
    fibres = simple.OutputPort(simple.CapsuleOptimizer(Input=bundle), 0)
    simple.SubstrateProduction(Input=fibres, VoxelSize=voxel_um, FolderName=folder).UpdatePipeline()


sweep(make, wanted.output, dispersion_deg=wanted.dispersions, fraction=wanted.fractions, seed=wanted.seeds, side_um=wanted.side, voxel_um=wanted.voxel_size)
