# SPDX-License-Identifier: BSD-3-Clause
"""Measures what substrates take on this machine, by side, fraction, voxel and threads, and makes tables and curves of it.

    ./cactus bench performance
    ./cactus bench performance --sides 50 --fractions --voxels --threads     adds a larger one to what is there
    ./cactus bench performance --output docs --anew                          those of docs/performance.md

writes FOLDER/performance.csv, a row for each substrate; FOLDER/performance.md, tables; and FOLDER/images/performance-*.svg, curves. What is in the
folder is kept: substrates of the same settings are measured anew, others added, if they are of the same machine. --anew forgets all of it first.

Each substrate is made by a pvpython of its own, in a folder that is removed again: once by the filters, one after the other, and once by
SubstrateProduction (the larger ones, for which the filters may have no memory, by that alone: --streamed). Let nothing else run meanwhile; how much
of the machine other programs took is in the table.
"""

import argparse
import csv
import datetime
import json
import os
import re
import resource
import subprocess
import sys
import tempfile
import time

import performance_page

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
MARK = "performance: "  # before what a child has measured
CAPSULES = 2 / 3  # of the volume fraction that fibres are grown to, as among the defaults of BundleInitializer


def busy_seconds():
    """Processor time that all programs of this machine have taken."""
    with open("/proc/stat", encoding="ascii") as file:
        user, nice, system, _idle, _waiting, *rest = map(int, file.readline().split()[1:9])
    return (user + nice + system + sum(rest)) / os.sysconf("SC_CLK_TCK")


def own_seconds():
    used = resource.getrusage(resource.RUSAGE_SELF)
    return used.ru_utime + used.ru_stime


def peak_megabytes(restart=False):
    """The largest resident set of this process so far; from here on, with `restart`."""
    if restart:
        with open("/proc/self/clear_refs", "w", encoding="ascii") as file:
            file.write("5")
    with open("/proc/self/status", encoding="ascii") as file:
        return int(next(line for line in file if line.startswith("VmHWM")).split()[1]) / 1000


class Stages:
    """What is measured of one stage after the other."""

    def __init__(self):
        self.found = {}

    def run(self, name, work):
        peak_megabytes(restart=True)
        busy, own, clock = busy_seconds(), own_seconds(), time.monotonic()
        work()
        clock, own, busy = time.monotonic() - clock, own_seconds() - own, busy_seconds() - busy
        self.found[name] = {"clock_s": clock, "processor_s": own, "peak_MB": peak_megabytes(), "others_s": max(0.0, busy - own)}


def length_of(lines):
    """Of all polylines together."""
    import numpy as np
    from vtkmodules.util.numpy_support import vtk_to_numpy

    points = vtk_to_numpy(lines.GetPoints().GetData()).astype(float)
    cells = lines.GetLines()
    offsets, ids = vtk_to_numpy(cells.GetOffsetsArray()), vtk_to_numpy(cells.GetConnectivityArray())
    steps = np.linalg.norm(np.diff(points[ids], axis=0), axis=1)
    steps[offsets[1:-1] - 1] = 0  # from a fibre's end to the next one's beginning
    return steps.sum()


