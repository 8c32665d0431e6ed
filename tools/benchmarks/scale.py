# SPDX-License-Identifier: BSD-3-Clause
"""Measures what a production takes per µm of fibre, per voxel and per triangle, on several ranks, and predicts larger ones from that.

    ./cactus bench scale
    ./cactus bench scale --sides 10 14 20 --ranks 1x2 2x1 --predict 500x31370x64 1000x125500x256

--ranks are ranks x threads of each, --predict side (µm) x fibres x cores. Every size is made by SubstrateProduction from the same kind of
bundle, in folders that are removed again. Processor time is that of all ranks, waiting for each other included; on a machine that does
other things, too, it says more than the clock. Memory of a rank is its largest resident set, and beside it what it adds to the memory of the
machine: pages that ranks have in common, which are ParaView's libraries for the most part, count once.
"""

import argparse
import json
import os
import shutil
import subprocess
import sys
import tempfile
import time

import numpy as np

MADE = """
import sys
from paraview.simple import *
side, threads, folder, voxel = float(sys.argv[1]), int(sys.argv[2]), sys.argv[3], float(sys.argv[4])
strands = folder + ".strands"
if threads == 0:
    bundle = BundleInitializer(Side=side, MeanDispersion=5, GammaShape=6, GammaScale=0.258, MaximumRadius=2.5, GrownFibreVolumeFraction=0.9)
    SaveData(strands, proxy=OutputPort(CapsuleOptimizer(Input=bundle), 0))
else:
    made = SubstrateProduction(Input=StrandReader(FileName=strands), FolderName=folder, NumberOfThreads=threads, VoxelSize=voxel)
    made.Format, made.Encoding, made.TargetFibreVolumeFraction = "Surfaces alone", "Binary", 0.9
    print("begins", flush=True)
    made.UpdatePipeline()
    print("ends", flush=True)
"""


def first_environment():
    """What this process was started with: MPI has added to it since, and what runs with that is no run of its own."""
    with open("/proc/self/environ", "rb") as file:
        return dict(entry.split(b"=", 1) for entry in file.read().split(b"\0") if b"=" in entry)


def in_common(processes):
    """Of the resident sets of processes that live (MB), the pages that others use, too."""
    found = {}
    for process in processes:
        try:
            with open(f"/proc/{process}/smaps_rollup") as file:
                found[process] = sum(int(line.split()[1]) / 1024 for line in file if line.startswith(("Shared_Clean:", "Shared_Dirty:")))
        except OSError:
            pass
    return found


