# SPDX-License-Identifier: BSD-3-Clause
"""command.py PROGRAM RECIPES: cactus-grow as a user has it: what it makes, what it refuses, how it ends, and that it leaves nothing half
done. RECIPES is the folder of the examples."""

import glob
import json
import math
import os
import pty
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time
import unittest

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "paraview"))
from folder_content import files  # noqa: E402  (which is in another folder)

PROGRAM, RECIPES = sys.argv[1:3]
REFERENCE = os.path.join(RECIPES, "..", "reference")

# A second of work.
SMALL = {
    "BundleInitializer": {"Side": 4, "Border": "Walls", "FibreVolumeFraction": 0.3, "MinimumRadius": 0.4, "MeanDispersion": 3, "GrownFibreVolumeFraction": 0},
    "FibreRadialGrowth": {"VoxelSize": 0.2, "GrowthIterations": 1},
}


class Command(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="cactus-grow-")
        self.addCleanup(shutil.rmtree, self.folder)

    def recipe(self, content, name="recipe.json"):
        path = os.path.join(self.folder, name)
        with open(path, "w", encoding="utf-8") as file:
            file.write(content if isinstance(content, str) else json.dumps(content))
        return path

    def run_it(self, *arguments, **options):
        return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, cwd=self.folder, **options)

    def assertRefused(self, content, pattern, status=2):
        """One line that says why, and nothing written."""
        before = sorted(os.listdir(self.folder)) + ["recipe.json"]
        done = self.run_it(self.recipe(content))
        self.assertEqual(done.returncode, status, done.stderr)
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        self.assertRegex(done.stderr, "^cactus-grow: .*" + pattern)
        self.assertEqual(done.stdout, "")
        self.assertLessEqual(set(os.listdir(self.folder)), set(before))

    def test_makes_a_substrate_and_makes_it_again(self):
        done = self.run_it(self.recipe(SMALL), "--threads", "2")
        self.assertEqual(done.returncode, 0, done.stderr)
        first = os.path.join(self.folder, "recipe")
        self.assertRegex(done.stdout, r"^.*/recipe: certified, \d+ outer and \d+ inner surfaces of \d+ triangles\n$")
        with open(os.path.join(first, "manifest.json"), encoding="utf-8") as file:
            manifest = json.load(file)
        self.assertTrue(manifest["certified"])
        self.assertEqual([stage["filter"] for stage in manifest["provenance"]],
                         ["BundleInitializer", "CapsuleOptimizer", "FibreRadialGrowth", "MyelinSurface", "SubstrateWriter"])
        again = self.run_it(first, "-t", "1")
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertEqual(files(first + "-rerun"), files(first))
        other = self.run_it(os.path.join(first, "manifest.json"), "--output=other")
        self.assertEqual(other.returncode, 0, other.stderr)
        self.assertEqual(files(os.path.join(self.folder, "other")), files(first))
        self.assertEqual(set(os.listdir(self.folder)), {"recipe.json", "recipe", "recipe-rerun", "other"})

    def test_production_writes_the_same_surfaces(self):
        growth = SMALL["FibreRadialGrowth"]
        streamed = {"BundleInitializer": SMALL["BundleInitializer"], "SubstrateProduction": {**growth, "FolderName": "streamed"}}
        for recipe in (streamed, {**SMALL, "SubstrateWriter": {"FolderName": "held"}}):
            done = self.run_it(self.recipe(recipe))
            self.assertEqual(done.returncode, 0, done.stderr)
        one, two = (files(os.path.join(self.folder, name)) for name in ("streamed", "held"))
        for name in two:
            if name != "manifest.json":
                self.assertEqual(one[name], two[name], name)
        again = self.run_it("streamed")
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertEqual(files(os.path.join(self.folder, "streamed-rerun")), one)

    def test_sources_in_a_list_and_from_a_file(self):
        bundle = SMALL["BundleInitializer"]
        several = {**SMALL, "BundleInitializer": [{**bundle, "FibreVolumeFraction": 0.15}, {**bundle, "FibreVolumeFraction": 0.1, "Seed": 2}]}
        done = self.run_it(self.recipe(several))
        self.assertEqual(done.returncode, 0, done.stderr)
        strands = os.path.join(self.folder, "recipe", "fibres.strands")
        shutil.move(strands, self.folder)
        # The file is named from where the recipe is, whatever folder the command runs in; its fibres do not overlap.
        recipe = self.recipe({"StrandReader": {"FileName": "fibres.strands"}, "CapsuleOptimizer": False,
                              "FibreRadialGrowth": SMALL["FibreRadialGrowth"],
                              "SubstrateWriter": {"Format": "Surfaces alone"}}, "strands.json")
        done = subprocess.run([PROGRAM, recipe], capture_output=True, text=True, cwd="/")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(self.run_it("strands").returncode, 0)
        with open(os.path.join(self.folder, "fibres.strands"), "a", encoding="utf-8") as file:
            file.write("\n")
        done = self.run_it("strands", "--output", "third")
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertRegex(done.stderr, r"StrandReader: .*fibres\.strands, which it has read, is another file than it was")

    def test_curved_bundles_again_from_their_manifest(self):
        laid = {"Shape": "Kiss", "BendRadius": 9, "Side": 4, "Margin": 1, "MinimumRadius": 0.4, "MaximumRadius": 1, "GrownFibreVolumeFraction": 0}
        done = self.run_it(self.recipe({"CurvedBundles": laid, "FibreRadialGrowth": SMALL["FibreRadialGrowth"],
                                        "SubstrateWriter": {"Format": "Surfaces alone"}}))
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        again = self.run_it("recipe")
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertEqual(files(os.path.join(self.folder, "recipe-rerun")), files(os.path.join(self.folder, "recipe")))

    def tract(self, name="tract.tck", **header):
        """A streamline (mm) along x, and one beside it."""
        points = [(x, y, z) for y in (0.0, 1.0) for x, z in ((-9.0, 0.0), (0.0, 0.3), (9.0, 0.0))]
        rows = [*points[:3], 3 * (math.nan,), *points[3:], 3 * (math.nan,), 3 * (math.inf,)]
        text = "mrtrix tracks\ndatatype: Float32LE\n" + "".join(f"{key}: {value}\n" for key, value in header.items()) + "file: . 128\nEND\n"
        with open(os.path.join(self.folder, name), "wb") as file:
            file.write(text.encode().ljust(128, b"\0") + b"".join(struct.pack("<3f", *row) for row in rows))

    def test_along_a_tract(self):
        self.tract(count=7)
        growth = SMALL["FibreRadialGrowth"]
        laid = {"ScaleFactor": 0.001, "Side": 4, "FibreVolumeFraction": 0.3, "MinimumRadius": 0.4, "GrownFibreVolumeFraction": 0}
        recipe = {"TractogramReader": {"FileName": "tract.tck"}, "TractFibres": laid, "FibreRadialGrowth": growth}
        done = subprocess.run([PROGRAM, self.recipe(recipe)], capture_output=True, text=True, cwd="/")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stderr, r"tract\.tck: the header says that there are 7 streamlines, and there are 2")
        again = self.run_it("recipe", "--threads", "1")
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertEqual(files(os.path.join(self.folder, "recipe-rerun")), files(os.path.join(self.folder, "recipe")))
        with open(os.path.join(self.folder, "recipe", "manifest.json"), encoding="utf-8") as file:
            stages = [stage["filter"] for stage in json.load(file)["provenance"]]
        self.assertEqual(stages[:3], ["TractogramReader", "TractFibres", "CapsuleOptimizer"])
        self.tract(count=2)
        done = self.run_it("recipe", "--output", "other")
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertRegex(done.stderr, r"TractogramReader: .*tract\.tck, which it has read, is another file than it was")

    def test_refuses_tracts_that_are_none(self):
        self.tract()
        with open(os.path.join(self.folder, "cut.tck"), "wb") as file, open(os.path.join(self.folder, "tract.tck"), "rb") as whole:
            file.write(whole.read()[:-12])
        reader = {"TractogramReader": {"FileName": "tract.tck"}}
        for content, pattern, status in (
            (reader, r"TractogramReader gives streamlines, which nothing follows: add TractFibres$", 2),
            ({"TractFibres": {}}, r"TractFibres has no streamlines to follow: name a file in TractogramReader$", 2),
            ({"TractogramReader": {}, "TractFibres": {}}, r"TractogramReader: FileName is empty", 2),
            ({"TractogramReader": {"FileName": "missing.trk"}, "TractFibres": {}}, r"cannot open tractogram .*missing\.trk: No such file", 2),
            ({"TractogramReader": {"FileName": "recipe.json"}, "TractFibres": {}}, r"a tractogram's name ends in \.tck, \.tck\.gz, \.trk, \.trk\.gz or \.trx$", 2),
            ({**reader, "TractFibres": {"Side": -1}}, r"TractFibres: Side is -1: give 0\.1 to 100000 µm$", 2),
            ({"TractogramReader": {"FileName": "cut.tck"}, "TractFibres": {}}, r"cut\.tck is truncated", 1),
            ({**reader, "TractFibres": {"Select": "Bundle"}}, r"no cell data BundleId|no BundleId", 1),
        ):
            with self.subTest(pattern=pattern):
                self.assertRefused(content, pattern, status)

    def test_refuses_what_is_no_recipe(self):
        for content, pattern in (
            ({"BundleInitializer": {"Side": -6}}, r"BundleInitializer: Side is -6: give 0\.1 to 100000 µm$"),
            ({"BundleInitializer": {"side": 6}}, r"BundleInitializer: there is no property side: is it Side\?$"),
            ({"BundleInitializer": {"Colour": 6}}, r"BundleInitializer: there is no property Colour$"),
            ({"CapsuleOptimizer": {"Momentum": 0.5}}, r"there is no property Momentum$"),
            ({"BundleInitializer": {"Seed": 1.5}}, r"Seed is 1\.5: give a whole number$"),
            ({"BundleInitializer": {"NumberOfBundles": 5e9}}, r"NumberOfBundles is 5000000000: give 1 to 2"),
            ({"BundleInitializer": {"MaximumRadius": "2"}}, r"MaximumRadius is \"2\": give a number$"),
            ({"BundleInitializer": {"MinimumRadius": 3}}, r"BundleInitializer: .*MinimumRadius"),
            ({"BundleInitializer": {"DispersionModel": "Wattson"}}, r'DispersionModel is "Wattson": give "Watson", "Cone", "Coherent", "Harmonics" or "Peaks"$'),
            ({"CapsuleOptimizer": {"TrimToDomain": 1}}, r"TrimToDomain is 1: give true or false$"),
            ({"CapsuleOptimizer": {"KeepHistory": True}}, r"CapsuleOptimizer: KeepHistory is of use in ParaView only"),
            ({"MyelinSurface": {"Meshing": "VTK filters"}}, r"MyelinSurface: Meshing by VTK filters needs ParaView"),
            ({"Bundle": {}}, r"there is no stage Bundle in a recipe: use BundleInitializer, "),
            ({"SubstrateWriter": {"Encoding": "Binary"}}, r"SubstrateWriter: Encoding Binary is not for simulators"),
            ({"BundleInitializer": {"Side": 6}, "SubstrateWriter": {"Format": "RMS", "VoxelSize": 0.7}}, r"SubstrateWriter: VoxelSize 0\.7 µm does not divide the domain's side of 6 µm"),
            ({"SubstrateProduction": {"Encoding": "Binary"}}, r"SubstrateProduction: Encoding Binary is not for simulators"),
            ({"SubstrateProduction": {"SampledFraction": 0.1}}, r"SubstrateProduction: Format is a simulator's, which would take the space of the fibres that SampledFraction leaves out"),
            ({"SubstrateProduction": {"DecimationError": 0.02}}, r"SubstrateProduction: DecimationError 0\.02 is more than the room of 0\.0075"),
            ({"MyelinSurface": {"DecimationError": 0.02}}, r"MyelinSurface: DecimationError 0\.02 is more than the room of 0\.0075"),
            ({"MyelinSurface": {}, "SubstrateProduction": {}}, r"MyelinSurface and SubstrateProduction, .*leave one out"),
            ({"MyelinSurface": 0.7}, r"MyelinSurface is 0\.7: give its properties in braces"),
            ({"StrandReader": {"FileName": "missing.strands"}}, r"missing\.strands"),
            ('{"MyelinSurface": {"GRatio": 0.7, "GRatio": 0.6}}', r'"GRatio" stands twice'),
            ('{"MyelinSurface": {"GRatio": 0.7},\n}', r"it is no JSON: parse error at line 2"),
            ('{"MyelinSurface": {"GRatio": 1e999}}', r"it is no JSON: number overflow"),
            (300 * "[", r"nested more deeply"),
            ("[]", r"it is no recipe"),
            ("", r"it is no JSON"),
            ({"provenance": ["BundleInitializer 0.1.0: Side=5"]}, r"in words only"),
            ({"provenance": []}, r"does not say how"),
        ):
            with self.subTest(content=content):
                self.assertRefused(content, pattern)

    def test_refuses_what_a_manifest_must_not_have(self):
        self.assertEqual(self.run_it(self.recipe(SMALL), "--output", "good").returncode, 0)
        with open(os.path.join(self.folder, "good", "manifest.json"), encoding="utf-8") as file:
            good = json.load(file)
        stages = [stage["filter"] for stage in good["provenance"]]

        def changed(stage, change):
            manifest = json.loads(json.dumps(good))
            change(manifest["provenance"][stages.index(stage)])
            return manifest

        for stage, change, pattern in (
            ("CapsuleOptimizer", lambda s: s["properties"].update(CheckpointFile="/tmp/x"), r"there is no property CheckpointFile$"),
            ("SubstrateWriter", lambda s: s["properties"].update(FolderName="/tmp/x"), r"there is no property FolderName$"),
            ("CapsuleOptimizer", lambda s: s.update(filter="ProgrammableFilter"), r"there is no stage ProgrammableFilter"),
            ("FibreRadialGrowth", lambda s: s["inputs"].update(Input=[{}]), r"where input Input of FibreRadialGrowth came from is not known"),
            ("FibreRadialGrowth", lambda s: s["inputs"]["Input"][0].update(changed=True), r"were changed after CapsuleOptimizer"),
            ("FibreRadialGrowth", lambda s: s["inputs"].update(Input=[{"filter": "vtkTransformFilter", "inputs": []}]), r"a vtkTransformFilter was at work"),
            ("FibreRadialGrowth", lambda s: s["inputs"].update(Input=[]), r"FibreRadialGrowth: it takes one Input, and has 0"),
            ("MyelinSurface", lambda s: s["inputs"].update(Input=[{"stage": good["provenance"][0]["id"], "port": 0}]), r"MyelinSurface: it cannot take"),
            ("BundleInitializer", lambda s: s["inputs"].update(Input=[{"stage": good["provenance"][4]["id"]}]), r"comes from a later stage"),
            ("CapsuleOptimizer", lambda s: s["reached"].update(IsResult=False), r"a state on its way"),
        ):
            with self.subTest(pattern=pattern):
                self.assertRefused(changed(stage, change), pattern)

    def test_arguments(self):
        for arguments, pattern in (
            ((), "no recipe is named"),
            (("--outptu", "x"), "there is no option --outptu"),
            (("one.json", "two.json"), '"two.json" is another'),
            (("one.json", "--threads", "many"), "--threads is many: give a whole number from 0 to 65536"),
            (("one.json", "--threads"), "--threads wants a value"),
            (("one.json",), "cannot read one.json"),
        ):
            done = self.run_it(*arguments)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn(pattern, done.stderr)
        self.assertIn("Usage: cactus-grow RECIPE", self.run_it("--help").stdout)
        self.assertRegex(self.run_it("--version").stdout, r"^cactus-grow \d+\.\d+\.\d+\n$")

    def test_a_run_that_fails_and_one_that_is_not_certified(self):
        infeasible = {"BundleInitializer": {**SMALL["BundleInitializer"], "FibreVolumeFraction": 0.97}}
        self.assertRefused(infeasible, "FibreVolumeFraction 0.97 cannot be reached", status=1)
        strict = {**SMALL, "SubstrateWriter": {"MinimumGap": 2}}
        done = self.run_it(self.recipe(strict, "strict.json"))
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertIn("is not certified", done.stderr)
        self.assertIn("NOT certified", done.stdout)
        with open(os.path.join(self.folder, "strict", "manifest.json"), encoding="utf-8") as file:
            self.assertFalse(json.load(file)["certified"])

    def test_what_is_the_users_is_kept(self):
        recipe = self.recipe(SMALL)
        self.assertEqual(self.run_it(recipe).returncode, 0)
        self.assertEqual(self.run_it(recipe).returncode, 0, "a folder that nobody has changed is replaced")
        with open(os.path.join(self.folder, "recipe", "notes.txt"), "w", encoding="utf-8") as file:
            file.write("mine\n")
        before = files(self.folder)
        done = self.run_it(recipe)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("notes.txt", done.stderr)
        self.assertEqual(files(self.folder), before)

    def stop(self, wait_for, number):
        """The command, stopped by a signal once it shows what is waited for: long before the end, however busy the machine."""
        recipe = self.recipe({"BundleInitializer": {"Side": 18}}, "large.json")
        master, slave = pty.openpty()
        with subprocess.Popen([PROGRAM, recipe, "-o", "large"], stdout=slave, stderr=slave, cwd=self.folder) as process:
            os.close(slave)
            shown = b""
            while wait_for not in shown:
                shown += os.read(master, 1 << 16)
            process.send_signal(number)
            try:
                while True:
                    shown += os.read(master, 1 << 16)
            except OSError:  # the other end is closed
                pass
        os.close(master)
        return process.returncode, shown.decode()

    def test_progress_and_signals_at_any_stage(self):
        for wait_for, number in ((b"2/5 CapsuleOptimizer", signal.SIGINT), (b"3/5 FibreRadialGrowth", signal.SIGTERM),
                                 (b"4/5 MyelinSurface", signal.SIGINT)):
            with self.subTest(stage=wait_for):
                status, shown = self.stop(wait_for, number)
                self.assertEqual(status, 128 + number, shown)
                self.assertRegex(shown, r"\r *\d+ %  ")
                self.assertRegex(shown, r"cactus-grow: stopped: large is as it was\r\n$")
                self.assertEqual(os.listdir(self.folder), ["large.json"])

    def test_goes_on_with_what_a_stopped_run_has_left(self):
        production = {"TargetFibreVolumeFraction": 0.8, "VoxelSize": 0.15, "Format": "Surfaces alone"}
        recipe = self.recipe({"BundleInitializer": {"Side": 8}, "SubstrateProduction": production})
        made = os.path.join(self.folder, "recipe.work", "outer", "*", "*.surface")
        with subprocess.Popen([PROGRAM, recipe, "-t", "1"], stderr=subprocess.PIPE, text=True, cwd=self.folder) as process:
            while not glob.glob(made):
                self.assertIsNone(process.poll(), "ended before it was stopped")
                time.sleep(0.01)
            process.send_signal(signal.SIGTERM)
            shown = process.stderr.read()
        self.assertEqual(process.returncode, 128 + signal.SIGTERM, shown)
        self.assertRegex(shown, r"cactus-grow: stopped: (.*/recipe) is as it was, "
                                r"what is finished is kept in \1\.work, and the same command goes on with it\n$")
        self.assertEqual(sorted(os.listdir(self.folder)), ["recipe.json", "recipe.work"])
        for output in ((), ("--output", "at-once")):
            self.assertEqual(self.run_it(recipe, *output).returncode, 0)
        self.assertEqual(sorted(os.listdir(self.folder)), ["at-once", "recipe", "recipe.json"])
        self.assertEqual(*(files(os.path.join(self.folder, name)) for name in ("recipe", "at-once")))

    def test_progress_in_the_log_of_a_job(self):
        writer = {"SubstrateWriter": {"Format": "Surfaces alone"}}
        self.assertEqual(self.run_it(self.recipe({**SMALL, **writer})).stderr, "", "shorter than a minute")
        recipe = self.recipe({"BundleInitializer": {"Side": 8}, "FibreRadialGrowth": {"VoxelSize": 0.15}, **writer})
        started = time.monotonic()
        done = self.run_it(recipe, "--progress", "1", "--threads", "1")
        lines = [line for line in done.stderr.splitlines() if "warning" not in line]
        self.assertGreaterEqual(len(lines), 1)
        self.assertLessEqual(len(lines), time.monotonic() - started)
        places = []
        for line in lines:
            self.assertRegex(line, r"^cactus-grow: +\d+ %  \d/5 [A-Z][A-Za-z]+")
            percent, stage = line.split(":")[1].split("%")
            places.append((stage.split("/")[0], int(percent)))
        self.assertEqual(places, sorted(places))
        for refused in ("-1", "1.5", "often"):
            self.assertIn("--progress is " + refused, self.run_it(recipe, "--progress", refused).stderr)

    def test_the_examples_are_recipes(self):
        examples = sorted(glob.glob(os.path.join(RECIPES, "*.json")) + glob.glob(os.path.join(REFERENCE, "*.json")))
        self.assertGreaterEqual(len(examples), 14)
        os.mkdir(os.path.join(self.folder, "taken"))
        with open(os.path.join(self.folder, "taken", "notes.txt"), "w", encoding="utf-8") as file:
            file.write("mine\n")
        for example in examples:
            # A good recipe gets as far as the folder, which is not free.
            done = self.run_it(example, "--output", "taken")
            self.assertEqual(done.returncode, 1, done.stderr)
            self.assertIn("taken", done.stderr)

    def test_reference_substrates_have_their_checksums(self):
        """Rows of recipes that are there, of certified substrates; they are made by examples/reference/make.py, which takes minutes."""
        with open(os.path.join(REFERENCE, "checksums.txt"), encoding="utf-8") as file:
            rows = [line.split() for line in file if not line.startswith("#")]
        recipes = sorted(name[: -len(".json")] for name in os.listdir(REFERENCE) if name.endswith(".json"))
        self.assertEqual([row[0] for row in rows[1:]], recipes)
        for row in rows[1:]:
            self.assertEqual(dict(zip(rows[0], row))["certified"], "yes", row)
            self.assertRegex(row[-1], "^[0-9a-f]{64}$")

    def test_needs_no_paraview(self):
        libraries = subprocess.run(["ldd", PROGRAM], capture_output=True, text=True, check=True).stdout
        self.assertNotRegex(libraries, "(?i)vtk|paraview|libpython|Qt|mpi")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
