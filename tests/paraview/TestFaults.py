# SPDX-License-Identifier: BSD-3-Clause
# ctest-needs: display
# ctest-timeout: 240
"""One fault, one message; what follows is empty, marked and silent; and the next good value works: in scripts, views and stopped runs."""

import math
import os
import time

from cactus_testing import CactusTestCase, fetch, main, produce
from chain import Chain
from paraview import simple
from paraview.simple import FibreRadialGrowth, OutputPort, SaveData, SubstrateStatistics
from vtkmodules.vtkCommonCore import vtkDoubleArray


def output(proxy, port=0):
    return proxy.GetClientSideObject().GetOutputDataObject(port)


def mark(proxy, port=0):
    array = output(proxy, port).GetFieldData().GetAbstractArray("Error")
    return array.GetValue(0) if array else ""


def size(proxy, port=0):
    data = output(proxy, port)
    return sum(data.GetNumberOfElements(kind) for kind in (0, 1, 6))  # points, cells, rows


class Faults(CactusTestCase):
    def setUp(self):
        super().setUp()
        self.chain = Chain(self.folder)

    def test_a_good_value_after_a_bad_one(self):
        for stage, name, bad, pattern in self.chain.bad_values():
            with self.subTest(stage=stage.SMProxy.GetXMLName(), property=name):
                good = getattr(stage, name)
                ports = range(stage.SMProxy.GetNumberOfOutputPorts())
                for first in (False, True):  # as the first value of all, and after a result
                    setattr(stage, name, bad)
                    with self.assertError(pattern):
                        stage.UpdatePipeline()
                        stage.UpdatePipeline()
                    for port in ports:
                        self.assertEqual(size(stage, port), 0)
                        self.assertRegex(mark(stage, port), pattern)
                    setattr(stage, name, good)
                    stage.UpdatePipeline()
                    for port in ports:
                        self.assertGreater(size(stage, port), 0)
                        self.assertEqual(mark(stage, port), "")

    def test_what_follows_a_fault_is_silent_and_comes_back(self):
        last = (self.chain.statistics, self.chain.certificate, self.chain.writer)
        for stage, name, bad, pattern in self.chain.bad_values()[1:5]:
            with self.subTest(stage=stage.SMProxy.GetXMLName()):
                good = getattr(stage, name)
                setattr(stage, name, bad)
                with self.assertError(pattern):
                    for follower in last:
                        follower.UpdatePipeline()
                for follower in last:
                    self.assertEqual(size(follower), 0)
                    self.assertRegex(mark(follower), pattern)
                self.assertFalse(os.path.exists(self.chain.writer.FolderName))
                setattr(stage, name, good)
        for follower in last:
            follower.UpdatePipeline()
            self.assertGreater(size(follower), 0)
        self.assertTrue(os.path.exists(self.chain.writer.FolderName))

    def test_a_view_of_each_stage(self):
        """As in the window: Apply sets the property, and the view asks for the data."""
        view = simple.CreateRenderView()
        for stage, name, bad, pattern in self.chain.bad_values()[:5]:
            with self.subTest(stage=stage.SMProxy.GetXMLName()):
                good = getattr(stage, name)
                shown = simple.Show(OutputPort(stage, 0), view)
                simple.Render(view)
                self.assertGreater(size(stage), 0)
                setattr(stage, name, bad)
                with self.assertError(pattern):
                    simple.Render(view)
                    simple.Render(view)
                self.assertEqual(size(stage), 0)
                setattr(stage, name, good)
                simple.Render(view)
                self.assertGreater(size(stage), 0)
                shown.Visibility = 0

    def test_a_writer_refuses_what_failed(self):
        self.chain.bundle.Side = -6
        path = os.path.join(self.folder, "failed.strands")
        with self.assertError("Side|writer"):
            self.chain.bundle.UpdatePipeline()
        with self.assertError("No matching writer"), self.assertRaises(AttributeError):
            SaveData(path, proxy=self.chain.bundle)
        self.assertFalse(os.path.exists(path))

    def test_a_stopped_run_is_not_started_by_what_asks_next(self):
        """The flag is set while progress is reported, as by the abort button."""
        chain = self.chain
        for stage in (chain.growth, chain.surface, chain.statistics, chain.certificate, chain.writer):
            with self.subTest(stage=stage.SMProxy.GetXMLName()):
                stage.NumberOfThreads = 1  # with more, the others may do it all before the one that asks
                algorithm = stage.GetClientSideObject()
                stops = []

                def stop(*_):
                    if 0 <= algorithm.GetProgress() < 1:
                        stops.append(1)
                        algorithm.SetAbortExecuteAndUpdateTime()

                observer = algorithm.AddObserver("ProgressEvent", stop)
                with self.assertError("stopped by the user, and nothing is kept"):
                    stage.UpdatePipeline()
                algorithm.RemoveObserver(observer)
                self.assertGreater(len(stops), 0)
                self.assertEqual(size(stage), 0)
                for _ in range(2):
                    time.sleep(1.1)  # what asks at one time is told once
                    with self.assertError("stopped by the user, and nothing is kept"):
                        algorithm.Update()  # UpdatePipeline() passes by what has not been changed
                    self.assertEqual(size(stage), 0)
                stage.NumberOfThreads = 2
                stage.UpdatePipeline()
                self.assertGreater(size(stage), 0)

    def test_history_of_a_run_that_fails(self):
        optimizer = self.chain.optimizer
        optimizer.KeepHistory = 1
        optimizer.OverlapTolerance = -1
        with self.assertError("OverlapTolerance"):
            optimizer.UpdatePipeline()
            optimizer.UpdatePipelineInformation()
            optimizer.UpdatePipeline()
        self.assertEqual(len(optimizer.TimestepValues), 0)
        optimizer.OverlapTolerance = 1e-3
        optimizer.UpdatePipeline()
        self.assertGreater(size(optimizer), 0)

    def test_ids_that_are_none(self):
        fibres = fetch(self.chain.bundle)
        outer = fetch(self.chain.surface, 0)
        for value in (math.nan, math.inf, -math.inf, 1e300, 2.0**31, 1.5, 0, -1, -1e300):
            for name in ("FibreId", "BundleId"):
                with self.subTest(value=value, array=name):
                    for good, filter, input in ((fibres, FibreRadialGrowth, "Input"), (outer, SubstrateStatistics, "Outer")):
                        data = good.NewInstance()
                        data.DeepCopy(good)
                        ids = vtkDoubleArray()
                        ids.SetName(name)
                        for cell in range(data.GetNumberOfCells()):
                            ids.InsertNextValue(good.GetCellData().GetArray(name).GetTuple1(cell))
                        ids.SetValue(1 if filter is FibreRadialGrowth else 0, value)
                        data.GetCellData().AddArray(ids)
                        more = {} if input == "Input" else {"Fibres": produce(fibres)}
                        with self.assertError(name + " of cell [01] is .*ids count from 1"):
                            filter(**{input: produce(data)}, **more).UpdatePipeline()

    def test_ids_of_the_image_that_are_none(self):
        image = fetch(self.chain.growth)
        for value in (math.nan, 1e300, 2.0**31, 1.5, 0):
            with self.subTest(value=value):
                data = image.NewInstance()
                data.ShallowCopy(image)
                ids = vtkDoubleArray()
                ids.SetName("FibreTable.FibreId")
                ids.DeepCopy(image.GetFieldData().GetArray("FibreTable.FibreId"))
                ids.SetValue(0, value)
                data.GetFieldData().AddArray(ids)
                with self.assertError("FibreTable.FibreId of cell 0 is .*ids count from 1"):
                    simple.MyelinSurface(Input=produce(data)).UpdatePipeline()

    def test_cells_with_points_that_do_not_exist(self):
        fibres = fetch(self.chain.bundle)
        fibres.GetLines().GetConnectivityArray().SetTuple1(1, 10**6)
        with self.assertError("cell 0 names point 1000000"):
            FibreRadialGrowth(Input=produce(fibres)).UpdatePipeline()
        outer = fetch(self.chain.surface, 0)
        outer.GetPolys().GetConnectivityArray().SetTuple1(5, 10**8)
        outer.GetPolys().GetConnectivityArray().Modified()
        with self.assertError("Outer holds triangles with points that do not exist"):
            simple.SubstrateCertificate(Outer=produce(outer)).UpdatePipeline()


if __name__ == "__main__":
    main()
