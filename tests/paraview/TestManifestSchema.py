# SPDX-License-Identifier: BSD-3-Clause
# ctest-timeout: 300
"""The manifests of all writers are what docs/manifest.schema.json says, by Debian's jsonschema, and damaged ones are not."""

import copy
import json
import os

import jsonschema
from cactus_testing import CactusTestCase, main, produce, proxies
from paraview.simple import (BundleInitializer, CapsuleOptimizer, FibreRadialGrowth, GroupDatasets, MyelinSurface, OutputPort, SaveData,
                             StrandReader, SubstrateProduction, SubstrateWriter, Transform)
from surfaces import surfaces, tube, two_tubes

SCHEMA = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "docs", "manifest.schema.json")


def formats():
    writer = next(element for _, element in proxies() if element.get("name") == "SubstrateWriter")
    return [entry.get("text") for entry in writer.findall("*[@name='Format']/EnumerationDomain/Entry")]


class ManifestSchema(CactusTestCase):
    def setUp(self):
        super().setUp()
        with open(SCHEMA, encoding="utf-8") as file:
            schema = json.load(file)
        jsonschema.Draft202012Validator.check_schema(schema)
        self.validator = jsonschema.Draft202012Validator(schema)

    def folder_name(self):
        return os.path.join(self.folder, "substrate")

    def write(self, **properties):
        SubstrateWriter(FolderName=self.folder_name(), **properties).UpdatePipeline()
        return self.manifest()

    def manifest(self):
        with open(os.path.join(self.folder_name(), "manifest.json"), encoding="utf-8") as file:
            return json.load(file)

    def assertValid(self, manifest):
        self.assertEqual([(list(error.path), error.message) for error in self.validator.iter_errors(manifest)], [])

    def tubes(self):
        lines, outer, inner = two_tubes(inset=0.05)
        return {"Fibres": produce(lines), "Outer": produce(outer), "Inner": produce(inner)}

    def test_every_format(self):
        self.assertGreaterEqual(len(formats()), 5)
        for name in formats():
            with self.subTest(format=name):
                more = {"RMS": {"VoxelSize": 0.25}, "SpinDoctor": {}}.get(name, {"StartPositions": 5})
                manifest = self.write(Format=name, **self.tubes(), **more)
                self.assertEqual(manifest["simulator"], name)
                self.assertValid(manifest)

    def test_a_chain_from_a_file_and_of_blocks(self):
        """Stages with all that a record may hold: files, what was reached, blocks, a filter of ParaView's own."""
        path = os.path.join(self.folder, "some.strands")
        SaveData(path, proxy=BundleInitializer(Border="Walls", CalibreVariation=0, Side=6, FibreVolumeFraction=0.1, MinimumRadius=0.5))
        bundle = BundleInitializer(Border="Walls", CalibreVariation=0, Side=6, FibreVolumeFraction=0.1, MinimumRadius=0.5, RadiusDistribution="Table", RadiusTable="0.5 0.6")
        fibres = OutputPort(CapsuleOptimizer(Input=GroupDatasets(Input=[StrandReader(FileName=path), bundle])), 0)
        grown = FibreRadialGrowth(Input=fibres, VoxelSize=0.1, TargetFibreVolumeFraction=0)
        made = MyelinSurface(Input=grown)
        manifest = self.write(Fibres=fibres, Outer=OutputPort(made, 0), Inner=OutputPort(made, 1))
        self.assertValid(manifest)
        self.assertIn("blocks", json.dumps(manifest["provenance"]))
        self.assertTrue(any("files" in stage for stage in manifest["provenance"]))
        self.assertTrue(any("reached" in stage for stage in manifest["provenance"]))
        turned = [Transform(Input=OutputPort(made, port)) for port in (0, 1)]
        for half in turned:
            half.Transform.Rotate = [0, 0, 180]
        manifest = self.write(Outer=turned[0], Inner=turned[1])
        self.assertValid(manifest)
        self.assertIn("vtkTransformFilter", json.dumps(manifest["provenance"][-1]["inputs"]))

    def test_surfaces_of_which_nothing_is_known(self):
        manifest = self.write(Outer=produce(surfaces({3: tube(-2, 0, 1.0, 10)}, 0, 10)))
        self.assertValid(manifest)
        self.assertEqual(manifest["provenance"][-1]["inputs"], {"Outer": [{}]})
        self.assertIsNone(manifest["fibres"])

    def test_not_certified(self):
        meeting = surfaces({3: tube(-0.5, 0, 1.0, 10), 5: tube(0.5, 0, 1.0, 10)}, 0, 10)
        with self.assertError("not certified"):
            manifest = self.write(Outer=produce(meeting))
        self.assertFalse(manifest["certified"])
        self.assertValid(manifest)

    def test_production(self):
        fibres = OutputPort(CapsuleOptimizer(Input=BundleInitializer(Border="Walls", CalibreVariation=0, Side=5)), 0)
        SubstrateProduction(Input=fibres, VoxelSize=0.2, FolderName=self.folder_name()).UpdatePipeline()
        self.assertValid(self.manifest())

    def test_damage_is_found(self):
        sound = self.write(**self.tubes())
        self.assertValid(sound)

        def entry(name, value, *where):
            def damage(manifest):
                for step in where:
                    manifest = manifest[step]
                manifest[name] = value

            return damage

        optional = {"extra_walkers_leaving", "directions"}
        self.assertLess(optional, set(sound))
        damages = [entry(name, [[]]) for name in sound]
        damages += [lambda manifest, name=name: manifest.pop(name) for name in sound if name not in optional]
        damages += [entry("extra", 1), entry("domain", [0, 1, 0, 1]), entry("faults", ["meets"]), entry("certified", False)]
        damages += [entry("path", "../elsewhere.ply", "files", 0), entry("path", "/etc/passwd", "files", 0), entry("fibre", 0.5, "files", 0)]
        damages += [entry("README.txt", "0" * 63, "sha256"), entry("../x", "0" * 64, "sha256"), entry("simulator", "mcdc")]
        damages += [entry("id", "1", "provenance", -1), entry("inputs", {"Outer": [{"port": 0}]}, "provenance", -1)]
        damages += [entry("p2", "0.9", "directions"), lambda manifest: manifest["directions"].pop("twist")]
        for number, damage in enumerate(damages):
            with self.subTest(damage=number):
                manifest = copy.deepcopy(sound)
                damage(manifest)
                self.assertFalse(self.validator.is_valid(manifest))


if __name__ == "__main__":
    main()
