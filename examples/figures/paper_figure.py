# SPDX-License-Identifier: BSD-3-Clause
"""What the figures share: their options, the substrates of the paper with what was measured on them, pictures of these as images for
matplotlib, and a folder in which nothing is replaced but what is still as it was written."""

import argparse
import contextlib
import csv
import hashlib
import io
import json
import os
import sys
import tempfile

import matplotlib

matplotlib.use("Agg")  # without a window
from matplotlib import pyplot  # noqa: E402
from paraview import servermanager, simple  # noqa: E402
from PIL import Image  # noqa: E402
from vtkmodules.vtkCommonCore import vtkPoints  # noqa: E402
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData  # noqa: E402

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path += [os.path.join(ROOT, "examples"), os.path.join(ROOT, "tools", "scripts")]
import paper  # noqa: E402
from picture import section_view, solid_view  # noqa: E402
from substrate_folder import Refusal, sha256  # noqa: E402

BLACK, LIGHT, DARK = [0.05, 0.05, 0.05], [0.80, 0.80, 0.80], [0.47, 0.47, 0.47]
PIXELS = 500
pyplot.rcParams.update({"font.size": 8, "axes.titlesize": 9, "axes.spines.top": False, "axes.spines.right": False})


class Folder:
    """Where figures go. `figures.json` has the checksum of every file that was written, by which it is known for ours, unchanged."""

    def __init__(self, path):
        self.path = path
        self.written = {}
        ledger = os.path.join(path, "figures.json")
        if os.path.lexists(ledger):
            try:
                with open(ledger, encoding="utf-8") as file:
                    found = json.load(file)
                if found["format"] != "CACTUS figures":
                    raise ValueError(found["format"])
                self.written = dict(found["sha256"])
            except (OSError, ValueError, KeyError, TypeError) as error:
                raise Refusal(f"{ledger} is there already, and is not that of ./cactus figures ({error}): name another folder with --output") from error

    def require(self, name):
        """Throws Refusal where something else has that name."""
        path = os.path.join(self.path, name)
        if os.path.lexists(path) and not (os.path.isfile(path) and sha256(path) == self.written.get(name)):
            raise Refusal(f"{path} is there already, and is not as ./cactus figures has written it: move it, or name another folder with --output")

    def put(self, name, content):
        self.require(name)
        self.written[name] = hashlib.sha256(content).hexdigest()
        ledger = json.dumps({"format": "CACTUS figures", "sha256": self.written}, indent=1).encode()
        # A file without its entry would not be known again; an entry without its file does no harm.
        for one, bytes_of_it in (("figures.json", ledger), (name, content)):
            beside = os.path.join(self.path, f"{one}.{os.getpid()}.part")
            with open(beside, "wb") as file:
                file.write(bytes_of_it)
            os.replace(beside, os.path.join(self.path, one))


def add_options(parser, side=None):
    """Those of every figure; `side` is the figure's own default."""
    parser.add_argument("--output", default="cactus-figures", metavar="DIR", help="folder for the figures (default: %(default)s)")
    parser.add_argument("--side", type=float, default=side, help=f"side of the (largest) domain, µm (default: {side or 'each has its own'})")
    parser.add_argument("--voxel-size", type=float, default=0.1, help="voxel of the label images, µm (default: %(default)s)")
    parser.add_argument("--fraction", type=float, default=0.955, help="fibre volume fraction of what is to be as dense as can be (default: %(default)s)")
    parser.add_argument("--seed", type=int, default=1, help="another seed, other substrates (default: %(default)s)")


class Figure:
    """One run of a figure's script, which is `script`: NAME.png and NAME.csv in the folder asked for."""

    def __init__(self, script, title, side):
        self.name = os.path.splitext(os.path.basename(script))[0]
        parser = argparse.ArgumentParser(prog=f"./cactus figures {self.name}", description=title)
        add_options(parser, side)
        self.options = parser.parse_args()
        self.rows = []
        try:
            os.makedirs(self.options.output, exist_ok=True)
            self.folder = Folder(self.options.output)
            for ending in ("png", "csv"):
                self.folder.require(f"{self.name}.{ending}")
        except OSError as error:
            sys.exit(f"figures: cannot write to {self.options.output}: {error.strerror}")
        except Refusal as refusal:
            sys.exit(f"figures: {refusal}")

    @contextlib.contextmanager
    def substrate(self, name, side=None, growth=None, **other):
        """A Substrate by its name in examples/paper.py, with other values for its `growth` and its bundle, for as long as it is needed."""
        print(f"    {name}", flush=True)
        made = Substrate(name, side or self.options.side, self.options, growth or {}, other)
        yield made
        made.close()

    def row(self, **quantities):
        """A row of the table. Numbers are rounded to what they are good for."""
        self.rows.append({name: f"{value:.4g}" if isinstance(value, float) else str(value) for name, value in quantities.items()})

    def fraction_row(self, quantity, value, reported, made):
        """The row of a Substrate in the paper's Table 1, which has `reported` its fibres and their volume fraction."""
        self.row(
            **{quantity: value}, paper_fibres=reported[0], paper_FVF=reported[1], fibres=int(made.whole["OuterSurfaces"]), FVF=made.whole["FVF"],
            smallest_gap_um=made.whole["SmallestGap_um"], certified="yes" if made.whole["Certified"] else "no",
        )

    def save(self, canvas):
        """The picture in 256 colours, which a web page loads in no time, and the table, which is printed, too."""
        drawn = io.BytesIO()
        canvas.savefig(drawn, format="png", dpi=110)
        pyplot.close(canvas)
        picture = io.BytesIO()
        Image.open(drawn).convert("RGB").quantize(256, method=Image.Quantize.MAXCOVERAGE, dither=Image.Dither.NONE).save(picture, format="png", optimize=True)
        table = io.StringIO()
        sheet = csv.DictWriter(table, fieldnames=list(self.rows[0]))
        sheet.writeheader()
        sheet.writerows(self.rows)
        try:
            self.folder.put(f"{self.name}.png", picture.getvalue())
            self.folder.put(f"{self.name}.csv", table.getvalue().encode())
        except (OSError, Refusal) as error:
            sys.exit(f"figures: cannot write to {self.options.output}: {error}")
        print("\n".join("    " + ", ".join(f"{name} {value}" for name, value in row.items()) for row in self.rows))
        print(f"Wrote {os.path.join(os.path.abspath(self.options.output), self.name)}.png and .csv", flush=True)


