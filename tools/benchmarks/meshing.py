# SPDX-License-Identifier: BSD-3-Clause
"""Makes the surfaces of one label image by both ways of meshing, and prints what comes out as rows of a Markdown table.

    ./cactus pvpython tools/benchmarks/meshing.py
    ./cactus pvpython tools/benchmarks/meshing.py --side 10 --reduction 0.9 0.97

The first row is Meshing CACTUS, the others Meshing VTK filters with each of the target reductions. Times are what the processor took, on
one thread, for both surfaces of all fibres: CACTUS looks for faults while it meshes; for VTK filters the time is given without looking for
them, which is taken to be what the certificate takes. Pairs that meet, gaps and flawed fibres are the certificate's. Distances are those of
random points on the outer surfaces, farther than 0.15 µm from the domain's faces, to the contours of the same fields, neither smoothed nor
coarsened, as CACTUS draws them.
"""

import argparse
import time

import numpy as np
from paraview import servermanager
from paraview.simple import *
from substrates import columns_of
from surfaces import corners_of, distances


def measured(surfaces):
    """The certificate's row, and how long the surfaces and the certificate took (s)."""
    start = time.process_time()
    UpdatePipeline(proxy=surfaces)
    made = time.process_time() - start
    certificate = SubstrateCertificate(Outer=OutputPort(surfaces, 0), Inner=OutputPort(surfaces, 1), NumberOfThreads=1)
    start = time.process_time()
    UpdatePipeline(proxy=certificate)
    judged = time.process_time() - start
    found = {name: values[0] for name, values in columns_of(certificate, 0).items()}
    Delete(certificate)
    return found, made, judged


def print_row(name, surfaces, contours, side):
    found, made, judged = measured(surfaces)
    if surfaces.Meshing == "VTK filters":
        made -= judged  # of the filter itself
    table = columns_of(surfaces, 2)
    outer = servermanager.Fetch(surfaces, idx=0)
    areas = corners_of(outer)[1]
    apart = distances(outer, contours, side)
    fibres = len(table["FibreId"])
    asked = table["Myelin"] == 0
    cells = (
        name,
        f"{made / fibres:.3f}",
        f"{judged / fibres:.3f}",
        f"{len(areas) / areas.sum():.1f}",
        f"{found['OuterPairsMeeting']:.0f}",
        f"{found['InnerLeaving']:.0f}",
        f"{found['SmallestGap_um']:.4f}",
        f"{table['Flawed'].sum():.0f} of {fibres}",
        "yes" if found["Certified"] else "no",
        f"{found['FVF']:.4f}",
        f"{np.abs(table['GRatio'] - table['TargetGRatio'])[asked].max():.4f}",
        f"{np.sqrt((apart**2).mean()):.4f}, {apart.max():.3f}",
    )
    print("| " + " | ".join(cells) + " |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--side", type=float, default=15, help="side of the cube, µm (%(default)s, as in the demo)")
    parser.add_argument("--voxel", type=float, default=0.1, help="VoxelSize, µm (%(default)s)")
    parser.add_argument("--reduction", type=float, nargs="+", default=[0.9], help="TargetReduction (%(default)s)")
    parser.add_argument("--iterations", type=int, default=20, help="SincIterations (%(default)s)")
    parser.add_argument("--band", type=float, default=0.1, help="SincPassBand (%(default)s)")
    arguments = parser.parse_args()
    initial = BundleInitializer(Side=arguments.side, GrownFibreVolumeFraction=0.85, MeanDispersion=10)
    fibres = OutputPort(CapsuleOptimizer(Input=initial), 0)
    grown = FibreRadialGrowth(Input=fibres, TargetFibreVolumeFraction=0.85, VoxelSize=arguments.voxel)
    UpdatePipeline(proxy=grown)
    columns = "meshing, seconds per fibre, and for the certificate, triangles/µm², pairs that meet, inner surfaces that leave"
    columns += ", smallest gap (µm), flawed fibres, certified, FVF, g off by at most, distance to the contours: rms and largest (µm)"
    print("| " + " | ".join(columns.split(", ")) + " |\n|" + "---|" * len(columns.split(", ")), flush=True)
    bare = MyelinSurface(Input=grown, SmoothingIterations=0, DecimationError=0)
    UpdatePipeline(proxy=bare)
    contours = servermanager.Fetch(bare, idx=0)
    Delete(bare)
    print_row("CACTUS", MyelinSurface(Input=grown, NumberOfThreads=1), contours, arguments.side)
    for reduction in arguments.reduction:
        surfaces = MyelinSurface(
            Input=grown,
            Meshing="VTK filters",
            SincIterations=arguments.iterations,
            SincPassBand=arguments.band,
            TargetReduction=reduction,
            NumberOfThreads=1,
        )
        print_row(f"VTK filters, TargetReduction {reduction:g}", surfaces, contours, arguments.side)


main()
