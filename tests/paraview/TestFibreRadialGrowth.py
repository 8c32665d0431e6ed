# SPDX-License-Identifier: BSD-3-Clause
"""Fibre radial growth through ParaView: the data model, targets, requested extents, repeatability, and bad input."""

import hashlib
import json
import math
import os
import random

import numpy as np
from cactus_testing import CactusTestCase, fetch, main, produce
from paraview.simple import (AppendGeometry, BundleInitializer, Calculator, CapsuleOptimizer, ExtractSurface, FibreRadialGrowth, GroupDatasets, MyelinSurface, OutputPort, StrandReader,
                             SubstrateCertificate, SubstrateStatistics, Threshold)
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import VTK_FLOAT, VTK_INT



def bundle(side=6.0, pitch=1.4, radius=0.6):
    """The text of a strand file: slightly bent fibres on a hexagonal lattice."""
    strands = []
    rows = int(side / pitch) + 1
    for row in range(-rows, rows + 1):
        for column in range(-rows, rows + 1):
            x, y = (column + 0.5 * (row % 2)) * pitch, row * pitch * math.sqrt(0.75)
            if max(abs(x), abs(y)) < 0.5 * side:
                points = [(x + 0.1 * math.sin(z), y + 0.1 * math.cos(1.3 * z), z) for z in (-3.5, -2, 0, 1, 2.5, 3.5)]
                strands.append(
                    f"{len(points)}\n" + "\n".join(f"{p[0]:.9g} {p[1]:.9g} {p[2]:.9g} {radius}" for p in points)
                )
    return f"{side}\n{len(strands)}\n" + "\n".join(strands) + "\n"


def arrays(image):
    data = image.GetPointData()
    return vtk_to_numpy(data.GetArray("FibreId")), vtk_to_numpy(data.GetArray("Depth"))


