# SPDX-License-Identifier: BSD-3-Clause
# ctest-extended
# ctest-timeout: 300
"""Who waits for a job sees in its log how far it is: a line now and then on standard error, from one rank, as CACTUS_PROGRESS asks."""

import os
import re
import subprocess
import time

from cactus_testing import CactusTestCase, environment_of_its_own, main

SCRIPT = """
import sys
from paraview.simple import *
fibres = CapsuleOptimizer(Input=BundleInitializer(Border="Walls", Side=float(sys.argv[2]), GrownFibreVolumeFraction=0.9))
made = SubstrateProduction(Input=OutputPort(fibres, 0), FolderName=sys.argv[1], NumberOfThreads=1)
made.UpdatePipeline()
"""
LINE = re.compile(r"^SubstrateProduction: ( [ \d]\d|100) %  \w.*$")


class ProgressLogTest(CactusTestCase):
    def said(self, name, progress, *launcher, side=16):
        path = os.path.join(self.folder, "script.py")
        with open(path, "w", encoding="utf-8") as file:
            file.write(SCRIPT)
        environment = environment_of_its_own()
        environment.pop("CACTUS_PROGRESS", None)
        if progress is not None:
            environment["CACTUS_PROGRESS"] = progress
        folder = os.path.join(self.folder, name)
        done = subprocess.run([*launcher, path, folder, str(side)], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, env=environment)
        return done.stderr, os.path.exists(os.path.join(folder, "manifest.json"))

    def test_a_line_now_and_then(self):
        said, isMade = self.said("often", "1", "pvpython")
        lines = [line for line in said.splitlines() if line.startswith("SubstrateProduction: ")]
        self.assertTrue(isMade, said)
        self.assertGreater(len(lines), 1, said)
        self.assertTrue(all(map(LINE.match, lines)), said)
        percents = [int(line.split()[1]) for line in lines]
        self.assertEqual(percents, sorted(percents))

    def test_none_of_short_work_nor_where_none_are_wanted(self):
        for name, progress in ("usual", None), ("empty", ""), ("none", "0"):
            said, isMade = self.said(name, progress, "pvpython", side=6)
            self.assertTrue(isMade, said)
            self.assertNotIn(" %  ", said)

    def test_one_rank_speaks_for_all(self):
        begin = time.monotonic()
        said, isMade = self.said("ranks", "1", "mpiexec", "-n", "2", "pvbatch")
        seconds = time.monotonic() - begin
        lines = [line for line in said.splitlines() if line.startswith("SubstrateProduction: ")]
        self.assertTrue(isMade, said)
        self.assertGreater(len(lines), 0, said)
        self.assertLess(len(lines), seconds, said)

    def test_what_is_no_number_of_seconds(self):
        for progress in "often", "86401":
            said, isMade = self.said("wrong", progress, "pvpython", side=6)
            self.assertFalse(isMade)
            self.assertIn(f"the environment variable CACTUS_PROGRESS is {progress}: give a whole number from 0 to 86400", said)
            self.assertEqual(said.count("ERR|"), 1, said)
        said, isMade = self.said("wrong", "often", "mpiexec", "-n", "2", "pvbatch", side=6)
        self.assertFalse(isMade)
        self.assertEqual(said.count("CACTUS_PROGRESS is often"), 1, said)


main()