class Substrate:
    """A substrate of the paper: `fibres`, `outer` and `inner` as pipeline ports; `whole` = {quantity: value} and `fibre` = {quantity:
    values of all fibres}, both as SubstrateCertificate has them."""

    def __init__(self, name, side, options, other_growth, other):
        bundle, growth, myelin = paper.properties(name, side, options.seed, options.fraction)
        initial = simple.BundleInitializer(**{**bundle, **other})
        optimiser = simple.CapsuleOptimizer(Input=initial)
        self.fibres = simple.OutputPort(optimiser, 0)
        grown = simple.FibreRadialGrowth(Input=self.fibres, VoxelSize=options.voxel_size, **{**growth, **other_growth})
        surfaces = simple.MyelinSurface(Input=grown, ReleaseInput=1, **myelin)
        self.outer, self.inner = simple.OutputPort(surfaces, 0), simple.OutputPort(surfaces, 1)
        certificate = simple.SubstrateCertificate(Outer=self.outer)
        self.side = side
        self.proxies = [certificate, surfaces, grown, optimiser, initial]
        whole = columns(certificate, 0)
        if not whole:
            sys.exit(f"figures: {name} could not be made, as the error above says")
        self.whole = {quantity: values[0] for quantity, values in whole.items()}
        self.fibre = columns(certificate, 1)

    def bundle(self, surfaces, number):
        """The surfaces of one bundle."""
        one = simple.Threshold(Input=surfaces, Scalars=["CELLS", "BundleId"], LowerThreshold=number, UpperThreshold=number)
        self.proxies.insert(0, one)
        return one

    def close(self):
        for proxy in self.proxies:
            simple.Delete(proxy)


def columns(proxy, port):
    """{name: list of numbers} of a table in the pipeline."""
    simple.OutputPort(proxy, port).UpdatePipeline()
    table = servermanager.Fetch(proxy, idx=port)
    names = [table.GetColumnName(i) for i in range(table.GetNumberOfColumns())]
    return {name: [table.GetValueByName(row, name).ToDouble() for row in range(table.GetNumberOfRows())] for name in names if table.GetNumberOfRows()}


def producer(data):
    """A data object as a source in the pipeline."""
    source = simple.TrivialProducer()
    source.GetClientSideObject().SetOutput(data)
    return source


def polyline(points):
    """One line through all points."""
    data, places, cells = vtkPolyData(), vtkPoints(), vtkCellArray()
    cells.InsertNextCell(len(points), [places.InsertNextPoint(point) for point in points])
    data.SetPoints(places)
    data.SetLines(cells)
    return data


def image(view, width=PIXELS, height=PIXELS):
    """A view as an image for matplotlib. It is closed: a render window that lives until Python ends takes the process down with it."""
    with tempfile.TemporaryDirectory(prefix="cactus-figure-") as scratch:
        path = os.path.join(scratch, "view.png")
        simple.SaveScreenshot(path, view, ImageResolution=[width, height])
        simple.Delete(view)
        return pyplot.imread(path)


def section(layers, window, **plane):
    """The image of a cut through the origin; see picture.section_view."""
    return image(section_view(layers, window, PIXELS, **plane))


def solid(layers, side):
    """The image of surfaces in three dimensions; see picture.solid_view."""
    return image(solid_view(layers, side, PIXELS))


def place(axis, picture, title="", bar=None):
    """Shows an image without axes, with a scale bar where `bar` = (length in µm, the image's width in µm)."""
    axis.imshow(picture)
    axis.set_title(title)
    axis.set_axis_off()
    if bar:
        height, width = picture.shape[:2]
        length = width * bar[0] / bar[1]
        axis.plot([0.04 * width, 0.04 * width + length], [1.03 * height] * 2, color="black", linewidth=2, clip_on=False)
        axis.text(0.04 * width + length / 2, 1.05 * height, f"{bar[0]:g} µm", ha="center", va="top")


def bar_for(window):
    """The length of a scale bar: 1, 2 or 5 times a power of ten, about a quarter of the window."""
    return max(length for length in (factor * 10.0**power for power in range(-3, 4) for factor in (1, 2, 5)) if length <= 0.3 * window)
