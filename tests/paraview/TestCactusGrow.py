# SPDX-License-Identifier: BSD-3-Clause
# ctest-timeout: 600
"""cactus-grow, which knows nothing of ParaView, writes the folders that the filters write, byte for byte."""

import json
import os
import re
import subprocess

import numpy
from cactus_testing import LEAVING, CactusTestCase, main
from folder_content import files
from nibabel.streamlines import TckFile, Tractogram
from paraview.simple import (BundleInitializer, CapsuleOptimizer, CurvedBundles, FibreRadialGrowth, GroupDatasets, MyelinSurface, OutputPort,
                             Placement, SubstrateProduction, SubstrateWriter, TractFibres, TractogramReader)

PROGRAM = os.path.join(os.environ["CACTUS_TOOLS"], "cactus-grow")
BUNDLE = {"Side": 4, "Border": "Walls", "FibreVolumeFraction": 0.25, "MinimumRadius": 0.4, "MeanDispersion": 3, "GrownFibreVolumeFraction": 0}
OTHER = {**BUNDLE, "RadiusDistribution": "Lognormal", "GRatio": 0.55, "Seed": 2}
TABLE = {**BUNDLE, "RadiusDistribution": "Table", "DispersionModel": "Watson"}
GROWTH = {"VoxelSize": 0.2, "GrowthIterations": 1, "Seed": 3}
NODES = {"NodeLength": 0.8, "InternodeFactor": 1, "ParanodeLength": 0.5, "NodeConstriction": 0.8, "NodeSeed": 5,
         "InternodeLoss": 0.6, "InternodeOrder": "Thinnest first", "RemyelinatedFraction": 0.5, "RemyelinatedGRatio": 0.9}
SURFACES = {"GRatioModel": "Distributed", "GRatioDeviation": 0.05, "Seed": 9, "MyelinFollowsAxon": True, "SwellingAmplitude": 0.02,
            "SwellingSpacing": 4, "SwellingLength": 1.6, **NODES}


