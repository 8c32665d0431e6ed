# SPDX-License-Identifier: BSD-3-Clause
# ctest-timeout: 300
"""A tract becomes a substrate: streamlines that nibabel wrote, through the whole chain to a certificate, with what was asked for and a
warning where a bundle cannot follow."""

import json
import os

import numpy
from cactus_testing import CactusTestCase, fetch, main, mesh_oracle, produce
from nibabel.streamlines import TckFile, Tractogram
from paraview.simple import (CapsuleOptimizer, FibreRadialGrowth, MyelinSurface, OutputPort, SubstrateCertificate, SubstrateWriter,
                             TractFibres, TractogramReader)
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkPolyData

RADIUS = 30.0  # mm, of the tract


def arc(radius=RADIUS, beside=0.0, points=120):
    """Half a circle around (10, 20, 30) mm, in a plane of x and z."""
    angles = numpy.linspace(0, numpy.pi, points)
    return numpy.column_stack([10 + radius * numpy.cos(angles), numpy.full(points, 20 + beside), 30 + radius * numpy.sin(angles)]).astype("f4")


class Tracts(CactusTestCase):
    def tract(self, *streamlines, unit="Micrometre"):
        path = os.path.join(self.folder, "tract.tck")
        TckFile(Tractogram(list(streamlines), affine_to_rasmm=numpy.eye(4))).save(path)
        return TractogramReader(FileName=path, LengthUnit=unit)

    def fibres(self, tract, **properties):
        values = {"ScaleFactor": 0.001, "Side": 7, "MinimumRadius": 0.4, "MaximumRadius": 1, "FibreVolumeFraction": 0.5,
                  "GrownFibreVolumeFraction": 0.6, "CalibreVariation": 0, **properties}
        return TractFibres(Input=tract, **values)

    def test_fibres_run_round_the_arc_at_their_distance(self):
        fibres = self.fibres(self.tract(arc(), arc(beside=15)), NumberOfStreamlines=1, GrownFibreVolumeFraction=0)
        data = fetch(fibres)
        points = vtk_to_numpy(data.GetPoints().GetData())
        offsets = vtk_to_numpy(data.GetLines().GetOffsetsArray())
        middle = numpy.array(self.reached(data)["Middle"]) / 1000  # mm
        self.assertLess(numpy.linalg.norm(middle - [10, 20, 60]), 1.0)
        # Where the tract has its centre, in the substrate: 1 mm is 1 µm.
        outwards = points - (numpy.array([10, 20, 30]) - middle)
        distance = numpy.hypot(outwards[:, 0], outwards[:, 2])
        for begin, end in zip(offsets[:-1], offsets[1:]):
            self.assertLess(numpy.ptp(distance[begin:end]), 0.02)
            self.assertLess(numpy.ptp(outwards[begin:end, 1]), 0.02)
        self.assertEqual([data.GetFieldData().GetArray("Domain").GetValue(i) for i in range(6)], [-3.5, 3.5] * 3)

    @staticmethod
    def reached(data):
        records = data.GetFieldData().GetAbstractArray("Provenance")
        record = json.loads(records.GetValue(records.GetNumberOfValues() - 1))
        assert record["filter"] == "TractFibres"
        return record["reached"]

    def test_units_give_the_same_fibres(self):
        points = [vtk_to_numpy(fetch(self.fibres(self.tract(arc(), unit=unit), LengthUnit=unit)).GetPoints().GetData())
                  for unit in ("Micrometre", "Millimetre")]
        numpy.testing.assert_allclose(points[0], points[1], atol=1e-3)
        as_read = fetch(self.fibres(self.tract(arc(), unit="Millimetre")))
        self.assertTrue((vtk_to_numpy(as_read.GetPoints().GetData()) == points[1]).all())
        record = json.loads(as_read.GetFieldData().GetAbstractArray("Provenance").GetValue(1))
        self.assertEqual(record["properties"]["LengthUnit"], "Millimetre")

    def test_to_a_certificate(self):
        optimised = CapsuleOptimizer(Input=self.fibres(self.tract(arc())))
        grown = FibreRadialGrowth(Input=OutputPort(optimised, 0), VoxelSize=0.15)
        surfaces = MyelinSurface(Input=grown)
        certificate = SubstrateCertificate(Outer=OutputPort(surfaces, 0), Inner=OutputPort(surfaces, 1))
        self.assertEqual(fetch(certificate).GetValueByName(0, "Certified").ToInt(), 1)
        folder = os.path.join(self.folder, "substrate")
        SubstrateWriter(Outer=OutputPort(surfaces, 0), Inner=OutputPort(surfaces, 1), Fibres=OutputPort(optimised, 0),
                        FolderName=folder).UpdatePipeline()
        found = mesh_oracle(os.path.join(folder, "outer"))
        volume = sum(mesh["volume"] for mesh in found["meshes"])
        self.assertAlmostEqual(volume / 7**3, 0.6, delta=0.06)
        self.assertEqual(found["summary"]["intersecting_pairs"], 0)
        self.assertEqual(found["summary"]["closed"], found["summary"]["meshes"])
        with open(os.path.join(folder, "manifest.json"), encoding="utf-8") as file:
            self.assertIn("TractFibres", [stage["filter"] for stage in json.load(file)["provenance"]])

    def test_two_that_cross(self):
        line = numpy.linspace(-50, 50, 51)[:, None].astype("f4")
        fibres = self.fibres(self.tract(line * [1, 0, 0], line * [0, 1, 0] + numpy.float32([0, 0, 1])), NumberOfStreamlines=0,
                             BundleDiameter=3)
        data = fetch(fibres)
        self.assertEqual(set(vtk_to_numpy(data.GetCellData().GetArray("BundleId"))), {1, 2})
        optimised = fetch(CapsuleOptimizer(Input=fibres))
        self.assertEqual(optimised.GetFieldData().GetArray("Converged").GetValue(0), 1)

    def test_a_bend_too_sharp_is_told(self):
        fibres = self.fibres(self.tract(arc(radius=11)), Side=12)
        with self.assertError(r"rounded off.*Gaussian"):
            fibres.UpdatePipeline()
        self.assertGreater(self.reached(fetch(fibres))["Smoothing"], 0)

    def test_an_end_in_the_domain_is_told(self):
        with self.assertError(r"2 ends of streamlines lie in the domain"):
            self.fibres(self.tract(numpy.float32([[0, 0, -2], [0, 0, 2]]))).UpdatePipeline()

    def test_what_is_no_tract_gives_one_error(self):
        with self.assertError(r"no streamlines"):
            self.fibres(produce(vtkPolyData())).UpdatePipeline()
        with self.assertError(r"BundleId"):
            self.fibres(self.tract(arc()), Select="Bundle").UpdatePipeline()
        with self.assertError(r"FirstStreamline"):
            self.fibres(self.tract(arc()), Select="Range", FirstStreamline=5, LastStreamline=9).UpdatePipeline()
        with self.assertError(r"BundleDiameter"):
            self.fibres(self.tract(arc(), arc(beside=0.1)), NumberOfStreamlines=0, BundleDiameter=14).UpdatePipeline()


if __name__ == "__main__":
    main()
