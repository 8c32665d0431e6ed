# SPDX-License-Identifier: BSD-3-Clause
# ctest-extended
# ctest-needs: display
# ctest-timeout: 300
"""./cactus report makes one page of a substrate folder that needs nothing but itself, says first whether it is certified, and shows numbers
that are those of the folder's own tables; what cannot be told of is refused. ./cactus pack makes an archive of folders that are as they were written,
which says of itself what a data repository wants to know, the same to the bit each time."""

import argparse
import base64
import csv
import hashlib
import html.parser
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree
import zipfile

from cactus_testing import CactusTestCase, main
from paraview import simple
from vtkmodules.vtkIOImage import vtkPNGReader

SCRIPTS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "tools", "scripts")
SCRIPT = os.path.join(SCRIPTS, "report.py")
sys.path.append(SCRIPTS)
import pack  # noqa: E402  (which is in another folder)
from substrate_folder import Refusal  # noqa: E402
CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")


class Page(html.parser.HTMLParser):
    """Texts by class or tag, addresses, and whether each tag that was opened was closed."""

    EMPTY = {"meta", "img", "br", "!doctype"}

    def __init__(self, text):
        super().__init__()
        self.open, self.addresses, self.rows, self.verdict, self.words = [], [], [], "", ""
        self.feed(text)
        self.close()

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        self.addresses += [(tag, attributes[name]) for name in ("src", "href", "xlink:href") if name in attributes]
        if tag == "tr":
            self.rows.append([])
        if tag in ("td", "th"):
            self.rows[-1].append("")
        if tag not in self.EMPTY:
            self.open.append((tag, attributes.get("class", "")))

    def handle_endtag(self, tag):
        assert self.open and self.open[-1][0] == tag, f"</{tag}> closes {self.open[-1:]}"
        self.open.pop()

    def handle_data(self, data):
        self.words += data
        if self.open and self.open[-1][1].startswith("verdict"):
            self.verdict += data
        if self.open and self.open[-1][0] in ("td", "th"):
            self.rows[-1][-1] += data


