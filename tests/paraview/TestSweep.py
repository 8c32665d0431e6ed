# SPDX-License-Identifier: BSD-3-Clause
# ctest-extended
# ctest-timeout: 300
# ctest-processors: 2
"""examples/sweep.py, by the module that the plugin holds, makes every case once, by one rank or shared by several with the same bits, makes nothing
again that is there, and its table says what the folders say. A script of one's own can do so from any folder."""

import csv
import hashlib
import json
import os
import subprocess

from cactus_testing import CactusTestCase, environment_of_its_own, main
from cactus_sweep import sweep  # which the plugin holds, once it is loaded
from vtkmodules.vtkParallelCore import vtkMultiProcessController

SCRIPT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "examples", "sweep.py")
TINY = ("--side", "5", "--voxel-size", "0.2", "--dispersions", "0", "8", "--fractions", "0.5", "--seeds", "1")
OWN = """
import sys
from paraview import simple
from cactus_sweep import sweep

def make(folder, style, seed, angle):
    if seed == 2:
        raise ValueError("no such seed")
    if seed == 4:
        sys.exit("as a script of its own ends")
    bundle = simple.BundleInitializer(Border="Walls", Side=6, MaximumRadius=0.8, NumberOfBundles=2, CrossingAngle=angle, CrossingStyle=style, Seed=seed, GrownFibreVolumeFraction=0.5, FibreVolumeFraction=0.4)
    fibres = simple.OutputPort(simple.CapsuleOptimizer(Input=bundle), 0)
    grown = simple.FibreRadialGrowth(Input=fibres, VoxelSize=0.2)
    simple.SubstrateWriter(Outer=simple.OutputPort(simple.MyelinSurface(Input=grown), 0), FolderName=folder).UpdatePipeline()

kept = simple.Sphere()
sweep(make, "mine", reached=("FVF", "MeanFancy", "Certified"), style="Sheets", seed=(seed for seed in (1, 2, 4, 3)), angle=60)
"""
RANKS = ("mpiexec", "-n", "2", "pvbatch")


def checksums(folder):
    """{file: checksum} of the surfaces and fibres below a folder."""
    found = {}
    for place, _, names in os.walk(folder):
        for name in names:
            if name.endswith((".ply", ".strands")):
                path = os.path.join(place, name)
                with open(path, "rb") as file:
                    found[os.path.relpath(path, folder)] = hashlib.sha256(file.read()).hexdigest()
    return found


