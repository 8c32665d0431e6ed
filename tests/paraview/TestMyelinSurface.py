# SPDX-License-Identifier: BSD-3-Clause
# ctest-timeout: 300
"""Myelin surfaces through ParaView: their measures by formula, and their soundness judged by the mesh oracle."""

import hashlib
import math
import os

import numpy
from cactus_testing import UNPARTED, CactusTestCase, fetch, main, mesh_oracle, produce
from paraview.simple import Calculator, CapsuleOptimizer, FibreRadialGrowth, MyelinSurface, OutputPort, Placement, StrandReader, SubstrateCertificate, SubstrateStatistics, TrivialProducer
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import reference, vtkDoubleArray, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkImageData, vtkPolyData, vtkStaticCellLocator


def strands(side, lines):
    """The text of a strand file of polylines {radius, [points]}."""
    text = [f"{side}", f"{len(lines)}"]
    for radius, points in lines:
        text.append(str(len(points)))
        text += [f"{p[0]:.9g} {p[1]:.9g} {p[2]:.9g} {radius}" for p in points]
    return "\n".join(text) + "\n"


def hexagonal(side=4.0, pitch=1.1, radius=0.5):
    """Bent fibres on a hexagonal lattice, which meet all their neighbours when they grow."""
    rows = int(side / pitch) + 1
    lines = []
    for row in range(-rows, rows + 1):
        for column in range(-rows, rows + 1):
            x, y = (column + 0.5 * (row % 2)) * pitch, row * pitch * math.sqrt(0.75)
            if max(abs(x), abs(y)) < 0.5 * side:
                along = numpy.linspace(-0.6 * side, 0.6 * side, 7)
                lines.append((radius, [(x + 0.05 * math.sin(2 * z + row), y + 0.05 * math.cos(2 * z), z) for z in along]))
    return strands(side, lines)