class Report(CactusTestCase):
    @classmethod
    def setUpClass(cls):
        cls.home = tempfile.mkdtemp(prefix="cactus-report-test-")
        cls.addClassCleanup(shutil.rmtree, cls.home)
        cls.substrate = os.path.join(cls.home, "substrate")
        bundle = simple.BundleInitializer(Border="Walls", Side=6, FibreVolumeFraction=0.5, GrownFibreVolumeFraction=0.6, MinimumRadius=0.3)
        fibres = simple.OutputPort(simple.CapsuleOptimizer(Input=bundle), 0)
        surfaces = simple.MyelinSurface(Input=simple.FibreRadialGrowth(Input=fibres, VoxelSize=0.15))
        simple.SubstrateWriter(Outer=simple.OutputPort(surfaces, 0), FolderName=cls.substrate).UpdatePipeline()

    def report(self, *words):
        done = subprocess.run(["pvpython", SCRIPT, *words], capture_output=True, text=True)
        return done.returncode, done.stdout + done.stderr.replace("ERR|", "")

    def made(self, folder, *words):
        """The text of the page of a folder."""
        output = os.path.join(self.folder, "page.html")
        code, said = self.report(folder, "--output", output, *words)
        self.assertEqual(code, 0, said)
        with open(output, encoding="utf-8") as file:
            return file.read()

    def copied_as(self, name):
        folder = os.path.join(self.folder, name)
        shutil.copytree(self.substrate, folder)
        return folder

    def copied(self):
        return self.copied_as("copy")

    def changed(self, **values):
        """A copy whose manifest says something else."""
        folder = self.copied()
        path = os.path.join(folder, "manifest.json")
        with open(path, encoding="utf-8") as file:
            manifest = {**json.load(file), **values}
        with open(path, "w", encoding="utf-8") as file:
            json.dump(manifest, file)
        return folder

    def test_the_page(self):
        text = self.made(self.substrate)
        page = Page(text)
        self.assertEqual(page.open, [])
        self.assertTrue(page.verdict.startswith("CERTIFIED"), page.verdict)
        # Nothing is fetched: what is shown is in the page, and what leads out is a link to click on.
        for tag, address in page.addresses:
            self.assertTrue(address.startswith("data:") or tag == "a", address)
        self.assertNotRegex(text, r"<script|<link|@import|url\(")
        self.check_numbers(page)
        self.check_picture(next(address for tag, address in page.addresses if tag == "img"))
        charts = re.findall(r"<svg .*?</svg>", text, re.S)
        self.assertEqual(len(charts), 6)
        for chart in charts:
            ElementTree.fromstring(chart)
        self.assertEqual(len(re.findall(r'r="1.6"', charts[2])), self.quantities()["Fibres"])
        self.check_profiles(charts[3:])
        for words in ("GammaShape\xa02.4", "TargetFibreVolumeFraction\xa0-1.0", "./cactus rerun substrate/manifest.json", "Villarreal-Haro", "10.3389/fninf.2023.1208073"):
            self.assertIn(words, page.words)
        address = next(address for tag, address in page.addresses if address.startswith("data:application/json"))
        with open(os.path.join(self.substrate, "manifest.json"), "rb") as file:
            self.assertEqual(base64.b64decode(address.split(",", 1)[1]), file.read())

    def quantities(self):
        with open(os.path.join(self.substrate, "certificate.csv"), encoding="utf-8") as file:
            return {row["quantity"]: float(row["value"]) for row in csv.DictReader(file)}

    def check_numbers(self, page):
        rows = {row[0]: row[1:] for row in page.rows}
        table = self.quantities()
        for name, asked, reached in (("fibre volume fraction (FVF)", 0.6, table["FVF"]), ("aggregate g-ratio", 0.7, table["AggregateGRatio"]),
                                     ("axon volume fraction (AVF)", 0.6 * 0.49, table["AVF"]), ("smallest gap between fibres (µm)", 0.02, table["SmallestGap_um"])):
            self.assertAlmostEqual(float(rows[name][0]), asked, places=4)
            self.assertAlmostEqual(float(rows[name][1]), reached, delta=1e-3 * reached)
        self.assertEqual(rows["mean dispersion (degrees)"][0], "5")
        # Of a gamma distribution cut to 0.3 to 2 µm, by summing up.
        weights = [(r, r**1.4 * 2.718281828459045 ** (-r / 0.25)) for r in (0.3 + 1.7 * (i + 0.5) / 10000 for i in range(10000))]
        mean = sum(r * w for r, w in weights) / sum(w for _, w in weights)
        self.assertAlmostEqual(float(rows["mean outer radius (µm)"][0]), mean, places=3)

    def check_profiles(self, charts):
        """Of three fibres from thin to thick, each with a curve of its outer diameter above that of its axon."""
        with open(os.path.join(self.substrate, "certificate_fibres.csv"), encoding="utf-8") as file:
            radii = {row["FibreId"]: float(row["OuterRadius_um"] or "nan") for row in csv.DictReader(file)}
        shown = [radii[re.search(r"Fibre (\d+)", chart).group(1)] for chart in charts]
        self.assertEqual(shown, sorted(shown))
        heights = []
        for chart in charts:
            outer, inner = (dict(tuple(map(float, point.split(","))) for point in points.split()) for points in re.findall(r'<polyline points="([^"]+)"', chart))
            self.assertGreater(len(outer), 0.8 * len(inner))  # not of a fibre that runs along the domain's side
            along = outer.keys() & inner.keys()
            self.assertGreater(len(along), 0.5 * len(outer))
            self.assertTrue(all(outer[place] < inner[place] for place in along))  # downwards, as SVG has it
            heights.append(sum(outer.values()) / len(outer))
        self.assertEqual(heights, sorted(heights, reverse=True))

    def check_picture(self, address):
        self.assertTrue(address.startswith("data:image/png;base64,"))
        path = os.path.join(self.folder, "picture.png")
        with open(path, "wb") as file:
            file.write(base64.b64decode(address.split(",", 1)[1]))
        reader = vtkPNGReader()
        reader.SetFileName(path)
        reader.Update()
        self.assertEqual(reader.GetOutput().GetDimensions()[:2], (1400, 700))
        low, high = reader.GetOutput().GetPointData().GetScalars().GetRange()
        self.assertLess(low + 100, high)  # something is drawn

    def test_bundles_have_axes_of_their_own(self):
        """Which a file of centre lines does not tell."""
        self.expected = r"fibres are not as asked"  # in so coarse voxels
        folder = os.path.join(self.folder, "crossing")
        bundles = simple.BundleInitializer(Border="Walls", Side=6, NumberOfBundles=2, CrossingAngle=90, FibreVolumeFraction=0.3, MaximumRadius=0.6, GrownFibreVolumeFraction=0.4)
        fibres = simple.OutputPort(simple.CapsuleOptimizer(Input=bundles), 0)
        surfaces = simple.MyelinSurface(Input=simple.FibreRadialGrowth(Input=fibres, VoxelSize=0.15))
        simple.SubstrateWriter(Outer=simple.OutputPort(surfaces, 0), FolderName=folder).UpdatePipeline()
        rows = {row[0]: row[1:] for row in Page(self.made(folder, "--no-pictures")).rows}
        asked, reached = map(float, rows["mean dispersion (degrees)"])
        self.assertEqual(asked, 5)
        self.assertAlmostEqual(reached, 5, delta=2)

    def test_what_was_asked_of_all_fibres(self):
        """Not of those of one source beside others."""
        with open(os.path.join(self.substrate, "manifest.json"), encoding="utf-8") as file:
            stages = json.load(file)["provenance"]
        folder = self.changed(provenance=[{"id": "0", "filter": "TractFibres", "properties": {"GrownFibreVolumeFraction": 0.5}}, *stages])
        rows = {row[0]: row[1:] for row in Page(self.made(folder, "--no-pictures")).rows}
        for name in ("fibre volume fraction (FVF)", "mean outer radius (µm)", "mean dispersion (degrees)"):
            self.assertNotRegex(rows[name][0], r"\d", name)
        shutil.rmtree(folder)
        self.assertIn("GRatio", stages[0]["properties"])
        stages[0]["properties"]["GRatio"] = 0.5  # of one bundle, whatever MyelinSurface says
        rows = {row[0]: row[1:] for row in Page(self.made(self.changed(provenance=stages), "--no-pictures")).rows}
        for name in ("aggregate g-ratio", "axon volume fraction (AVF)", "myelin volume fraction (MVF)"):
            self.assertNotRegex(rows[name][0], r"\d", name)

    def test_radii_that_hardly_differ(self):
        with open(os.path.join(self.substrate, "manifest.json"), encoding="utf-8") as file:
            stages = json.load(file)["provenance"]
        asked = stages[0]["properties"]
        for values, mean in (({"MinimumRadius": 0.5, "MaximumRadius": 0.5}, 0.5), ({"GammaShape": 1000, "GammaScale": 0.001}, 1.0), ({"GammaShape": 1100, "GammaScale": 0.001}, 1.1),
                             ({"RadiusDistribution": "Lognormal", "LognormalMean": 0.6, "LognormalDeviation": 1e-5}, 0.6)):
            stages[0]["properties"] = {**asked, **values}
            folder = self.changed(provenance=stages)
            rows = {row[0]: row[1:] for row in Page(self.made(folder, "--no-pictures")).rows}
            self.assertAlmostEqual(float(rows["mean outer radius (µm)"][0]), mean, delta=0.003)
            shutil.rmtree(folder)

    def test_a_sample(self):
        folder = os.path.join(self.folder, "sample")
        fibres = simple.OutputPort(simple.CapsuleOptimizer(Input=simple.BundleInitializer(Border="Walls", Side=5, MinimumRadius=0.3)), 0)
        simple.SubstrateProduction(Input=fibres, FolderName=folder, Format="Surfaces alone", SampledFraction=0.5, VoxelSize=0.15).UpdatePipeline()
        page = Page(self.made(folder))
        self.assertRegex(page.verdict, r"^CERTIFIED.* This is a sample of \d+ fibres, the others of which have no surfaces here\.$")
        rows = {row[0]: row[1:] for row in page.rows}
        self.assertLess(float(rows["fibres"][1]), float(rows["fibres"][0]))
        self.assertEqual(rows["fibre volume fraction (FVF)"][0], "–")
        self.check_picture(next(address for tag, address in page.addresses if tag == "img"))

    def test_what_was_changed_is_said_first(self):
        folder = self.copied()
        with open(os.path.join(folder, "outer", "fibre_00001.ply"), "a", encoding="utf-8") as file:
            file.write("\n")
        page = Page(self.made(folder, "--no-pictures"))
        self.assertRegex(page.verdict, r"^CHANGED SINCE: 1 files.*outer/fibre_00001\.ply")
        os.truncate(os.path.join(folder, "outer", "fibre_00001.ply"), 5000)
        page = Page(self.made(folder))
        self.assertRegex(page.verdict, r"^CHANGED SINCE: 1 files.*outer/fibre_00001\.ply")
        self.assertRegex(page.words, r"No picture: .*fibre_00001\.ply is not as it was written")

    def test_what_is_not_certified_is_said_with_its_reasons(self):
        page = Page(self.made(self.changed(certified=False, faults=["2 pairs of surfaces meet"]), "--no-pictures"))
        self.assertRegex(page.verdict, r"^NOT CERTIFIED.*2 pairs of surfaces meet")

    def test_texts_of_a_manifest_stay_texts(self):
        """A manifest may come from anybody."""
        text = self.made(self.changed(certified=False, faults=["<script>alert(1)</script>"], version="<b>9</b>"), "--no-pictures")
        self.assertNotIn("<script>", text)
        self.assertNotIn("<b>9</b>", text)
        self.assertEqual(Page(text).open, [])

    def test_beside_the_folder(self):
        folder = self.copied()
        code, said = self.report(folder, "--no-pictures")
        self.assertEqual(code, 0, said)
        self.assertTrue(os.path.isfile(folder + "-report.html"))
        self.assertEqual(self.report(folder + "/manifest.json", "--no-pictures")[0], 0)  # again, over the first

    def test_refusals(self):
        other = os.path.join(self.folder, "other.html")
        with open(other, "w", encoding="utf-8") as file:
            file.write("<html>my own</html>")
        inside = os.path.join(self.substrate, "report.html")
        for words, message in (((self.substrate, "--output", other), "is no report"), ((self.substrate, "--output", inside), "in the folder itself"),
                               ((self.folder,), "cannot read"), ((self.changed(format="another"),), "no manifest of a substrate")):
            code, said = self.report(*words, "--no-pictures")
            self.assertEqual(code, 2, said)
            self.assertIn(message, said)
        with open(other, encoding="utf-8") as file:
            self.assertEqual(file.read(), "<html>my own</html>")
        self.assertFalse(os.path.exists(inside))

    @unittest.skipUnless(CHROMIUM, "chromium is not installed")
    def test_in_a_browser(self):
        """It is laid out as it is meant, without a network, and prints on two pages."""
        self.made(self.substrate)
        printed = os.path.join(self.folder, "page.pdf")
        browser = [CHROMIUM, "--headless", "--no-sandbox", "--disable-gpu", f"--user-data-dir={self.folder}/profile", "--host-resolver-rules=MAP * ~NOTFOUND"]
        address = f"file://{self.folder}/page.html"
        subprocess.run([*browser, f"--print-to-pdf={printed}", "--no-pdf-header-footer", address], check=True, capture_output=True, timeout=100)
        with open(printed, "rb") as file:
            self.assertEqual(len(re.findall(rb"/Type\s*/Page\b", file.read())), 2)
        shown = subprocess.run([*browser, "--dump-dom", address], check=True, capture_output=True, text=True, timeout=100).stdout
        self.assertIn('<div class="verdict good">CERTIFIED', shown)

    def uncertified(self):
        """A copy of another name whose manifest says, with its checksum, that it is not certified."""
        folder = self.copied_as("faulty")
        path = os.path.join(folder, "manifest.json")
        with open(path, encoding="utf-8") as file:
            text = file.read()
        own = json.loads(text)["manifest_sha256"]
        text = text.replace(own, 64 * "0").replace('"certified": true', '"certified": false').replace('"faults": []', '"faults": ["surfaces meet"]')
        with open(path, "w", encoding="utf-8") as file:
            file.write(text.replace('"manifest_sha256": "' + 64 * "0", '"manifest_sha256": "' + hashlib.sha256(text.encode()).hexdigest()))
        return folder

    def wanted(self, *folders, **options):
        return argparse.Namespace(**{"folders": folders, "creator": ["Family, Given"], "output": os.path.join(self.folder, "mine.zip"), "title": None, "version": "1.0.0",
                                     "licence": "CC-BY-4.0", "allow_uncertified": False, **options})

    def test_a_pack(self):
        folders = self.substrate, self.uncertified()
        with open(os.path.join(folders[1], "mcdc", "output", "signal.txt"), "w", encoding="utf-8") as file:
            file.write("of a simulation")
        output = os.path.join(self.folder, "mine.zip")
        done = subprocess.run(["pvpython", os.path.join(SCRIPTS, "pack.py"), *folders, "--creator", "Family, Given", "--creator", "Other, Name", "--output", output,
                               "--allow-uncertified"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        with zipfile.ZipFile(output) as archive:
            self.assertIsNone(archive.testzip())
            archive.extractall(self.folder)
        place = os.path.join(self.folder, "mine")
        subprocess.run(["sha256sum", "--check", "--strict", "--quiet", "SHA256SUMS"], cwd=place, check=True)
        with open(os.path.join(place, "SHA256SUMS"), encoding="utf-8") as file:
            listed = {line[66:].rstrip("\n") for line in file}
        self.assertEqual(listed | {"SHA256SUMS"}, set(pack.files_below(place)))
        for folder in folders:
            name = os.path.basename(folder)
            there = os.path.join(place, "substrates", name)
            self.assertEqual(pack.Substrate(there, True).files(), pack.Substrate(folder, True).files(), "as it was written")
            self.assertTrue(os.path.isdir(os.path.join(there, "mcdc", "output")))
            self.assertFalse(os.listdir(os.path.join(there, "mcdc", "output")))
            self.assertTrue({f"reports/{name}.html", f"previews/{name}.vtm"} <= listed)
        with open(os.path.join(place, ".zenodo.json"), encoding="utf-8") as file:
            data = json.load(file)
        self.assertEqual([one["name"] for one in data["creators"]], ["Family, Given", "Other, Name"])
        self.assertEqual((data["license"], data["upload_type"], data["version"]), ("CC-BY-4.0", "dataset", "1.0.0"))
        self.assertEqual(data["related_identifiers"][0]["identifier"], "10.3389/fninf.2023.1208073")
        self.assertRegex(data["description"], r"<li>faulty: 6 x 6 x 6 µm, \d+ fibres, .*fibre volume fraction 0\.\d{4}, axon volume fraction 0\.\d{4}, not certified, for MC/DC")
        self.assertRegex(data["description"], r"<li>substrate: [^<]*, certified, for MC/DC")
        # Again, the same bytes.
        again = os.path.join(self.folder, "again")
        os.mkdir(again)
        pack.pack(self.wanted(*reversed(folders), creator=["Family, Given", "Other, Name"], output=os.path.join(again, "mine.zip"), allow_uncertified=True))
        with open(output, "rb") as one, open(os.path.join(again, "mine.zip"), "rb") as other:
            self.assertEqual(hashlib.sha256(one.read()).hexdigest(), hashlib.sha256(other.read()).hexdigest())

    def test_what_is_not_packed(self):
        """Before anything is read of ParaView, and nothing is written."""
        faulty, there = self.uncertified(), os.path.join(self.folder, "there.zip")
        with open(there, "w", encoding="utf-8") as file:
            file.write("mine")
        changed = self.changed(certified=False)
        with open(os.path.join(self.copied_as("other"), "outer", "fibre_00001.ply"), "a", encoding="utf-8") as file:
            file.write("more")
        os.remove(os.path.join(self.copied_as("gone"), "certificate.csv"))
        before = sorted(os.listdir(self.folder))
        for wanted, why in (
            (self.wanted(faulty), r"faulty is not certified \(surfaces meet\).*--allow-uncertified"),
            (self.wanted(changed), r"manifest\.json is not as it was written"),
            (self.wanted(os.path.join(self.folder, "other")), r"1 files of .*other are gone or not as they were written, such as outer/fibre_00001\.ply"),
            (self.wanted(os.path.join(self.folder, "gone")), r"1 files of .*gone are gone.*certificate\.csv"),
            (self.wanted(self.substrate, self.substrate), r"several folders are called substrate"),
            (self.wanted(self.substrate, creator=["Somebody"]), r"'Somebody' is no name"),
            (self.wanted(self.substrate, licence="my own"), r"'my own' is no name of a licence"),
            (self.wanted(self.substrate, output=there), r"there\.zip is there already"),
            (self.wanted(self.substrate, output=os.path.join(self.folder, "mine.tar")), r"does not end with \.zip"),
            (self.wanted(self.substrate, output=os.path.join(self.substrate, "mine.zip")), r"mine\.zip is in .*substrate itself"),
            (self.wanted(self.folder), r"cannot read .*manifest\.json"),
        ):
            with self.subTest(why=why), self.assertRaisesRegex(Refusal, why):
                pack.pack(wanted)
        self.assertEqual(sorted(os.listdir(self.folder)), before)
        self.assertFalse(os.path.exists(os.path.join(self.substrate, "mine.zip")))


if __name__ == "__main__":
    main()
