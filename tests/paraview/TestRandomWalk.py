# SPDX-License-Identifier: BSD-3-Clause
"""What a simulator finds: walkers stay in the compartment that they start in, and a straight fibre restricts them as theory says."""

import math
import os

from cactus_testing import CactusTestCase, main, produce, random_walk
from paraview.simple import BundleInitializer, CapsuleOptimizer, FibreRadialGrowth, MyelinSurface, OutputPort, SubstrateWriter
from surfaces import EQUIVALENT, surfaces, tube, without

COMPARTMENTS = ("inner", "myelin", "outside")


class RandomWalk(CactusTestCase):
    def write(self, outer, inner, **properties):
        folder = os.path.join(self.folder, "substrate")
        SubstrateWriter(Outer=outer, Inner=inner, FolderName=folder, **properties).UpdatePipeline()
        return folder

    def straight_fibre(self, length, damage=lambda inner: inner, **properties):
        outer = surfaces({1: tube(0, 0, 1.0, length, 40)}, 0, length)
        inner = surfaces({1: damage(tube(0, 0, 0.7, length - 0.04, 40))}, 1, length)
        return self.write(produce(outer), produce(inner), **properties)

    def test_nobody_leaves_a_grown_substrate(self):
        bundle = BundleInitializer(Border="Walls", Side=6, FibreVolumeFraction=0.6, MinimumRadius=0.4, MeanDispersion=10, Seed=5)
        grown = FibreRadialGrowth(Input=OutputPort(CapsuleOptimizer(Input=bundle), 0))
        myelin = MyelinSurface(Input=grown, GRatio=0.7)
        folder = self.write(OutputPort(myelin, 0), OutputPort(myelin, 1))
        self._messages = [message for message in self._messages if "too thin in the image to hold an axon" not in message]
        # Steps of 0.2 µm at 2 µm²/ms are 3.3 µs long: this is a third of a second.
        walked = random_walk(folder, walkers=20, steps=100000, step=0.2)
        for compartment in COMPARTMENTS:
            found = walked[compartment]
            self.assertEqual((found["walkers"], found["leaked"]), (20, 0), compartment)
            self.assertGreater(found["reflections"], 100000, compartment)

    def test_straight_fibre_restricts_as_theory_says(self):
        walkers, steps, step, radius, length = 2000, 400, 0.2, 0.7 * EQUIVALENT, 60.0
        inner = random_walk(self.straight_fibre(length), walkers=walkers, steps=steps, step=step)["inner"]
        self.assertEqual((inner["walkers"], inner["leaked"]), (walkers, 0))
        x, y, z = inner["squared_displacement_um2"]
        # Across, in the long run, both ends are anywhere in the circle: <(x - x0)²> = r²/2, a diffusivity of r²/(4 t). The standard
        # error of the mean of both axes is 0.87 / sqrt(walkers) of it.
        self.assertAlmostEqual((x + y) / radius**2, 1.0, delta=4 * 0.87 / walkers**0.5)
        # Along, the walk is free but for the ends (Mitra et al., 1993, in one dimension).
        dt = steps * step**2 / 6  # diffusivity times time
        free = 2 * dt * (1 - 8 / (3 * math.pi**0.5) * dt**0.5 / length)
        self.assertAlmostEqual(z / free, 1.0, delta=4 * (2 / walkers) ** 0.5)

    def test_says_where_there_is_no_room_to_start(self):
        folder = self.straight_fibre(4.0, damage=lambda inner: tube(0, 0, 0.005, 3.96))
        with self.assertRaisesRegex(AssertionError, "only . of 5 walkers found room to start: inner"):
            random_walk(folder, walkers=5, steps=1)

    def test_finds_a_hole(self):
        with self.assertError(r"not certified: 1 surfaces are not closed"):
            folder = self.straight_fibre(4.0, damage=lambda inner: without(inner, range(1600, 1620)), AllowOpenSurfaces=1)
        walked = random_walk(folder, walkers=40, steps=10000, step=0.1)
        self.assertGreater(walked["inner"]["leaked"], 8)
        self.assertGreater(walked["myelin"]["leaked"], 8)
        self.assertEqual(walked["outside"]["leaked"], 0)


if __name__ == "__main__":
    main()
