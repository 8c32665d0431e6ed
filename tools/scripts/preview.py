# SPDX-License-Identifier: BSD-3-Clause
"""Makes one small file of a substrate folder of any size that ParaView opens at once: its fibres as tubes, and three cuts through its surfaces.

Run it with ./cactus preview. Each processor reads one surface after the other, so that memory goes with what is shown.
"""

import argparse
import math
import multiprocessing
import os
import sys

from paraview import servermanager, simple
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkIntArray, vtkLogger, vtkPoints, vtkSMPTools
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkCompositeDataSet, vtkMultiBlockDataSet, vtkPlane, vtkPolyData
from vtkmodules.vtkCommonExecutionModel import vtkTrivialProducer
from vtkmodules.vtkFiltersCore import vtkAppendPolyData, vtkCutter, vtkTubeFilter
from vtkmodules.vtkFiltersGeneral import vtkContourTriangulator
from vtkmodules.vtkIOLegacy import vtkPolyDataReader, vtkPolyDataWriter
from vtkmodules.vtkIOPLY import vtkPLYReader
from vtkmodules.vtkIOXML import vtkXMLMultiBlockDataWriter

from substrate_folder import Refusal, ended, manifest_path, read_manifest, read_rows, sha256

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.append(os.path.join(ROOT, "examples"))
from picture import AXON, MYELIN, moved  # noqa: E402  (which is no room of scripts)

AXES = "xyz"
TUBE_SIDES = 8
IN_ONE_FILE = ("Camino", "Disimpy", "Surfaces by bundle")  # all surfaces of a kind, or of a bundle
SAYS_OF_FORMAT = "the surfaces of a folder for {} are in one file: ParaView opens them as they are"


def middle_of(manifest):
    domain = manifest["domain"]
    return [0.5 * (domain[2 * axis] + domain[2 * axis + 1]) for axis in range(3)]


def surface_files(folder, manifest):
    """(entry of the manifest, path) of each surface that has a file of its own, in µm."""
    if manifest.get("simulator") in IN_ONE_FILE:
        raise Refusal(SAYS_OF_FORMAT.format(manifest["simulator"]))
    found = []
    for entry in manifest["files"]:
        path = os.path.join(folder, entry["path"])
        if entry["path"] in manifest["sha256"] and os.path.isfile(path):
            found.append((entry, path))
    return found


def read_surface(manifest, entry, path):
    """The polygons of a surface's file, as surface_files() has it. Throws Refusal where it is not as it was written: VTK's reader ends the process at one that is cut off."""
    if sha256(path) != manifest["sha256"][entry["path"]]:
        raise Refusal(f"{path} is not as it was written: if it was not copied as a whole, copy it again")
    reader = vtkPLYReader()
    reader.SetFileName(path)
    reader.Update()
    return reader.GetOutput()


def in_middle(polygons, manifest, lift=0.0):
    """The same as a source, with the domain's middle in the origin, and lifted along z (µm)."""
    source = vtkTrivialProducer()
    source.SetOutput(polygons)
    back = [-middle for middle in middle_of(manifest)]
    return moved(source, [back[0], back[1], back[2] + lift])


def with_numbers(data, **numbers):
    """The polygons with whole numbers on all cells."""
    for name, number in numbers.items():
        values = vtkIntArray()
        values.SetName(name)
        values.SetNumberOfValues(data.GetNumberOfCells())
        values.Fill(number)
        data.GetCellData().AddArray(values)
    return data


def _filled(mesh, point, normal):
    """The cross-section of a closed surface as filled polygons, or None where the plane passes by."""
    bounds = mesh.GetBounds()
    axis = normal.index(1.0)
    if not bounds[2 * axis] < point[axis] < bounds[2 * axis + 1]:
        return None
    plane = vtkPlane()
    plane.SetOrigin(point)
    plane.SetNormal(normal)
    cutter = vtkCutter()
    cutter.SetCutFunction(plane)
    cutter.SetInputData(mesh)
    triangulator = vtkContourTriangulator()
    triangulator.SetInputConnection(cutter.GetOutputPort())
    triangulator.Update()
    return triangulator.GetOutput()


