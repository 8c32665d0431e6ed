# SPDX-License-Identifier: BSD-3-Clause
"""Makes the substrates of the paper's Table 1 and Figure 6 at its radii, several of each with different seeds, and prints what is reached.

    python3 tools/benchmarks/paper_table.py --program build/release/bin/cactus-grow --side 100 --seeds 10 --output table.csv
    python3 tools/benchmarks/paper_table.py --only dispersion-10 --side 300 --voxel-size 0.25 --output table.csv
    python3 tools/benchmarks/paper_table.py --print --output table.csv

The substrates are those of examples/paper.py, with radii from Γ(6, 0.258) µm cut at 2.5 µm: with them the number of fibres in (500 µm)³ is that of
the paper. A row of the CSV file is one substrate; rows that are there already are not made again, so that a run that was stopped goes on. Needs
neither ParaView nor VTK.
"""

import argparse
import csv
import json
import math
import os
import statistics
import subprocess
import sys
import tempfile
import time

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path[:0] = [os.path.join(ROOT, "examples"), os.path.join(ROOT, "tools", "scripts")]
import paper  # noqa: E402
from report_facts import AskedRadii, in_domain, ks_distance, mean_radius  # noqa: E402

RADII = {"GammaShape": 6, "GammaScale": 0.258, "MaximumRadius": 2.5}
SUBSTRATES = [f"dispersion-{angle}" for angle in paper.DISPERSION] + [f"crossing-{angle}" for angle in paper.CROSSING] + ["radii-0.9"]
COLUMNS = ("substrate", "side_um", "voxel_um", "seed", "fibres", "FVF", "smallest_gap_um", "mean_radius_um", "asked_mean_radius_um", "KS_distance", "certified", "seconds")


def recipe(name, side, seed, voxel):
    bundle, growth, myelin = paper.properties(name, side, seed)
    preset = bundle.pop("Preset", None)
    bundle.update(RADII)
    production = {"VoxelSize": voxel, "Format": "Surfaces alone", "Encoding": "Binary", **growth, **myelin}
    return {**({"Preset": preset} if preset else {}), "BundleInitializer": bundle, "SubstrateProduction": production}


def numbers_of(path):
    with open(path, newline="", encoding="utf-8") as file:
        return [{name: float(value) if value else math.nan for name, value in row.items()} for row in csv.DictReader(file)]


def made(name, wanted, seed):
    """The row of one substrate, whose folder is removed again."""
    with tempfile.TemporaryDirectory(prefix="cactus-paper-table-") as scratch:
        path, folder = os.path.join(scratch, "recipe.json"), os.path.join(scratch, "substrate")
        with open(path, "w", encoding="utf-8") as file:
            json.dump(recipe(name, wanted.side, seed, wanted.voxel_size), file)
        begin = time.monotonic()
        done = subprocess.run([wanted.program, path, "--output", folder, "--progress", "0"], stdout=subprocess.DEVNULL)
        if done.returncode not in (0, 3):  # 3: written, and not certified
            sys.exit(f"paper_table: {name} with seed {seed} was not made")
        seconds = time.monotonic() - begin
        with open(os.path.join(folder, "manifest.json"), encoding="utf-8") as file:
            manifest = json.load(file)
        with open(os.path.join(folder, "certificate.csv"), newline="", encoding="utf-8") as file:
            whole = {row["quantity"]: row["value"] for row in csv.DictReader(file)}
        fibres = in_domain(numbers_of(os.path.join(folder, "certificate_fibres.csv")))
    asked = AskedRadii(manifest)
    radii = [fibre["OuterRadius_um"] for fibre in fibres if math.isfinite(fibre["OuterRadius_um"])]
    return {
        "substrate": name, "side_um": f"{wanted.side:g}", "voxel_um": f"{wanted.voxel_size:g}", "seed": str(seed), "fibres": str(manifest["outer_surfaces"]),
        "FVF": f"{float(whole['FVF']):.4f}", "smallest_gap_um": f"{float(whole['SmallestGap_um']):.4f}", "mean_radius_um": f"{mean_radius(fibres, 'OuterRadius_um'):.4f}",
        "asked_mean_radius_um": f"{asked.mean():.4f}", "KS_distance": f"{ks_distance(radii, asked.density):.4f}",
        "certified": "yes" if manifest["certified"] else "no", "seconds": f"{seconds:.0f}",
    }


def spread(rows, column, places):
    values = [float(row[column]) for row in rows]
    return f"{statistics.mean(values):.{places}f}" + (f" ± {statistics.stdev(values):.{places}f}" if len(values) > 1 else "")


def as_table(rows):
    """The rows as a Markdown table: mean and standard deviation over seeds."""
    lines = ["| substrate | side (µm) | seeds | certified | fibres | FVF (%) | mean radius: drawn, reached (µm) | KS distance |", "|---|---|---|---|---|---|---|---|"]
    groups = {}
    for row in rows:
        groups.setdefault((row["substrate"], row["side_um"]), []).append(row)
    for (name, side), group in groups.items():
        in_per_cent = [{**row, "FVF": 100 * float(row["FVF"])} for row in group]
        certified = sum(row["certified"] == "yes" for row in group)
        lines.append(f"| {name} | {side} | {len(group)} | {certified} | {spread(group, 'fibres', 0)} | {spread(in_per_cent, 'FVF', 2)} | "
                     f"{group[0]['asked_mean_radius_um']}, {spread(group, 'mean_radius_um', 3)} | {spread(group, 'KS_distance', 3)} |")
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--program", default=os.path.join(ROOT, "build", "release", "bin", "cactus-grow"), metavar="PATH", help="cactus-grow (default: %(default)s)")
    parser.add_argument("--only", nargs="+", default=SUBSTRATES, choices=SUBSTRATES, metavar="NAME", help="some of " + ", ".join(SUBSTRATES))
    parser.add_argument("--side", type=float, default=100, help="side of the domain, µm (default: %(default)s)")
    parser.add_argument("--voxel-size", type=float, default=0.15, help="µm (default: %(default)s)")
    parser.add_argument("--seeds", type=int, default=1, help="how many substrates of each (default: %(default)s)")
    parser.add_argument("--minutes", type=float, default=math.inf, help="begin no substrate after so many")
    parser.add_argument("--output", default="paper-table.csv", metavar="FILE", help="rows are added to it (default: %(default)s)")
    parser.add_argument("--print", action="store_true", help="make nothing, print the table of what is in the file")
    wanted = parser.parse_args()
    rows = []
    if os.path.exists(wanted.output):
        with open(wanted.output, newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
    begin = time.monotonic()
    known = {(row["substrate"], float(row["side_um"]), int(row["seed"])) for row in rows}
    for seed in () if wanted.print else range(1, wanted.seeds + 1):
        for name in wanted.only:
            if (name, wanted.side, seed) in known or time.monotonic() - begin > 60 * wanted.minutes:
                continue
            rows.append(made(name, wanted, seed))
            with open(wanted.output, "w", newline="", encoding="utf-8") as file:
                sheet = csv.DictWriter(file, COLUMNS)
                sheet.writeheader()
                sheet.writerows(rows)
            print(", ".join(f"{column} {value}" for column, value in rows[-1].items()), flush=True)
    print(as_table(rows))


if __name__ == "__main__":
    main()
