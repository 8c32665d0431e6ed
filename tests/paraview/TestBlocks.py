# SPDX-License-Identifier: BSD-3-Clause
"""Composite data sets (multi-block, partitioned): all blocks are one substrate, or the input is refused by name; for every filter."""

import os

from cactus_testing import UNPARTED, CactusTestCase, fetch, main, make, produce, proxies
from paraview.simple import (AppendDatasets, AppendGeometry, BundleInitializer, CapsuleOptimizer, ExtractBlock, FibreRadialGrowth,
                             GroupDatasets, GroupTimeSteps, MyelinSurface, OutputPort, SaveData, StrandReader,
                             SubstrateCertificate, SubstrateStatistics, SubstrateWriter)
from surfaces import cell_array, set_domain, tube
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkMultiBlockDataSet, vtkPartitionedDataSet, vtkPolyData, vtkTable
from vtkmodules.vtkFiltersCore import vtkAppendPolyData


def ids(data, name="FibreId"):
    return sorted(vtk_to_numpy(data.GetCellData().GetArray(name)))


def table_ids(image):
    return sorted(vtk_to_numpy(image.GetFieldData().GetArray("FibreTable.FibreId")))


def surfaces(fibres, radius, surface):
    """Closed surfaces of the fibres (id: place along x) in one data set."""
    append = vtkAppendPolyData()
    for fibre, x in fibres.items():
        part = tube(x, 0, radius, 9 - surface)
        cell_array(part, "FibreId", fibre)
        cell_array(part, "BundleId", 1)
        cell_array(part, "Surface", surface)
        append.AddInputData(part)
    append.Update()
    data = append.GetOutput()
    set_domain(data, 10)
    return data


def blocks(*parts, kind=vtkMultiBlockDataSet):
    composite = kind()
    for i, part in enumerate(parts):
        (composite.SetBlock if kind is vtkMultiBlockDataSet else composite.SetPartition)(i, part)
    return composite