def _as_bytes(polygons):
    writer = vtkPolyDataWriter()
    writer.SetInputData(polygons)
    writer.SetFileTypeToBinary()
    writer.WriteToOutputStringOn()
    writer.Write()
    return writer.GetOutputStdString()


def _from_bytes(content):
    reader = vtkPolyDataReader()
    reader.ReadFromInputStringOn()
    reader.SetBinaryInputString(content, len(content))
    reader.Update()
    return reader.GetOutput()


def _part_of(manifest, entry):
    """What of a manifest is about one surface."""
    return {"domain": manifest["domain"], "sha256": {entry["path"]: manifest["sha256"][entry["path"]]}}


def _cuts_of(task):
    """{axis: bytes} of the cuts through one surface, or why it is refused."""
    manifest, entry, path, axes = task
    try:
        surface = read_surface(manifest, entry, path)
    except Refusal as refusal:
        return str(refusal)
    found = {}
    for axis in axes:
        cut = _filled(surface, middle_of(manifest), [float(name == axis) for name in AXES])
        if cut is not None and cut.GetNumberOfCells() > 0:
            found[axis] = _as_bytes(with_numbers(cut, FibreId=entry["fibre"], BundleId=entry["bundle"], Compartment=int(entry["surface"] == "inner")))
    return found


def cuts_through(folder, manifest, axes):
    """{axis: {"outer" or "inner": polygons}}: the cross-sections of all surfaces in the planes through the domain's middle, each with the FibreId,
    BundleId and Compartment (0: fibre, 1: axon) of its surface."""
    vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_WARNING)  # the cutter says that it cuts, each time
    together = {axis: {kind: vtkAppendPolyData() for kind in ("outer", "inner")} for axis in axes}
    files = surface_files(folder, manifest)
    tasks = ((_part_of(manifest, entry), entry, path, axes) for entry, path in files)
    # Processes, since VTK's filters hold Python's lock. A forked process lacks the threads that VTK may have.
    with multiprocessing.get_context("fork").Pool(len(os.sched_getaffinity(0)), vtkSMPTools.SetBackend, ("Sequential",)) as pool:
        for (entry, _), found in zip(files, pool.imap(_cuts_of, tasks)):
            if isinstance(found, str):
                raise Refusal(found)
            for axis, content in found.items():
                together[axis][entry["surface"]].AddInputData(_from_bytes(content))
    cuts = {}
    for axis, kinds in together.items():
        cuts[axis] = {}
        for kind, append in kinds.items():
            if append.GetNumberOfInputConnections(0) > 0:
                append.Update()
                cuts[axis][kind] = append.GetOutput()
    return cuts


def drawn_cut(folder, manifest, window):
    """The cut across z as layers of (polygons, colour) about the origin, for a view of `window` µm."""
    cut = cuts_through(folder, manifest, "z")["z"]
    return [(in_middle(cut[kind], manifest, lift), colour)
            for kind, lift, colour in (("outer", 0.0, MYELIN), ("inner", 0.01 * window, AXON)) if kind in cut]


def outer_radii(folder, count):
    """Of so many fibres by increasing id, the mean outer radius; none where the folder does not tell of just these."""
    rows = read_rows(os.path.join(folder, "certificate_fibres.csv"))
    radii = [row["OuterRadius_um"] for row in sorted(rows, key=lambda row: row["FibreId"])]
    return radii if len(radii) == count else []


