# SPDX-License-Identifier: BSD-3-Clause
"""Makes a substrate of every combination of dispersions, fractions and seeds, and a table of what came out.

    ./cactus pvpython examples/sweep.py --dispersions 0 10 20 --fractions 0.7 0.9 --seeds 1 2 3
    ./cactus pvbatch -np 4 --sym examples/sweep.py --dispersions 0 10 20 --fractions 0.7 0.9 --seeds 1 2 3

Each becomes a folder in the folder --output, as SubstrateWriter writes it, with sweep.csv beside them. What is there is not made again: a sweep
that was stopped goes on, in the middle of a case, too, and one that asks for more makes what is missing. Several ranks share the cases.
"""

import argparse
import csv
import itertools
import os
import sys

from paraview import servermanager, simple
from vtkmodules.vtkParallelCore import vtkDummyController, vtkMultiProcessController

REACHED = ("OuterSurfaces", "FVF", "AVF", "AggregateGRatio", "SmallestGap_um", "Triangles", "Certified")

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("--dispersions", type=float, nargs="+", default=[5.0, 15.0], help="mean dispersions, degrees (default: 5 15)")
parser.add_argument("--fractions", type=float, nargs="+", default=[0.7, 0.9], help="fibre volume fractions (default: 0.7 0.9)")
parser.add_argument("--seeds", type=int, nargs="+", default=[1, 2, 3], help="(default: 1 2 3)")
parser.add_argument("--side", type=float, default=20.0, help="side of the domain, µm (default: 20)")
parser.add_argument("--voxel-size", type=float, default=0.1, help="µm (default: 0.1)")
parser.add_argument("--output", default="cactus-sweep", metavar="DIR", help="(default: cactus-sweep)")
wanted = parser.parse_args()
cases = list(itertools.product(wanted.dispersions, wanted.fractions, wanted.seeds))
table = os.path.join(wanted.output, "sweep.csv")
header = ["dispersion_deg", "fraction", "seed", *REACHED]


def folder_of(case):
    """Named by all that a case is made of: what else is varied below goes into the name, too."""
    return os.path.join(wanted.output, "dispersion-{}_fraction-{}_seed-{}_side-{}_voxel-{}".format(*case, wanted.side, wanted.voxel_size))


def make(case):
    """From nothing to its folder, which is written whole or not at all."""
    dispersion, fraction, seed = case
    bundle = simple.BundleInitializer(Side=wanted.side, MeanDispersion=dispersion, FibreVolumeFraction=min(0.7, 0.9 * fraction), GrownFibreVolumeFraction=fraction, Seed=seed)
    optimiser = simple.CapsuleOptimizer(Input=bundle)
    production = simple.SubstrateProduction(Input=simple.OutputPort(optimiser, 0), VoxelSize=wanted.voxel_size, FolderName=folder_of(case))
    production.UpdatePipeline()
    for proxy in (production, optimiser, bundle):
        simple.Delete(proxy)


def row(case):
    """What its certificate says."""
    with open(os.path.join(folder_of(case), "certificate.csv"), newline="", encoding="utf-8") as file:
        reached = {line["quantity"]: line["value"] for line in csv.DictReader(file)}
    return [*map(str, case), *(reached[name] for name in REACHED)]


def refuse(why):
    print(f"sweep: {why}", file=sys.stderr, flush=True)
    sys.exit(1)


world = vtkMultiProcessController.GetGlobalController()
rank, ranks = world.GetLocalProcessId(), world.GetNumberOfProcesses()
if ranks > 1 and not servermanager.vtkProcessModule.GetProcessModule().GetSymmetricMPIMode():
    refuse("several ranks share the cases with --sym: ./cactus pvbatch -np N --sym examples/sweep.py")
os.makedirs(wanted.output, exist_ok=True)
if os.path.exists(table) and open(table, encoding="utf-8", errors="replace").readline().strip() != ",".join(header):
    refuse(f"{table} is there already, and is no table of a sweep: name another folder with --output")

# Each rank works as if it were alone, so that no stage waits for the others.
alone = vtkDummyController()
vtkMultiProcessController.SetGlobalController(alone)
for case in cases[rank::ranks]:
    if not os.path.exists(folder_of(case)):
        print(f"{folder_of(case)} (rank {rank})", flush=True)
        make(case)
vtkMultiProcessController.SetGlobalController(world)
world.Barrier()

there = [case for case in cases if os.path.exists(os.path.join(folder_of(case), "certificate.csv"))]
if rank == 0:
    rows = [header, *map(row, there)]
    with open(table, "w", newline="", encoding="utf-8") as file:
        csv.writer(file).writerows(rows)
    print("\n".join("".join(f"{value[:15]:>16}" for value in values) for values in rows))
    print(f"{len(there)} of {len(cases)} cases are in {os.path.abspath(wanted.output)}")
if len(there) < len(cases):
    refuse("not every case came out, as the errors above say")
