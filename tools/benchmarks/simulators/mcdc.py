# SPDX-License-Identifier: BSD-3-Clause
"""Runs MC/DC on a substrate folder and prints how fast its walkers are, beside walkers of our own, as rows of a Markdown table.

    ./cactus pvpython tools/benchmarks/simulators/mcdc.py --walkers 400 --milliseconds 3 -- MC-DC_Simulator FOLDER

The configurations are the folder's, with fewer walkers and a shorter duration; steps are as long as they have them (--step takes
others). Inside, walkers of both programs start anywhere in the axons and the figure is the mean squared displacement over 2 t; ours is
cactus_random_walk (tests/tools), which shares no code with the product. Outside, they start in the box of extra.conf, and ours, the walk
of SubstrateStatistics, anywhere outside the fibres; the figure is how much the mean squared displacement grows in the second half of
the time, over that of free walkers. Behind ± is the standard error. The last row is how many of MC/DC's walkers outside have left the
domain, and what the manifest says of the whole duration.
"""

import argparse
import json
import math
import os
import re
import subprocess
import tempfile

import numpy as np
from paraview import servermanager
from paraview.simple import OutputPort, SubstrateReader, SubstrateStatistics

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__)))))
RECORDED = 40  # times at which positions are written


def number(conf, key):
    return float(re.search(rf"^{key} (\S+)$", conf, re.MULTILINE).group(1))


def changed(conf, **lines):
    for key, value in lines.items():
        conf = re.sub(rf"^{key} .*$", f"{key} {value}", conf, flags=re.MULTILINE)
    return conf


