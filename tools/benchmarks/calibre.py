# SPDX-License-Identifier: BSD-3-Clause
"""Prints how the calibre of axons varies along them on final surfaces, as rows of a Markdown table.

    ./cactus pvpython tools/benchmarks/calibre.py --side 20 --seeds 3 --fractions 0.6 0.8 0.9 --variations 0.1 0.2 0.3 0.4
    ./cactus pvpython tools/benchmarks/calibre.py --side 20 --seeds 3 --fractions 0.6 0.8 0.9 --beads 0.3 0.6

Inner surfaces are cut every 0.25 µm. From differences of ln r at distances along an axon (the variogram, which needs no mean and so is not biased for
short axons): its deviation, and the distance at which the correlation falls to one half. Beside them: the diffusivity along axons, 1/<1/α> of those
that run through most of the domain; the Kolmogorov-Smirnov distance of outer radii to their targets and the ratio of their means; fibres whose myelin
is not as asked; the part of the length where the axon's radius is below
a voxel, as asked and on final surfaces; whether the substrate is certified; and the time of the four stages.
"""

import argparse
import time

import numpy as np
from paraview import servermanager
from paraview.simple import *
from vtkmodules.util.numpy_support import vtk_to_numpy

SPACING = 0.25
G_RATIO = 0.7  # MyelinSurface's
FAR = (4.5, 8.0)  # µm, at which no correlation is left


def variogram(lines):
    """Half the mean squared difference of ln r at 0, 1, 2… steps along lines of equally spaced values, by weight of pairs."""
    steps = int(FAR[1] / SPACING) + 1
    sums, pairs = np.zeros(steps), np.zeros(steps)
    for line in lines:
        for step in range(1, min(steps, len(line))):
            differences = line[step:] - line[:-step]
            valid = np.isfinite(differences)
            sums[step] += 0.5 * (differences[valid] ** 2).sum()
            pairs[step] += valid.sum()
    return sums / np.maximum(pairs, 1)


def measure(lines):
    """Deviation of ln r, and the distance at which its correlation falls to one half."""
    values = variogram(lines)
    variance = values[int(FAR[0] / SPACING) :].mean()
    beyond = int(np.argmax(values > 0.5 * variance))
    half = SPACING * (beyond - 1 + (0.5 * variance - values[beyond - 1]) / (values[beyond] - values[beyond - 1]))
    return np.sqrt(variance), half


def along_fibres(data, side):
    """ln of the radius at every SPACING along each fibre's part in the domain."""
    points = vtk_to_numpy(data.GetPoints().GetData()).astype(float)
    radii = vtk_to_numpy(data.GetPointData().GetArray("Radius"))
    ends = vtk_to_numpy(data.GetLines().GetOffsetsArray())
    lines = []
    for first, last in zip(ends[:-1], ends[1:]):
        path = points[first:last]
        lengths = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(path, axis=0), axis=1))])
        places = np.arange(0.5 * SPACING, lengths[-1], SPACING)
        inside = np.all([abs(np.interp(places, lengths, path[:, axis])) < 0.5 * side for axis in range(3)], axis=0)
        values = np.where(inside, np.log(np.interp(places, lengths, radii[first:last])), np.nan)
        lines.append(values)
    return lines


def necks(data, side, voxel):
    """The part of the fibres' length in the domain along which the inner radius that is asked for is below a voxel."""
    targets = vtk_to_numpy(data.GetCellData().GetArray("TargetRadius"))
    thin = total = 0
    for line, target in zip(along_fibres(data, side), targets):
        outer = np.exp(line[np.isfinite(line)])
        if len(outer):
            # TargetRadius is the root mean square of the outer radius, and the myelin is as thick along the whole fibre.
            inner = outer * target / np.sqrt((outer**2).mean()) - (1 - G_RATIO) * target
            thin, total = thin + (inner < voxel).sum(), total + len(outer)
    return thin / total


def columns(table, *names):
    return [vtk_to_numpy(table.GetColumnByName(name)) for name in names]


