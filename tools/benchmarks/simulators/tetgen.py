# SPDX-License-Identifier: BSD-3-Clause
"""Fills substrates with tetrahedra by tetgen and prints what it took, as rows of a table.

    python3 tools/benchmarks/simulators/tetgen.py --side 8 --gaps 0.02 0.1 --angles 0 20 --errors 0.005 -- build/release/bin/cactus-grow

Triangles are those of the surfaces; tetgen has --limit seconds of the processor for each row.
"""

import argparse
import json
import os
import re
import resource
import signal
import subprocess
import tempfile


def tetrahedra(folder, limit):
    """(tetrahedra, seconds of the processor) of `tetgen -pqA`, or None where it has not ended in time."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    path = os.path.join(folder, "substrate_dir", "substrate_mesh.poly")
    done = subprocess.run(["tetgen", "-pqA", path], capture_output=True, text=True, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (limit, limit)))
    if done.returncode == -signal.SIGXCPU:
        return None
    done.check_returncode()
    found = re.findall(r"Mesh tetrahedra: (\d+)", done.stdout)
    return int(found[-1]) if found else 0, resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before


def grown(program, folder, side, fraction, gap, angle, error):
    """Writes a substrate for SpinDoctor, and counts the triangles of its surfaces."""
    recipe = os.path.join(folder, "recipe.json")
    with open(recipe, "w") as file:
        json.dump({"BundleInitializer": {"Side": side}, "FibreRadialGrowth": {"MinimumGap": gap, "TargetFibreVolumeFraction": fraction},
                   "MyelinSurface": {"MinimumAngle": angle, "DecimationError": error}, "SubstrateWriter": {"Format": "SpinDoctor"}}, file)
    substrate = os.path.join(folder, "substrate")
    subprocess.run([program, recipe, "--output", substrate, "--progress", "0"], check=True, capture_output=True)
    with open(os.path.join(substrate, "manifest.json")) as file:
        return substrate, json.load(file)["triangles"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--side", type=float, default=8)
    parser.add_argument("--fraction", type=float, default=0.8, help="TargetFibreVolumeFraction")
    parser.add_argument("--gaps", type=float, nargs="+", default=[0.02, 0.1], help="MinimumGap")
    parser.add_argument("--angles", type=float, nargs="+", default=[0, 20], help="MinimumAngle")
    parser.add_argument("--errors", type=float, nargs="+", default=[0.005], help="DecimationError")
    parser.add_argument("--limit", type=int, default=240)
    parser.add_argument("program", help="cactus-grow")
    arguments = parser.parse_args()
    print("| MinimumGap | MinimumAngle | DecimationError | triangles | tetrahedra | seconds |\n|" + 6 * "---|", flush=True)
    for gap in arguments.gaps:
        for angle in arguments.angles:
            for error in arguments.errors:
                with tempfile.TemporaryDirectory() as folder:
                    substrate, triangles = grown(arguments.program, folder, arguments.side, arguments.fraction, gap, angle, error)
                    found = tetrahedra(substrate, arguments.limit)
                end = f"{found[0]:,} | {found[1]:.0f}" if found else f"none | over {arguments.limit:g}"
                print(f"| {gap:g} | {angle:g} | {error:g} | {triangles:,} | {end} |", flush=True)


if __name__ == "__main__":
    main()