def simulate(program, folder, compartment, domain, options):
    """Positions (µm) of walkers by walker, time (RECORDED + 1 of them) and axis; diffusivity (µm²/ms); and the length of a step (µm)."""
    with open(os.path.join(folder, "mcdc", compartment + ".conf"), encoding="utf-8") as file:
        conf = file.read()
    time, diffusivity = options.milliseconds / 1e3, number(conf, "diffusivity")
    steps = number(conf, "T") * time / number(conf, "duration")
    if options.step:
        steps = 6e12 * diffusivity * time / options.step**2
    steps = RECORDED * math.ceil(steps / RECORDED)
    conf = changed(conf, N=options.walkers, T=steps, duration=time, num_process=options.processes, write_txt=0, write_bin=1,
                   write_traj_file=1, exp_prefix="output/" + compartment, scheme_file="b0.scheme")
    if options.sphere:
        conf = changed(conf, sphere_size=options.sphere)
    if compartment == "intra":
        corners = "\n".join(" ".join(f"{value / 1e3:.9g}" for value in corner) for corner in (domain[::2], domain[1::2]))
        starts = r"<spawning_area>[^<]*</spawning_area>\nini_walkers_pos intra\n|ini_walkers_file [^\n]*\n"
        conf = re.sub(starts, f"<spawning_area>\n{corners}\n</spawning_area>\nini_walkers_pos intra\n", conf)
    times = " ".join(str(steps * i // RECORDED) for i in range(RECORDED + 1))
    conf = conf.replace("<END>", f"<log>\n<positions>\n{times}\n</positions>\n</log>\n<END>")
    with tempfile.TemporaryDirectory() as scratch:
        for name in os.listdir(folder):
            os.symlink(os.path.abspath(os.path.join(folder, name)), os.path.join(scratch, name))
        os.mkdir(os.path.join(scratch, "output"))
        for name, text in (("run.conf", conf), ("b0.scheme", f"VERSION: STEJSKALTANNER\n0 0 1 0 {time / 2} {time / 4} {time}\n")):
            with open(os.path.join(scratch, name), "w", encoding="utf-8") as file:
                file.write(text)
        subprocess.run([os.path.abspath(program), "--conf", "run.conf"], cwd=scratch, check=True, stdout=subprocess.DEVNULL)
        paths = [os.path.join(scratch, "output", f"{compartment}_{i}.traj") for i in range(options.processes)]
        numbers = np.concatenate([np.fromfile(path, np.float32) for path in paths])
    return 1e3 * numbers.reshape(-1, RECORDED + 1, 3).astype(float), 1e9 * diffusivity, math.sqrt(6e12 * diffusivity * time / steps)


def mean_and_error(values):
    return np.column_stack([values.mean(axis=0), values.std(axis=0) / math.sqrt(len(values))])


def cells(figures):
    return " | ".join(f"{value:.3f} ± {error:.3f}" if error else f"{value:.3f}" for value, error in figures)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", help="MC-DC_Simulator")
    parser.add_argument("folder", help="a substrate folder, Format MC/DC, with inner surfaces and fibres.strands")
    parser.add_argument("--walkers", type=int, default=400, help="of MC/DC; ours are ten times as many")
    parser.add_argument("--milliseconds", type=float, default=3.0)
    parser.add_argument("--processes", type=int, default=1)
    parser.add_argument("--step", type=float, help="µm, in place of that of the configurations")
    parser.add_argument("--sphere", type=float, help="sphere_size, in place of that of the configurations")
    parser.add_argument("--compartments", nargs="+", default=["intra", "extra"])
    parser.add_argument("--walk", default=os.path.join(ROOT, "build/release/bin/cactus_random_walk"), help="where that program is")
    options = parser.parse_args()
    with open(os.path.join(options.folder, "manifest.json"), encoding="utf-8") as file:
        manifest = json.load(file)
    domain = manifest["domain"]
    print("| | step (µm) | x | y | z |\n|---|---|---|---|---|")
    if "intra" in options.compartments:
        places, diffusivity, step = simulate(options.program, options.folder, "intra", domain, options)
        moved = (places[:, -1] - places[:, 0]) ** 2 / (2 * options.milliseconds)
        print(f"| inside, MC/DC (µm²/ms) | {step:.3f} | {cells(mean_and_error(moved))} |", flush=True)
        steps = round(6 * diffusivity * options.milliseconds / step**2)
        walk = [options.walk, "--walkers", str(10 * options.walkers), "--steps", str(steps), "--step", repr(step), options.folder]
        inner = json.loads(subprocess.run(walk, check=True, capture_output=True, text=True).stdout)["inner"]
        own = np.array(inner["squared_displacement_um2"]) / (2 * options.milliseconds)
        errors = moved.std(axis=0) / math.sqrt(10 * options.walkers)
        print(f"| inside, cactus_random_walk (µm²/ms) | {step:.3f} | {cells(zip(own, errors))} |", flush=True)
    if "extra" in options.compartments:
        places, diffusivity, step = simulate(options.program, options.folder, "extra", domain, options)
        squares = (places - places[:, :1]) ** 2
        grown = (squares[:, -1] - squares[:, RECORDED // 2]) / (diffusivity * options.milliseconds)
        print(f"| outside, MC/DC, over free | {step:.3f} | {cells(mean_and_error(grown))} |", flush=True)
        substrate = SubstrateReader(FileName=os.path.join(options.folder, "manifest.json"))
        statistics = SubstrateStatistics(Outer=OutputPort(substrate, 0), Fibres=OutputPort(substrate, 2), ExtraAxonalWalkers=10 * options.walkers,
                                         WalkDistance=math.sqrt(2 * diffusivity * options.milliseconds), WalkStep=step)
        statistics.UpdatePipeline()
        table = servermanager.Fetch(statistics)
        own = [[table.GetColumnByName(f"ExtraAxonalDiffusivity{what}{axis}").GetValue(0) for what in ("Ratio", "Error")] for axis in "XYZ"]
        print(f"| outside, SubstrateStatistics, over free | {step:.3f} | {cells(own)} |")
        isOut = ((places < domain[::2]) | (places > domain[1::2])).any(axis=(1, 2)).mean()
        said = manifest.get("extra_walkers_leaving")
        print(f"\nLeft the domain in {options.milliseconds:g} ms: {isOut:.3f} ± {math.sqrt(isOut * (1 - isOut) / len(places)):.3f} "
              f"of MC/DC's walkers outside; by the manifest, in the configuration's duration: {said}")


if __name__ == "__main__":
    main()