def distance(values, others):
    places = np.concatenate([values, others])
    return abs(np.searchsorted(np.sort(values), places, side="right") / len(values) - np.searchsorted(np.sort(others), places, side="right") / len(others)).max()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--side", type=float, default=20.0, metavar="MICROMETRES")
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--fractions", type=float, nargs="+", default=[0.6, 0.8, 0.9])
    parser.add_argument("--variations", type=float, nargs="+", default=[0.1, 0.2, 0.3, 0.4])
    parser.add_argument("--beads", type=float, nargs="+", default=[], metavar="AMPLITUDE", help="CalibreModel Beads, in place of --variations")
    parser.add_argument("--voxel", type=float, default=0.1)
    options = parser.parse_args()
    print("| fraction | asked | seed | outer ln r before, after | inner ln r | half at (µm) | 1/<1/α> | Γ0 (µm) | beads: amplitude, spacing (µm) | FVF | necks below a voxel: asked, reached | radii: KS, mean | iterations, pairs | not as asked | certified | s |")
    print("|---" * 16 + "|")
    for fraction in options.fractions:
        for variation in options.beads or options.variations:
            asked = {"CalibreModel": "Beads", "BeadAmplitude": variation} if options.beads else {"CalibreVariation": variation}
            for seed in range(1, options.seeds + 1):
                begin = time.time()
                before = BundleInitializer(Side=options.side, Seed=seed, GrownFibreVolumeFraction=fraction, **asked)
                before.FibreVolumeFraction = min(0.6, 0.8 * fraction)
                optimised = CapsuleOptimizer(Input=before)
                fibres = OutputPort(optimised, 0)
                surfaces = MyelinSurface(Input=FibreRadialGrowth(Input=fibres, VoxelSize=options.voxel))
                surfaces.UpdatePipeline()
                took = time.time() - begin
                statistics = SubstrateStatistics(Fibres=fibres, Outer=OutputPort(surfaces, 0), Inner=OutputPort(surfaces, 1), CutSpacing=SPACING)
                summary, table, profiles = (servermanager.Fetch(statistics, idx=port) for port in (0, 1, 3))
                convergence = servermanager.Fetch(optimised, idx=1)
                certificate = servermanager.Fetch(SubstrateCertificate(Fibres=fibres, Outer=OutputPort(surfaces, 0), Inner=OutputPort(surfaces, 1)))
                ids, outer, inner = columns(profiles, "FibreId", "OuterDiameter_um", "InnerDiameter_um")
                arc, = columns(profiles, "ArcLength_um")
                lines = {"outer": [], "inner": []}
                for fibre in np.unique(ids):
                    mine = ids == fibre
                    places = np.round(arc[mine] / SPACING - 0.5).astype(int)
                    for name, diameters in (("outer", outer), ("inner", inner)):
                        line = np.full(places.max() - places.min() + 1, np.nan)
                        line[places - places.min()] = np.log(diameters[mine])
                        lines[name].append(line)
                mean, deviation, targets = columns(table, "OuterRadius_um", "OuterRadiusDeviation_um", "TargetRadius_um")
                measured = np.hypot(mean, np.nan_to_num(deviation))  # root mean square, as TargetRadius; without a cut it is the mean
                lengths, ratios = columns(table, "Length_um", "AxonDiffusivityRatio")
                whole = np.isfinite(measured) & (lengths > 0)
                inside = np.isfinite(ratios) & (lengths > 0.5 * options.side)
                made, myelin = columns(servermanager.Fetch(surfaces, idx=2), "FibreId", "Myelin")
                long = columns(table, "FibreId")[0][lengths > 0.3 * options.side]
                value = lambda name: summary.GetColumnByName(name).GetTuple1(0)
                rows = convergence.GetNumberOfRows()
                pairs = convergence.GetColumnByName("OverlappingPairs").GetTuple1(rows - 1)
                cells = [
                    f"{fraction:g}",
                    f"{variation:g}",
                    str(seed),
                    f"{measure(along_fibres(servermanager.Fetch(before), options.side))[0]:.3f}, {measure(lines['outer'])[0]:.3f}",
                    "{0:.3f}".format(*measure(lines["inner"])),
                    "{1:.2f}".format(*measure(lines["inner"])),
                    f"{np.average(ratios[inside], weights=lengths[inside]):.3f}",
                    f"{value('MeanAxonAreaFluctuation_um'):.2f}",
                    f"{value('MeanBeadAmplitude'):.2f}, {value('MeanBeadSpacing_um'):.1f}",
                    f"{value('FVF'):.4f}",
                    f"{100 * necks(servermanager.Fetch(before), options.side, options.voxel):.2f} %, {100 * (inner[np.isfinite(inner)] < 2 * options.voxel).mean():.2f} %",
                    f"{distance(measured[whole], targets[whole]):.3f}, {measured[whole].mean() / targets[whole].mean():.3f}",
                    f"{rows}, {pairs:g}",
                    f"{(myelin[np.isin(made, long)] > 0).sum()} of {len(long)}",
                    "yes" if certificate.GetColumnByName("Certified").GetTuple1(0) else "no",
                    f"{took:.1f}",
                ]
                print("| " + " | ".join(cells) + " |", flush=True)


main()
