# SPDX-License-Identifier: BSD-3-Clause
# ctest-extended
# ctest-timeout: 200
# ctest-needs: display
"""The example that plays the optimiser's history: fibres lie in each other in the first picture of its film strip, and not in the last one; the
animation is a film."""

import os
import subprocess

import numpy
from cactus_testing import CactusTestCase, main
from paraview.vtk.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

SCRIPT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "examples", "disentangling.py")


def reddish(picture):
    """How many pixels are clearly red."""
    return numpy.count_nonzero((picture[:, :, 0] > 1.5 * picture[:, :, 1]) & (picture[:, :, 0] > 60))


class Disentangling(CactusTestCase):
    def run_script(self):
        return subprocess.run(
            ["pvpython", SCRIPT, "--side", "6", "--dispersion", "10", "--interval", "20", "--pictures", "3", "--output", self.folder], capture_output=True, text=True, check=False
        )

    def test_the_film_strip_shows_fibres_come_apart(self):
        made = self.run_script()
        self.assertEqual(made.returncode, 0, made.stderr)
        self.assertRegex(made.stdout, r"^[1-9][0-9]* overlapping pairs at first, 0 after [1-9][0-9]* iterations")
        reader = vtkPNGReader()
        reader.SetFileName(os.path.join(self.folder, "film-strip.png"))
        reader.Update()
        width, height, _ = reader.GetOutput().GetDimensions()
        self.assertEqual(width, 3 * height)
        strip = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars()).reshape(height, width, -1).astype(int)
        first, _, last = (strip[:, i * height : (i + 1) * height] for i in range(3))
        self.assertGreater(reddish(first), 500)
        self.assertLess(reddish(last), 0.1 * reddish(first))
        with open(os.path.join(self.folder, "disentangling.ogv"), "rb") as file:
            self.assertEqual(file.read(4), b"OggS")
        self.assertGreater(os.path.getsize(os.path.join(self.folder, "disentangling.ogv")), 20000)

    def test_nothing_is_overwritten(self):
        with open(os.path.join(self.folder, "film-strip.png"), "w", encoding="utf-8") as file:
            file.write("somebody's")
        refused = self.run_script()
        self.assertEqual(refused.returncode, 1)
        self.assertIn("is there already", refused.stderr)
        self.assertEqual(os.listdir(self.folder), ["film-strip.png"])


if __name__ == "__main__":
    main()
