# SPDX-License-Identifier: BSD-3-Clause
# ctest-extended
# ctest-timeout: 200
# ctest-needs: display
"""The script of the presets' states: a state that is loaded has the preset's chain, makes the substrate and shows it."""

import os
import subprocess
import sys

import numpy
from cactus_testing import CactusTestCase, main, pixels
from paraview import simple

SCRIPT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "examples", "states.py")
sys.path.append(os.path.dirname(SCRIPT))
import states  # noqa: E402  (which is in another folder)

PRESET = "Corpus callosum, in-vivo-like"


class States(CactusTestCase):
    expected = r"fibres are not as asked"  # in so small a domain, of the thinnest

    def run_script(self, *arguments):
        return subprocess.run(["pvpython", SCRIPT, "--side", "7", "--voxel-size", "0.1", "--output", self.folder, *arguments], capture_output=True, text=True, check=False)

    def test_every_preset_has_a_file_of_its_own(self):
        names = states.known()
        self.assertIn(PRESET, names)
        files = {states.file_name(name) for name in names}
        self.assertEqual(len(files), len(names))
        self.assertIn("corpus-callosum-in-vivo-like.pvsm", files)

    def test_a_loaded_state_shows_the_substrate(self):
        made = self.run_script(PRESET)
        self.assertEqual(made.returncode, 0, made.stderr)
        path = os.path.join(self.folder, states.file_name(PRESET))
        self.assertEqual(os.listdir(self.folder), [os.path.basename(path)])
        simple.LoadState(path)
        found = {proxy.GetXMLName(): proxy for proxy in simple.GetSources().values()}
        self.assertEqual(set(found), {"BundleInitializer", "CapsuleOptimizer", "FibreRadialGrowth", "MyelinSurface"})
        for name in ("BundleInitializer", "FibreRadialGrowth", "MyelinSurface"):
            self.assertEqual(found[name].Preset, PRESET)
        self.assertEqual((found["BundleInitializer"].Side, found["FibreRadialGrowth"].MinimumGap), (7, 0.04))
        (view,) = simple.GetRenderViews()
        self.assertEqual([name for name, _ in simple.GetLayouts()], [PRESET])
        view.ViewSize = [400, 400]
        image = pixels(view)
        background = numpy.all(abs(image - image[0, 0]) < 8, axis=2)
        for edge in (background[0], background[-1], background[:, 0], background[:, -1]):
            self.assertTrue(edge.all(), "the substrate does not lie within the view")
        self.assertLess(numpy.count_nonzero(background), 0.7 * background.size)
        for place, colour in ((0, "myelin"), (2, "axons")):
            others = [other for other in range(3) if other != place]
            is_its = numpy.all([image[:, :, place] > 1.3 * image[:, :, other] for other in others], axis=0) & (image[:, :, place] > 60)
            self.assertGreater(numpy.count_nonzero(is_its), 2000, colour)

    def test_nothing_is_overwritten(self):
        path = os.path.join(self.folder, states.file_name(PRESET))
        with open(path, "w", encoding="utf-8") as file:
            file.write("somebody's")
        refused = self.run_script(PRESET)
        self.assertEqual(refused.returncode, 1)
        self.assertIn("is there already", refused.stderr)
        with open(path, encoding="utf-8") as file:
            self.assertEqual(file.read(), "somebody's")

    def test_a_wrong_name_gets_those_that_there_are(self):
        refused = self.run_script("Corpus callosum")
        self.assertEqual(refused.returncode, 2)
        self.assertIn(PRESET, refused.stderr)
        self.assertEqual(os.listdir(self.folder), [])


if __name__ == "__main__":
    main()
