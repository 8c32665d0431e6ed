# SPDX-License-Identifier: BSD-3-Clause
"""Makes one HTML page of a substrate folder: its verdict, what was asked and reached, distributions, pictures, and how it was made.

Run it with ./cactus report. The page needs no network and no other file, and prints on two sheets.
"""

import argparse
import base64
import math
import os
import re
import sys
import tempfile

from paraview import servermanager, simple
from vtkmodules.vtkFiltersCore import vtkAppendPolyData

import report_charts
from report_facts import AskedRadii, asked_and_reached, asked_g_ratio, in_domain
from preview import IN_ONE_FILE, SAYS_OF_FORMAT, drawn_cut, in_middle, middle_of, read_surface, surface_files, tubes, with_numbers
from report_page import page
from report_profiles import profiles
from substrate_folder import Refusal, changed_files, citation, ended, manifest_path, read_manifest, read_quantities, read_rows

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.append(os.path.join(ROOT, "examples"))
from picture import draw_substrate, moved  # noqa: E402  (which is no room of scripts)

OUTER, INNER, ASKED = "#c8553d", "#1b6ca8", "#222222"
# Triangles of all surfaces up to which they are drawn as they are, and of the tubes that stand for more of them.
MOST_DRAWN = 10_000_000
MOST_OF_TUBES = 1_000_000
# How a page of ours begins, so that an earlier one may be replaced, and nothing else.
MARK = '<meta name="generator" content="CACTUS report">'


