# SPDX-License-Identifier: BSD-3-Clause
"""The judge judged: the mesh oracle on surfaces whose faults are known."""

import os

from cactus_testing import CactusTestCase, main, mesh_oracle


def cube(centre, half=1.0, flipped=False):
    """(points, triangles) of a cube, outward unless flipped."""
    signs = (-1, 1)
    points = [tuple(c + s * half for c, s in zip(centre, (x, y, z))) for z in signs for y in signs for x in signs]
    # fmt: off
    triangles = [(0, 2, 1), (1, 2, 3), (4, 5, 6), (5, 7, 6), (0, 1, 4), (1, 5, 4),
                 (2, 6, 3), (3, 6, 7), (0, 4, 2), (2, 4, 6), (1, 3, 5), (3, 7, 5)]
    # fmt: on
    return points, [(a, c, b) if flipped else (a, b, c) for a, b, c in triangles]


def together(one, other):
    shift = len(one[0])
    return one[0] + other[0], one[1] + [tuple(corner + shift for corner in triangle) for triangle in other[1]]


class MeshOracle(CactusTestCase):
    def write(self, name, mesh):
        points, triangles = mesh
        with open(os.path.join(self.folder, name), "w") as file:
            file.write("ply\nformat ascii 1.0\n")
            file.write(f"element vertex {len(points)}\nproperty float x\nproperty float y\nproperty float z\n")
            file.write(f"element face {len(triangles)}\nproperty list uchar int vertex_indices\nend_header\n")
            file.writelines("%r %r %r\n" % point for point in points)
            file.writelines("3 %d %d %d\n" % triangle for triangle in triangles)

    def one(self, mesh):
        self.write("one.ply", mesh)
        return mesh_oracle(self.folder)["meshes"][0]

    def two(self, a, b, *arguments):
        self.write("a.ply", a)
        self.write("b.ply", b)
        return mesh_oracle(self.folder, *arguments)["pairs"]

    def test_sound_surface(self):
        found = self.one(cube((100, 0, 0)))
        self.assertTrue(found["manifold"] and found["closed"] and found["outward"])
        self.assertFalse(found["self_intersecting"])
        self.assertAlmostEqual(found["volume"], 8)
        self.assertAlmostEqual(found["area"], 24)
        self.assertEqual((found["points"], found["triangles"], found["pieces"], found["degenerate"]), (8, 12, 1, 0))

    def test_flipped(self):
        found = self.one(cube((0, 0, 0), flipped=True))
        self.assertTrue(found["closed"])
        self.assertFalse(found["outward"])
        self.assertAlmostEqual(found["volume"], -8)

    def test_one_of_two_pieces_flipped(self):
        found = self.one(together(cube((0, 0, 0), 2), cube((9, 0, 0), flipped=True)))
        self.assertEqual(found["pieces"], 2)
        self.assertFalse(found["outward"])

    def test_hole(self):
        points, triangles = cube((0, 0, 0))
        found = self.one((points, triangles[:-1]))
        self.assertTrue(found["manifold"])
        self.assertFalse(found["closed"] or found["outward"])

    def test_not_manifold(self):
        points, triangles = cube((0, 0, 0))
        found = self.one((points, triangles + triangles[:1]))
        self.assertFalse(found["manifold"] or found["closed"])

    def test_one_triangle_turned(self):
        points, triangles = cube((0, 0, 0))
        found = self.one((points, triangles[:-1] + [triangles[-1][::-1]]))
        self.assertFalse(found["manifold"] or found["closed"])

    def test_two_cubes_that_share_a_corner(self):
        points, triangles = together(cube((0, 0, 0)), cube((2, 2, 2)))
        shared = [tuple(7 if corner == 8 else corner for corner in triangle) for triangle in triangles]
        self.assertFalse(self.one((points, shared))["manifold"])

    def test_self_intersection(self):
        self.assertTrue(self.one(together(cube((0, 0, 0)), cube((1, 0.5, 0.5))))["self_intersecting"])

    def test_degenerate(self):
        points, triangles = cube((0, 0, 0))
        middle = tuple((a + b) / 2 for a, b in zip(points[0], points[1]))
        found = self.one((points + [middle], triangles + [(0, 8, 1)]))
        self.assertEqual(found["degenerate"], 1)

    def test_apart(self):
        self.assertEqual(self.two(cube((0, 0, 0)), cube((2.5, 0, 0))), [])

    def test_intersecting_and_touching(self):
        for x in (1.5, 2.0):
            pairs = self.two(cube((0, 0, 0)), cube((x, 0, 0)))
            self.assertEqual([(p["a"], p["b"], p["relation"]) for p in pairs], [("a.ply", "b.ply", "intersect")])

    def test_inside(self):
        self.assertEqual([p["relation"] for p in self.two(cube((0, 0, 0)), cube((0, 0, 0), 0.5))], ["b_in_a"])
        self.assertEqual([p["relation"] for p in self.two(cube((0, 0, 0), 0.5), cube((0, 0, 0)))], ["a_in_b"])
        half_inside = together(cube((0, 0, 0), 0.5), cube((9, 0, 0), 0.5))
        self.assertEqual([p["relation"] for p in self.two(half_inside, cube((0, 0, 0)))], ["a_partly_in_b"])

    def test_gap(self):
        a, b = cube((0, 0, 0)), cube((2.25, 2.25, 0))
        distance = 0.25 * 2**0.5
        (pair,) = self.two(a, b, "--gap", "0.36")
        self.assertEqual(pair["relation"], "near")
        self.assertAlmostEqual(pair["distance"], distance)
        self.assertEqual(self.two(a, b, "--gap", "0.35"), [])

    def test_says_what_it_cannot_read(self):
        with self.assertRaisesRegex(AssertionError, "no .ply or .off"):
            mesh_oracle(self.folder)
        self.write("bad.ply", ([(0, 0, float("nan")), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)]))
        with self.assertRaisesRegex(AssertionError, "bad.ply"):
            mesh_oracle(self.folder)


if __name__ == "__main__":
    main()
