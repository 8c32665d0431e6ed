# SPDX-License-Identifier: BSD-3-Clause
# ctest-timeout: 300
# ctest-needs: display
"""CapsuleOptimizer in ParaView: what it hands on, says and keeps."""

import os
import tempfile

from cactus_testing import CactusTestCase, fetch, main, produce
from paraview import servermanager
from paraview.simple import (BundleInitializer, CapsuleOptimizer, CreateView, GetAnimationScene, OutputPort, Show, Transform, Tube)
from vtkmodules.vtkCommonCore import vtkStringArray

COLUMNS = ["Iteration", "OverlapCost", "MaximumPenetration", "OverlappingPairs", "CurvatureCost", "LengthCost", "RadiusCost",
           "CompactnessCost", "Seconds"]


def number(data, name):
    return data.GetFieldData().GetArray(name).GetValue(0)


def fetch_at(proxy, time):
    proxy.UpdatePipeline(time)
    return proxy.GetClientSideObject().GetOutputDataObject(0)


def bundle(**properties):
    return BundleInitializer(Border="Walls", Side=10, FibreVolumeFraction=0.6, MeanDispersion=8, **properties)


class Optimizer(CactusTestCase):
    def test_no_overlap_is_left_and_the_shape_is_reported(self):
        optimizer = CapsuleOptimizer(Input=bundle(), TrimToDomain=0)
        fibres = fetch(optimizer, 0)
        self.assertEqual(number(fibres, "Converged"), 1)
        self.assertLessEqual(number(fibres, "MaximumPenetration"), 1e-3)
        overlap = fibres.GetPointData().GetArray("Overlap")
        self.assertEqual(overlap.GetNumberOfTuples(), fibres.GetNumberOfPoints())
        self.assertAlmostEqual(overlap.GetRange()[1], number(fibres, "MaximumPenetration"))
        self.assertAlmostEqual(number(fibres, "InitialMeanDispersion"), 8, delta=0.3)
        self.assertAlmostEqual(number(fibres, "MeanDispersion"), number(fibres, "InitialMeanDispersion"), delta=1)
        self.assertGreater(number(fibres, "TangentDispersion"), number(fibres, "InitialTangentDispersion"))
        self.assertEqual(number(fibres, "CrossingAngle"), 0)
        self.assertGreater(number(fibres, "SmallestBendRadius"), 1)
        self.assertGreater(number(fibres, "SmallestCurvatureRadius"), 0.2)
        self.assertEqual(number(fibres, "RadiusDistance"), 0)
        self.assertGreater(number(fibres, "LengthIncrease"), 0)
        self.assertLess(number(fibres, "LengthIncrease"), 0.2)
        self.assertEqual(fibres.GetFieldData().GetAbstractArray("Provenance").GetNumberOfValues(), 2)

        table = fetch(optimizer, 1)
        names = [table.GetColumnName(i) for i in range(table.GetNumberOfColumns())]
        self.assertEqual(names, COLUMNS)
        last = table.GetNumberOfRows() - 1
        self.assertGreater(last, 10)
        self.assertGreater(table.GetColumnByName("MaximumPenetration").GetValue(0), 0.1)
        self.assertLessEqual(table.GetColumnByName("MaximumPenetration").GetValue(last), 1e-3)
        self.assertEqual(table.GetColumnByName("Iteration").GetValue(last), last)

    def test_tangents_of_a_dense_bundle_stay_where_neighbours_point_alike(self):
        def tangents(**properties):
            start = BundleInitializer(Border="Walls", Side=20, FibreVolumeFraction=0.7, MeanDispersion=10, CalibreVariation=0, **properties)
            fibres = fetch(CapsuleOptimizer(Input=start), 0)
            self.assertEqual(number(fibres, "Converged"), 1)
            self.assertAlmostEqual(number(fibres, "MeanDispersion"), number(fibres, "InitialMeanDispersion"), delta=0.3)
            return number(fibres, "TangentDispersion") - number(fibres, "InitialTangentDispersion")

        self.assertLess(tangents(), 1)
        self.assertGreater(tangents(DispersionModel="Watson"), 3)

    def test_several_bundles_in_any_direction(self):
        upright = bundle(CalibreVariation=0)
        lying = Transform(Input=bundle(Seed=2, CalibreVariation=0))
        lying.Transform.Rotate = [90, 0, 0]
        lying.TransformAllInputVectors = 0
        with self.assertError("together have 1.[0-9]+ times the domain's volume"):
            fetch(CapsuleOptimizer(Input=[upright, lying]), 0)
        upright.FibreVolumeFraction = lying.Input.FibreVolumeFraction = 0.4
        optimizer = CapsuleOptimizer(Input=[upright, lying])
        with self.assertError("the fibres have become [0-9]+ % longer"):  # of two in one place
            fibres = fetch(optimizer, 0)
        self.assertEqual(number(fibres, "Converged"), 1)
        self.assertGreater(number(fibres, "LengthIncrease"), 0.08)
        ids = fibres.GetCellData().GetArray("BundleId")
        self.assertEqual({ids.GetValue(i) for i in range(fibres.GetNumberOfCells())}, {1, 2})
        self.assertAlmostEqual(number(fibres, "InitialCrossingAngle"), 90, delta=1)
        self.assertAlmostEqual(number(fibres, "CrossingAngle"), 90, delta=1)

    def test_what_runs_out_of_iterations_says_so_and_keeps_the_best(self):
        source = bundle()
        optimizer = CapsuleOptimizer(Input=source, MaximumIterations=3)
        with self.assertError("overlaps remain: MaximumIterations were used up after 3 iterations"):
            fibres = fetch(optimizer, 0)
        self.assertEqual(number(fibres, "Converged"), 0)
        self.assertGreater(number(fibres, "MaximumPenetration"), 1e-3)
        self.assertGreater(fibres.GetNumberOfCells(), 0)

    def test_what_is_stopped_keeps_the_best_and_can_be_run_again(self):
        """As with the abort button: the flag is set while progress is reported, and nobody else takes it back."""
        optimizer = CapsuleOptimizer(Input=bundle(), HistoryInterval=1)
        algorithm = optimizer.GetClientSideObject()

        def stop(*_):
            if 0 < algorithm.GetProgress() < 1:
                algorithm.SetAbortExecuteAndUpdateTime()

        observer = algorithm.AddObserver("ProgressEvent", stop)
        optimizer.KeepHistory = 1
        with self.assertError("overlaps remain: the run was stopped after [1-9][0-9]* iterations with [0-9]+ capsule pairs above"):
            fibres = fetch(optimizer, 0)
        self.assertEqual(number(fibres, "Converged"), 0)
        self.assertGreater(number(fibres, "MaximumPenetration"), 1e-3)
        self.assertAlmostEqual(fibres.GetPointData().GetArray("Overlap").GetRange()[1], number(fibres, "MaximumPenetration"))
        tubes = Tube(Input=OutputPort(optimizer, 0), Scalars=["POINTS", "Radius"])
        self.assertGreater(fetch(tubes).GetNumberOfCells(), 0)
        # Looking back at its states does not start the run again: it would not be stopped, and converge.
        algorithm.RemoveObserver(observer)
        states = fetch(optimizer, 1).GetNumberOfRows()
        fetch_at(optimizer, 0)
        self.assertEqual(fetch(optimizer, 1).GetNumberOfRows(), states)

        optimizer.KeepHistory = 0
        self.assertEqual(number(fetch(optimizer, 0), "Converged"), 1)

    def test_radii_that_may_change_keep_their_distribution(self):
        fibres = fetch(CapsuleOptimizer(Input=bundle(), RadiusTolerance=0.02), 0)
        self.assertEqual(number(fibres, "Converged"), 1)
        self.assertGreater(number(fibres, "RadiusDistance"), 0)
        self.assertLess(number(fibres, "RadiusDistance"), 0.1)

    def test_time_steps_show_the_way_from_the_first_state_to_the_result(self):
        plain = fetch(CapsuleOptimizer(Input=bundle()), 0)
        optimizer = CapsuleOptimizer(Input=bundle(), KeepHistory=1, HistoryInterval=10)
        optimizer.UpdatePipeline()
        optimizer.UpdatePipelineInformation()
        times = list(optimizer.TimestepValues)
        self.assertGreater(len(times), 4)
        self.assertEqual(times[:3], [0, 10, 20])
        largest = []
        for time in times:
            state = fetch_at(optimizer, time)
            largest.append(number(state, "MaximumPenetration"))
            self.assertEqual(state.GetPointData().GetArray("Overlap").GetNumberOfTuples(), state.GetNumberOfPoints())
        self.assertGreater(largest[0], 0.1)
        self.assertLessEqual(largest[-1], 1e-3)
        result = fetch_at(optimizer, times[-1])
        self.assertEqual(result.GetNumberOfPoints(), plain.GetNumberOfPoints())
        for i in range(0, plain.GetNumberOfPoints(), 17):
            self.assertEqual(result.GetPoint(i), plain.GetPoint(i))
        # The table is that of the whole run, whatever the time.
        table = fetch(optimizer, 1)
        self.assertEqual(table.GetNumberOfRows(), times[-1] + 1)
        # Off again, there are no time steps.
        optimizer.KeepHistory = 0
        optimizer.UpdatePipeline()
        optimizer.UpdatePipelineInformation()
        self.assertEqual(len(optimizer.TimestepValues), 0)

    def test_time_steps_reach_what_follows(self):
        """As in a view that plays an animation of tubes: each time is known downstream, and shows its own state."""
        optimizer = CapsuleOptimizer(Input=bundle(), KeepHistory=1, HistoryInterval=40)
        tubes = Tube(Input=OutputPort(optimizer, 0), Scalars=["POINTS", "Radius"])
        OutputPort(optimizer, 1).UpdatePipeline(0)  # a time that the other port was asked for does not count
        times = list(optimizer.TimestepValues)
        self.assertEqual(times[:2], [0, 40])
        scene = GetAnimationScene()
        scene.UpdateAnimationUsingDataTimeSteps()
        self.assertEqual((scene.StartTime, scene.EndTime), (0, times[-1]))
        largest = [number(fetch_at(tubes, time), "MaximumPenetration") for time in (0, 40, times[-1], 40, 0)]
        self.assertGreater(largest[0], largest[1])
        self.assertGreater(largest[1], largest[2])
        self.assertLessEqual(largest[2], 1e-3)
        self.assertEqual(largest[3:], [largest[1], largest[0]])

    def test_follows_the_time_of_what_comes_in(self):
        first = CapsuleOptimizer(Input=bundle(), KeepHistory=1, HistoryInterval=20)
        second = CapsuleOptimizer(Input=OutputPort(first, 0))
        second.UpdatePipeline()
        second.UpdatePipelineInformation()
        times = list(first.TimestepValues)
        self.assertEqual(list(second.TimestepValues), times)
        initial = [number(fetch_at(second, time), "InitialMeanDispersion") for time in (times[0], times[-1], times[0])]
        self.assertNotEqual(initial[0], initial[1])
        self.assertEqual(initial[0], initial[2])
        # Its own times are another run's iterations, of which the first one knows nothing.
        second.KeepHistory = 1
        second.UpdatePipeline()
        runs = []
        second.GetClientSideObject().AddObserver("ProgressEvent", lambda caller, _: runs.append(caller.GetProgressText()))
        second.UpdatePipelineInformation()
        for time in second.TimestepValues:
            self.assertEqual(number(fetch_at(second, time), "InitialMeanDispersion"), initial[1])
        self.assertEqual([text for text in runs if text and "iteration" in text], [])

    def test_hands_on_what_fields_come_with_the_fibres(self):
        fibres = fetch(bundle())
        subject = vtkStringArray()
        subject.SetName("Subject")
        subject.InsertNextValue("17")
        fibres.GetFieldData().AddArray(subject)
        optimised = fetch(CapsuleOptimizer(Input=produce(fibres)), 0)
        self.assertEqual(optimised.GetFieldData().GetAbstractArray("Subject").GetValue(0), "17")
        self.assertAlmostEqual(number(optimised, "GrownFibreVolumeFraction"), number(fibres, "GrownFibreVolumeFraction"))

    def test_convergence_leaves_the_view_to_the_fibres_and_can_be_drawn(self):
        optimizer = CapsuleOptimizer(Input=bundle(), MaximumIterations=5)
        with self.assertError("overlaps remain"):
            optimizer.UpdatePipeline()
        controller = servermanager.vtkSMParaViewPipelineControllerWithRendering()
        self.assertEqual(controller.GetPreferredViewType(optimizer.SMProxy, 1), "None")
        # By row, which is the iteration, and every column is there to be drawn.
        chart = Show(OutputPort(optimizer, 1), CreateView("XYChartView"))
        self.assertEqual(chart.UseIndexForXAxis, 1)
        self.assertEqual(sorted(chart.SeriesVisibility), sorted(COLUMNS))

    def test_a_run_that_was_cut_short_is_resumed(self):
        plain = fetch(CapsuleOptimizer(Input=bundle()), 0)
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "run.checkpoint")
            with self.assertError("overlaps remain: MaximumIterations were used up"):
                fetch(CapsuleOptimizer(Input=bundle(), CheckpointFile=path, MaximumIterations=20), 0)
            self.assertEqual(os.listdir(folder), ["run.checkpoint"])
            optimizer = CapsuleOptimizer(Input=bundle(), CheckpointFile=path, Resume=1)
            resumed = fetch(optimizer, 0)
            for i in range(plain.GetNumberOfPoints()):
                self.assertEqual(resumed.GetPoint(i), plain.GetPoint(i))
            iterations = fetch(optimizer, 1).GetColumnByName("Iteration")
            self.assertEqual([iterations.GetValue(i) for i in range(25)], list(range(25)))
            with self.assertError("was written for other fibres or other parameters"):
                fetch(CapsuleOptimizer(Input=bundle(Seed=2), CheckpointFile=path, Resume=1), 0)
            # What is there is kept, whether a run is to go on from it or not: another run's, and what is no checkpoint at all.
            with open(path, "rb") as file:
                kept = file.read()
            with self.assertError("was written for other fibres or other parameters, and is kept"):
                fetch(CapsuleOptimizer(Input=bundle(Seed=2), CheckpointFile=path), 0)
            with open(path, "rb") as file:
                self.assertEqual(file.read(), kept)
            with open(path, "wb") as file:
                file.write(kept[:500] + b"x" + kept[501:])
            with self.assertError("CheckpointFile .*run.checkpoint is damaged: remove it"):
                fetch(CapsuleOptimizer(Input=bundle(), CheckpointFile=path, Resume=1), 0)
            other = os.path.join(folder, "thesis.txt")
            with open(other, "w") as file:
                file.write("chapter 1")
            with self.assertError("thesis.txt is not a checkpoint of this program, and is kept"):
                fetch(CapsuleOptimizer(Input=bundle(), CheckpointFile=other), 0)
            with open(other) as file:
                self.assertEqual(file.read(), "chapter 1")
            self.assertEqual(sorted(os.listdir(folder)), ["run.checkpoint", "thesis.txt"])


if __name__ == "__main__":
    main()