def ranks_below(process):
    """Processor time (s) and largest resident set (MB) of each pvbatch that a process has started, as far as they live."""
    found, parents = {}, [process]
    while parents:
        try:
            with open(f"/proc/{parents[0]}/task/{parents[0]}/children") as file:
                children = file.read().split()
            with open(f"/proc/{parents[0]}/stat") as file:
                name, rest = file.read().rsplit(")", 1)
            with open(f"/proc/{parents[0]}/status") as file:
                peak = [line for line in file if line.startswith("VmHWM")]
        except OSError:
            children, name, peak = [], "", []
        if peak and "pvbatch" in name and not any("pvbatch" in child for child in children):
            fields = rest.split()
            seconds = (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")
            found[parents[0]] = (seconds, int(peak[0].split()[1]) / 1024)
        parents = parents[1:] + children
    return found


def run(ranks, *arguments):
    """Processor time from beginning to end, the clock's, and of the rank with the most memory its largest resident set and what it
    adds to the memory of the machine (MB), of the script above."""
    with tempfile.NamedTemporaryFile("w", suffix=".py") as script:
        script.write(MADE)
        script.flush()
        command = ["mpiexec", "-n", str(ranks), "pvbatch", script.name, *map(str, arguments)]
        environment = {**first_environment(), b"OMP_NUM_THREADS": str(max(1, int(arguments[1]))).encode()}  # MPI's settings are the launcher's
        process = subprocess.Popen(command, stdout=subprocess.PIPE, env=environment)
        os.set_blocking(process.stdout.fileno(), False)
        usage, before, common, said, begun, clock, weighed = {}, {}, {}, b"", None, 0.0, 0.0
        while process.poll() is None:
            usage.update(ranks_below(process.pid))
            said += process.stdout.read() or b""
            if begun is None and b"begins" in said:
                begun, before = time.monotonic(), dict(usage)
            if begun is not None and not clock and b"ends" in said:
                clock = time.monotonic() - begun
            if begun is not None and not clock and time.monotonic() > weighed + 1.0:
                common.update(in_common(usage))
                weighed = time.monotonic()
            time.sleep(0.05)
        if process.returncode != 0:
            raise SystemExit(f"scale: {' '.join(command)} failed")
    seconds = sum(used - before.get(number, (0, 0))[0] for number, (used, _) in usage.items())
    resident, number = max(((memory, number) for number, (_, memory) in usage.items()), default=(0.0, None))
    return seconds, clock, resident, resident - common.get(number, 0.0) * (1.0 - 1.0 / ranks)


def measure(side, ranks, threads, voxel, folder):
    """One row: what was made, and what it took."""
    strands = folder + ".strands"
    if not os.path.exists(strands):
        run(1, side, 0, folder, voxel)
    seconds, clock, memory, own = run(ranks, side, threads, folder, voxel)
    with open(os.path.join(folder, "manifest.json"), encoding="utf-8") as file:
        manifest = json.load(file)
    written = sum(os.path.getsize(os.path.join(path, name)) for path, _, names in os.walk(folder) for name in names)
    shutil.rmtree(folder)
    return {"side": side, "ranks": ranks, "threads": threads, "fibres": manifest["fibres"], "length": 1.01 * side * manifest["fibres"],
            "triangles": manifest["triangles"], "bytes": written, "seconds": seconds, "clock": clock, "memory": memory,
            "own": own, "certified": manifest["certified"]}


def line(sizes, figures):
    """(at nothing, per size), both not negative."""
    slope, start = np.polyfit(sizes, figures, 1) if len(set(sizes)) > 1 else (figures[0] / sizes[0], 0.0)
    return (start, slope) if start > 0 and slope > 0 else (0.0, float(np.dot(sizes, figures) / np.dot(sizes, sizes)))


def model(rows):
    """The constants, from the rows of one rank."""
    rows = [row for row in rows if row["ranks"] == 1] or rows
    lengths = np.array([row["length"] for row in rows])
    fixed, per_length = line(lengths, np.array([row["seconds"] for row in rows]))
    memory, memory_per_length = line(lengths, np.array([row["memory"] for row in rows]))
    triangles = sum(row["triangles"] for row in rows)
    return {"seconds": fixed, "seconds_per_um": per_length, "memory_MB": memory, "memory_MB_per_um": memory_per_length,
            "triangles_per_um": triangles / lengths.sum(), "bytes_per_triangle": sum(row["bytes"] for row in rows) / triangles}


def predicted(constants, side, fibres, cores):
    """Hours on so many cores, if all are busy all the time; triangles; GB of the folder, and of the work folder meanwhile."""
    length = 1.01 * side * fibres
    hours = (constants["seconds"] + constants["seconds_per_um"] * length) / cores / 3600
    triangles = constants["triangles_per_um"] * length
    return hours, triangles, triangles * constants["bytes_per_triangle"] / 1e9, 17 * triangles / 1e9


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--sides", type=float, nargs="+", default=[10, 14, 20], help="µm (%(default)s)")
    parser.add_argument("--ranks", nargs="+", default=["1x2", "2x1"], help="ranks x threads (%(default)s)")
    parser.add_argument("--predict", nargs="+", default=["500x31370x64", "1000x125500x256"], help="side x fibres x cores (%(default)s)")
    parser.add_argument("--voxel", type=float, default=0.1, help="VoxelSize, µm (%(default)s)")
    arguments = parser.parse_args()
    rows = []
    print("| side (µm) | fibres | ranks x threads | processor time (s) | clock (s) | ms per µm of fibre | memory of a rank (MB) | its own (MB) | triangles per µm | certified |")
    print("|" + "---|" * 10, flush=True)
    with tempfile.TemporaryDirectory() as scratch:
        for side in arguments.sides:
            for setting in arguments.ranks:
                ranks, threads = map(int, setting.split("x"))
                row = measure(side, ranks, threads, arguments.voxel, os.path.join(scratch, f"side-{side:g}"))
                rows.append(row)
                print(f"| {side:g} | {row['fibres']} | {setting} | {row['seconds']:.1f} | {row['clock']:.1f} | {1000 * row['seconds'] / row['length']:.2f} | "
                      f"{row['memory']:.0f} | {row['own']:.0f} | {row['triangles'] / row['length']:.0f} | {'yes' if row['certified'] else 'NO'} |", flush=True)
    constants = model(rows)
    print("\n" + "\n".join(f"{name}: {value:.4g}" for name, value in constants.items()))
    print("\n| side (µm) | fibres | cores | hours | triangles (10⁹) | folder (GB) | work folder (GB) |\n|" + "---|" * 7)
    for wanted in arguments.predict:
        side, fibres, cores = map(int, wanted.split("x"))
        hours, triangles, folder, work = predicted(constants, side, fibres, cores)
        print(f"| {side} | {fibres} | {cores} | {hours:.1f} | {triangles / 1e9:.2f} | {folder:.0f} | {work:.0f} |")


if __name__ == "__main__":
    sys.exit(main())
