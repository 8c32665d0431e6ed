# SPDX-License-Identifier: BSD-3-Clause
"""The substrate folder, read again by a parser of its own: what is written is what went in, once, whole, or not at all."""

import csv
import hashlib
import json
import os

from cactus_testing import CactusTestCase, fetch, main, produce
from paraview.simple import SubstrateWriter
from surfaces import EQUIVALENT, POLYGON, surfaces, tube, two_tubes
from vtkmodules.vtkFiltersCore import vtkMassProperties
from vtkmodules.vtkIOPLY import vtkPLYReader


def read_ply(path):
    """Points and triangles of an ASCII PLY file, read as strictly as a simulator that knows one dialect does."""
    with open(path, encoding="ascii") as file:
        lines = [line.rstrip("\n") for line in file]
    end = lines.index("end_header")
    header = [line for line in lines[:end] if not line.startswith("comment")]
    assert header[:2] == ["ply", "format ascii 1.0"], header
    vertices, faces = int(header[2].split()[-1]), int(header[6].split()[-1])
    assert header[2:] == [
        f"element vertex {vertices}",
        "property float x",
        "property float y",
        "property float z",
        f"element face {faces}",
        "property list uchar int vertex_indices",
    ], header
    body = lines[end + 1 :]
    assert len(body) == vertices + faces
    points = [tuple(map(float, line.split())) for line in body[:vertices]]
    triangles = [tuple(map(int, line.split())) for line in body[vertices:]]
    assert all(len(point) == 3 for point in points)
    assert all(len(t) == 4 and t[0] == 3 and all(0 <= i < vertices for i in t[1:]) for t in triangles)
    return points, [t[1:] for t in triangles]


def volume_of(points, triangles):
    volume = 0.0
    for triangle in triangles:
        a, b, c = (points[i] for i in triangle)
        volume += (
            a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0])
        ) / 6
    return volume


def is_closed(triangles):
    """Every directed edge stands there once, and its reverse, too."""
    edges = [(t[i], t[(i + 1) % 3]) for t in triangles for i in range(3)]
    return len(set(edges)) == len(edges) and all((b, a) in set(edges) for a, b in edges)


