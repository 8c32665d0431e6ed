# SPDX-License-Identifier: BSD-3-Clause
# ctest-extended
# ctest-timeout: 200
# ctest-needs: display
"""The pictures of the filters' pages can be drawn again: there is one for each that pages show, and what is drawn is no empty sheet."""

import os
import subprocess
import sys

import numpy
from cactus_testing import CactusTestCase, main
from PIL import Image

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.append(os.path.join(ROOT, "tools", "scripts"))
import filter_pictures  # noqa: E402  (which is in another folder)


class FilterPictures(CactusTestCase):
    def test_there_is_one_for_each_that_pages_show(self):
        shown = {os.path.splitext(name)[0] for name in os.listdir(os.path.join(ROOT, "docs", "images", "filters"))}
        self.assertEqual(shown, set(filter_pictures.PICTURES))

    def test_views_charts_and_sections_are_drawn(self):
        names = ["MyelinSurface", "SubstrateStatistics", "HistologyMask"]
        made = subprocess.run(["pvpython", os.path.join(ROOT, "tools", "scripts", "filter_pictures.py"), "--output", self.folder, *names], capture_output=True, text=True, check=False)
        self.assertEqual(made.returncode, 0, made.stderr)
        self.assertEqual(sorted(os.listdir(self.folder)), sorted(name + ".png" for name in names))
        for name in names:
            picture = numpy.asarray(Image.open(os.path.join(self.folder, name + ".png")).convert("RGB"))
            self.assertLess(numpy.mean(numpy.all(picture == 255, axis=2)), 0.95, name)
            self.assertGreater(len(numpy.unique(picture.reshape(-1, 3), axis=0)), 20, name)


if __name__ == "__main__":
    main()
