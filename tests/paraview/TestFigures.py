# SPDX-License-Identifier: BSD-3-Clause
# ctest-extended
# ctest-needs: display
# ctest-timeout: 600
"""./cactus figures makes every figure of the paper, with a table whose numbers are those asked for, and replaces nothing that is not as it
has written it; cuts show surfaces where they are, by formula."""

import csv
import math
import os
import subprocess
import sys

import numpy
import surfaces
from cactus_testing import CactusTestCase, main, produce
from paraview import simple
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
SCRIPT = os.path.join(ROOT, "tools", "scripts", "figures.py")
FOLDER = os.path.join(ROOT, "examples", "figures")
NAMES = ["pipeline", "capsules", "dispersion", "crossings", "histology", "sizes", "seeds", "single_fibres"]
sys.path.append(os.path.join(ROOT, "examples"))
from picture import section_view  # noqa: E402  (which is in another folder)


def pixels(path):
    reader = vtkPNGReader()
    reader.SetFileName(path)
    reader.Update()
    width, height, _ = reader.GetOutput().GetDimensions()
    return vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars()).reshape(height, width, -1)


class Figures(CactusTestCase):
    def run_script(self, *command):
        done = subprocess.run(["pvpython", *command], capture_output=True, text=True)
        return done.returncode, done.stdout + done.stderr.replace("ERR|", "")

    def figures(self, *words):
        return self.run_script(SCRIPT, *words)

    def table(self, name):
        with open(os.path.join(self.folder, f"{name}.csv"), newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def test_every_figure_is_listed(self):
        code, said = self.figures("--list")
        self.assertEqual(code, 0, said)
        self.assertEqual([line.split()[0] for line in said.splitlines()], NAMES)

    def make(self, name, *words, script=None):
        code, said = self.run_script(script or os.path.join(FOLDER, f"{name}.py"), "--output", self.folder, *words)
        self.assertEqual(code, 0, said)
        self.assertGreater(numpy.ptp(pixels(os.path.join(self.folder, f"{name}.png")).astype(int)), 100)

    def test_pipeline(self):
        self.make("pipeline", "--side", "7", "--voxel-size", "0.25")
        for row in self.table("pipeline"):
            self.assertGreater(int(row["overlapping_pairs_before"]), 0)
            self.assertEqual(int(row["overlapping_pairs_after"]), 0)

    def make_rows(self, name, rows):
        """A figure of some of the paper's rows alone, {name of a table in examples/paper.py: rows}."""
        script = os.path.join(self.folder, "some.py")
        with open(script, "w", encoding="utf-8") as file:
            file.write(f"import runpy, sys\nsys.path.insert(0, {os.path.join(ROOT, 'examples')!r})\nimport paper\n")
            file.writelines(f"paper.{table} = {{row: paper.{table}[row] for row in {kept}}}\n" for table, kept in rows.items())
            file.write(f"sys.path.insert(0, {FOLDER!r})\nrunpy.run_path({os.path.join(FOLDER, name + '.py')!r}, run_name='__main__')\n")
        self.make(name, "--side", "6", "--voxel-size", "0.25", "--fraction", "0.85", script=script)
        for row in self.table(name):
            self.assertEqual(row["certified"], "yes")
            self.assertAlmostEqual(float(row["FVF"]), 0.85, delta=0.015)

    def test_dispersion(self):
        self.make_rows("dispersion", {"DISPERSION": [0, 5]})
        self.assertEqual([row["dispersion_deg"] for row in self.table("dispersion")], ["0", "5"])

    def test_crossings(self):
        self.make_rows("crossings", {"CROSSING": [60]})
        self.assertEqual([row["paper_FVF"] for row in self.table("crossings")], ["0.935"])

    def test_histology(self):
        self.make("histology", "--side", "6", "--voxel-size", "0.1")
        for row in self.table("histology"):
            for name in ("AVF", "MVF", "FVF"):
                self.assertAlmostEqual(float(row[name]), float(row[f"target_{name}"]), delta=0.01)
            self.assertAlmostEqual(float(row["g"]), math.sqrt(float(row["AVF"]) / float(row["FVF"])), delta=1e-3)

    def test_sizes(self):
        self.make("sizes", "--side", "20", "--voxel-size", "0.4")
        rows = self.table("sizes")
        self.assertEqual([float(row["side_um"]) for row in rows], [4.0, 8.0, 12.0, 20.0])
        self.assertLess(float(rows[-1]["KS_distance"]), float(rows[0]["KS_distance"]))

    def test_single_fibres(self):
        self.make("single_fibres", "--side", "8", "--voxel-size", "0.2")
        for row in self.table("single_fibres"):
            for kind in ("outer", "inner"):
                self.assertAlmostEqual(float(row[f"{kind}_diameter_um"]), float(row[f"target_{kind}_diameter_um"]), delta=0.1)

    def test_seeds(self):
        """The fewer the seed points, the less round the fibres, of the same thickness."""
        self.make("seeds", "--side", "7")
        rows = self.table("seeds")
        self.assertEqual([row["certified"] for row in rows], ["yes"] * 3)
        circularity, radius = ([float(row[name]) for row in rows] for name in ("circularity", "mean_radius_um"))
        self.assertGreater(circularity[0], circularity[1] + 0.005)
        self.assertGreater(circularity[1], circularity[2] + 0.005)
        self.assertLess(max(radius) - min(radius), 0.03 * radius[0])

    def test_what_is_not_ours_stays(self):
        script, words = os.path.join(FOLDER, "capsules.py"), ("--side", "5", "--output", self.folder)
        code, said = self.figures("capsules", *words)
        self.assertEqual(code, 0, said)
        picture = os.path.join(self.folder, "capsules.png")
        with open(picture, "ab") as file:
            file.write(b"my own")
        with open(picture, "rb") as file:
            mine = file.read()
        code, said = self.run_script(script, *words)
        self.assertNotEqual(code, 0)
        self.assertIn("is not as ./cactus figures has written it", said)
        with open(picture, "rb") as file:
            self.assertEqual(file.read(), mine)
        with open(os.path.join(self.folder, "figures.json"), "w", encoding="utf-8") as file:
            file.write("{}")
        code, said = self.run_script(script, *words)
        self.assertNotEqual(code, 0)
        self.assertIn("figures.json is there already", said)

    def test_a_figure_that_there_is_not(self):
        code, said = self.figures("capsule")
        self.assertNotEqual(code, 0)
        self.assertIn("there is no figure capsule", said)

    def shares(self, outer, inner, **plane):
        """How much of a cut of 10 µm is myelin, axon and neither."""
        path = os.path.join(self.folder, "cut.png")
        view = section_view([(outer, [0, 0, 0]), (inner, [0.5, 0.5, 0.5])], 10.0, 500, **plane)
        simple.SaveScreenshot(path, view, ImageResolution=[500, 500])
        simple.Delete(view)
        grey = pixels(path)[:, :, 0].astype(int)
        return [numpy.count_nonzero(abs(grey - value) < 40) / grey.size * 100.0 for value in (0, 127, 255)]

    def test_a_cut_shows_what_is_there(self):
        """Across two straight tubes, and at an angle, where circles become ellipses."""
        _, outer, inner = (produce(data) for data in surfaces.two_tubes())
        tilt = math.radians(35)
        for plane, stretch in (({}, 1.0), ({"normal": (math.sin(tilt), 0.0, math.cos(tilt)), "up": (0.0, 1.0, 0.0)}, 1.0 / math.cos(tilt))):
            outside, within = ([r * r * surfaces.POLYGON * stretch for r in radii] for radii in ((1.0, 1.5), (0.7, 0.9)))
            found = self.shares(outer, inner, **plane)
            for share, wanted in zip(found, (sum(outside) - sum(within), sum(within), 100.0 - sum(outside))):
                self.assertAlmostEqual(share, wanted, delta=0.3)


if __name__ == "__main__":
    main()
