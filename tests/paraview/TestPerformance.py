# SPDX-License-Identifier: BSD-3-Clause
# ctest-extended
# ctest-timeout: 200
"""./cactus bench performance: each substrate has a row whose stages add up, which is measured anew or added to; page and curves are those of
the table, and are known not to be where it changes."""

import csv
import os
import shutil
import subprocess
import tempfile

from cactus_testing import CactusTestCase, main

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
SCRIPT = os.path.join(ROOT, "tools", "benchmarks", "performance.py")
PAGE = os.path.join(ROOT, "tools", "benchmarks", "performance_page.py")
STAGES = {"filters": ("packing", "optimiser", "growth", "surfaces", "writer"), "streamed": ("packing", "optimiser", "production")}


class Performance(CactusTestCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.made = tempfile.mkdtemp(prefix="cactus-performance-")
        cls.addClassCleanup(shutil.rmtree, cls.made)
        cls.measure("--sides", "5", "--threads", "1", "2", "--threads-side", "5", "--voxels", "0.1", "0.2", "--series-side", "5")

    @classmethod
    def measure(cls, *arguments):
        done = subprocess.run(["pvpython", "-B", SCRIPT, "--output", cls.made, "--fractions", *arguments], capture_output=True, text=True)
        return done.returncode, done.stdout + done.stderr.replace("ERR|", "")

    def table(self):
        with open(self.path(), newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def path(self, name="performance.csv"):
        return os.path.join(self.made, name)

    def checked(self):
        done = subprocess.run(["pvpython", "-B", PAGE, "--check", self.made], capture_output=True, text=True)
        return done.returncode, done.stdout

    def test_a_row_for_each_substrate(self):
        rows = self.table()
        # Nothing is measured twice that is wanted for two series.
        settings = [(row["way"], row["voxel_um"], row["threads"]) for row in rows]
        self.assertEqual(len(settings), len(set(settings)))
        for threads in ("1", "2"):
            self.assertIn(("filters", "0.1", threads), settings)
        cores = str(len(os.sched_getaffinity(0)))
        self.assertIn(("filters", "0.2", cores), settings)
        self.assertIn(("streamed", "0.1", cores), settings)
        for row in rows:
            with self.subTest(**{name: row[name] for name in ("way", "voxel_um", "threads")}):
                for quantity in ("clock_s", "processor_s"):
                    stages = [float(row[f"{stage}_{quantity}"]) for stage in STAGES[row["way"]]]
                    self.assertGreater(min(stages), 0)
                    self.assertAlmostEqual(sum(stages), float(row[quantity]), delta=1e-3 * sum(stages))
                self.assertEqual(row["certified"], "yes")
                # Fibres go from face to face, those around the domain count with their length, and the files are binary: 19 bytes a triangle, and what is beside them.
                self.assertTrue(0.95 < float(row["length_um"]) / 5 / int(row["fibres"]) < 3, row)
                self.assertTrue(19 < 1e6 * float(row["folder_MB"]) / int(row["triangles"]) < 60)
                self.assertTrue(50 < float(row["peak_MB"]) < 4000)
        # The same substrates whoever makes them, by as many threads as may be.
        self.assertEqual(len({row["triangles"] for row in rows if row["voxel_um"] == "0.1"}), 1)

    def test_page_and_curves_are_of_the_table(self):
        self.assertEqual(self.checked()[0], 0)
        with open(self.path("performance.md"), encoding="utf-8") as file:
            page = file.read()
        for wanted in ("## By side", "## By voxel", "## By threads", "| growth of a fibre, one core | about 60 s |"):
            self.assertIn(wanted, page)
        self.assertNotIn("## By fraction", page)  # which was not asked for
        with open(self.path(), encoding="utf-8") as file:
            table = file.read()
        self.addCleanup(lambda: open(self.path(), "w", encoding="utf-8").write(table))
        with open(self.path(), "w", encoding="utf-8") as file:
            file.write(table.replace(",yes,", ",no,"))
        failed, said = self.checked()
        self.assertEqual(failed, 1)
        self.assertIn("performance.md does not say", said)
        self.assertIn("performance-sides.svg is of another", said)

    def test_adds_to_what_is_there_of_this_machine(self):
        before = self.table()
        failed, said = self.measure("--sides", "4", "--streamed", "--voxels", "--threads")
        self.assertEqual(failed, 0, said)
        after = self.table()
        self.assertEqual([row for row in after if row["side_um"] != "4"], before)
        self.assertEqual([row["way"] for row in after if row["side_um"] == "4"], ["streamed"])
        self.assertEqual(self.checked()[0], 0)

        with open(self.path(), encoding="utf-8") as file:
            table = file.read()
        with open(self.path(), "w", encoding="utf-8") as file:
            file.write(table.replace(before[0]["processor"], "Another"))
        failed, said = self.measure("--sides", "4", "--streamed", "--voxels", "--threads")
        with open(self.path(), "w", encoding="utf-8") as file:
            file.write(table)
        self.assertNotEqual(failed, 0)
        self.assertIn("is of another machine", said)


if __name__ == "__main__":
    main()
