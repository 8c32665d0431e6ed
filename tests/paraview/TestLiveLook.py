# SPDX-License-Identifier: BSD-3-Clause
# ctest-extended
# ctest-timeout: 200
# ctest-processors: 2
"""CapsuleOptimizer shows its fibres while it works: states on the way, then the result, with the same bits; it can be stopped and keeps its best
state. GetNeedsUpdate() is what ParaView's window asks every 200 ms."""

import os
import time

import numpy
from cactus_testing import CactusTestCase, fetch, main
from paraview.simple import BundleInitializer, CapsuleOptimizer, Delete
from paraview.vtk.util.numpy_support import vtk_to_numpy


def number(data, name):
    return data.GetFieldData().GetArray(name).GetValue(0)


def points(data):
    return vtk_to_numpy(data.GetPoints().GetData())


class LiveLook(CactusTestCase):
    def bundle(self, side=14):
        return BundleInitializer(Border="Walls", Side=side, MeanDispersion=12, Seed=3)

    def look(self, optimizer):
        """What its output is, as the window asks for it."""
        optimizer.SMProxy.MarkModified(optimizer.SMProxy)
        optimizer.UpdatePipeline()
        return optimizer.GetClientSideObject().GetOutputDataObject(0)

    def has_news(self, optimizer):
        optimizer.UpdatePropertyInformation()
        return bool(optimizer.SMProxy.GetProperty("HasNews").GetElement(0))

    def wait(self, optimizer):
        """Looks on as the window does, until the result is there; returns how many states were shown."""
        shown, deadline = 0, time.monotonic() + 100
        while self.running(optimizer) and time.monotonic() < deadline:
            shown += self.has_news(optimizer)
            time.sleep(0.002)
        return shown

    def test_states_are_shown_and_the_result_is_the_same(self):
        bundle = self.bundle(30)
        expected = CapsuleOptimizer(Input=bundle)
        last = fetch(expected, 0)
        live = CapsuleOptimizer(Input=bundle, ShowEvery=1)
        first = self.look(live)
        self.assertEqual(number(first, "Converged"), 0)
        self.assertGreater(number(first, "MaximumPenetration"), 0.1)
        self.assertLess(fetch(live, 1).GetNumberOfRows(), fetch(expected, 1).GetNumberOfRows())
        self.assertGreater(self.wait(live), 1)
        result = self.look(live)
        self.assertEqual(number(result, "Converged"), 1)
        self.assertTrue(numpy.array_equal(points(result), points(last)))
        self.assertEqual(result.GetFieldData().GetAbstractArray("Provenance").GetValue(1).count('"IsResult": true'), last.GetFieldData().GetAbstractArray("Provenance").GetValue(1).count('"IsResult": true'))
        self.assertEqual(fetch(live, 1).GetNumberOfRows(), fetch(expected, 1).GetNumberOfRows())
        self.assertFalse(self.has_news(live))

    def test_stop_keeps_the_best_state(self):
        live = CapsuleOptimizer(Input=self.bundle(20), ShowEvery=1, OverlapTolerance=1e-9)
        before = number(self.look(live), "MaximumPenetration")
        while fetch(live, 1).GetNumberOfRows() < 20:
            self.has_news(live)
        live.SMProxy.InvokeCommand("Stop")
        with self.assertError("the run was stopped"):
            self.wait(live)
        result = self.look(live)
        self.assertLess(number(result, "MaximumPenetration"), before)
        self.assertLess(fetch(live, 1).GetNumberOfRows(), 200)
        self.assertFalse(self.has_news(live))

    def running(self, live):
        """Whether what is shown is a state on the way."""
        return '"IsResult":false' in "".join(self.look(live).GetFieldData().GetAbstractArray("Provenance").GetValue(1).split())

    def test_another_value_starts_anew(self):
        bundle = self.bundle()
        live = CapsuleOptimizer(Input=bundle, ShowEvery=2)
        self.look(live)
        live.CurvatureWeight = 5
        self.wait(live)
        expected = CapsuleOptimizer(Input=bundle, CurvatureWeight=5)
        self.assertTrue(numpy.array_equal(points(self.look(live)), points(fetch(expected, 0))))
        live.ShowEvery = 0
        self.assertTrue(numpy.array_equal(points(self.look(live)), points(fetch(expected, 0))))

    def test_deleted_while_it_works(self):
        live = CapsuleOptimizer(Input=self.bundle(30), ShowEvery=1)
        self.look(live)
        start = time.monotonic()
        Delete(live)
        del live
        self.assertLess(time.monotonic() - start, 10)

    def test_a_resumed_run_is_shown_at_once(self):
        """Whatever iteration it goes on from."""
        bundle, path = self.bundle(30), os.path.join(self.folder, "run")
        with self.assertError("MaximumIterations were used up"):
            fetch(CapsuleOptimizer(Input=bundle, CheckpointFile=path, MaximumIterations=7))
        live = CapsuleOptimizer(Input=bundle, CheckpointFile=path, Resume=1, ShowEvery=1000)
        self.assertTrue(self.running(live))
        Delete(live)
        del live

    def test_a_fault_is_said_once(self):
        live = CapsuleOptimizer(Input=self.bundle(), ShowEvery=5, CheckpointFile="/nowhere/checkpoint")
        with self.assertError("cannot write /nowhere/checkpoint"):
            live.UpdatePipeline()
            live.UpdatePipeline()
        live.CheckpointFile = ""
        self.wait(live)
        self.assertEqual(number(self.look(live), "Converged"), 1)


if __name__ == "__main__":
    main()