def make(way, side, fraction, voxel, threads, folder):
    """Makes a substrate in this process, and prints what it took."""
    from paraview import servermanager, simple

    stages = Stages()
    bundle = simple.BundleInitializer(Side=side, FibreVolumeFraction=CAPSULES * fraction, GrownFibreVolumeFraction=fraction)
    stages.run("packing", bundle.UpdatePipeline)
    optimiser = simple.CapsuleOptimizer(Input=bundle, NumberOfThreads=threads)
    stages.run("optimiser", optimiser.UpdatePipeline)
    fibres = simple.OutputPort(optimiser, 0)
    if way == "streamed":
        produced = simple.SubstrateProduction(Input=fibres, FolderName=folder, VoxelSize=voxel, NumberOfThreads=threads,
                                              Format="Surfaces alone", Encoding="Binary")
        stages.run("production", produced.UpdatePipeline)
    else:
        grown = simple.FibreRadialGrowth(Input=fibres, VoxelSize=voxel, NumberOfThreads=threads)
        stages.run("growth", grown.UpdatePipeline)
        surfaces = simple.MyelinSurface(Input=grown, NumberOfThreads=threads)
        stages.run("surfaces", surfaces.UpdatePipeline)
        given = {"Fibres": fibres, "Outer": simple.OutputPort(surfaces, 0), "Inner": simple.OutputPort(surfaces, 1), "NumberOfThreads": threads}
        certificate = simple.SubstrateCertificate(**given)
        stages.run("certificate", certificate.UpdatePipeline)
        writer = simple.SubstrateWriter(FolderName=folder, Format="Surfaces alone", Encoding="Binary", **given)
        stages.run("writer", writer.UpdatePipeline)
    with open(os.path.join(folder, "manifest.json"), encoding="utf-8") as file:
        manifest = json.load(file)
    written = sum(os.path.getsize(os.path.join(path, name)) for path, _, names in os.walk(folder) for name in names)
    print(MARK + json.dumps({
        "stages": stages.found, "fibres": manifest["fibres"], "triangles": manifest["triangles"], "certified": manifest["certified"],
        "length_um": length_of(servermanager.Fetch(optimiser, idx=0)), "folder_MB": written / 1e6,
    }))


def measured(way, side, fraction, voxel, threads):
    """The row of a substrate, which another process makes."""
    with tempfile.TemporaryDirectory() as scratch:
        settings = [str(value) for value in (way, side, fraction, voxel, threads, os.path.join(scratch, "substrate"))]
        done = subprocess.run(["pvpython", __file__, "--make", *settings], stdout=subprocess.PIPE, text=True,
                              env={**os.environ, "OMP_NUM_THREADS": str(threads)})
    said = [line for line in done.stdout.splitlines() if line.startswith(MARK)]
    if done.returncode != 0 or not said:
        sys.exit(f"performance: the substrate {' '.join(settings[:-1])} could not be made, see above")
    found = json.loads(said[0][len(MARK):])
    stages = found.pop("stages")
    whole = [stage for name, stage in stages.items() if name != "certificate"]  # the writer certifies what it writes
    clock = sum(stage["clock_s"] for stage in whole)
    row = {"way": way, "side_um": side, "fraction": fraction, "voxel_um": voxel, "threads": threads, **found,
           "certified": "yes" if found["certified"] else "no",
           "clock_s": clock, "processor_s": sum(stage["processor_s"] for stage in whole), "peak_MB": max(stage["peak_MB"] for stage in whole),
           "others_percent": 100 * sum(stage["others_s"] for stage in whole) / (clock * os.cpu_count())}
    for name, stage in stages.items():
        row.update({f"{name}_{quantity}": stage[quantity] for quantity in ("clock_s", "processor_s", "peak_MB")})
    return row


def machine():
    """What the figures are of."""
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        model = re.search(r"^model name\s*: (.*)$", file.read(), re.MULTILINE)
    with open(os.path.join(ROOT, "CMakeLists.txt"), encoding="utf-8") as file:
        version = re.search(r"^project\(Cactus VERSION ([0-9.]+)", file.read(), re.MULTILINE)[1]
    memory = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") / 1e9
    return {"processor": model[1].strip() if model else os.uname().machine, "cores": len(os.sched_getaffinity(0)),
            "memory_GB": round(memory), "version": version, "date": datetime.date.today().isoformat()}


