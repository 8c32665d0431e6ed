# SPDX-License-Identifier: BSD-3-Clause
"""Makes whole substrates and prints what was measured on their meshes, as rows of a Markdown table.

    ./cactus pvpython tools/benchmarks/substrates.py --side 50 --fraction 0.955 dispersion-0 dispersion-25 crossing-90
    ./cactus pvpython tools/benchmarks/substrates.py --side 30 histology-1 histology-2 histology-3 histology-4

Their names are those of examples/paper.py. The last columns compare the radii that were asked for with those of the meshes.
"""

import argparse
import csv
import os
import resource
import sys
import time

import numpy as np
from paraview import servermanager
from paraview.simple import *

sys.path.append(os.path.join(os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__)))), "examples"))
import paper  # noqa: E402  (which is in another folder)


def columns_of(proxy, index):
    table = servermanager.Fetch(proxy, idx=index)
    return {
        table.GetColumnName(i): np.array([table.GetValue(row, i).ToDouble() for row in range(table.GetNumberOfRows())])
        for i in range(table.GetNumberOfColumns())
    }


def certificate_in(folder):
    """What the certificate in a substrate folder says of all fibres, and the radius of each."""
    with open(f"{folder}/certificate.csv", newline="") as file:
        found = {row["quantity"]: [float(row["value"])] for row in csv.DictReader(file)}
    with open(f"{folder}/certificate_fibres.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    return found, {name: np.array([float(row[name] or "nan") for row in rows]) for name in ("FibreId", "OuterRadius_um")}


def compare_radii(fibres, certified):
    """Correlation of the fibres' target radii with those of their meshes, and the Kolmogorov-Smirnov distance of the two."""
    targets = dict(zip(fibres["FibreId"], fibres["TargetRadius_um"]))
    reached = dict(zip(certified["FibreId"], certified["OuterRadius_um"]))
    both = np.array([(targets[fibre], radius) for fibre, radius in reached.items() if np.isfinite(radius)])
    values = np.sort(both.ravel())
    below = [np.searchsorted(np.sort(radii), values, side="right") / len(radii) for radii in both.T]
    return len(both), np.corrcoef(both.T)[0, 1], np.abs(below[0] - below[1]).max()


def seconds(work):
    start = time.time()
    work()
    return time.time() - start


def properties(name, arguments):
    """The properties of BundleInitializer, FibreRadialGrowth and MyelinSurface for a substrate of that name."""
    found = paper.properties(name, arguments.side, arguments.seed, arguments.fraction, arguments.tolerance)
    return found or sys.exit(f"{name} is no substrate: dispersion-D, coherent-D, crossing-A, histology-N or radii-F")


def substrate(name, arguments):
    bundle, growth, myelin = properties(name, arguments)
    initial = BundleInitializer(**bundle)
    optimizer = CapsuleOptimizer(Input=initial)
    fibres = OutputPort(optimizer, 0)
    times = [seconds(lambda: UpdatePipeline(proxy=optimizer))]
    # The image alone takes 8 bytes a voxel, and nothing but the surfaces is wanted of it.
    grown = FibreRadialGrowth(Input=fibres, VoxelSize=arguments.voxel, **growth)
    surfaces = MyelinSurface(Input=grown, ReleaseInput=1, **myelin)
    outer, inner = OutputPort(surfaces, 0), OutputPort(surfaces, 1)
    times.append(seconds(lambda: UpdatePipeline(proxy=surfaces)))
    if arguments.output:
        # Certifies what it writes.
        os.makedirs(arguments.output, exist_ok=True)
        folder = f"{arguments.output}/{name}"
        last = SubstrateWriter(Fibres=fibres, Outer=outer, Inner=inner, FolderName=folder)
        times.append(seconds(last.UpdatePipeline))
        found, certified = certificate_in(folder)
    else:
        last = SubstrateCertificate(Fibres=fibres, Outer=outer, Inner=inner)
        times.append(seconds(lambda: UpdatePipeline(proxy=last)))
        found, certified = columns_of(last, 0), columns_of(last, 1)
    if not found:
        sys.exit(f"{name} failed, see above")
    found = {key: value[0] for key, value in found.items()}
    radii = compare_radii(columns_of(surfaces, 2), certified)
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e6
    cells = (
        name,
        f"{found['OuterSurfaces']:.0f}",
        f"{found['FVF']:.4f}",
        f"{found['AVF']:.4f}",
        f"{found['FVF'] - found['AVF']:.4f}",
        f"{found['AggregateGRatio']:.4f}",
        "yes" if found["Certified"] else "no",
        f"{found['SmallestGap_um']:.4f}",
        f"{found['TrianglesPerArea_um-2']:.1f}",
        " + ".join(f"{t:.0f}" for t in times),
        f"{radii[1]:.4f}, {radii[2]:.3f} ({radii[0]})",
        f"{peak:.1f}",
    )
    print("| " + " | ".join(cells) + " |", flush=True)
    for proxy in (last, surfaces, grown, optimizer, initial):
        Delete(proxy)


def parser_for(description, side, fraction, tolerance):
    """Of what is common to this program and surfaces.py, with defaults of their own."""
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="+", metavar="SUBSTRATE")
    parser.add_argument("--side", type=float, default=side, help="side of the cube, µm (%(default)s)")
    parser.add_argument("--fraction", type=float, default=fraction, help="fibre volume fraction of the dense ones (%(default)s)")
    parser.add_argument("--tolerance", type=float, default=tolerance, help="SurfaceTolerance, µm (%(default)s)")
    parser.add_argument("--voxel", type=float, default=0.1, help="VoxelSize, µm (%(default)s)")
    parser.add_argument("--seed", type=int, default=1, help="Seed of the bundle (%(default)s)")
    return parser


def main():
    parser = parser_for(__doc__, side=30, fraction=0.955, tolerance=0.0065)
    parser.add_argument("--output", help="folder for the substrates' files; none are written without it")
    arguments = parser.parse_args()
    columns = "substrate, fibres, FVF, AVF, MVF, g, certified, smallest gap (µm), triangles/µm²".split(", ")
    stages = "optimise + grow and mesh + certify" + (" and write" if arguments.output else "") + " (s)"
    columns += [stages, "radii: correlation, KS (fibres)", "peak memory so far (GB)"]
    print("| " + " | ".join(columns) + " |\n|" + "---|" * len(columns), flush=True)
    for name in arguments.names:
        substrate(name, arguments)


if __name__ == "__main__":
    main()