class FibreRadialGrowthTest(CactusTestCase):
    def fibres(self):
        path = os.path.join(self.folder, "bundle.strands")
        with open(path, "w") as file:
            file.write(bundle())
        return StrandReader(FileName=path)

    def test_takes_its_target_from_the_bundle(self):
        """Through the optimiser, of one bundle and of several; a warning names the difference where another one is given."""
        one, two = (BundleInitializer(Border="Walls", Side=6, FibreVolumeFraction=0.3, GrownFibreVolumeFraction=0.35, Seed=seed) for seed in (1, 2))
        both, parted = CapsuleOptimizer(Input=[one, two]), CapsuleOptimizer(Input=one)
        self.assertAlmostEqual(fetch(both).GetFieldData().GetArray("GrownFibreVolumeFraction").GetValue(0), 0.7)
        for fibres, fraction in ((OutputPort(parted, 0), 0.35), (OutputPort(both, 0), 0.7)):
            image = fetch(FibreRadialGrowth(Input=fibres, VoxelSize=0.1, SurfaceRoughness=0))
            self.assertAlmostEqual(np.mean(vtk_to_numpy(image.GetPointData().GetArray("FibreId")) > 0), fraction, delta=0.005)
        with self.assertError(r"TargetFibreVolumeFraction is 0\.5.*made to fill 0\.7.*thinner.*about 15 %"):
            fetch(FibreRadialGrowth(Input=OutputPort(both, 0), VoxelSize=0.2, TargetFibreVolumeFraction=0.5))
        other = fetch(both)
        other.GetFieldData().GetArray("GrownFibreVolumeFraction").SetValue(0, 0.35)
        with self.assertError(r"made to fill 0\.35.*would fill 0\.\d+ with their TargetRadius.*give TargetFibreVolumeFraction 0\.\d+"):
            fetch(FibreRadialGrowth(Input=produce(other), VoxelSize=0.2))

    def test_fibres_that_were_picked_or_joined_keep_their_radii(self):
        """By ParaView's own filters, which pass on what the first of their inputs says of the whole."""
        one, two = (BundleInitializer(Border="Walls", Side=6, FibreVolumeFraction=0.3, GrownFibreVolumeFraction=0.35, Seed=seed) for seed in (1, 2))
        whole = fetch(CapsuleOptimizer(Input=[one, two]))
        ids = vtk_to_numpy(whole.GetCellData().GetArray("FibreId"))
        parted = produce(whole)

        def part(least, most):
            picked = Threshold(Input=parted, Scalars=["CELLS", "FibreId"], LowerThreshold=least, UpperThreshold=most)
            return ExtractSurface(Input=picked)

        middle = int(np.median(ids))
        halves = part(1, middle), part(middle + 1, ids.max())

        def made(fibres):
            image = fetch(FibreRadialGrowth(Input=fibres, VoxelSize=0.1))
            return image.GetFieldData().GetArray("FibreVolumeFraction").GetValue(0)

        fractions = [made(half) for half in halves]
        self.assertTrue(all(0.2 < fraction < 0.5 for fraction in fractions), fractions)
        self.assertAlmostEqual(sum(fractions), 0.7, delta=1e-6)
        for join in (AppendGeometry, GroupDatasets):
            self.assertAlmostEqual(made(join(Input=list(halves))), 0.7, delta=1e-6)

    def test_gives_the_data_model(self):
        image = fetch(FibreRadialGrowth(Input=self.fibres(), VoxelSize=0.1, GrowthIterations=2))
        self.assertEqual(image.GetExtent(), (0, 59, 0, 59, 0, 59))
        for found, expected in zip(image.GetOrigin() + image.GetSpacing(), 3 * (-2.95,) + 3 * (0.1,)):
            self.assertAlmostEqual(found, expected, 12)
        data = image.GetPointData()
        self.assertEqual(data.GetArray("FibreId").GetDataType(), VTK_INT)
        self.assertEqual(data.GetArray("Depth").GetDataType(), VTK_FLOAT)
        ids, depth = arrays(image)
        self.assertTrue(((ids > 0) == (depth > 0)).all())
        self.assertTrue((depth[ids == 0] >= -4 * 0.1 - 1e-6).all())
        field = image.GetFieldData()
        table = [field.GetArray("FibreTable." + name) for name in ("FibreId", "BundleId", "TargetRadius")]
        self.assertTrue(set(ids) - {0} <= set(vtk_to_numpy(table[0])))
        self.assertEqual({column.GetNumberOfTuples() for column in table}, {table[0].GetNumberOfTuples()})
        self.assertAlmostEqual(table[2].GetValue(0), 0.6)
        for name, value in (("Growth", 0.2), ("MinimumGap", 0.02), ("SurfaceTolerance", 0.0075), ("VoxelSize", 0.1)):
            self.assertAlmostEqual(field.GetArray(name).GetValue(0), value)
        self.assertIsNone(field.GetArray("FibreVolumeFraction"))  # no target
        self.assertEqual([field.GetArray("Domain").GetValue(i) for i in range(6)], [-3, 3, -3, 3, -3, 3])
        stages = field.GetAbstractArray("Provenance")
        self.assertEqual(stages.GetNumberOfValues(), 2)
        self.assertIn("FibreRadialGrowth", stages.GetValue(1))

    def test_target_is_met_over_the_domain(self):
        growth = FibreRadialGrowth(Input=self.fibres(), VoxelSize=0.1, TargetFibreVolumeFraction=0.8)
        ids, _ = arrays(fetch(growth))
        self.assertAlmostEqual((ids > 0).mean(), 0.8, delta=0.003)
        self.assertEqual(fetch(growth).GetFieldData().GetArray("FibreVolumeFraction").GetValue(0), 0.8)
        growth.Margin = 0.3
        image = fetch(growth)
        self.assertEqual(image.GetExtent(), (0, 65, 0, 65, 0, 65))
        ids, _ = arrays(image)
        inner = ids.reshape(66, 66, 66)[3:-3, 3:-3, 3:-3]
        self.assertAlmostEqual((inner > 0).mean(), 0.8, delta=0.003)

    def test_radii_end_on_target(self):
        bundle = BundleInitializer(Border="Walls", Side=10, MeanDispersion=3, GrownFibreVolumeFraction=0.85, Seed=1)
        fibres = OutputPort(CapsuleOptimizer(Input=bundle), 0)
        image = fetch(FibreRadialGrowth(Input=fibres, VoxelSize=0.1, TargetFibreVolumeFraction=0.85))
        ids = arrays(image)[0].reshape(100, 100, 100)
        field = image.GetFieldData()
        target = dict(zip(*(vtk_to_numpy(field.GetArray("FibreTable." + name)) for name in ("FibreId", "TargetRadius"))))
        cut = set(np.unique(ids[:, (0, -1), :])) | set(np.unique(ids[:, :, (0, -1)]))
        # Those that run from end to end without touching a side: their volume is their length times their area.
        whole = sorted((set(np.unique(ids[0])) & set(np.unique(ids[-1]))) - cut - {0})
        self.assertGreater(len(whole), 15)
        ratios = [math.sqrt((ids == fibre).sum() * 1e-3 / 10 / math.pi) / target[fibre] for fibre in whole]
        self.assertAlmostEqual(np.mean(ratios), 1.0, delta=0.03)
        self.assertLess(max(ratios) - min(ratios), 0.2)  # calibre varies over a few µm

    def test_sections_of_axons_have_the_axis_ratio_asked_for(self):
        """On final surfaces, which are certified, by some thirty axons; of a fibre that has none of its own growth alone shapes the sections."""
        for border in ("Cut", "Periodic"):
            bundle = BundleInitializer(Side=8, Border=border, MaximumRadius=1, FibreVolumeFraction=0.55, GrownFibreVolumeFraction=0.7, SectionAxisRatio=0.8)
            fibres = OutputPort(CapsuleOptimizer(Input=bundle), 0)
            surfaces = MyelinSurface(Input=FibreRadialGrowth(Input=fibres))
            given = {"Fibres": fibres, "Outer": OutputPort(surfaces, 0), "Inner": OutputPort(surfaces, 1)}
            self.assertEqual(fetch(SubstrateCertificate(**given), 0).GetColumnByName("Certified").GetValue(0), 1)
            reached = fetch(SubstrateStatistics(**given), 0)
            self.assertAlmostEqual(reached.GetColumnByName("MeanInnerAxisRatio").GetValue(0), 0.8, delta=0.04)
            self.assertAlmostEqual(reached.GetColumnByName("FVF").GetValue(0), 0.7, delta=0.003)
            plain = Calculator(Input=fibres, AttributeType="Cell Data", ResultArrayName="TargetAxisRatio", Function="1")
            round_ones = MyelinSurface(Input=FibreRadialGrowth(Input=plain))
            table = fetch(SubstrateStatistics(Fibres=plain, Outer=OutputPort(round_ones, 0), Inner=OutputPort(round_ones, 1)), 0)
            self.assertGreater(table.GetColumnByName("MeanInnerAxisRatio").GetValue(0), 0.9)

    def test_fibres_that_still_overlap_are_warned_of(self):
        optimizer = CapsuleOptimizer(Input=BundleInitializer(Border="Walls", Side=6, MeanDispersion=10, DispersionModel="Watson"), MaximumIterations=3)
        with self.assertError("overlaps remain"):
            fibres = fetch(optimizer, 0)
        self.assertEqual(fibres.GetFieldData().GetArray("Converged").GetValue(0), 0)
        growth = FibreRadialGrowth(Input=OutputPort(optimizer, 0), VoxelSize=0.2)
        with self.assertError("still overlap"):
            self.assertGreater(arrays(fetch(growth))[0].max(), 0)
        optimizer.MaximumIterations = 3000
        fetch(growth)  # and says nothing

    def test_fibres_that_were_never_parted_are_warned_of(self):
        """Once, by how far they overlap; not after the optimiser, and not where nothing overlaps."""
        bundle = BundleInitializer(Border="Walls", Side=6, MeanDispersion=10, DispersionModel="Watson")
        growth = FibreRadialGrowth(Input=bundle, VoxelSize=0.2)
        with self.assertError(r"[1-9]\d* pairs of capsules.*overlap, the worst by [1-9]\d* %.*Apply CapsuleOptimizer first"):
            fetch(growth)
        growth.Input = OutputPort(CapsuleOptimizer(Input=bundle), 0)
        fetch(growth)
        fetch(FibreRadialGrowth(Input=BundleInitializer(Border="Walls", Side=6, MeanDispersion=0, CalibreVariation=0), VoxelSize=0.2))

    def test_parted_fibres_that_were_changed_since_are_warned_of(self):
        bundle = BundleInitializer(Border="Walls", Side=6, MeanDispersion=10, DispersionModel="Watson", GrownFibreVolumeFraction=0)
        parted = OutputPort(CapsuleOptimizer(Input=bundle), 0)
        thinner, thicker = (Calculator(Input=parted, ResultArrayName="Radius", Function=f"Radius*{factor}") for factor in (0.9, 1.3))
        fetch(FibreRadialGrowth(Input=thinner, VoxelSize=0.2, GrowthIterations=1))
        with self.assertError(r"pairs of capsules.*overlap, the worst by [1-9]\d* %"):
            fetch(FibreRadialGrowth(Input=thicker, VoxelSize=0.2, GrowthIterations=1))

    def test_bundles_that_were_parted_each_for_itself_are_warned_of(self):
        parted = [OutputPort(CapsuleOptimizer(Input=BundleInitializer(Border="Walls", Side=6, FibreVolumeFraction=0.3, GrownFibreVolumeFraction=0.35, Seed=seed)), 0) for seed in (1, 2)]
        with self.assertError(r"pairs of capsules.*the optimiser has not parted these fibres"):
            fetch(FibreRadialGrowth(Input=GroupDatasets(Input=parted), VoxelSize=0.2))

    def test_a_requested_extent_equals_that_part_of_the_whole(self):
        growth = FibreRadialGrowth(Input=self.fibres(), VoxelSize=0.1, TargetFibreVolumeFraction=0.75)
        whole_ids, whole_depth = (values.reshape(60, 60, 60).copy() for values in arrays(fetch(growth)))
        algorithm = growth.GetClientSideObject()
        chance = random.Random(5)
        for _ in range(8):
            ends = [sorted(chance.sample(range(60), 2)) for _ in range(3)]
            extent = [end for pair in ends for end in pair]
            algorithm.Modified()
            algorithm.UpdateExtent(extent)
            part = algorithm.GetOutputDataObject(0)
            self.assertEqual(list(part.GetExtent()), extent)
            (i0, i1), (j0, j1), (k0, k1) = ends
            ids, depth = (values.reshape(k1 - k0 + 1, j1 - j0 + 1, i1 - i0 + 1) for values in arrays(part))
            box = (slice(k0, k1 + 1), slice(j0, j1 + 1), slice(i0, i1 + 1))
            self.assertEqual(ids.tobytes(), whole_ids[box].tobytes())
            self.assertEqual(depth.tobytes(), whole_depth[box].tobytes())

    def test_threads_do_not_change_a_bit(self):
        growth = FibreRadialGrowth(Input=self.fibres(), VoxelSize=0.1, TargetFibreVolumeFraction=0.85)
        digests = set()
        for threads in (1, 2, 4):
            growth.NumberOfThreads = threads
            ids, depth = arrays(fetch(growth))
            digests.add(hashlib.sha256(ids.tobytes() + depth.tobytes()).hexdigest())
        self.assertEqual(len(digests), 1)

    def test_bad_properties_give_one_error_and_no_image(self):
        for name, value in (
            ("VoxelSize", 0.0),
            ("VoxelSize", -0.1),
            ("VoxelSize", float("nan")),
            ("VoxelSize", 50.0),
            ("TargetFibreVolumeFraction", -0.5),
            ("TargetFibreVolumeFraction", 1.0),
            ("GrowthIterations", -1),
            ("MinimumGap", -0.01),
            ("SurfaceTolerance", -0.01),
            ("SurfaceRoughness", 0.6),
            ("Margin", -1.0),
            ("NumberOfThreads", -1),
        ):
            with self.subTest(property=name, value=value):
                growth = FibreRadialGrowth(Input=self.fibres())
                with self.assertError(name):
                    setattr(growth, name, value)
                    growth.UpdatePipeline()

    def test_a_target_out_of_reach_is_met_as_far_as_can_be(self):
        growth = FibreRadialGrowth(Input=self.fibres(), TargetFibreVolumeFraction=0.995, MinimumGap=0.1)
        with self.assertError(r"TargetFibreVolumeFraction 0\.995 cannot be reached: the fibres fill 0\.\d+ of the domain"):
            growth.UpdatePipeline()
        image = fetch(growth)
        reached = json.loads(image.GetFieldData().GetAbstractArray("Provenance").GetValue(1))["reached"]
        self.assertAlmostEqual(reached["FibreVolumeFraction"], (arrays(image)[0] > 0).mean(), places=2)
        self.assertEqual(image.GetFieldData().GetArray("FibreVolumeFraction").GetValue(0), reached["FibreVolumeFraction"])

    def test_an_image_beyond_memory(self):
        growth = FibreRadialGrowth(Input=self.fibres(), VoxelSize=0.001)
        with self.assertError(r"VoxelSize 0\.001 .*GB"):
            growth.UpdatePipeline()


if __name__ == "__main__":
    main()