def tubes(folder, triangles):
    """The fibres as tubes about their centre lines, as thick as their outer surfaces are on average, of about so many triangles; None where the
    folder has no centre lines."""
    path = os.path.join(folder, "fibres.strands")
    if not os.path.isfile(path):
        return None
    lines = servermanager.Fetch(simple.StrandReader(FileName=path))
    count = lines.GetNumberOfCells()
    radii = outer_radii(folder, count)
    packed = lines.GetPointData().GetArray("Radius")
    each = max(2, triangles // (2 * TUBE_SIDES * max(1, count)))
    points, cells, radius, ids = vtkPoints(), vtkCellArray(), vtkDoubleArray(), vtkIntArray()
    radius.SetName("Radius")
    ids.SetName("FibreId")
    fibre_ids = lines.GetCellData().GetArray("FibreId")
    for i in range(count):
        of_line = lines.GetCell(i).GetPointIds()
        length = of_line.GetNumberOfIds()
        steps = min(each, length) - 1
        cells.InsertNextCell(steps + 1)
        for step in range(steps + 1):
            at = of_line.GetId(round(step * (length - 1) / steps))
            own = radii[i] if radii and math.isfinite(radii[i]) else packed.GetValue(at)
            cells.InsertCellPoint(points.InsertNextPoint(lines.GetPoint(at)))
            radius.InsertNextValue(own)
        ids.InsertNextValue(int(fibre_ids.GetTuple1(i)))
    simplified = vtkPolyData()
    simplified.SetPoints(points)
    simplified.SetLines(cells)
    simplified.GetPointData().SetScalars(radius)
    simplified.GetCellData().AddArray(ids)
    tube = vtkTubeFilter()
    tube.SetInputData(simplified)
    tube.SetNumberOfSides(TUBE_SIDES)
    tube.SetVaryRadiusToVaryRadiusByAbsoluteScalar()
    tube.CappingOn()
    tube.Update()
    return tube.GetOutput()


def arguments():
    parser = argparse.ArgumentParser(prog="./cactus preview", description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("folder", help="a substrate folder, or its manifest.json")
    parser.add_argument("--output", metavar="FILE.vtm", help="file to write; what it names goes into a folder FILE beside it (default: FOLDER-preview.vtm)")
    parser.add_argument("--triangles", type=int, default=2_000_000, metavar="N", help="about how many triangles the tubes are to have (default: %(default)s)")
    return parser.parse_args()


def write_preview(folder, manifest, output, triangles):
    """Writes the file and what it names; the names of its blocks."""
    cuts = cuts_through(folder, manifest, AXES)
    blocks = [("Fibres", tubes(folder, triangles))]
    for axis, kinds in cuts.items():
        blocks += [(f"Cut across {axis}, {name}", kinds.get(kind)) for kind, name in (("outer", "fibres"), ("inner", "axons"))]
    blocks = [(name, block) for name, block in blocks if block is not None]
    shown = vtkMultiBlockDataSet()
    for number, (name, block) in enumerate(blocks):
        shown.SetBlock(number, block)
        shown.GetMetaData(number).Set(vtkCompositeDataSet.NAME(), name)
    writer = vtkXMLMultiBlockDataWriter()
    writer.SetFileName(output)
    writer.SetInputData(shown)
    writer.SetDataModeToBinary()  # Debian's ParaView cannot read the appended data that is the default
    if writer.Write() != 1 or not os.path.isfile(output):
        raise Refusal(f"cannot write {output}")
    return [name for name, _ in blocks]


def preview(wanted):
    manifest_file = manifest_path(wanted.folder)
    folder = os.path.dirname(os.path.abspath(manifest_file))
    manifest = read_manifest(manifest_file)
    output = os.path.abspath(wanted.output or folder + "-preview.vtm")
    if not output.endswith(".vtm"):
        raise Refusal(f"{output} does not end with .vtm, by which ParaView knows the file")
    if os.path.commonpath([os.path.realpath(output), os.path.realpath(folder)]) == os.path.realpath(folder):
        raise Refusal(f"{output} is in the folder itself, which would no longer be as it was written: name a file outside with --output")
    for path in (output, output[: -len(".vtm")]):
        if os.path.lexists(path):
            raise Refusal(f"{path} is there already: remove it, or name another file with --output")
    if wanted.triangles < 1:
        raise Refusal("--triangles has to be 1 or more")
    if not hasattr(simple, "StrandReader"):
        raise Refusal("the plugin is not loaded: run this by ./cactus preview")
    gone = [entry["path"] for entry in manifest["files"] if not os.path.isfile(os.path.join(folder, entry["path"]))]
    if gone:
        raise Refusal(f"{len(gone)} of {len(manifest['files'])} surfaces are not in the folder, such as {gone[0]}: copy it again, whole")
    print(f"Wrote {output}: " + "; ".join(write_preview(folder, manifest, output, wanted.triangles)))
    return 0


if __name__ == "__main__":
    sys.exit(ended("preview", lambda: preview(arguments())))
