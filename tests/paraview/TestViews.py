# SPDX-License-Identifier: BSD-3-Clause
# ctest-extended
# ctest-needs: display
"""What a render view shows of each stage without a setting: tubes in their box, a section, axons in their myelin, seen at an angle."""

import numpy
from cactus_testing import UNPARTED, CactusTestCase, main, pixels
from paraview import simple
from paraview.vtk.util.numpy_support import vtk_to_numpy

SIDE = 6.0


def reddish(image):
    return numpy.count_nonzero((image[:, :, 0] > 2 * image[:, :, 1]) & (image[:, :, 0] > 2 * image[:, :, 2]) & (image[:, :, 0] > 60))


def bluish(image):
    return numpy.count_nonzero((image[:, :, 2] > 1.4 * image[:, :, 0]) & (image[:, :, 2] > 60))


class Views(CactusTestCase):
    expected = UNPARTED

    def view(self):
        view = simple.CreateView("RenderView", ViewSize=[300, 300], UseColorPaletteForBackground=0, Background=[1, 1, 1], OrientationAxesVisibility=0)
        self.addCleanup(simple.Delete, view)
        return view

    def bundle(self, **options):
        return simple.BundleInitializer(Border="Walls", **{"Side": SIDE, "Seed": 1, "GrownFibreVolumeFraction": 0, "CalibreVariation": 0, **options})

    def test_fibres_are_tubes_in_the_colours_of_their_direction(self):
        bundle, view = self.bundle(), self.view()
        shown = simple.Show(bundle, view)
        simple.ResetCamera(view)
        self.assertEqual(shown.Representation, "Tubes")
        # An array that was chosen would get a scalar bar in the window, of a magnitude that says nothing.
        self.assertEqual(shown.ColorArrayName[1], "")
        tubes = bluish(pixels(view))
        self.assertGreater(tubes, 15000)  # of 90,000: a block, seen at an angle
        shown.DirectionColors = 0
        self.assertEqual(bluish(pixels(view)), 0)
        shown.DirectionColors = 1
        simple.ColorBy(shown, ("POINTS", "Radius"))
        self.assertLess(bluish(pixels(view)), tubes)
        simple.ColorBy(shown, None)
        self.assertEqual(bluish(pixels(view)), tubes)
        shown.Representation = "Wireframe"
        self.assertLess(bluish(pixels(view)), tubes / 3)

    def test_two_bundles_have_a_colour_each(self):
        crossing, view = self.bundle(NumberOfBundles=2, CrossingAngle=90, CrossingStyle="Sheets", MeanDispersion=0, FibreVolumeFraction=0.3), self.view()
        simple.Show(crossing, view)
        simple.ResetCamera(view)
        seen = pixels(view).astype(int)
        red, green, blue = seen[:, :, 0], seen[:, :, 1], seen[:, :, 2]
        self.assertGreater(numpy.count_nonzero((red > green + 40) & (green > blue + 10)), 2000)  # orange
        self.assertGreater(numpy.count_nonzero((green > red + 30) & (green > blue + 5)), 2000)  # green

    def test_streamlines_have_the_colours_of_their_direction(self):
        lines, view = simple.PassArrays(Input=self.bundle(), PointDataArrays=["Direction"], CellDataArrays=[]), self.view()
        shown = simple.Show(lines, view, "FibreRepresentation")
        shown.Representation = "Tubes"
        simple.ResetCamera(view)
        self.assertGreater(bluish(pixels(view)), 1000)
        shown.DirectionColors = 0
        self.assertEqual(bluish(pixels(view)), 0)

    def test_direction_is_the_tangent(self):
        crossing = self.bundle(NumberOfBundles=2, CrossingAngle=90, CrossingStyle="Sheets", MeanDispersion=0, FibreVolumeFraction=0.3)
        crossing.UpdatePipeline()
        fibres = simple.servermanager.Fetch(crossing)
        colours = vtk_to_numpy(fibres.GetPointData().GetArray("Direction"))
        # Both bundles run in the x-z plane at 45 degrees to z.
        self.assertTrue(numpy.all(abs(colours - numpy.array([255 * 0.5**0.5, 0, 255 * 0.5**0.5])) < 1.0))

    def test_what_is_selected_is_the_fibre_under_the_pointer(self):
        bundle, view = self.bundle(FibreVolumeFraction=0.15, MeanDispersion=0, MinimumRadius=0.4), self.view()
        simple.Show(bundle, view)
        simple.Render(view)  # the first time, ParaView moves the camera
        view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = [0, 0, 30], [0, 0, 0], [0, 1, 0]
        view.CameraParallelProjection, view.CameraParallelScale = 1, SIDE / 2
        simple.Render(view)
        fibres = simple.servermanager.Fetch(bundle)
        inside = 0
        for fibre in range(fibres.GetNumberOfCells()):
            first, count = (fibres.GetCell(fibre).GetPointId(0), fibres.GetCell(fibre).GetNumberOfPoints())
            x, y = (round(150 + 300 / SIDE * coordinate) for coordinate in fibres.GetPoint(first)[:2])
            if not (10 < x < 290 and 10 < y < 290):
                continue
            inside += 1
            for select, attributes, wanted in ((simple.SelectSurfaceCells, "GetCellData", range(fibre, fibre + 1)),
                                               (simple.SelectSurfacePoints, "GetPointData", range(first, first + count))):
                simple.ClearSelection(bundle)
                reach = 2 if attributes == "GetCellData" else round(270 / SIDE * fibres.GetPointData().GetArray("Radius").GetValue(first))
                select(Rectangle=[x - reach, y - reach, x + reach, y + reach], View=view)
                chosen = simple.ExtractSelection(Input=bundle, Selection=bundle.GetSelectionInput(0))
                found = simple.servermanager.Fetch(chosen)
                found = found.GetBlock(0) if found.IsA("vtkMultiBlockDataSet") else found
                name = "vtkOriginalCellIds" if attributes == "GetCellData" else "vtkOriginalPointIds"
                ids = set(vtk_to_numpy(getattr(found, attributes)().GetArray(name)))
                self.assertTrue(ids and ids <= set(wanted), f"{name} of fibre {fibre}: {ids}")
                simple.Delete(chosen)
        self.assertGreater(inside, 2)
        simple.ClearSelection(bundle)

    def test_a_tube_has_its_fibre_radius(self):
        view = self.view()
        bundle = self.bundle(FibreVolumeFraction=0.0873, RadiusDistribution="Table", RadiusTable="0.5", MeanDispersion=0, Seed=3)
        shown = simple.Show(bundle, view)
        shown.ColorArrayName = [None, ""]
        simple.Render(view)  # the first time, ParaView moves the camera
        view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = [0, 0, 30], [0, 0, 0], [0, 1, 0]
        view.CameraParallelProjection, view.CameraParallelScale = 1, SIDE / 2
        bundle.UpdatePipeline()
        fibres = bundle.GetDataInformation().GetNumberOfCells()
        area = numpy.count_nonzero(pixels(view)[:, :, 0] < 250) * (SIDE / 300) ** 2
        box = 4 * SIDE * 2 * SIDE / 300  # its edges, two pixels wide at most
        self.assertGreater(area, 0.95 * fibres * 3 * 0.5**2)  # polygons of twelve corners have 3 r²
        self.assertLess(area, fibres * numpy.pi * 0.5**2 * 1.1 + box)

    def test_fibres_without_radius_are_shown_as_lines(self):
        line, view = simple.Line(), self.view()
        shown = simple.Show(line, view, "FibreRepresentation")
        shown.Representation = "Tubes"
        simple.ResetCamera(view)
        self.assertLess(numpy.count_nonzero(pixels(view)[:, :, 0] < 250), 2000)

    def test_a_camera_that_was_moved_stays(self):
        view = self.view()
        view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = [10, 0, 0], [1, 0, 0], [0, 1, 0]
        simple.Show(self.bundle(), view)
        simple.Render(view)
        for across in list(view.CameraPosition)[1:]:  # ParaView itself may move it nearer, and to the middle of the tubes
            self.assertAlmostEqual(across, 0, delta=0.1)

    def test_growth_is_a_section(self):
        grown, view = simple.FibreRadialGrowth(Input=self.bundle(), TargetFibreVolumeFraction=0.8, VoxelSize=0.2), self.view()
        shown = simple.Show(grown, view)
        simple.ResetCamera(view)
        self.assertEqual(shown.Representation, "Slice")
        self.assertGreater(numpy.count_nonzero(numpy.ptp(pixels(view), axis=2) > 30), 5000)

    def test_images_are_sections_of_voxels(self):
        grown = simple.FibreRadialGrowth(Input=self.bundle(), TargetFibreVolumeFraction=0.8, VoxelSize=0.2)
        sampled = simple.SubstrateSampler(Outer=simple.MyelinSurface(Input=grown), VoxelSize=SIDE)  # a single one
        field = simple.FibreField(Input=grown, Select="All fibres")
        for data, array in ((sampled, "AVF"), (simple.Placement(Input=sampled), "AVF"), (field, "Field")):
            view = self.view()
            shown = simple.Show(data, view)
            simple.ColorBy(shown, ("POINTS", array))
            simple.ResetCamera(view)
            self.assertIn(shown.Representation, ("Sections", "Placed"))
            self.assertGreater(numpy.count_nonzero(numpy.ptp(pixels(view), axis=2) > 30), 5000)

    def test_the_faces_show_axons_within_myelin(self):
        grown, view = simple.FibreRadialGrowth(Input=self.bundle(), TargetFibreVolumeFraction=0.8, VoxelSize=0.2), self.view()
        surfaces = simple.MyelinSurface(Input=grown)
        shown = simple.Show(simple.OutputPort(surfaces, 0), view)
        self.assertEqual(shown.Representation, "Myelin")
        simple.ResetCamera(view)
        alone = pixels(view)
        self.assertEqual(bluish(alone), 0)
        self.assertGreater(reddish(alone), 15000)
        self.assertEqual(simple.Show(simple.OutputPort(surfaces, 1), view).Representation, "Axons")
        both = pixels(view)
        self.assertGreater(bluish(both), reddish(alone) / 20)
        self.assertGreater(reddish(both), reddish(alone) / 2)
        shown.MyelinColor = [0.0, 0.0, 0.0]
        self.assertEqual(reddish(pixels(view)), 0)


if __name__ == "__main__":
    main()
