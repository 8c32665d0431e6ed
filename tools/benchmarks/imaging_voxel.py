# SPDX-License-Identifier: BSD-3-Clause
"""Draws large substrates, whole or samples, from their folders, a row for each: a cut, its middle, and radii beside their target; and prints a row of a table.

    ./cactus pvpython tools/benchmarks/imaging_voxel.py FOLDER... --output docs/images/imaging-voxel.png

The recipes of those in docs/performance.md are at its top. Memory goes with what is drawn.
"""

import argparse
import math
import os
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path += [os.path.join(ROOT, "examples", "figures"), os.path.join(ROOT, "tools", "scripts")]
from paper_figure import pyplot  # noqa: E402  (sets the look of all figures)
from preview import drawn_cut  # noqa: E402
from report_facts import AskedRadii, in_domain, ks_distance, mean_radius  # noqa: E402
from substrate_folder import ended, manifest_path, read_manifest, read_quantities, read_rows  # noqa: E402
from paraview import simple  # noqa: E402
from picture import flat_view  # noqa: E402  (after paper_figure, which names its folder)

PIXELS = 1000
TIMES = 8.0  # as large is the middle of a cut


def image_of(layers, window):
    """What is drawn of a cut in a square of `window` µm about its middle, as an array of pixels."""
    view = flat_view(layers, window, PIXELS)
    with tempfile.TemporaryDirectory() as scratch:
        path = os.path.join(scratch, "cut.png")
        simple.SaveScreenshot(path, view, ImageResolution=[PIXELS, PIXELS])
        image = pyplot.imread(path)
    simple.Delete(view)
    return image


def facts_of(folder, manifest):
    """What a row of the table says, and the radii with their target."""
    domain = manifest["domain"]
    fibres = read_rows(os.path.join(folder, "certificate_fibres.csv"))
    whole = read_quantities(os.path.join(folder, "certificate.csv"))
    radii = [row["OuterRadius_um"] for row in in_domain(fibres) if math.isfinite(row["OuterRadius_um"])]
    density = AskedRadii(manifest).density
    return {
        "side (µm)": f"{domain[1] - domain[0]:g}",
        "fibres": f"{len(fibres):,}" + (f" of {manifest['sample_of_fibres']:,}" if "sample_of_fibres" in manifest else ""),
        "FVF": f"{whole['FVF']:.4f}",
        "mean radius: target, reached (µm)": f"{AskedRadii(manifest).mean() or math.nan:.3f}, {mean_radius(fibres, 'OuterRadius_um'):.3f}",
        "KS distance": f"{ks_distance(radii, density):.3f}",
        "smallest gap (µm)": f"{whole['SmallestGap_um']:.4f}",
        "triangles": f"{manifest['triangles']:,}",
        "certified": "yes" if manifest["certified"] else "no",
    }, radii, density


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("folders", nargs="+", help="substrate folders")
    parser.add_argument("--output", required=True, metavar="FILE.png", help="the figure to write")
    options = parser.parse_args()
    canvas, axes = pyplot.subplots(len(options.folders), 3, figsize=(12.6, 4.2 * len(options.folders)), layout="constrained", squeeze=False)
    for i, name in enumerate(options.folders):
        path = manifest_path(name)
        manifest, folder = read_manifest(path), os.path.dirname(os.path.abspath(path))
        row, radii, density = facts_of(folder, manifest)
        if i == 0:
            print("| " + " | ".join(row) + " |\n|" + "---|" * len(row))
        print("| " + " | ".join(row.values()) + " |", flush=True)
        side = float(row["side (µm)"])
        layers = drawn_cut(folder, manifest, side / TIMES)
        whole, middle, sizes = axes[i]
        for drawn, window, title in ((whole, side, f"({side:g} µm)³, {row['fibres']} fibres"), (middle, side / TIMES, f"its middle, {side / TIMES:g} µm")):
            drawn.imshow(image_of(layers, window), interpolation="lanczos")
            drawn.set(title=title, xticks=[], yticks=[])
        sizes.hist(radii, bins=50, density=True, color="#8fb0d0", label="reached")
        sizes.plot(*zip(*density), color="#c8553d", label="target")
        sizes.set(xlabel="mean radius of a fibre (µm)", ylabel="density", title=f"KS distance {row['KS distance']}")
    axes[0, 2].legend(frameon=False)
    canvas.savefig(options.output, dpi=130)
    print(f"Wrote {options.output}")
    return 0


if __name__ == "__main__":
    sys.exit(ended("imaging_voxel", main))