class CactusGrow(CactusTestCase):
    def write(self, fibres, growth, surfaces, **properties):
        """A folder by the filters."""
        made = MyelinSurface(Input=FibreRadialGrowth(Input=fibres, **growth), **surfaces)
        SubstrateWriter(Outer=OutputPort(made, 0), Inner=OutputPort(made, 1), Fibres=fibres, FolderName=self.path("filters"),
                        **properties).UpdatePipeline()

    def path(self, name):
        return os.path.join(self.folder, name)

    def grow(self, recipe, name):
        """A folder by cactus-grow."""
        path = recipe
        if not isinstance(recipe, str):
            path = self.path(name + ".json")
            with open(path, "w", encoding="utf-8") as file:
                json.dump(recipe, file)
        # A slow machine would tell its progress each minute.
        done = subprocess.run([PROGRAM, path, "--output", self.path(name), "--threads", "2", "--progress", "0"], capture_output=True, text=True)
        # In so small a substrate all walkers outside leave, which is said.
        said = [line for line in done.stderr.splitlines() if not re.search(LEAVING, line)]
        self.assertEqual((done.returncode, said), (0, []))

    def assertSame(self, one, two):
        one, two = files(self.path(one)), files(self.path(two))
        self.assertEqual(sorted(one), sorted(two))
        self.assertIn("manifest.json", one)
        self.assertIn("fibres.strands", one)
        for name, content in one.items():
            self.assertEqual(content, two[name], name)

    def test_a_grown_bundle(self):
        bundle = {"Side": 5, "Seed": 4, "MinimumRadius": 0.5}
        fibres = OutputPort(CapsuleOptimizer(Input=BundleInitializer(**bundle)), 0)
        self.write(fibres, {"VoxelSize": 0.15}, {"GRatio": 0.65})
        self.grow({"BundleInitializer": bundle, "FibreRadialGrowth": {"VoxelSize": 0.15}, "MyelinSurface": {"GRatio": 0.65}}, "grown")
        self.assertSame("filters", "grown")
        self.grow(self.path("filters"), "again")
        self.assertSame("filters", "again")

    def test_two_bundles_distributed_g_ratios_and_another_simulator(self):
        fibres = OutputPort(CapsuleOptimizer(Input=[BundleInitializer(**BUNDLE), BundleInitializer(**OTHER)]), 0)
        self.write(fibres, GROWTH, SURFACES, Format="MCMRSimulator", StartPositions=20)
        self.grow({"BundleInitializer": [BUNDLE, OTHER], "FibreRadialGrowth": GROWTH, "MyelinSurface": SURFACES,
                   "SubstrateWriter": {"Format": "MCMRSimulator", "StartPositions": 20}}, "grown")
        self.assertSame("filters", "grown")

    def test_blocks_and_tables_from_a_manifest(self):
        path = self.path("radii.txt")
        with open(path, "w", encoding="utf-8") as file:
            file.write("0.4 0.55\n0.7\n")
        sources = [BundleInitializer(RadiusTable="0.4 0.45;0.61", **TABLE), BundleInitializer(RadiusTableFile=path, **TABLE)]
        fibres = OutputPort(CapsuleOptimizer(Input=GroupDatasets(Input=sources)), 0)
        self.write(fibres, GROWTH, {}, StartPositions=20)
        self.grow(self.path("filters"), "grown")
        self.assertSame("filters", "grown")

    def test_a_preset(self):
        fibres = OutputPort(CapsuleOptimizer(Input=BundleInitializer(Preset="Histological target c", Side=6, MinimumRadius=0.4)), 0)
        self.write(fibres, {"VoxelSize": 0.15}, {})
        self.grow({"Preset": "Histological target c", "BundleInitializer": {"Side": 6, "MinimumRadius": 0.4}, "FibreRadialGrowth": {"VoxelSize": 0.15}}, "grown")
        self.assertSame("filters", "grown")

    def tract(self, name, group=False):
        """Streamlines (mm) that bend beside each other; in a .trx of two groups, as a folder, or in a .tck."""
        angles = numpy.linspace(-0.6, 0.6, 25)
        streamlines = [numpy.column_stack([40 * numpy.cos(angles) - 40, 0 * angles + 3 * beside, 40 * numpy.sin(angles)]).astype("<f4")
                       for beside in range(-1, 2)]
        path = self.path(name)
        if not group:
            TckFile(Tractogram(streamlines, affine_to_rasmm=numpy.eye(4))).save(path)
            return path
        os.makedirs(os.path.join(path, "groups"))
        points = numpy.concatenate(streamlines)
        with open(os.path.join(path, "header.json"), "w", encoding="utf-8") as file:
            json.dump({"NB_VERTICES": len(points), "NB_STREAMLINES": 3, "DIMENSIONS": [9, 9, 9], "VOXEL_TO_RASMM": numpy.eye(4).tolist()}, file)
        points.tofile(os.path.join(path, "positions.3.float32"))
        numpy.array([0, 25, 50], "<u8").tofile(os.path.join(path, "offsets.uint64"))
        numpy.array([0, 2], "<u4").tofile(os.path.join(path, "groups", "outer.uint32"))
        numpy.array([1], "<u4").tofile(os.path.join(path, "groups", "inner.uint32"))
        return path

    TRACT = {"Side": 5, "ScaleFactor": 0.001, "FibreVolumeFraction": 0.25, "MinimumRadius": 0.4, "GrownFibreVolumeFraction": 0, "CalibreVariation": 0.15}

    def test_fibres_along_a_tract(self):
        path, box = self.tract("tract.tck"), {**self.TRACT, "Length": 6}
        reader = TractogramReader(FileName=path, LengthUnit="Millimetre")
        fibres = OutputPort(CapsuleOptimizer(Input=TractFibres(Input=reader, **box)), 0)
        self.write(fibres, GROWTH, {})
        # Named as it is found from where the recipe is; the record has the path as it was given.
        self.grow({"TractogramReader": {"FileName": path, "LengthUnit": "Millimetre"}, "TractFibres": box,
                   "FibreRadialGrowth": GROWTH}, "grown")
        self.assertSame("filters", "grown")
        self.grow(self.path("filters"), "again")
        self.assertSame("filters", "again")

    def test_curved_bundles(self):
        laid = {"Shape": "Kiss", "BendRadius": 12, "Side": 5, "Length": 6, "Margin": 1, "FibreVolumeFraction": 0.25, "MinimumRadius": 0.4, "GrownFibreVolumeFraction": 0}
        self.write(OutputPort(CapsuleOptimizer(Input=CurvedBundles(**laid)), 0), GROWTH, {})
        self.grow({"CurvedBundles": laid, "FibreRadialGrowth": GROWTH}, "grown")
        self.assertSame("filters", "grown")

    def test_groups_of_a_tract_and_tracts_in_blocks(self):
        """Bundles of a .trx that is a folder, beside a straight bundle; and two tracts at one input, of which one has no bundles."""
        groups, plain = self.tract("tract.trx", group=True), self.tract("tract.tck")
        reader = TractogramReader(FileName=groups, Radius=0.2)
        chosen = {"Select": "Bundle", "BundleId": 1, "NumberOfStreamlines": 0, "BundleDiameter": 3.5, **self.TRACT, "FibreVolumeFraction": 0.4}
        both = GroupDatasets(Input=[TractogramReader(FileName=plain), reader])
        bundles = [BundleInitializer(**{**BUNDLE, "Side": 5}), TractFibres(Input=reader, **chosen), TractFibres(Input=both, Seed=6, **self.TRACT)]
        fibres = OutputPort(CapsuleOptimizer(Input=bundles), 0)
        self.write(fibres, {**GROWTH, "GrowthIterations": 0}, {})
        self.grow(self.path("filters"), "grown")
        self.assertSame("filters", "grown")

    def test_what_is_placed_is_for_paraview(self):
        fibres = OutputPort(CapsuleOptimizer(Input=BundleInitializer(**BUNDLE)), 0)
        made = MyelinSurface(Input=FibreRadialGrowth(Input=fibres, **GROWTH))
        SubstrateWriter(Outer=Placement(Input=OutputPort(made, 0), PositionX=3), FolderName=self.path("placed")).UpdatePipeline()
        done = subprocess.run([PROGRAM, self.path("placed")], capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stdout, len(done.stderr.splitlines())), (2, "", 1))
        self.assertRegex(done.stderr, r"there is no stage Placement that could be run without ParaView \(\./cactus rerun may\)")

    def test_a_production(self):
        fibres = OutputPort(CapsuleOptimizer(Input=BundleInitializer(**BUNDLE)), 0)
        SubstrateProduction(Input=fibres, FolderName=self.path("filters"), **GROWTH).UpdatePipeline()
        self.grow({"BundleInitializer": BUNDLE, "SubstrateProduction": GROWTH}, "grown")
        self.assertSame("filters", "grown")


if __name__ == "__main__":
    main()
