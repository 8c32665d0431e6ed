# SPDX-License-Identifier: BSD-3-Clause
"""Grows the tutorial bundle of the CACTUS paper: from nothing to closed surfaces, a table of what was reached, and a picture.

Run it with ./cactus demo. All lengths are in µm, all angles in degrees.
"""

import argparse
import csv
import os
import sys
import time

from paraview import servermanager, simple

from output_folder import first_free, make_folder
from picture import draw_substrate

FOLDER = "cactus-demo"
FILES = ("substrate", "fibres.vtp", "fibres.strands", "labels.vti", "outer.vtp", "inner.vtp", "convergence.csv", "fibres.csv", "certificate.csv",
         "certificate_fibres.csv", "statistics.csv", "substrate.png")


def arguments():
    parser = argparse.ArgumentParser(prog="./cactus demo", description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--output", metavar="DIR", help=f"folder for everything it writes (default: {FOLDER}, or {FOLDER}-2 and so on where one is there)")
    parser.add_argument("--side", type=float, default=30.0, help="side of the cubic domain, µm (default: %(default)s)")
    parser.add_argument("--dispersion", type=float, default=10.0, help="mean dispersion, degrees (default: %(default)s)")
    parser.add_argument("--fvf", type=float, default=0.9, help="fibre volume fraction to grow to (default: %(default)s)")
    parser.add_argument("--g-ratio", type=float, default=0.7, help="inner over outer radius (default: %(default)s)")
    parser.add_argument("--voxel-size", type=float, default=0.1, help="voxel of the label image, µm (default: %(default)s)")
    parser.add_argument("--seed", type=int, default=1, help="another seed, another substrate (default: %(default)s)")
    parser.add_argument("--no-picture", action="store_true", help="do not render substrate.png")
    return parser.parse_args()


class Stages:
    """Runs the stages of the chain, and prints how far each is and how long it took."""

    def __init__(self):
        self.start = time.perf_counter()
        self.failed = False

    def run(self, title, proxy, summary=None):
        begin = shown = time.perf_counter()
        algorithm = proxy.GetClientSideObject()

        def progress(caller, _event):
            nonlocal shown
            if time.perf_counter() - shown > 1.0:
                shown = time.perf_counter()
                print(f"    {100 * caller.GetProgress():3.0f} %  {caller.GetProgressText() or ''}", flush=True)

        def error(_caller, _event):
            self.failed = True

        observers = [algorithm.AddObserver("ProgressEvent", progress), algorithm.AddObserver("ErrorEvent", error)]
        print(title, flush=True)
        proxy.UpdatePipeline()
        for observer in observers:
            algorithm.RemoveObserver(observer)
        if self.failed:
            sys.exit(f"demo: '{title}' failed, as the error above says")  # VTK has printed it
        print(f"    {summary() + ', ' if summary else ''}{time.perf_counter() - begin:.1f} s", flush=True)


def rows(proxy, port):
    """A table of the pipeline as a list of dictionaries."""
    table = servermanager.Fetch(proxy, idx=port)
    names = [table.GetColumnName(column) for column in range(table.GetNumberOfColumns())]
    return [{name: table.GetValueByName(row, name).ToDouble() for name in names} for row in range(table.GetNumberOfRows())]


def save(name, proxy, **options):
    simple.SaveData(name, proxy=proxy, **options)
    if not os.path.exists(name):
        sys.exit(f"demo: could not write {name}")


def cells(port):
    return port.GetDataInformation().GetNumberOfCells()


def main():
    wanted = arguments()
    folder = wanted.output or first_free(FOLDER, FILES)
    paths = dict(zip(FILES, make_folder("demo", folder, FILES)))

    stages = Stages()
    bundle = simple.BundleInitializer(Side=wanted.side, FibreVolumeFraction=min(wanted.fvf, 0.6), GrownFibreVolumeFraction=wanted.fvf, GammaShape=2.4, GammaScale=0.25, MeanDispersion=wanted.dispersion, Seed=wanted.seed)
    stages.run("Bundle initialiser", bundle, lambda: f"{cells(bundle)} fibres")
    initial = simple.SubstrateStatistics(Fibres=bundle)
    initial.UpdatePipeline()
    asked = rows(initial, 0)[0]

    optimised = simple.CapsuleOptimizer(Input=bundle)
    stages.run(
        "Capsule optimiser",
        optimised,
        lambda: "largest penetration {MaximumPenetration:.1e} after {Iteration:.0f} iterations".format(**rows(optimised, 1)[-1]),
    )
    fibres = simple.OutputPort(optimised, 0)

    grown = simple.FibreRadialGrowth(Input=fibres, VoxelSize=wanted.voxel_size, Seed=wanted.seed)
    stages.run("Fibre radial growth", grown, lambda: f"{grown.GetDataInformation().GetNumberOfPoints() / 1e6:.1f} million voxels")

    surfaces = simple.MyelinSurface(Input=grown, GRatioModel="Constant", GRatio=wanted.g_ratio)
    outer, inner = simple.OutputPort(surfaces, 0), simple.OutputPort(surfaces, 1)
    stages.run("Myelin surfaces", surfaces, lambda: f"{cells(outer)} outer and {cells(inner)} inner triangles")

    statistics = simple.SubstrateStatistics(Fibres=fibres, Outer=outer, Inner=inner)
    stages.run("Statistics", statistics)
    reached = rows(statistics, 0)[0]

    certificate = simple.SubstrateCertificate(Fibres=fibres, Outer=outer, Inner=inner)
    stages.run("Certificate", certificate, lambda: "certified" if rows(certificate, 0)[0]["Certified"] else "NOT certified")
    checked = rows(certificate, 0)[0]

    writer = simple.SubstrateWriter(Fibres=fibres, Outer=outer, Inner=inner, FolderName=paths["substrate"])
    stages.run("PLY folder with MCDC configuration", writer)

    print("Other files", flush=True)
    begin = time.perf_counter()
    inline = {"DataMode": "Binary", "CompressorType": "LZ4"}  # Debian's ParaView cannot read appended data back
    save(paths["fibres.vtp"], fibres, **inline)
    save(paths["fibres.strands"], fibres)
    save(paths["labels.vti"], grown, **inline)
    save(paths["outer.vtp"], outer, **inline)
    save(paths["inner.vtp"], inner, **inline)
    save(paths["convergence.csv"], simple.OutputPort(optimised, 1))
    save(paths["fibres.csv"], simple.OutputPort(statistics, 1))
    save(paths["certificate.csv"], simple.OutputPort(certificate, 0))
    save(paths["certificate_fibres.csv"], simple.OutputPort(certificate, 1))
    print(f"    {time.perf_counter() - begin:.1f} s", flush=True)
    if not wanted.no_picture:
        print("Picture", flush=True)
        begin = time.perf_counter()
        draw_substrate(outer, inner, wanted.side, paths["substrate.png"])
        print(f"    {time.perf_counter() - begin:.1f} s", flush=True)

    g = wanted.g_ratio
    table = [
        ("fibres", None, reached["Fibres"]),
        ("fibre volume fraction (FVF)", wanted.fvf, reached["FVF"]),
        ("axon volume fraction (AVF)", g * g * wanted.fvf, reached["AVF"]),
        ("myelin volume fraction (MVF)", (1.0 - g * g) * wanted.fvf, reached["MVF"]),
        ("aggregate g-ratio", g, reached["AggregateGRatio"]),
        ("mean dispersion, initial (deg)", wanted.dispersion, asked["MeanDispersion_deg"]),
        ("mean dispersion, final (deg)", wanted.dispersion, reached["MeanDispersion_deg"]),
        ("mean outer radius (um)", reached["MeanTargetRadius_um"], reached["MeanOuterRadius_um"]),
        ("mean inner radius (um)", None, reached["MeanInnerRadius_um"]),
        ("largest penetration", 1e-3, reached["LargestPenetration"]),
        ("triangles", None, reached["Triangles"]),
        ("certified", 1, checked["Certified"]),
        ("surfaces not closed and manifold", 0, checked["NotClosed"] + checked["NotManifold"]),
        ("surfaces not outward", 0, checked["NotOutward"]),
        ("surfaces that cut themselves", 0, checked["SelfIntersecting"]),
        ("pairs of outer surfaces that meet", 0, checked["OuterPairsMeeting"] + checked["OuterPairsNested"]),
        ("inner surfaces that leave theirs", 0, checked["InnerLeaving"]),
        ("smallest gap (um)", checked["MinimumGap_um"], checked["SmallestGap_um"]),
        ("thinnest myelin (um)", None, checked["SmallestMyelin_um"]),
        ("largest squared edge ratio", None, checked["LargestSquaredEdgeRatio"]),
    ]
    with open(paths["statistics.csv"], "w", newline="", encoding="utf-8") as file:
        sheet = csv.writer(file)
        sheet.writerow(["quantity", "asked", "reached"])
        sheet.writerows([name, "" if aim is None else f"{aim:.9g}", f"{value:.9g}"] for name, aim, value in table)
    print(f"\n{'':<34}{'asked':>10}{'reached':>12}")
    for name, aim, value in table:
        print(f"{name:<34}{'-' if aim is None else f'{aim:.4g}':>10}{value:>12.6g}")
    print(f"\nAll in {os.path.abspath(folder)}, after {time.perf_counter() - stages.start:.0f} s.")
    if not checked["Certified"]:
        sys.exit("demo: the surfaces are not certified, as the warning above says")


if __name__ == "__main__":
    main()