class Blocks(CactusTestCase):
    expected = UNPARTED

    def bundle(self, **properties):
        return BundleInitializer(Border="Walls", CalibreVariation=0, Side=6, FibreVolumeFraction=0.2, MinimumRadius=0.4, MeanDispersion=2, GrownFibreVolumeFraction=0, **properties)

    def test_growth_of_grouped_bundles(self):
        one, two = self.bundle(), self.bundle(Seed=2)
        counts = [fetch(bundle).GetNumberOfCells() for bundle in (one, two)]
        plain = fetch(FibreRadialGrowth(Input=one, VoxelSize=0.3))
        image = fetch(FibreRadialGrowth(Input=GroupDatasets(Input=[one]), VoxelSize=0.3))
        for name in ("FibreId", "Depth"):
            same = (vtk_to_numpy(data.GetPointData().GetArray(name)).tobytes() for data in (image, plain))
            self.assertEqual(next(same), next(same))
        both = fetch(FibreRadialGrowth(Input=GroupDatasets(Input=[one, two]), VoxelSize=0.3))
        self.assertEqual(table_ids(both), list(range(1, sum(counts) + 1)))
        self.assertEqual(both.GetFieldData().GetAbstractArray("Provenance").GetNumberOfValues(), 3)

    def test_growth_of_one_block_and_of_grouped_times(self):
        group = GroupDatasets(Input=[self.bundle(), self.bundle(Seed=2)], BlockNames=["first", "second"])
        block = ExtractBlock(Input=group, Selectors=["/Root/first"])
        image = fetch(FibreRadialGrowth(Input=block, VoxelSize=0.3))
        self.assertEqual(table_ids(image), ids(fetch(self.bundle())))
        optimizer = CapsuleOptimizer(Input=self.bundle(), KeepHistory=1)
        states = GroupTimeSteps(Input=OutputPort(optimizer, 0))
        self.assertGreater(len(table_ids(fetch(FibreRadialGrowth(Input=states, VoxelSize=0.3)))), 0)

    def test_optimiser_of_grouped_bundles(self):
        """As of the same bundles at several connections, with and without the history that is made before the data."""
        one, two = self.bundle(), self.bundle(Seed=2)
        wanted = fetch(CapsuleOptimizer(Input=[one, two]))
        for history in (0, 1):
            with self.subTest(KeepHistory=history):
                found = fetch(CapsuleOptimizer(Input=GroupDatasets(Input=[one, two]), KeepHistory=history))
                self.assertEqual(ids(found), ids(wanted))
                self.assertEqual(ids(found, "BundleId"), ids(wanted, "BundleId"))
                points = (vtk_to_numpy(data.GetPoints().GetData()).tobytes() for data in (found, wanted))
                self.assertEqual(next(points), next(points))

    def test_appended_fibres(self):
        one, two = self.bundle(), self.bundle(Seed=2)
        with self.assertError("is a vtkUnstructuredGrid: fibres are polylines .* AppendGeometry"):
            FibreRadialGrowth(Input=AppendDatasets(Input=[one, two])).UpdatePipeline()
        with self.assertError("shares its FibreId with another fibre"):
            FibreRadialGrowth(Input=AppendGeometry(Input=[one, two])).UpdatePipeline()

    def test_domains_that_differ(self):
        group = GroupDatasets(Input=[self.bundle(), BundleInitializer(Border="Walls", Side=7)])
        with self.assertError("blocks of the input have different Domains"):
            FibreRadialGrowth(Input=group).UpdatePipeline()

    def test_images_in_blocks_are_refused(self):
        """Their extent was read from where there was none."""
        growth = FibreRadialGrowth(Input=self.bundle(), VoxelSize=0.3)
        for _ in range(3):
            with self.assertError("is a vtkMultiBlockDataSet, and one label image is expected"):
                surfaces = MyelinSurface(Input=GroupDatasets(Input=[growth]))
                surfaces.UpdatePipeline()
        for port in range(3):
            self.assertEqual(fetch(OutputPort(surfaces, port), port).GetNumberOfElements(0), 0)

    def test_all_blocks_are_judged_and_written(self):
        for kind in (vtkMultiBlockDataSet, vtkPartitionedDataSet):
            with self.subTest(kind=kind):
                outer = blocks(surfaces({1: -4, 2: -2}, 0.8, 0), None, surfaces({7: 0, 9: 2}, 0.8, 0), kind=kind)
                inner = blocks(surfaces({1: -4, 2: -2, 7: 0}, 0.5, 1), surfaces({9: 2}, 0.5, 1), kind=kind)
                certificate = SubstrateCertificate(Outer=produce(outer), Inner=produce(inner))
                self.assertEqual(fetch(certificate).GetValueByName(0, "Certified").ToInt(), 1)
                fibres = fetch(certificate, 1)
                self.assertEqual([fibres.GetValueByName(row, "FibreId").ToInt() for row in range(4)], [1, 2, 7, 9])
                folder = os.path.join(self.folder, kind.__name__)
                table = fetch(SubstrateWriter(Outer=produce(outer), Inner=produce(inner), FolderName=folder))
                self.assertEqual(table.GetNumberOfRows(), 8)
                self.assertEqual(len(os.listdir(os.path.join(folder, "outer"))), 4)

    def test_surfaces_of_one_fibre_in_two_blocks_are_an_error(self):
        part = surfaces({1: -4, 2: -2}, 0.8, 0)
        twice = blocks(part, part)
        for filter, more in ((SubstrateCertificate, {}), (SubstrateWriter, {"FolderName": os.path.join(self.folder, "twice")}),
                             (SubstrateStatistics, {"Fibres": self.bundle()})):
            if filter is SubstrateStatistics:
                set_domain(part, 6)
            with self.subTest(filter=filter.__name__):
                with self.assertError("Outer, block 2 holds FibreId 1, and so does block 1"):
                    filter(Outer=produce(twice), **more).UpdatePipeline()
        self.assertEqual(os.listdir(self.folder), [])

    def test_strand_file_of_blocks(self):
        path = os.path.join(self.folder, "both.strands")
        group = GroupDatasets(Input=[self.bundle(), self.bundle(Seed=2)])
        SaveData(path, proxy=group)
        self.assertEqual(fetch(StrandReader(FileName=path)).GetNumberOfCells(), len(ids(fetch(CapsuleOptimizer(Input=group)))))

    def test_blocks_of_other_data_are_refused_by_name(self):
        image = vtkImageData()
        image.SetDimensions(3, 3, 3)
        # Placement takes what comes (TestPlacement.py).
        for element in (element for group, element in proxies() if group == "filters" and element.get("name") != "Placement"):
            for what, data in (("vtkImageData", blocks(image)), ("", blocks()), ("", blocks(None, vtkPolyData())), ("vtkTable", vtkTable())):
                with self.subTest(filter=element.get("name"), data=what):
                    proxy = make(element, {"vtkPolyData": data, "vtkImageData": data})
                    if element.get("name") == "SubstrateWriter":
                        proxy.FolderName = os.path.join(self.folder, "none")
                    with self.assertError(f"is a {what}|one (label image|mask) is expected" if what else "one mask is expected|holds no|no surfaces|is empty|has no field data Domain|one label image"):
                        proxy.UpdatePipeline()


if __name__ == "__main__":
    main()
