# SPDX-License-Identifier: BSD-3-Clause
"""Nothing that is read or written depends on the locale: a script that sets a German one gets the same bytes as one that does not."""

import hashlib
import locale
import os
import shutil
import subprocess
import unittest

from cactus_testing import CactusTestCase, fetch, main
from paraview.simple import (
    BundleInitializer,
    CapsuleOptimizer,
    FibreRadialGrowth,
    MyelinSurface,
    OutputPort,
    SaveData,
    StrandReader,
    SubstrateReader,
    SubstrateWriter,
)


class Locale(CactusTestCase):
    def setUp(self):
        super().setUp()
        self.addCleanup(locale.setlocale, locale.LC_ALL, locale.setlocale(locale.LC_ALL))

    def make_german(self):
        """Sets a German locale, made for this test, or skips it."""
        if shutil.which("localedef") is None:
            self.skipTest("there is no localedef to make a German locale with")
        made = subprocess.run(
            ["localedef", "-i", "de_DE", "-f", "UTF-8", os.path.join(self.folder, "de_DE.UTF-8")], capture_output=True, text=True
        )
        os.environ["LOCPATH"] = self.folder
        self.addCleanup(os.environ.pop, "LOCPATH")
        try:
            locale.setlocale(locale.LC_ALL, "de_DE.UTF-8")
        except locale.Error as error:
            self.skipTest(f"localedef did not make a German locale ({error}): {made.stderr}")
        self.assertEqual(locale.format_string("%.1f", 0.5), "0,5")

    def chain(self, name):
        """A small substrate by way of a strand file and a folder; hashes of all files, and what the data say of their origin."""
        place = os.path.join(self.folder, name)
        os.mkdir(place)
        bundle = BundleInitializer(Border="Walls", Side=3, FibreVolumeFraction=0.4, RadiusDistribution="Table", RadiusTable="0.45 5e-1;.55", Seed=2)
        optimizer = CapsuleOptimizer(Input=bundle, OverlapTolerance=0.0015)
        strands = os.path.join(place, "fibres.strands")
        SaveData(strands, proxy=OutputPort(optimizer, 0))
        # The same name in both, for it is part of what is said of the origin.
        again = os.path.join(self.folder, "again.strands")
        shutil.copy(strands, again)
        growth = FibreRadialGrowth(Input=StrandReader(FileName=again), VoxelSize=0.15, GrowthIterations=2)
        surface = MyelinSurface(Input=growth, GRatio=0.65)
        folder = os.path.join(place, "substrate")
        writer = SubstrateWriter(
            Outer=OutputPort(surface, 0), Inner=OutputPort(surface, 1), FolderName=folder, AllowOpenSurfaces=1, MinimumGap=0.0015
        )
        table = fetch(writer)
        files = {}
        for root, _, names in os.walk(place):
            for file in names:
                path = os.path.join(root, file)
                with open(path, "rb") as content:
                    files[os.path.relpath(path, place)] = hashlib.sha256(content.read()).hexdigest()
        read = fetch(SubstrateReader(FileName=folder)).GetPoints().GetData()
        files["read again"] = [read.GetTuple3(i) for i in range(read.GetNumberOfTuples())]
        outputs = [fetch(bundle), fetch(optimizer), fetch(surface), table]
        origins = [data.GetFieldData().GetAbstractArray("Provenance") for data in outputs]
        said = [[array.GetValue(i) for i in range(array.GetNumberOfValues())] for array in origins if array is not None]
        return files, said

    def test_a_chain_gives_the_same_bytes(self):
        plain, said = self.chain("plain")
        self.assertGreater(len(plain), 10)
        self.make_german()
        german, german_said = self.chain("german")
        self.assertEqual(german, plain)
        self.assertEqual(german_said, said)
        self.assertTrue(any('"OverlapTolerance": 0.0015' in line for lines in said for line in lines), said)


if __name__ == "__main__":
    main()