class Sweep(CactusTestCase):
    def sweep(self, place, *words, start=("pvpython",)):
        command = [*start, SCRIPT, *TINY, "--output", os.path.join(self.folder, place), *words]
        done = subprocess.run(command, capture_output=True, text=True, env=environment_of_its_own())
        return done.returncode, done.stdout + done.stderr.replace("ERR|", "")

    def rows(self, place):
        with open(os.path.join(self.folder, place, "sweep.csv"), newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def test_alone_and_in_ranks(self):
        code, said = self.sweep("alone")
        self.assertEqual(code, 0, said)
        rows = self.rows("alone")
        self.assertEqual([float(row["dispersion_deg"]) for row in rows], [0.0, 8.0])
        for row in rows:
            folder = os.path.join(self.folder, "alone", f"dispersion_deg-{row['dispersion_deg']}_fraction-0.5_seed-1_side_um-5.0_voxel_um-0.2")
            with open(os.path.join(folder, "manifest.json"), encoding="utf-8") as file:
                stages = {stage["filter"]: stage["properties"] for stage in json.load(file)["provenance"]}
            self.assertEqual(stages["BundleInitializer"]["MeanDispersion"], float(row["dispersion_deg"]))
            self.assertEqual(float(row["Certified"]), 1.0)
            self.assertAlmostEqual(float(row["FVF"]), 0.5, delta=0.01)
            self.assertEqual(sum(name.endswith(".ply") for name in os.listdir(os.path.join(folder, "outer"))), float(row["OuterSurfaces"]))

        # Two ranks make one each, the same.
        code, said = self.sweep("shared", start=(*RANKS, "--sym"))
        self.assertEqual(code, 0, said)
        for rank in (0, 1):
            self.assertEqual(said.count(f"(rank {rank})"), 1, said)
        self.assertEqual(checksums(os.path.join(self.folder, "shared")), checksums(os.path.join(self.folder, "alone")))
        self.assertEqual(self.rows("shared"), rows)

        # What is there is not made again.
        self.make_one_more(rows)

    def make_one_more(self, rows):
        before = {name: os.stat(os.path.join(self.folder, "alone", name)).st_ino for name in os.listdir(os.path.join(self.folder, "alone")) if name != "sweep.csv"}
        code, said = self.sweep("alone", "--seeds", "1", "2", "--dispersions", "8")
        self.assertEqual(code, 0, said)
        self.assertEqual(said.count("(rank 0)"), 1, said)
        self.assertEqual(before, {name: os.stat(os.path.join(self.folder, "alone", name)).st_ino for name in before})
        again = self.rows("alone")
        self.assertEqual([row["seed"] for row in again], ["1", "2"])
        self.assertEqual(again[0], rows[1])

    def test_a_script_of_ones_own(self):
        """It lies anywhere; a case that fails keeps none of the others from being made; unknown quantities are empty; nothing but its own is deleted."""
        script = os.path.join(self.folder, "own.py")
        with open(script, "w", encoding="utf-8") as file:
            file.write(OWN.replace("\nsweep(", "\ntry:\n    sweep(") + "finally:\n    print('left', [name for name, _ in simple.GetSources()], len(simple.GetSources()))\n")
        done = subprocess.run(["pvpython", script], capture_output=True, text=True, env=environment_of_its_own(), cwd=self.folder)
        said = done.stdout + done.stderr.replace("ERR|", "")
        self.assertNotEqual(done.returncode, 0, said)
        self.assertIn("ValueError: no such seed", said)
        self.assertIn("as a script of its own ends", said)
        self.assertIn("2 of 4 cases are in", said)
        self.assertIn("not every case came out", said)
        self.assertRegex(said, r"left \['Sphere1'\] 1")
        rows = self.rows("mine")
        self.assertEqual([(row["style"], row["seed"], row["angle"], row["MeanFancy"]) for row in rows], [("Sheets", "1", "60", ""), ("Sheets", "3", "60", "")])
        for row in rows:
            self.assertAlmostEqual(float(row["FVF"]), 0.5, delta=0.01)
            self.assertTrue(os.path.exists(os.path.join(self.folder, "mine", f"style-Sheets_seed-{row['seed']}_angle-60", "manifest.json")))

    def test_an_interrupted_sweep_gives_the_controller_back(self):
        """Ctrl-C ends the script; what it leaves is a process of its ranks again, which the others have not waited for in vain."""
        world = vtkMultiProcessController.GetGlobalController()

        def make(_folder, seed):
            raise KeyboardInterrupt(seed)

        with self.assertRaises(KeyboardInterrupt):
            sweep(make, os.path.join(self.folder, "interrupted"), seed=[1, 2])
        self.assertIs(vtkMultiProcessController.GetGlobalController(), world)

    def test_refusals(self):
        """Ranks that would all make everything, and a table that is somebody's own."""
        code, said = self.sweep("shared", start=RANKS)
        self.assertNotEqual(code, 0)
        self.assertIn("--sym", said)
        os.mkdir(os.path.join(self.folder, "mine"))
        mine = os.path.join(self.folder, "mine", "sweep.csv")
        with open(mine, "w", encoding="utf-8") as file:
            file.write("my own")
        code, said = self.sweep("mine")
        self.assertNotEqual(code, 0)
        self.assertIn("is no table of a sweep", said)
        with open(mine, encoding="utf-8") as file:
            self.assertEqual(file.read(), "my own")
        self.assertEqual(os.listdir(os.path.join(self.folder, "mine")), ["sweep.csv"])


if __name__ == "__main__":
    main()
