# SPDX-License-Identifier: BSD-3-Clause
# ctest-timeout: 300
"""What data say of how they were made: every stage with its values, every input, and what filters in between have done."""

import json
import os

from cactus_testing import UNPARTED, CactusTestCase, fetch, main
from paraview.simple import (AppendGeometry, BundleInitializer, CapsuleOptimizer, FibreField, FibreRadialGrowth, GroupDatasets, MyelinSurface,
                             OpenDataFile, OutputPort, SaveData, StrandReader, SubstrateStatistics, Transform)
from vtkmodules.vtkCommonCore import vtkStringArray
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkIOLegacy import vtkDataSetReader, vtkDataSetWriter

STRANDS = "6\n2\n2\n-1 0 -4 0.7\n-1 0 4 0.7\n2\n1 0 -4 0.7\n1 0 4 0.7\n"


def records(data):
    array = data.GetFieldData().GetAbstractArray("Provenance")
    return [json.loads(array.GetValue(i)) for i in range(array.GetNumberOfValues())]


def bundle(**properties):
    return BundleInitializer(Border="Walls", Side=5, FibreVolumeFraction=0.2, MinimumRadius=0.4, MeanDispersion=2, GrownFibreVolumeFraction=0, **properties)


class Provenance(CactusTestCase):
    expected = UNPARTED

    def test_values_are_values(self):
        (record,) = records(fetch(bundle(RadiusDistribution="Table", RadiusTable="0.5, 0.625", Seed=3)))
        self.assertEqual(record["filter"], "BundleInitializer")
        self.assertRegex(record["version"], r"^\d+\.\d+\.\d+$")
        values = record["properties"]
        self.assertEqual((values["Side"], values["Seed"], values["RadiusTable"]), (5.0, 3, [0.5, 0.625]))
        self.assertEqual((values["RadiusDistribution"], values["DispersionModel"]), ("Table", "Coherent"))
        self.assertEqual(record["reached"]["Fibres"], fetch(bundle(RadiusDistribution="Table", RadiusTable="0.5 0.625", Seed=3)).GetNumberOfLines())
        # What has no effect is left out, and so is what does not change the result.
        self.assertFalse({"GammaShape", "CrossingAngle", "SheetThickness"} & set(values))
        optimised = records(fetch(CapsuleOptimizer(Input=bundle(), NumberOfThreads=1)))[-1]["properties"]
        self.assertFalse({"NumberOfThreads", "KeepHistory", "CheckpointFile"} & set(optimised))
        self.assertIs(optimised["TrimToDomain"], True)

    def test_all_stages_and_all_inputs(self):
        optimizer = CapsuleOptimizer(Input=[bundle(), bundle(Seed=2)])
        growth = FibreRadialGrowth(Input=OutputPort(optimizer, 0), VoxelSize=0.2)
        surface = MyelinSurface(Input=growth)
        statistics = SubstrateStatistics(Fibres=OutputPort(optimizer, 0), Outer=OutputPort(surface, 0), Inner=OutputPort(surface, 1))
        stages = records(fetch(statistics))
        self.assertEqual([stage["filter"] for stage in stages], ["BundleInitializer", "BundleInitializer", "CapsuleOptimizer", "FibreRadialGrowth", "MyelinSurface", "SubstrateStatistics"])
        inputs = stages[-1]["inputs"]
        self.assertEqual([inputs[name][0]["port"] for name in ("Fibres", "Outer", "Inner")], [0, 0, 1])
        self.assertEqual([inputs[name][0]["stage"] for name in ("Fibres", "Outer")], [stages[2]["id"], stages[4]["id"]])
        self.assertEqual([one["stage"] for one in stages[2]["inputs"]["Input"]], [stages[0]["id"], stages[1]["id"]])
        self.assertNotIn("changed", json.dumps(stages))

    def test_files_are_known_by_their_checksums(self):
        path = os.path.join(self.folder, "my spacing.strands")
        with open(path, "w", encoding="utf-8") as file:
            file.write(STRANDS)
        (record,) = records(fetch(StrandReader(FileName=path)))
        self.assertEqual(record["properties"]["FileName"], path)
        self.assertEqual(record["files"][0]["path"], path)
        self.assertEqual(len(record["files"][0]["sha256"]), 64)

    def test_what_other_filters_did(self):
        """A filter that changes nothing of the fibres is passed over, any other is named with what came in."""
        (reference,) = records(fetch(CapsuleOptimizer(Input=AppendGeometry(Input=[bundle()]))))[-1]["inputs"]["Input"]
        self.assertEqual(set(reference), {"stage", "port", "checksum"})
        moved = Transform(Input=bundle())
        moved.Transform.Translate = [1, 0, 0]
        (reference,) = records(fetch(CapsuleOptimizer(Input=moved)))[-1]["inputs"]["Input"]
        self.assertRegex(reference["filter"], "Transform")
        self.assertEqual(len(reference["inputs"]), 1)

    def test_blocks(self):
        grouped = GroupDatasets(Input=[bundle(), bundle(Seed=2)])
        stages = records(fetch(FibreRadialGrowth(Input=grouped, VoxelSize=0.3)))
        (reference,) = stages[-1]["inputs"]["Input"]
        self.assertEqual([one["stage"] for one in reference["blocks"]], [stages[0]["id"], stages[1]["id"]])
        field = FibreField(Input=FibreRadialGrowth(Input=bundle(), VoxelSize=0.2), Select="All fibres")
        stages = records(fetch(field).GetBlock(0))
        self.assertEqual([stage["filter"] for stage in stages], ["BundleInitializer", "FibreRadialGrowth", "FibreField"])

    def test_files_of_paraview_keep_it(self):
        """Fibres that were saved are still known; from an edited file nobody knows where the data came from."""
        path = os.path.join(self.folder, "fibres.vtp")
        SaveData(path, proxy=bundle(), DataMode="Ascii")
        (reference,) = records(fetch(CapsuleOptimizer(Input=OpenDataFile(path))))[-1]["inputs"]["Input"]
        self.assertEqual((reference.get("port"), reference.get("changed")), (0, None))
        with open(path, encoding="utf-8") as file:
            text = file.read()
        start = text.index("<", text.index('Name="Radius"')) if "Name=\"Radius\"" in text else -1
        self.assertGreater(start, 0)
        numbers = text[text.index(">", text.index('Name="Radius"')) + 1 : start]
        with open(path, "w", encoding="utf-8") as file:
            file.write(text.replace(numbers, numbers.replace("0.", "0.0", 1), 1))
        (reference,) = records(fetch(CapsuleOptimizer(Input=OpenDataFile(path))))[-1]["inputs"]["Input"]
        self.assertIs(reference["changed"], True)

    def test_legacy_files_can_be_read(self):
        """As which a server hands images to its client; their reader looks for keywords in the field data, too."""
        image = fetch(FibreRadialGrowth(Input=bundle(), VoxelSize=0.5))
        path = os.path.join(self.folder, "image.vtk")
        for before in range(260):
            copy = vtkImageData()
            copy.DeepCopy(image)
            shift = vtkStringArray()
            shift.SetName("Shift")
            shift.InsertNextValue(before * "x")
            fields = copy.GetFieldData()
            stages = fields.GetAbstractArray("Provenance")
            fields.Initialize()
            fields.AddArray(shift)
            fields.AddArray(stages)
            writer = vtkDataSetWriter()
            writer.SetInputData(copy)
            writer.SetFileTypeToBinary()
            writer.SetFileName(path)
            writer.Write()
            reader = vtkDataSetReader()
            reader.SetFileName(path)
            reader.Update()
            self.assertEqual(reader.GetOutput().GetDimensions(), image.GetDimensions())
            self.assertEqual(records(reader.GetOutput()), records(image))


if __name__ == "__main__":
    main()