def parts(surface):
    """{fibre: (points, triangles)} of an output of the filter; fails unless fibres share no points and come in order."""
    ids = vtk_to_numpy(surface.GetCellData().GetArray("FibreId"))
    assert (numpy.diff(ids) >= 0).all()
    points = vtk_to_numpy(surface.GetPoints().GetData())
    triangles = vtk_to_numpy(surface.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    result = {}
    used = 0
    for fibre in numpy.unique(ids):
        own = triangles[ids == fibre]
        first, last = own.min(), own.max()
        assert first == used
        used = last + 1
        result[int(fibre)] = (points[first : last + 1], own - first)
    assert used == len(points)
    return result


def volume(part):
    points, triangles = part
    a, b, c = (points[triangles[:, i]] for i in range(3))
    return numpy.einsum("ij,ij->i", a, numpy.cross(b, c)).sum() / 6


def distances(part, other, inside):
    """From points spread evenly over one surface, at most `inside` from the middle along each axis, to another surface."""
    points, triangles = part
    corners = points[triangles]
    areas = numpy.linalg.norm(numpy.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    random = numpy.random.default_rng(1)
    weights = random.dirichlet((1, 1, 1), 2000)
    picked = corners[random.choice(len(triangles), len(weights), p=areas / areas.sum())]
    places = numpy.einsum("ij,ijk->ik", weights, picked)
    places = places[abs(places).max(axis=1) < inside]
    data = vtkPolyData()
    data.SetPoints(vtkPoints())
    data.GetPoints().SetData(numpy_to_vtk(other[0], deep=True))
    cells = vtkCellArray()
    cells.SetData(3, numpy_to_vtkIdTypeArray(other[1].astype(numpy.int64).ravel(), deep=True))
    data.SetPolys(cells)
    locator = vtkStaticCellLocator()
    locator.SetDataSet(data)
    locator.BuildLocator()
    squares = numpy.empty(len(places))
    cell, part_of_cell, square = reference(0), reference(0), reference(0.0)
    for i, place in enumerate(places):
        locator.FindClosestPoint(place, [0.0, 0.0, 0.0], cell, part_of_cell, square)
        squares[i] = square.get()
    return numpy.sqrt(squares)


def column(table, name):
    return vtk_to_numpy(table.GetColumnByName(name))


class MyelinSurfaceTest(CactusTestCase):
    expected = UNPARTED

    def growth(self, text, **properties):
        path = os.path.join(self.folder, "fibres.strands")
        with open(path, "w") as file:
            file.write(text)
        return FibreRadialGrowth(Input=StrandReader(FileName=path), **properties)

    def judge(self, surfaces, *arguments):
        """What the oracle finds in {name: part}."""
        folder = os.path.join(self.folder, "judged")
        os.makedirs(folder, exist_ok=True)
        for old in os.listdir(folder):
            os.remove(os.path.join(folder, old))
        for name, (points, triangles) in surfaces.items():
            with open(os.path.join(folder, name + ".ply"), "w") as file:
                file.write("ply\nformat ascii 1.0\n")
                file.write(f"element vertex {len(points)}\nproperty double x\nproperty double y\nproperty double z\n")
                file.write(f"element face {len(triangles)}\nproperty list uchar int vertex_indices\nend_header\n")
                file.writelines("%.17g %.17g %.17g\n" % tuple(point) for point in points)
                file.writelines("3 %d %d %d\n" % tuple(triangle) for triangle in triangles)
        return mesh_oracle(folder, *arguments)

    def assertSound(self, outer, inner, gap):
        """All closed, outward, free of self-intersections and contacts; inner in outer; outer ones `gap` apart."""
        surfaces = {f"outer{fibre}": part for fibre, part in outer.items()}
        found = self.judge(surfaces, "--gap", str(gap))
        count = len(outer)
        self.assertEqual(
            found["summary"],
            {
                "meshes": count,
                "closed": count,
                "manifold": count,
                "outward": count,
                "self_intersecting": 0,
                "intersecting_pairs": 0,
                "near_pairs": 0,
            },
        )
        self.assertEqual([mesh["pieces"] for mesh in found["meshes"]], [1] * count)
        surfaces.update({f"inner{fibre}": part for fibre, part in inner.items()})
        found = self.judge(surfaces)
        for name in ("closed", "manifold", "outward"):
            self.assertEqual(found["summary"][name], count + len(inner))
        self.assertEqual(found["summary"]["self_intersecting"] + found["summary"]["intersecting_pairs"], 0)
        inside = {(pair["a"], pair["b"]) for pair in found["pairs"] if pair["relation"] == "a_in_b"}
        self.assertEqual(inside, {(f"inner{fibre}.ply", f"outer{fibre}.ply") for fibre in inner})

    def test_one_straight_fibre(self):
        growth = self.growth(strands(6, [(1.0, [(0.03, -0.02, -9), (0.03, -0.02, 9)])]), GrowthIterations=0, SurfaceRoughness=0)
        for smoothing in (0, 2):
            surface = MyelinSurface(Input=growth, GRatio=0.6, SmoothingIterations=smoothing)
            outer, inner = (parts(fetch(surface, port))[1] for port in (0, 1))
            # Blurring would move a cylinder's surface inwards by n h² / (4 r); that is made up for.
            radius = 1.0
            self.assertAlmostEqual(volume(outer), math.pi * 6, delta=0.002 * math.pi * 6)
            self.assertAlmostEqual(volume(inner) / volume(outer), 0.36, delta=0.36 * 0.002)
            # Flat caps, exactly on the faces of the domain; those of the axon a gap inside, in single precision.
            self.assertEqual((outer[0][:, 2].min(), outer[0][:, 2].max()), (-3.0, 3.0))
            inset = float(numpy.float32(2.98))
            self.assertEqual((inner[0][:, 2].min(), inner[0][:, 2].max()), (-inset, inset))
            # Points lie where the surface is, and the myelin is as thick all around.
            side = numpy.abs(outer[0][:, 2]) < 2.9
            distance = numpy.hypot(outer[0][side, 0] - 0.03, outer[0][side, 1] + 0.02)
            self.assertLess(numpy.abs(distance - radius).max(), 0.008)
            table = fetch(surface, 2)
            self.assertEqual(table.GetNumberOfRows(), 1)
            self.assertAlmostEqual(column(table, "OuterVolume_um3")[0], volume(outer), 9)
            self.assertAlmostEqual(column(table, "InnerVolume_um3")[0], volume(inner), 9)
            self.assertAlmostEqual(column(table, "GRatio")[0], math.sqrt(volume(inner) / volume(outer)), 9)
            self.assertAlmostEqual(column(table, "Thickness_um")[0], 0.4, delta=0.01)
            self.assertEqual(list(column(table, "Myelin")), [0])

    def test_bundle_grown_to_contact_is_sound(self):
        growth = self.growth(hexagonal(), TargetFibreVolumeFraction=0.9, VoxelSize=0.08)
        surface = MyelinSurface(Input=growth)
        outer, inner = (parts(fetch(surface, port)) for port in (0, 1))
        self.assertGreater(len(outer), 12)
        self.assertEqual(set(inner), set(outer))
        self.assertSound(outer, inner, 0.02)
        table = fetch(surface, 2)
        self.assertEqual(set(column(table, "OuterClosed")) | set(column(table, "InnerClosed")), {1})
        self.assertLess(max(column(table, "OuterSquaredEdgeRatio").max(), column(table, "InnerSquaredEdgeRatio").max()), 1000)
        total = [sum(volume(part) for part in one.values()) for one in (outer, inner)]
        self.assertAlmostEqual(total[0] / 4**3, 0.9, delta=0.005)
        self.assertAlmostEqual(math.sqrt(total[1] / total[0]), 0.7, delta=0.001)
        self.assertEqual(set(column(table, "Flawed")), {0})

    def test_skew_fibres_are_sound(self):
        lines = [
            (0.6, [(-4, -1, 0.2), (0, -0.2, 0.1), (4, 1, -0.3)]),
            (0.5, [(-1, -4, 1.0), (0.1, 0, 1.2), (1, 4, 0.9)]),
            (0.4, [(0.9, 0.9, -4), (1.1, 0.8, -1.1), (1.9, 1.6, 4)]),
        ]
        growth = self.growth(strands(5, lines), GrowthIterations=3, VoxelSize=0.1)
        surface = MyelinSurface(Input=growth, SmoothingIterations=1)
        self.assertSound(*(parts(fetch(surface, port)) for port in (0, 1)), 0.02)

    def test_coarsening_keeps_its_distance(self):
        growth = self.growth(hexagonal(3.0), TargetFibreVolumeFraction=0.85)
        surface = MyelinSurface(Input=growth, DecimationError=0)
        fine = parts(fetch(surface, 0))
        counts = []
        for error in (0.0025, 0.005):
            surface.DecimationError = error
            coarse = parts(fetch(surface, 0))
            counts.append(sum(len(triangles) for _, triangles in coarse.values()))
            self.assertEqual(set(coarse), set(fine))
            for fibre in coarse:
                self.assertAlmostEqual(volume(coarse[fibre]), volume(fine[fibre]), delta=0.006 * volume(fine[fibre]))
                for one, other in ((coarse, fine), (fine, coarse)):
                    apart = distances(one[fibre], other[fibre], 1.49)
                    self.assertLess(math.sqrt((apart**2).mean()), 0.75 * error)
                    self.assertLess(numpy.percentile(apart, 90), 1.1 * error)
                    self.assertLess(numpy.percentile(apart, 99), 3.0 * error)
        self.assertLess(counts[1], counts[0])
        self.assertLess(counts[1], 0.06 * sum(len(triangles) for _, triangles in fine.values()))

    def test_fibres_that_may_touch_are_coarsened_too(self):
        # MinimumGap 0: caps of axons keep off the plane of the outer surfaces' caps all the same.
        surface = MyelinSurface(Input=self.growth(hexagonal(3.0), TargetFibreVolumeFraction=0.8, MinimumGap=0))
        outer, inner = (parts(fetch(surface, port)) for port in (0, 1))
        self.assertEqual(set(inner), set(outer))
        self.assertSound(outer, inner, 1e-6)
        for fibre in inner:
            self.assertAlmostEqual(inner[fibre][0][:, 2].max(), 1.5 - 0.05 * 0.1, places=6)
            self.assertLess(len(inner[fibre][1]), 2 * len(outer[fibre][1]))

    def myelin(self, outer, inner, side):
        """Smallest distance of the inner surfaces to the walls of the outer ones, by the oracle; caps are left out."""
        walls = {}
        for fibre, (points, triangles) in outer.items():
            on_face = numpy.abs(points[triangles]) == side / 2
            walls[fibre] = (points, triangles[~on_face.all(axis=1).any(axis=1)])
        smallest = math.inf
        for fibre, part in inner.items():
            found = self.judge({"inner": part, "wall": walls[fibre]}, "--gap", "0.2")
            smallest = min([smallest] + [pair["distance"] for pair in found["pairs"] if pair["distance"] is not None])
        return smallest

    def test_fibres_that_may_touch_do_not_meet(self):
        # Neither gap nor tolerance: contours of neighbours cross each other until they are moved apart.
        growth = self.growth(hexagonal(3.0), TargetFibreVolumeFraction=0.95, MinimumGap=0, SurfaceTolerance=0)
        surface = MyelinSurface(Input=growth, DecimationError=0)
        outer, inner = (parts(fetch(surface, port)) for port in (0, 1))
        self.assertGreater(len(outer), 6)
        self.assertSound(outer, inner, 0.001)
        self.assertEqual(set(column(fetch(surface, 2), "Flawed")), {0})

    def test_faults_are_looked_for_without_coarsening(self):
        growth = self.growth(hexagonal(), TargetFibreVolumeFraction=0.9, VoxelSize=0.3)
        surface = MyelinSurface(Input=growth, DecimationError=0, GRatio=0.93)
        with self.assertError(r"fibres are not as asked.*with thicker myelin \(2\)"):
            surface.UpdatePipeline()
        outer, inner = (parts(fetch(surface, port)) for port in (0, 1))
        self.assertSound(outer, inner, 0.02)
        self.assertGreaterEqual(self.myelin(outer, inner, 4), 0.02)

    def test_myelin_is_as_thick_as_promised(self):
        growth = self.growth(hexagonal(), TargetFibreVolumeFraction=0.9, VoxelSize=0.2)
        surface = MyelinSurface(Input=growth, GRatio=0.95)
        with self.assertError(r"fibres are not as asked.*with thicker myelin \(2\)"):
            surface.UpdatePipeline()
        outer, inner = (parts(fetch(surface, port)) for port in (0, 1))
        self.assertGreaterEqual(self.myelin(outer, inner, 4), 0.02)
        whole = fetch(SubstrateCertificate(Outer=OutputPort(surface, 0), Inner=OutputPort(surface, 1)))
        self.assertEqual((column(whole, "Certified")[0], column(whole, "ThinMyelin")[0]), (1, 0))
        self.assertGreaterEqual(column(whole, "SmallestMyelin_um")[0], 0.02)

    def test_fibres_that_vanish_are_counted(self):
        lines = [(1.2, [(-0.6, 0, -9), (-0.6, 0, 9)]), (0.3, [(1.2, 0, -9), (1.2, 0, 9)]), (0.5, [(9, 0, -9), (9, 0, 9)])]
        for gap, fraction, verdict in ((2, None, "1 of 2"), (8, 0.0, "2 of 2")):
            growth = self.growth(strands(6, lines), TargetFibreVolumeFraction=0, MinimumGap=gap, VoxelSize=0.2)
            surface = MyelinSurface(Input=growth)
            with self.assertError(rf"of 2 fibres are not as asked.*{verdict[0]} without any surface \(Myelin 4\).*MinimumGap {gap}"):
                surface.UpdatePipeline()
            lost = column(fetch(surface, 2), "Myelin") == 4
            self.assertEqual(lost.sum(), int(verdict[0]) + 1)  # and the one that passes by outside
            certificate = SubstrateCertificate(Outer=OutputPort(surface, 0), Inner=OutputPort(surface, 1))
            with self.assertError(rf"not certified: {verdict} fibres have no outer surface"):
                whole = fetch(certificate)
            self.assertEqual((column(whole, "Fibres")[0], column(whole, "WithoutOuter")[0]), (2, int(verdict[0])))
            statistics = SubstrateStatistics(Fibres=growth.Input, Outer=OutputPort(surface, 0), Inner=OutputPort(surface, 1))
            row = fetch(statistics)
            values = [column(row, name)[0] for name in ("FVF", "AVF", "MVF", "AggregateGRatio")]
            self.assertTrue(numpy.isfinite(values).all(), values)
            if fraction is not None:
                self.assertEqual(values, [0, 0, 0, 0])

    def test_coarse_voxels_give_what_they_can(self):
        for size in (0.75, 1.0, 1.5, 2.0, 3.0):
            growth = self.growth(hexagonal(6.0, 1.3, 0.55), TargetFibreVolumeFraction=0.9, VoxelSize=size)
            surface = MyelinSurface(Input=growth)
            surface.UpdatePipeline()
            messages, self._messages = self._messages, []
            table = fetch(surface, 2)
            if (column(table, "Myelin") != 0).any() or column(table, "Flawed").any():
                self.assertEqual(len(messages), 1)
                self.assertRegex(messages[0], rf"fibres are not as asked.*VoxelSize {size:g} µm is coarse for fibres of radii")
            else:
                self.assertEqual((messages, size < 1.5), ([], True))
            has_outer, has_inner = column(table, "OuterTriangles") > 0, column(table, "InnerTriangles") > 0
            self.assertTrue((column(table, "OuterClosed") == has_outer).all())
            self.assertTrue((column(table, "InnerClosed") == has_inner).all())
            self.assertTrue((has_outer == (column(table, "Myelin") != 4)).all())

    def test_much_smoothing(self):
        surface = MyelinSurface(Input=self.growth(hexagonal(3.0), TargetFibreVolumeFraction=0.8), SmoothingIterations=20)
        self.assertSound(*(parts(fetch(surface, port)) for port in (0, 1)), 0.02)

    def test_models(self):
        growth = self.growth(hexagonal(), TargetFibreVolumeFraction=0.8)
        surface = MyelinSurface(Input=growth, GRatioModel="Distributed", GRatio=0.65, GRatioDeviation=0.06)
        table = fetch(surface, 2)
        as_asked = column(table, "Myelin") == 0
        self.assertGreater(as_asked.mean(), 0.9)
        wanted, reached = column(table, "TargetGRatio").copy(), column(table, "GRatio").copy()
        self.assertLess(numpy.abs(wanted - reached)[as_asked].max(), 0.002)
        self.assertAlmostEqual(wanted.mean(), 0.65, delta=0.05)
        self.assertGreater(wanted.std(), 0.02)
        surface.Seed = 2
        self.assertTrue((column(fetch(surface, 2), "TargetGRatio") != wanted).all())

        surface.GRatioModel = "TargetAxonVolumeFraction"
        surface.TargetAxonVolumeFraction = 0.37
        axons = sum(volume(part) for part in parts(fetch(surface, 1)).values())
        self.assertAlmostEqual(axons / 4**3, 0.37, delta=0.002)
        surface.TargetAxonVolumeFraction = 0.85
        with self.assertError(r"TargetAxonVolumeFraction 0\.85 cannot be reached"):
            surface.UpdatePipeline()

    def test_log_linear_model(self):
        lines = [(1.5, [(-2, 0, -9), (-2, 0, 9)]), (0.45, [(2, 0, -9), (2, 0, 9)])]
        growth = self.growth(strands(8, lines), GrowthIterations=0, SurfaceRoughness=0)
        table = fetch(MyelinSurface(Input=growth, GRatioModel="LogLinear", SmoothingIterations=0), 2)
        diameter, low, high = 3.0, 0.1, 3.0
        for _ in range(60):
            middle = 0.5 * (low + high)
            thick = 0.35 + 0.006 * middle + 0.024 * math.log(middle)
            low, high = (middle, high) if middle + 2 * thick < diameter else (low, middle)
        self.assertAlmostEqual(column(table, "GRatio")[0], low / diameter, delta=0.004)
        self.assertAlmostEqual(column(table, "TargetGRatio")[1], 0.3, 12)

    def test_beyond_the_domain(self):
        text = strands(4, [(0.8, [(0, 0, -9), (0, 0, 9)])])
        growth = self.growth(text, GrowthIterations=0, SurfaceRoughness=0, Margin=0.5)
        surface = MyelinSurface(Input=growth)
        clipped = parts(fetch(surface, 0))[1]
        self.assertEqual(clipped[0][:, 2].max(), 2.0)
        surface.ClipToDomain = 0
        whole = parts(fetch(surface, 0))[1]
        self.assertAlmostEqual(whole[0][:, 2].max(), 2.5, 12)
        self.assertAlmostEqual(volume(whole) / volume(clipped), 5 / 4, delta=0.002)

    @staticmethod
    def digest(surface):
        """Of both surfaces and the table."""
        digest = hashlib.sha256()
        for port in (0, 1):
            output = fetch(surface, port)
            digest.update(vtk_to_numpy(output.GetPoints().GetData()).tobytes())
            digest.update(vtk_to_numpy(output.GetPolys().GetConnectivityArray()).tobytes())
            digest.update(vtk_to_numpy(output.GetCellData().GetArray("FibreId")).tobytes())
        table = fetch(surface, 2)
        for i in range(table.GetNumberOfColumns()):
            digest.update(vtk_to_numpy(table.GetColumn(i)).tobytes())
        return digest.hexdigest()

    def test_threads_do_not_change_a_bit(self):
        growth = self.growth(hexagonal(3.0), TargetFibreVolumeFraction=0.85)
        # Each a filter of its own, which has no outer surfaces yet.
        digests = {self.digest(MyelinSurface(Input=growth, NumberOfThreads=threads)) for threads in (1, 2, 4)}
        self.assertEqual(len(digests), 1)

    def test_an_image_may_begin_below_zero(self):
        """As that of a volume of interest may: the same samples in the same place, counted from elsewhere."""
        growth = self.growth(hexagonal(3.0), TargetFibreVolumeFraction=0.85)
        growth.UpdatePipeline()
        image = growth.GetClientSideObject().GetOutputDataObject(0)
        volumes = []
        for shift in (0, 20, 37):
            shifted = vtkImageData()
            shifted.ShallowCopy(image)
            shifted.SetExtent([end - shift for end in image.GetExtent()])
            shifted.SetOrigin([first + shift * step for first, step in zip(image.GetOrigin(), image.GetSpacing())])
            source = TrivialProducer()
            source.GetClientSideObject().SetOutput(shifted)
            table = fetch(MyelinSurface(Input=source), 2)
            volumes.append(vtk_to_numpy(table.GetColumnByName("OuterVolume_um3")))
        for found in volumes[1:]:
            numpy.testing.assert_allclose(found, volumes[0], rtol=1e-3)

    def test_outer_surfaces_are_kept_while_only_g_ratios_change(self):
        growth = self.growth(hexagonal(3.0), TargetFibreVolumeFraction=0.85)
        kept = MyelinSurface(Input=growth)
        stages = set()
        filter = kept.GetClientSideObject()
        filter.AddObserver("ProgressEvent", lambda *_: stages.add(filter.GetProgressText()))
        spaces = "keeping fibres apart"
        again = {"making surfaces", "making outer surfaces", spaces}  # outer ones alone where g-ratios depend on all

        def after(**properties):
            stages.clear()
            for name, value in properties.items():
                setattr(kept, name, value)
            kept.UpdatePipeline()
            self.assertIn(None, stages, "what the run before ended with is not said again")
            return stages - {None}

        self.assertLessEqual({"making surfaces", spaces}, after())
        told = {}
        for change in (
            {"GRatio": 0.6},
            {"GRatioModel": "LogLinear"},
            {"GRatioModel": "Distributed", "Seed": 7},
            {"GRatioDeviation": 0.1},
            {"MyelinFollowsAxon": 1},
            {"SwellingAmplitude": 0.2},
            {"SwellingSpacing": 4, "SwellingLength": 1},
            {"GRatioModel": "TargetAxonVolumeFraction", "TargetAxonVolumeFraction": 0.3},
        ):
            told.update(change)
            seen = after(**change)
            self.assertIn("making inner surfaces", seen, change)
            self.assertEqual(seen & again, set(), change)
            self.assertEqual(self.digest(kept), self.digest(MyelinSurface(Input=growth, **told)), change)
        for change in ({"DecimationError": 0.004}, {"SmoothingIterations": 1}, {"ClipToDomain": 0}):
            told.update(change)
            self.assertLessEqual({"making outer surfaces", spaces}, after(**change), change)
        growth.MinimumGap = 0.03
        self.assertLessEqual({"making outer surfaces", spaces}, after())
        self.assertEqual(self.digest(kept), self.digest(MyelinSurface(Input=growth, **told)))
        # What failed in between has not spoilt them.
        with self.assertError("TargetAxonVolumeFraction 0.9 cannot be reached"):
            after(TargetAxonVolumeFraction=0.9)
        self.assertEqual(after(TargetAxonVolumeFraction=0.3) & again, set())
        self.assertEqual(self.digest(kept), self.digest(MyelinSurface(Input=growth, **told)))
        # Nodes of Ranvier are as deep as the g-ratio makes myelin.
        told.update(GRatioModel="Constant", GRatio=0.6, NodeLength=1, InternodeFactor=1, ParanodeLength=0.5)
        after(**told)
        told["GRatio"] = 0.65
        self.assertLessEqual({"making surfaces", spaces}, after(GRatio=0.65))
        self.assertEqual(self.digest(kept), self.digest(MyelinSurface(Input=growth, **told)))

    def test_axons_swell_inside_the_same_fibres(self):
        """A twin: outer surfaces have the same bits, axons the same volumes; what has no room is said."""
        growth = self.growth(hexagonal(6.0), GrowthIterations=1, VoxelSize=0.1)
        healthy, swollen = (MyelinSurface(Input=growth, **properties) for properties in ({}, {"SwellingAmplitude": 0.2, "SwellingSpacing": 3, "SwellingLength": 1}))
        outer, inner, ratios = [], [], []
        for one in (healthy, swollen):
            outer.append(vtk_to_numpy(fetch(one, 0).GetPoints().GetData()))
            inner.append(vtk_to_numpy(fetch(one, 2).GetColumnByName("InnerVolume_um3")))
            given = {"Outer": OutputPort(one, 0), "Inner": OutputPort(one, 1), "Fibres": growth.Input}
            self.assertTrue(fetch(SubstrateCertificate(**given), 0).GetColumnByName("Certified").GetValue(0))
            measured = fetch(SubstrateStatistics(CutSpacing=0.25, **given), 0)
            ratios.append(measured.GetColumnByName("MeanAxonDiffusivityRatio").GetValue(0))
        numpy.testing.assert_array_equal(*outer)
        numpy.testing.assert_allclose(*inner, rtol=0.003)
        self.assertGreater(ratios[0], 0.99)
        self.assertLess(ratios[1], 0.98)
        with self.assertError("axons with myelin swell by less than SwellingAmplitude 0.35"):
            swollen.SwellingAmplitude = 0.35
            swollen.SwellingSpacing = 5
            swollen.UpdatePipeline()

    def test_fibres_say_how_much_myelin_there_is(self):
        """By point data, which pass the optimiser. Another fraction or g-ratio makes outer surfaces again."""
        healthy = self.growth(hexagonal(3.0), GrowthIterations=1, VoxelSize=0.1)
        said = Calculator(Input=healthy.Input, ResultArrayName="MyelinFraction", Function="min(1, max(0, abs(coordsZ) - 0.3))", ResultArrayType="Double")
        growth = FibreRadialGrowth(Input=OutputPort(CapsuleOptimizer(Input=said, MaximumIterations=0), 0), GrowthIterations=1, VoxelSize=0.1)
        lost, surfaces = {}, MyelinSurface(Input=growth)
        for name, one in (("healthy", MyelinSurface(Input=healthy)), ("0.7", surfaces)):
            lost[name] = vtk_to_numpy(fetch(one, 2).GetColumnByName("LostMyelin"))
        self.assertEqual(lost["healthy"].max(), 0)
        self.assertGreater(lost["0.7"].min(), 0.1)
        self.assertTrue(fetch(SubstrateCertificate(Outer=OutputPort(surfaces, 0)), 0).GetColumnByName("Certified").GetValue(0))
        for change in ({"GRatio": 0.8}, {}):
            for name, value in change.items():
                setattr(surfaces, name, value)
            if not change:
                said.Function = "min(1, max(0, abs(coordsZ) - 0.6))"
            self.assertEqual(self.digest(surfaces), self.digest(MyelinSurface(Input=growth, GRatio=0.8)))
        said.Function = "2 + 0 * coordsZ"
        with self.assertError("MyelinFraction is 2"):
            growth.UpdatePipeline()

    def test_thin_fibres_lose_their_internodes_first(self):
        """Another order makes outer surfaces again."""
        thick, thin = (0.7, [(-0.9, 0, -9), (-0.9, 0, 9)]), (0.45, [(0.9, 0, -9), (0.9, 0, 9)])
        growth = self.growth(strands(6, [thick, thin]), GrowthIterations=0)
        surfaces = MyelinSurface(Input=growth, NodeLength=0.8, InternodeFactor=1, ParanodeLength=0.5, InternodeLoss=0.5)
        lost = {}
        for order in ("Random", "Thinnest first"):
            surfaces.InternodeOrder = order
            lost[order] = vtk_to_numpy(fetch(surfaces, 2).GetColumnByName("LostMyelin")).copy()
        surfaces.InternodeLoss = 0
        lost["none"] = vtk_to_numpy(fetch(surfaces, 2).GetColumnByName("LostMyelin"))
        self.assertAlmostEqual(lost["Thinnest first"][0], lost["none"][0], delta=0.01)
        self.assertGreater(lost["Thinnest first"][1], lost["none"][1] + 0.2)
        self.assertNotEqual(lost["Random"].tolist(), lost["Thinnest first"].tolist())

    def test_outer_surfaces_of_vtk_are_kept_too(self):
        growth = self.growth(hexagonal(3.0), GrowthIterations=1)
        kept = MyelinSurface(Input=growth, Meshing="VTK filters")
        warned = "fibres are not as asked"
        with self.assertError(warned):
            kept.UpdatePipeline()
        with self.assertError(warned):
            kept.GRatio = 0.5
            digest = self.digest(kept)
        with self.assertError(warned):
            self.assertEqual(digest, self.digest(MyelinSurface(Input=growth, Meshing="VTK filters", GRatio=0.5)))

    def test_the_image_can_be_released(self):
        cells = set()
        for release in (0, 1):
            growth = self.growth(hexagonal(3.0), GrowthIterations=1)
            surface = MyelinSurface(Input=growth, ReleaseInput=release)
            surface.UpdatePipeline()
            filters = [growth.GetClientSideObject(), surface.GetClientSideObject()]
            images = [filters[0].GetOutputDataObject(0), filters[1].GetInputDataObject(0, 0)]
            for image in images:
                self.assertEqual(image.GetPointData().GetNumberOfArrays(), 0 if release else 2)
            cells.add((fetch(surface, 0).GetNumberOfCells(), fetch(surface, 1).GetNumberOfCells()))
            # Taking the surfaces has not made it anew; asking for it does.
            self.assertEqual(images[1].GetPointData().GetNumberOfArrays(), 0 if release else 2)
            self.assertGreater(fetch(growth, 0).GetPointData().GetArray("FibreId").GetRange()[1], 0)
        self.assertEqual(len(cells), 1)

    def test_data_model(self):
        surface = MyelinSurface(Input=self.growth(hexagonal(3.0), GrowthIterations=1))
        for port in (0, 1):
            output = fetch(surface, port)
            self.assertEqual(set(vtk_to_numpy(output.GetCellData().GetArray("Surface"))), {port})
            self.assertEqual(set(vtk_to_numpy(output.GetCellData().GetArray("BundleId"))), {1})
            self.assertEqual([output.GetFieldData().GetArray("Domain").GetValue(i) for i in range(6)], 3 * [-1.5, 1.5])
            stages = output.GetFieldData().GetAbstractArray("Provenance")
            self.assertIn("MyelinSurface", stages.GetValue(stages.GetNumberOfValues() - 1))

    def test_triangles_have_the_values_of_their_fibre(self):
        length, along = 4 / 0.8, numpy.array([0.6, 0, 0.8])  # from the lower to the upper face
        lines = [(0.5, [(along[0] * t, y, along[2] * t) for t in (-3, 3)]) for y in (-0.7, 0.7)]
        surface = MyelinSurface(Input=self.growth(strands(4, lines), VoxelSize=0.05), GRatio=0.6)
        outer, inner = (parts(fetch(surface, port)) for port in (0, 1))
        for port in (0, 1):
            data = fetch(surface, port)
            ids = vtk_to_numpy(data.GetCellData().GetArray("FibreId"))
            values = {name: vtk_to_numpy(data.GetCellData().GetArray(name)) for name in ("Radius", "GRatio", "Direction")}
            self.assertEqual(values["Radius"].dtype, numpy.float32)
            for fibre in outer:
                own = {name: numpy.unique(array[ids == fibre], axis=0) for name, array in values.items()}
                self.assertEqual([len(array) for array in own.values()], [1, 1, 1])
                self.assertAlmostEqual(own["Radius"][0], math.sqrt(volume(outer[fibre]) / (math.pi * length)), delta=1e-4)
                self.assertAlmostEqual(own["GRatio"][0], math.sqrt(volume(inner[fibre]) / volume(outer[fibre])), delta=1e-5)
                numpy.testing.assert_allclose(own["Direction"][0], 255 * along, atol=2)
            facts = data.GetFieldData()
            self.assertEqual({facts.GetArrayName(i) for i in range(facts.GetNumberOfArrays())}, {"Domain", "MinimumGap", "Provenance", "WantedFibres"})
        both = Placement(Input=OutputPort(surface, 0), RotationY=90)
        placed = fetch(both)
        numpy.testing.assert_allclose(vtk_to_numpy(placed.GetCellData().GetArray("Direction"))[0], (204, 0, 153), atol=2)
        self.assertAlmostEqual(placed.GetCellData().GetArray("Radius").GetValue(0), 5e-4, delta=2e-5)
        alone = Placement(Input=OutputPort(surface, 1), RotationY=90)
        inner = [vtk_to_numpy(fetch(*one).GetPoints().GetData()) for one in ((both, 1), (alone, 0))]
        numpy.testing.assert_array_equal(*inner)
        self.assertEqual(fetch(alone, 1).GetNumberOfPoints(), 0)

    def test_bad_properties(self):
        growth = self.growth(hexagonal(3.0), GrowthIterations=1)
        for name, value in (
            ("GRatioModel", 7),
            ("GRatio", 0.0),
            ("GRatio", 1.0),
            ("GRatio", float("nan")),
            ("SmoothingIterations", -1),
            ("SmoothingIterations", 21),
            ("DecimationError", -0.1),
            ("DecimationError", 0.008),
            ("NumberOfThreads", -1),
        ):
            with self.subTest(property=name, value=value):
                surface = MyelinSurface(Input=growth)
                with self.assertError(name):
                    surface.SMProxy.GetProperty(name).SetElement(0, value)
                    surface.SMProxy.UpdateVTKObjects()
                    surface.UpdatePipeline()
        surface = MyelinSurface(Input=growth, GRatioModel="Distributed", GRatioDeviation=0.5)
        with self.assertError("GRatioDeviation"):
            surface.UpdatePipeline()
        surface = MyelinSurface(Input=growth, GRatioModel="TargetAxonVolumeFraction")
        with self.assertError("TargetAxonVolumeFraction"):
            surface.UpdatePipeline()

    def test_bad_images(self):
        image = fetch(self.growth(hexagonal(3.0), GrowthIterations=1, VoxelSize=0.2))

        def spoilt(spoil):
            copy = image.NewInstance()
            copy.DeepCopy(image)
            spoil(copy)
            return MyelinSurface(Input=produce(copy))

        def set_value(name, value):
            return lambda data: data.GetPointData().GetArray(name).SetValue(700, value)

        def as_double(data):
            array = vtkDoubleArray()
            array.SetName("Depth")
            array.SetNumberOfValues(data.GetNumberOfPoints())
            data.GetPointData().AddArray(array)

        for spoil, message in (
            (lambda data: data.GetPointData().RemoveArray("FibreId"), "FibreId"),
            (lambda data: data.GetPointData().RemoveArray("Depth"), "Depth"),
            (as_double, "Depth"),
            (lambda data: data.GetFieldData().RemoveArray("Domain"), "Domain"),
            (lambda data: data.GetFieldData().RemoveArray("MinimumGap"), "MinimumGap"),
            (lambda data: data.GetFieldData().RemoveArray("SurfaceTolerance"), "SurfaceTolerance"),
            (lambda data: data.GetFieldData().RemoveArray("FibreTable.FibreId"), "FibreTable.FibreId"),
            (lambda data: data.SetSpacing(0.2, 0.2, 0.3), "cubes"),
            (set_value("Depth", float("nan")), "not finite"),
            (set_value("FibreId", -3), "FibreId of -3|does not fit"),
            (lambda data: data.GetFieldData().GetArray("FibreTable.FibreId").SetValue(0, 999), "not in its FibreTable"),
            (lambda data: data.SetOrigin(100, 0, 0), "Domain"),
            (lambda data: data.Initialize(), "empty"),
        ):
            with self.assertError(message):
                spoilt(spoil).UpdatePipeline()


if __name__ == "__main__":
    main()