class Writer(CactusTestCase):
    def setUp(self):
        super().setUp()
        self.fibres, self.outer, self.inner = two_tubes(inset=0.1)
        self.target = os.path.join(self.folder, "substrate")

    def write(self, **properties):
        arguments = {"Outer": produce(self.outer), "Inner": produce(self.inner), "FolderName": self.target}
        arguments.update(properties)
        writer = SubstrateWriter(**arguments)
        writer.UpdatePipeline()
        return writer

    def test_files_hold_the_surfaces(self):
        table = fetch(self.write(Fibres=produce(self.fibres)))
        self.assertEqual(os.listdir(self.folder), ["substrate"])
        self.assertEqual(
            sorted(os.listdir(self.target)), ["README.txt", "certificate.csv", "certificate_fibres.csv", "fibres.strands", "inner", "manifest.json", "mcdc", "outer"]
        )
        with open(os.path.join(self.target, "manifest.json")) as file:
            manifest = json.load(file)
        self.assertEqual(manifest["domain"], [-5, 5, -5, 5, -5, 5])
        self.assertEqual(manifest["fibres"], 2)
        wanted = {
            "outer/fibre_00003.ply": (3, 10 * POLYGON),
            "outer/fibre_00005.ply": (5, 22.5 * POLYGON),
            "inner/fibre_00003.ply": (3, 4.9 * 0.98 * POLYGON),
            "inner/fibre_00005.ply": (5, 8.1 * 0.98 * POLYGON),
        }
        self.assertEqual({entry["path"] for entry in manifest["files"]}, set(wanted))
        self.assertEqual(table.GetNumberOfRows(), 4)
        for entry in manifest["files"]:
            fibre, volume = wanted[entry["path"]]
            points, triangles = read_ply(os.path.join(self.target, entry["path"]))
            self.assertEqual(entry["fibre"], fibre)
            self.assertEqual(entry["bundle"], 1 + fibre % 2)
            self.assertEqual(len(triangles), entry["triangles"])
            self.assertAlmostEqual(volume_of(points, triangles), volume, places=3)
            self.assertAlmostEqual(entry["volume_um3"], volume_of(points, triangles), places=5)
            self.assertTrue(is_closed(triangles))
            self.assertTrue(entry["closed"])
            self.assertEqual(len({i for t in triangles for i in t}), len(points), "no point is left over")

    def test_vtk_reads_binary_files(self):
        self.write(Format="Surfaces alone", Encoding="Binary", StartPositions=3)
        self.assertEqual(sorted(os.listdir(self.target)), ["README.txt", "certificate.csv", "certificate_fibres.csv", "inner", "manifest.json", "outer", "start"])
        for name, surface in (("outer/fibre_00003.ply", 3), ("outer/fibre_00005.ply", 5)):
            path = os.path.join(self.target, name)
            reader = vtkPLYReader()
            reader.SetFileName(path)
            reader.Update()
            mass = vtkMassProperties()
            mass.SetInputData(reader.GetOutput())
            self.assertAlmostEqual(mass.GetVolume(), {3: 10, 5: 22.5}[surface] * POLYGON, places=3)
            with open(path, "rb") as file:
                body = file.read().split(b"end_header\n", 1)[1]
            self.assertEqual(len(body), 13 * reader.GetOutput().GetNumberOfCells() + 12 * reader.GetOutput().GetNumberOfPoints())
        with open(os.path.join(self.target, "start", "intra.txt")) as file:
            self.assertTrue(all(abs(float(number)) < 5 for number in file.read().split()), "µm")

    def test_vtk_reads_a_file_for_each_bundle(self):
        """Both fibres are of bundle 2."""
        for encoding in ("ASCII", "Binary"):
            self.write(Format="Surfaces by bundle", Encoding=encoding)
            self.assertEqual(os.listdir(os.path.join(self.target, "outer")), ["bundle_00002.ply"])
            reader = vtkPLYReader()
            reader.SetFileName(os.path.join(self.target, "outer", "bundle_00002.ply"))
            reader.Update()
            mass = vtkMassProperties()
            mass.SetInputData(reader.GetOutput())
            self.assertAlmostEqual(mass.GetVolume(), (10 + 22.5) * POLYGON, places=3)

    def test_simulators_get_no_binary_files(self):
        for name in ("MC/DC", "Reference program", "Camino", "Disimpy"):
            with self.subTest(Format=name), self.assertError("Encoding Binary is not for simulators whose readers of PLY files"):
                self.write(Format=name, Encoding="Binary", Fibres=produce(self.fibres))
            self.assertFalse(os.path.exists(self.target))

    def test_holds_its_certificate(self):
        self.write(Fibres=produce(self.fibres))
        with open(os.path.join(self.target, "manifest.json")) as file:
            manifest = json.load(file)
        self.assertIs(manifest["certified"], True)
        self.assertEqual(manifest["faults"], [])
        with open(os.path.join(self.target, "certificate.csv"), newline="") as file:
            values = dict(list(csv.reader(file))[1:])
        self.assertEqual(values["Certified"], "1")
        self.assertAlmostEqual(float(values["SmallestGap_um"]), 1.5, places=6)
        with open(os.path.join(self.target, "certificate_fibres.csv"), newline="") as file:
            fibres = list(csv.DictReader(file))
        self.assertEqual([row["NearestFibre"] for row in fibres], ["5", "3"])
        self.assertAlmostEqual(float(fibres[0]["OuterRadius_um"]), EQUIVALENT, places=5)

    def test_says_what_is_not_certified(self):
        with self.assertError(r"not certified: fibres 3 and 5 come as near as 1\.5"):
            self.write(MinimumGap=2.0)
        with open(os.path.join(self.target, "manifest.json")) as file:
            manifest = json.load(file)
        self.assertIs(manifest["certified"], False)
        self.assertEqual(len(manifest["faults"]), 1)

    def test_points_keep_nine_digits(self):
        self.write()
        points, _ = read_ply(os.path.join(self.target, "outer/fibre_00003.ply"))
        for index, point in enumerate(points):
            for got, wanted in zip(point, self.outer.GetPoint(index)):
                self.assertLessEqual(abs(got - wanted), 5e-9 * abs(wanted) + 1e-30)

    def test_configuration_finds_its_files(self):
        self.write()
        for compartment, kind in (("intra", "inner"), ("extra", "outer")):
            with open(os.path.join(self.target, "mcdc", compartment + ".conf")) as file:
                words = file.read().split()
            self.assertEqual(words[-1], "<END>")
            self.assertEqual(words[words.index("ini_walkers_pos") + 1], compartment)
            with open(os.path.join(self.target, words[words.index("ply_file_list") + 1])) as file:
                scale, *paths = file.read().split()
            self.assertEqual(float(scale), 1e-3)
            self.assertEqual(paths, [f"{kind}/fibre_00003.ply", f"{kind}/fibre_00005.ply"])
            for path in paths:
                self.assertTrue(os.path.isfile(os.path.join(self.target, path)))

    def test_manifest_knows_every_file(self):
        self.write(Fibres=produce(self.fibres))
        with open(os.path.join(self.target, "manifest.json")) as file:
            text = file.read()
        manifest = json.loads(text)
        found = {}
        for folder, _, names in os.walk(self.target):
            for name in names:
                path = os.path.join(folder, name)
                with open(path, "rb") as file:
                    found[os.path.relpath(path, self.target)] = hashlib.sha256(file.read()).hexdigest()
        del found["manifest.json"]
        self.assertEqual(manifest["sha256"], found)
        own = manifest["manifest_sha256"]
        self.assertEqual(hashlib.sha256(text.replace(own, 64 * "0").encode()).hexdigest(), own)

    def test_writing_again_keeps_what_is_the_users(self):
        self.write()
        with open(os.path.join(self.target, "mcdc", "intra.conf")) as file:
            configuration = file.read()
        for path in ("mcdc/intra.conf", "mcdc/pgse.scheme", "README.txt"):
            with open(os.path.join(self.target, path), "a") as file:
                file.write("edited")
        for path in ("outer/mine.ply", "mcdc/output/intra_DWI.txt"):
            with open(os.path.join(self.target, path), "w") as file:
                file.write("precious")
        with self.assertError(
            r"results of simulations \(mcdc/output/intra_DWI\.txt\); other data \(outer/mine\.ply\); "
            r"files that were changed .*\(README\.txt, mcdc/intra\.conf, mcdc/pgse\.scheme\): choose another FolderName"
        ):
            self.write()
        with open(os.path.join(self.target, "mcdc", "intra.conf")) as file:
            self.assertEqual(file.read(), configuration + "edited")
        self.assertTrue(os.path.exists(os.path.join(self.target, "outer", "mine.ply")))
        for path in ("mcdc/intra.conf", "mcdc/pgse.scheme", "README.txt", "outer/mine.ply", "mcdc/output/intra_DWI.txt"):
            os.rename(os.path.join(self.target, path), os.path.join(self.folder, os.path.basename(path)))
        self.write()
        with open(os.path.join(self.target, "mcdc", "intra.conf")) as file:
            self.assertEqual(file.read(), configuration)

    def test_the_folder_it_runs_in(self):
        self.addCleanup(os.chdir, os.getcwd())
        os.mkdir(self.target)
        os.chdir(self.target)
        with self.assertError(r"the folder that this program runs in"):
            self.write(FolderName=".")
        self.write(FolderName="relative")
        self.assertEqual(os.listdir("."), ["relative"])
        os.chdir("relative")
        with self.assertError(r"above the folder that this program runs in"):
            self.write(FolderName="..")
        os.chdir(self.target)
        os.rename("relative", os.path.join(self.folder, "elsewhere"))
        os.rmdir(self.target)
        with self.assertError(r"cannot write folder relative: the folder that this program runs in is no more"):
            self.write(FolderName="relative")

    def test_links(self):
        place = os.path.join(self.folder, "place")
        os.symlink(place, self.target)
        for _ in range(2):
            self.write()
            self.assertTrue(os.path.islink(self.target))
            self.assertTrue(os.path.isfile(os.path.join(place, "manifest.json")))
        self.assertEqual(sorted(os.listdir(self.folder)), ["place", "substrate"])

    def test_without_inner_surfaces(self):
        writer = SubstrateWriter(Outer=produce(self.outer), FolderName=self.target)
        writer.UpdatePipeline()
        self.assertEqual(fetch(writer).GetNumberOfRows(), 2)
        self.assertEqual(sorted(os.listdir(self.target)), ["README.txt", "certificate.csv", "certificate_fibres.csv", "manifest.json", "mcdc", "outer"])

    def test_writes_for_changes_of_its_own_only(self):
        """What comes in is written when it is asked for; of what is not, it is said once."""
        source = produce(self.outer)
        writer = SubstrateWriter(Outer=source, FolderName=self.target)
        writer.UpdatePipeline()

        def time():
            return os.stat(os.path.join(self.target, "manifest.json")).st_mtime_ns

        first = time()
        moved = surfaces({3: tube(-2, 0, 0.9, 10)}, 0, 10)
        source.GetClientSideObject().SetOutput(moved)
        source.MarkModified(None)
        with self.assertError(r"has changed since .*substrate was written, which stays as it is: press Write"):
            for _ in range(2):
                writer.UpdatePipeline()
        self.assertEqual(time(), first)
        self.assertEqual(fetch(writer).GetNumberOfRows(), 2)
        writer.SMProxy.InvokeCommand("Write")
        self.assertGreater(time(), first)
        writer.UpdatePipeline()
        self.assertEqual(fetch(writer).GetNumberOfRows(), 1)
        writer.AllowOpenSurfaces = 1
        second = time()
        writer.UpdatePipeline()
        self.assertGreater(time(), second)

    def test_bad_places(self):
        with self.assertError(r"FolderName is empty"):
            self.write(FolderName="")
        with self.assertError(r"cannot write folder .*nowhere"):
            self.write(FolderName=os.path.join(self.folder, "nowhere", "substrate"))
        with self.assertError(r"cannot write folder"):
            self.write(FolderName="/proc/substrate")
        self.assertEqual(os.listdir(self.folder), [])
        os.mkdir(self.target)
        with open(os.path.join(self.target, "thesis.tex"), "w") as file:
            file.write("precious")
        with self.assertError(r"is there already and is not a substrate folder"):
            self.write()
        self.assertEqual(os.listdir(self.target), ["thesis.tex"])

    def test_bad_surfaces(self):
        part = tube(-2, 0, 1, 10)
        part.BuildCells()
        part.DeleteCell(7)
        part.RemoveDeletedCells()
        leaking = surfaces({3: part, 5: tube(2, 0, 1.5, 10)}, 0, 10)
        with self.assertError(r"outer surface of fibre 3 is not closed \(3 open"):
            self.write(Outer=produce(leaking))
        with self.assertError(r"Outer holds inner surfaces"):
            self.write(Outer=produce(self.inner))
        self.outer.GetFieldData().RemoveArray("Domain")
        with self.assertError(r"Domain"):
            self.write()
        self.assertEqual(os.listdir(self.folder), [])
        with self.assertError(r"not closed \(3 open.* which StartPositions are inside"):
            self.write(Outer=produce(leaking), AllowOpenSurfaces=1, StartPositions=3)
        self.assertEqual(os.listdir(self.folder), [])
        with self.assertError(r"not certified: 1 surfaces are not closed \(fibre 3 first\)"):
            self.write(Outer=produce(leaking), AllowOpenSurfaces=1)
        self.assertEqual(os.listdir(self.folder), ["substrate"])


if __name__ == "__main__":
    main()