def arguments():
    parser = argparse.ArgumentParser(prog="./cactus report", description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("folder", help="a substrate folder, or its manifest.json")
    parser.add_argument("--output", metavar="FILE.html", help="file to write, outside the folder (default: beside it, FOLDER-report.html)")
    parser.add_argument("--no-pictures", action="store_true", help="do not read the surfaces to draw them")
    return parser.parse_args()


def beginning(path):
    """The first characters of a file; none of what cannot be read."""
    try:
        with open(path, encoding="utf-8", errors="replace") as file:
            return file.read(1000)
    except OSError:
        return ""


def check_output(output, folder):
    """Throws Refusal where there is something else, and in the folder itself, which would no longer be as it was written."""
    if os.path.commonpath([os.path.realpath(output), os.path.realpath(folder)]) == os.path.realpath(folder):
        raise Refusal(f"{output} is in the folder itself, which would no longer be as it was written: name a file outside with --output")
    if os.path.lexists(output) and MARK not in beginning(output):
        raise Refusal(f"{output} is there already, and is no report: name another file with --output")


def fibre_lines(folder):
    """The fibres' centre lines as a pipeline source, or None where the folder has none."""
    path = os.path.join(folder, "fibres.strands")
    return simple.StrandReader(FileName=path) if os.path.isfile(path) else None


def directions(fibres):
    """Unit vectors from end to end of each fibre."""
    data = servermanager.Fetch(fibres)
    found = []
    for i in range(data.GetNumberOfCells()):
        ids = data.GetCell(i).GetPointIds()
        first, last = data.GetPoint(ids.GetId(0)), data.GetPoint(ids.GetId(ids.GetNumberOfIds() - 1))
        along = [b - a for a, b in zip(first, last)]
        length = math.hypot(*along)
        if length > 0:
            found.append([part / length for part in along])
    return found


def in_bundles(lines, manifest, fibres):
    """The centre lines as a source, each in the bundle that the manifest has its surfaces in, which a file of lines does not tell; None where some
    have none. `fibres` = rows of the certificate's table."""
    bundles = {entry["fibre"]: entry["bundle"] for entry in manifest["files"]}
    data = servermanager.Fetch(lines)
    ids = sorted(int(row["FibreId"]) for row in fibres)
    if len(ids) != data.GetNumberOfCells() or not bundles.keys() >= set(ids):
        return lines if len(set(bundles.values())) == 1 else None
    with_numbers(data, BundleId=0)  # the array that is there may be the reader's own
    for place, fibre in enumerate(ids):
        data.GetCellData().GetArray("BundleId").SetValue(place, bundles[fibre])
    source = simple.TrivialProducer()
    source.GetClientSideObject().SetOutput(data)
    return source


def mean_dispersion(lines, manifest, fibres):
    """Degrees between the fibres and their bundle's axis, by Substrate Statistics; None where bundles or lines are not known."""
    known = in_bundles(lines, manifest, fibres) if lines is not None else None
    if known is None:
        return None
    table = servermanager.Fetch(simple.SubstrateStatistics(Fibres=known))
    return table.GetValueByName(0, "MeanDispersion_deg").ToDouble()


def surfaces(folder, manifest, kind):
    """All surfaces of a kind as one source, moved so that the domain's middle is the origin; None where there are none."""
    together = vtkAppendPolyData()
    files = [(entry, path) for entry, path in surface_files(folder, manifest) if entry["surface"] == kind]
    for entry, path in files:
        together.AddInputData(read_surface(manifest, entry, path))
    return moved(together, [-middle for middle in middle_of(manifest)]) if files else None


def drawn(folder, manifest, side, path):
    """Draws the surfaces, or of very many a cut through them beside tubes. False where there is nothing to draw."""
    if manifest["triangles"] <= MOST_DRAWN:
        outer, inner = surfaces(folder, manifest, "outer"), surfaces(folder, manifest, "inner")
        if outer is None:
            return False
        draw_substrate(outer, inner, side, path, pixels=700)
        return True
    layers, fibres = drawn_cut(folder, manifest, side), tubes(folder, MOST_OF_TUBES)
    if not layers or fibres is None:
        return False
    draw_substrate(in_middle(fibres, manifest), None, side, path, pixels=700, flat=layers)
    return True


def picture(folder, manifest):
    """A cut and a view in three dimensions, as the data URI of a PNG; or None, and why."""
    if manifest.get("simulator") in IN_ONE_FILE:
        return None, f"No picture: {SAYS_OF_FORMAT.format(manifest['simulator'])}."
    domain = manifest["domain"]
    side = max(domain[2 * axis + 1] - domain[2 * axis] for axis in range(3))
    with tempfile.TemporaryDirectory(prefix="cactus-report-") as scratch:
        path = os.path.join(scratch, "substrate.png")
        if not drawn(folder, manifest, side, path):
            return None, "No picture: there are no outer surfaces, or of very many no centre lines to draw in their place."
        with open(path, "rb") as file:
            return data_uri("image/png", file.read()), ""


def data_uri(kind, content):
    return f"data:{kind};base64,{base64.b64encode(content).decode()}"


def charts(manifest, fibres, lines):
    """SVG texts of the radii, the g-ratios and the directions, and what is to be said of them."""
    fibres = in_domain(fibres)
    outer = [row["OuterRadius_um"] for row in fibres if math.isfinite(row["OuterRadius_um"])]
    inner = [row["InnerRadius_um"] for row in fibres if math.isfinite(row["InnerRadius_um"])]
    g_ratios = [row["GRatio"] for row in fibres if math.isfinite(row["GRatio"])]
    drawn, notes = [], []
    if outer:
        top = math.ceil(10 * max(outer + inner)) / 10
        density = AskedRadii(manifest).density
        bins = 25
        curve = ("asked (outer)", [(r, weight * len(outer) * top / bins) for r, weight in density if r <= top], ASKED) if density else None
        drawn.append(report_charts.histograms("Radii", "radius (µm), number of fibres", [("outer", outer, OUTER), ("inner", inner, INNER)], 0.0, top, bins, curve))
        notes.append(f"Radii are those of circles with the area of the cross-sections of the surfaces, of the {len(outer)} fibres with a centre line in the domain. "
                     "A fibre without a cross-section wholly in the domain has the radius of the tube with its volume.")
    if g_ratios:
        asked = asked_g_ratio(manifest)
        label = "g-ratio, number of fibres" + (f"; asked {asked:g}" if asked is not None else "")
        drawn.append(report_charts.histograms("g-ratio", label, [("reached", g_ratios, INNER)], 0.0, 1.0))
    if lines is not None:
        drawn.append(report_charts.rose("Directions", directions(lines), "a point for each fibre; rings: its angle from z"))
    else:
        notes.append("The folder has no centre lines (fibres.strands), and so no directions and no dispersion.")
    return drawn, notes


def profile_charts(folder, manifest, fibres, lines):
    """SVG texts of the diameters along some fibres, on the same axes, with room for the names above the curves."""
    if lines is None or manifest.get("simulator") in IN_ONE_FILE:
        return []
    found = profiles(folder, manifest, fibres, lines)
    right = max([length for _, cuts in found for length, _, _ in cuts], default=1.0)
    top = 1.4 * max([diameter for _, cuts in found for _, *both in cuts for diameter in both if math.isfinite(diameter)], default=1.0)
    return [report_charts.curves(f"Fibre {fibre}", "length along it, diameter (µm)",
                                 [("outer", [(length, outer) for length, outer, _ in cuts], OUTER), ("inner", [(length, inner) for length, _, inner in cuts], INNER)],
                                 right, top) for fibre, cuts in found]


def gathered(folder, manifest_file, with_pictures):
    """All that the page shows."""
    manifest = read_manifest(manifest_file)
    certificate = read_quantities(os.path.join(folder, "certificate.csv"))
    fibres = read_rows(os.path.join(folder, "certificate_fibres.csv"))
    lines = fibre_lines(folder)
    drawn, notes = charts(manifest, fibres, lines)
    along, shown, why = [], None, "No picture: --no-pictures."
    try:
        if with_pictures:
            shown, why = picture(folder, manifest)
            along = profile_charts(folder, manifest, fibres, lines)
    except Refusal as refusal:
        shown, why = None, f"No picture: {refusal}."
    name = os.path.basename(os.path.abspath(folder))
    with open(manifest_file, "rb") as file:
        content = file.read()
    return {
        "title": f"Substrate {name}", "certified": bool(manifest["certified"]), "sample_of": manifest.get("sample_of_fibres"), "judged": manifest["judged"], "faults": manifest["faults"],
        "changed": changed_files(folder, manifest),
        "rows": asked_and_reached(manifest, certificate, fibres, mean_dispersion(lines, manifest, fibres)),
        "picture": shown, "no_picture": why, "charts": drawn, "profiles": along, "notes": notes, "stages": manifest["provenance"],
        "again": [f"./cactus rerun {name}/manifest.json", "(the same to the bit, with CACTUS " + manifest["version"] + ")"],
        "manifest": data_uri("application/json", content), "citation": (citation()["words"], citation()["link"]),
        "versions": f"Substrate: CACTUS {manifest['version']}. Report: ParaView {servermanager.vtkSMProxyManager.GetVersionMajor()}."
                    f"{servermanager.vtkSMProxyManager.GetVersionMinor()}.{servermanager.vtkSMProxyManager.GetVersionPatch()}.",
    }


def write(path, text):
    """Whole or not at all."""
    beside = f"{path}.{os.getpid()}.part"
    try:
        with open(beside, "w", encoding="utf-8") as file:
            file.write(text)
        os.replace(beside, path)
    except OSError as error:
        if os.path.exists(beside):
            os.remove(beside)
        raise Refusal(f"cannot write {path}: {error.strerror}") from error


def report(wanted):
    manifest_file = manifest_path(wanted.folder)
    folder = os.path.dirname(os.path.abspath(manifest_file))
    output = os.path.abspath(wanted.output or folder + "-report.html")
    check_output(output, folder)
    if not hasattr(simple, "SubstrateStatistics"):
        raise Refusal("the plugin is not loaded: run this by ./cactus report")
    write(output, page(gathered(folder, manifest_file, not wanted.no_pictures)))
    print(f"Wrote {output}")
    return 0


if __name__ == "__main__":
    sys.exit(ended("report", lambda: report(arguments())))
