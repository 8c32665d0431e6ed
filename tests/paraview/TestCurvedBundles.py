# SPDX-License-Identifier: BSD-3-Clause
# ctest-timeout: 300
"""A bend, a fan and two bundles that kiss become substrates: through the whole chain to a certificate, with the shape that was asked for."""

import numpy
from cactus_testing import CactusTestCase, fetch, main
from paraview.simple import CapsuleOptimizer, CurvedBundles, FibreRadialGrowth, MyelinSurface, OutputPort, SubstrateCertificate
from vtkmodules.util.numpy_support import vtk_to_numpy

SIDE = 9.0


def lines(data):
    """The control points of each fibre."""
    points = vtk_to_numpy(data.GetPoints().GetData())
    offsets = vtk_to_numpy(data.GetLines().GetOffsetsArray())
    return [points[begin:end] for begin, end in zip(offsets[:-1], offsets[1:])]


class Curves(CactusTestCase):
    def fibres(self, **properties):
        """The fibres after CapsuleOptimizer, which are those of a certified substrate."""
        values = {"Side": SIDE, "BendRadius": 12, "MinimumRadius": 0.4, "MaximumRadius": 1, "CalibreVariation": 0, **properties}
        fibres = OutputPort(CapsuleOptimizer(Input=CurvedBundles(**values)), 0)
        grown = FibreRadialGrowth(Input=fibres, VoxelSize=0.15)
        surfaces = MyelinSurface(Input=grown)
        certificate = SubstrateCertificate(Outer=OutputPort(surfaces, 0), Inner=OutputPort(surfaces, 1))
        self.assertEqual(fetch(certificate).GetValueByName(0, "Certified").ToInt(), 1)
        return fetch(fibres)

    def test_a_bend_has_its_radius(self):
        distances = []
        for line in lines(self.fibres(Shape="Bend")):
            from_axis = numpy.hypot(line[:, 0] - 12, line[:, 2])
            self.assertLess(numpy.ptp(from_axis), 1)  # 2 for a straight one through the middle
            distances.append(from_axis.mean())
        self.assertLess(min(distances), 12 - 3)
        self.assertGreater(max(distances), 12 + 3)

    def test_a_fan_opens_by_its_angle(self):
        below, above = [], []
        for line in lines(self.fibres(Shape="Fan", FanAngle=60)):
            steps = numpy.diff(line, axis=0)
            angles = numpy.degrees(numpy.arctan2(steps[:, 0], steps[:, 2]))
            if line[0, 2] < -SIDE / 2 + 0.1 and abs(line[0, 0]) < SIDE / 2:
                below.append(angles[0])
            if line[-1, 2] > SIDE / 2 - 0.1 and abs(line[-1, 0]) > SIDE / 2 - 1.5:
                above.append(angles[-1] * numpy.sign(line[-1, 0]))
        self.assertLess(abs(numpy.mean(below)), 2)
        self.assertLess(numpy.std(below), 8)
        self.assertGreater(len(above), 5)
        self.assertAlmostEqual(numpy.mean(above), 27, delta=4)  # the outermost 1.5 µm are just within the edges of 30°

    def test_two_bundles_kiss(self):
        data = self.fibres(Shape="Kiss", KissDistance=4)
        bundles = vtk_to_numpy(data.GetCellData().GetArray("BundleId"))
        middles, spread = {}, {}
        for bundle in (1, 2):
            mine = [line for line, own in zip(lines(data), bundles) if own == bundle]
            nearest = [line[abs(line[:, 2]).argmin(), 0] for line in mine if abs(line[:, 2]).min() < 0.6]
            middles[bundle] = numpy.mean(nearest)
            spread[bundle] = max(abs(line[[0, -1], 0]).max() for line in mine)
        self.assertAlmostEqual(middles[2] - middles[1], 4, delta=0.4)
        self.assertGreater(min(spread.values()), 4.5)

    def test_a_bad_value_gives_one_error_and_a_good_one_works_again(self):
        fibres = CurvedBundles(Side=12, BendRadius=5)
        with self.assertError(r"BendRadius 5 µm is too sharp here: give 15 µm or more"):
            fibres.UpdatePipeline()
        fibres.BendRadius = 15
        self.assertGreater(fetch(fibres).GetNumberOfCells(), 30)


if __name__ == "__main__":
    main()