def text_of(value):
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def add(row, path):
    """Puts a row into a table, in place of one with the same settings."""
    rows = [] if not os.path.exists(path) else performance_page.read(path)
    row = {name: text_of(row.get(name, "")) for name in performance_page.COLUMNS}
    rows = [other for other in rows if performance_page.settings(other) != performance_page.settings(row)] + [row]
    rows.sort(key=performance_page.settings)
    with open(path + ".new", "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, performance_page.COLUMNS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    os.replace(path + ".new", path)


def plan(arguments):
    """The settings of all substrates that are wanted."""
    fraction, voxel, cores = 0.9, 0.1, len(os.sched_getaffinity(0))
    ways = ["streamed"] if arguments.streamed else ["filters", "streamed"]
    wanted = [(way, side, fraction, voxel, cores) for side in arguments.sides for way in ways]
    wanted += [("filters", arguments.series_side, other, voxel, cores) for other in arguments.fractions]
    wanted += [("filters", arguments.series_side, fraction, other, cores) for other in arguments.voxels]
    wanted += [("filters", arguments.threads_side, fraction, voxel, other) for other in arguments.threads]
    return list(dict.fromkeys(wanted))


def main():
    cores = len(os.sched_getaffinity(0))
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--output", default="cactus-performance", help="folder for table and curves (%(default)s)")
    parser.add_argument("--sides", type=float, nargs="*", default=[10.0, 20.0, 30.0], help="µm (%(default)s)")
    parser.add_argument("--fractions", type=float, nargs="*", default=[0.6, 0.7, 0.8, 0.9], help="fibre volume fractions (%(default)s)")
    parser.add_argument("--voxels", type=float, nargs="*", default=[0.2, 0.15, 0.1, 0.075], help="VoxelSize, µm (%(default)s)")
    parser.add_argument("--series-side", type=float, default=15.0, help="side of the substrates for these two, µm (%(default)s)")
    threads = sorted({cores} | {2**n for n in range(20) if 2**n < cores})
    parser.add_argument("--threads", type=int, nargs="*", default=threads, help="numbers of threads (%(default)s)")
    parser.add_argument("--threads-side", type=float, default=20.0, help="side of the substrates for these, µm (%(default)s)")
    parser.add_argument("--streamed", action="store_true", help="make those of --sides by SubstrateProduction alone")
    parser.add_argument("--anew", action="store_true", help="forget what has been measured before")
    parser.add_argument("--repeats", type=int, default=1, help="of each substrate, of which the one with the median clock is kept (%(default)s)")
    parser.add_argument("--make", nargs=6, metavar="SETTING", help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.make:
        way, side, fraction, voxel, threads, folder = arguments.make
        return make(way, float(side), float(fraction), float(voxel), int(threads), folder)

    here = machine()
    path = os.path.join(arguments.output, "performance.csv")
    before = arguments.anew and os.path.exists(path)
    if os.path.exists(path) and not before:
        for row in performance_page.read(path):
            if (row["processor"], row["cores"]) != (here["processor"], str(here["cores"])):
                sys.exit(f"performance: {path} is of another machine ({row['cores']} cores of {row['processor']}): name another folder with --output")
    os.makedirs(os.path.join(arguments.output, "images"), exist_ok=True)
    for settings in plan(arguments):
        rows = sorted((measured(*settings) for _ in range(max(1, arguments.repeats))), key=lambda row: row["clock_s"])
        row = rows[(len(rows) - 1) // 2]
        if before:
            os.remove(path)  # now that something takes its place
            before = False
        add({**here, **row}, path)
        way, side, fraction, voxel, threads = settings
        print(f"{way}, {side:g} µm, {fraction:g}, voxels of {voxel:g} µm, {threads} thread{'s' * (threads > 1)}: {row['clock_s']:.1f} s by the clock, "
              f"{row['processor_s']:.1f} s of processor time, {row['peak_MB']:.0f} MB; others took {row['others_percent']:.0f} % of the machine", flush=True)
    performance_page.write(arguments.output)
    print(f"Wrote {arguments.output}/performance.md")
    return 0


if __name__ == "__main__":
    sys.exit(main())
