# SPDX-License-Identifier: BSD-3-Clause
"""Runs Camino by the commands of README.txt, and our own walk on the same surfaces: diffusivities beside each other.

    git clone https://github.com/ozermetin/camino    # a copy of Camino with its classes; it needs Java
    python3 tools/benchmarks/simulators/camino.py --side 5 --walkers 100 camino/bin/datasynth build/release/bin

Walkers, steps, the acquisition and -p are replaced in the commands: -p 1e-20 in place of 0 spares Camino a test of each walker against
all triangles after each step, and pulses are so short (1/200 of --time, ms) and weak (b D = 0.1) that -ln(S)/b is the diffusivity by the
mean squared displacement, which our walk tells. Camino takes a pulse for whole steps, so that its b is another one (a sixth less here):
what it finds is taken over what it finds in free water. Both walks have steps of --step. Errors are standard errors; Camino's is that of
the mean of 1 - cos(phase) over the walkers, which for small phases is half their mean square.
"""

import argparse
import json
import math
import os
import re
import struct
import subprocess
import tempfile

GYROMAGNETIC = 267.51525e6  # rad/(s·T), as Camino has it
FREE = 2e-9  # m²/s


def scheme(time, b):
    """An acquisition along x, y and z after `time` (s)."""
    pulse = time / 200
    gradient = math.sqrt(b / (time - pulse / 3)) / (GYROMAGNETIC * pulse)
    lines = [f"{direction} {gradient:.9g} {time:.9g} {pulse:.9g} {time + pulse:.9g}" for direction in ("1 0 0", "0 1 0", "0 0 1")]
    return "\n".join(["VERSION: STEJSKALTANNER", f"0 0 1 0 {time:.9g} {pulse:.9g} {time + pulse:.9g}", *lines]) + "\n"


def decay(program, folder, words):
    """-ln(S) along x, y and z."""
    done = subprocess.run([os.path.abspath(program), *words], cwd=folder, capture_output=True)
    if done.returncode != 0 or not done.stdout:
        raise SystemExit(f"datasynth {' '.join(words)}\nended with {done.returncode}: {done.stderr.decode()[-500:]}")
    signal = struct.unpack(f">{len(done.stdout) // 4}f", done.stdout)
    return [-math.log(value / signal[0]) for value in signal[1:]]


def camino(program, folder, where, arguments):
    """µm²/ms along x, y and z by Camino, with errors."""
    time = 1e-3 * arguments.time
    with open(os.path.join(folder, "README.txt")) as file:
        command = re.search(rf"    datasynth (.*-initial {where}(?:.*\\\n)*.*) > {where}.bfloat", file.read()).group(1).replace("\\\n", " ")
    with open(os.path.join(folder, "short.scheme"), "w") as file:
        file.write(scheme(time, 0.1 / FREE))
    steps = math.ceil(6 * FREE * time * 1.005 / (1e-6 * arguments.step) ** 2)
    for name, value in (("walkers", arguments.walkers), ("tmax", steps), ("schemefile", "short.scheme"), ("p", "1e-20")):
        command = re.sub(rf"-{name} \S+", f"-{name} {value}", command)
    free = f"-walkers 20000 -tmax {steps} -p 0 -voxels 1 -initial uniform -diffusivity {FREE} -substrate empty -schemefile short.scheme"
    unhindered = sum(decay(program, folder, free.split())) / 3
    found = [1e9 * FREE * value / unhindered for value in decay(program, folder, command.split())]
    return found, [value * math.sqrt(2 / arguments.walkers) for value in found]


def own(program, folder, arguments):
    """The same inside and outside by our walk in the surfaces of a folder."""
    steps = math.ceil(6e9 * FREE * arguments.time / arguments.step**2)
    walk = subprocess.run([program, "--walkers", "3000", "--steps", str(steps), "--step", str(arguments.step), folder], check=True, capture_output=True)
    found = json.loads(walk.stdout)
    return {where: [square / (2 * arguments.time) for square in found[name]["squared_displacement_um2"]] for where, name in (("intra", "inner"), ("extra", "outside"))}


def grown(program, folder, side, name):
    recipe = os.path.join(folder, "recipe.json")
    with open(recipe, "w") as file:
        json.dump({"BundleInitializer": {"Side": side}, "SubstrateWriter": {"Format": name}}, file)
    substrate = os.path.join(folder, name)
    subprocess.run([program, recipe, "--output", substrate, "--progress", "0"], check=True, capture_output=True)
    return substrate


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--side", type=float, default=5)
    parser.add_argument("--walkers", type=int, default=100)
    parser.add_argument("--time", type=float, default=1, help="ms")
    parser.add_argument("--step", type=float, default=0.05, help="µm")
    parser.add_argument("datasynth", help="Camino's")
    parser.add_argument("programs", help="the folder of cactus-grow and cactus_random_walk")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        grow = os.path.join(arguments.programs, "cactus-grow")
        surfaces = grown(grow, folder, arguments.side, "Surfaces alone")
        ours = own(os.path.join(arguments.programs, "cactus_random_walk"), surfaces, arguments)
        substrate = grown(grow, folder, arguments.side, "Camino")
        print("| | diffusivity (µm²/ms) along x | y | z |\n|---|---|---|---|")
        for where in ("intra", "extra"):
            print(f"| {where}, our walk |", " | ".join(f"{value:.3f}" for value in ours[where]), "|", flush=True)
            cells = (f"{value:.3f} ± {error:.3f}" for value, error in zip(*camino(arguments.datasynth, substrate, where, arguments)))
            print(f"| {where}, Camino |", " | ".join(cells), "|", flush=True)


if __name__ == "__main__":
    main()
