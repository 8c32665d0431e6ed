# SPDX-License-Identifier: BSD-3-Clause
# ctest-timeout: 900
# ctest-processors: 2
"""Chains with parameters drawn at random over all that is legal, judged by the mesh oracle and compared with the certificate.

    ./cactus pvpython tests/paraview/TestRandomChains.py [--seed N] [--cases N] [--only INDEX]... [--workers N] [--report FILE]

The seed is a new one each run, unless CACTUS_CHAINS_SEED or --seed says which; it is printed, and a chain that fails prints the script
that repeats it. Each chain ends in surfaces that are what the certificate says, or in one clear error:

- certified: the oracle finds nothing, on the files that a simulator is given, and the gap holds;
- the oracle finds a fault: the certificate counts it, and a warning has said so;
- Flawed in MyelinSurface's table is 1 exactly for fibres in which the certificate, too, finds a fault;
- fibres without a surface or an axon are told of.
"""

import argparse
import contextlib
import csv
import math
import os
import random
import re
import shutil
import sys
import tempfile
import time

from cactus_testing import LEAVING
from torture import pool


# Drawing -------------------------------------------------------------------------------------------------------------------------


class Draw:
    """Random parameters; everything is drawn in the same order whatever comes out, and rounded so that it prints well."""

    def __init__(self, seed):
        self.random = random.Random(seed)

    @staticmethod
    def rounded(value):
        return float(f"{value:.6g}")

    def uniform(self, low, high):
        return self.rounded(self.random.uniform(low, high))

    def log(self, low, high):
        return self.rounded(math.exp(self.random.uniform(math.log(low), math.log(high))))

    def choice(self, *options):
        return self.random.choice(options)

    def whole(self, low, high):
        return self.random.randint(low, high)

    def seldom(self, share, value, otherwise):
        """`value` in one of 1 / share cases."""
        return value if self.random.random() < share else otherwise


def parameters(seed, index):
    """{stage: {property: value}} of one chain."""
    draw = Draw(f"{seed}/{index}")
    mean = draw.log(0.25, 0.9)
    side = draw.seldom(0.1, draw.log(1.5, 12), draw.log(3, 8))
    side = max(side, 5 * mean)
    shape = draw.log(1, 12)
    least = draw.seldom(0.1, mean, draw.log(0.1, mean))
    most = draw.seldom(0.1, least, draw.log(max(least, mean), max(2 * mean, side / 4)))
    spacing = draw.log(0.2, 1.5)
    fraction = draw.seldom(0.1, draw.uniform(0.02, 0.85), draw.uniform(0.3, 0.65))
    bundle = {
        "Side": side,
        "FibreVolumeFraction": fraction,
        "GrownFibreVolumeFraction": draw.seldom(0.5, 0.0, draw.uniform(fraction, 0.97)),
        "Margin": draw.seldom(0.7, 0.0, draw.log(0.05, 2)),
        "RadiusDistribution": draw.choice("Gamma", "Lognormal", "Table"),
        "GammaShape": shape,
        "GammaScale": Draw.rounded(mean / shape),
        "LognormalMean": mean,
        "LognormalDeviation": Draw.rounded(mean * draw.log(0.05, 1)),
        "RadiusTable": " ".join(str(min(max(draw.log(least, most), least), most)) for _ in range(draw.whole(1, 6))),
        "MinimumRadius": least,
        "MaximumRadius": most,
        "MeanDispersion": draw.seldom(0.15, 0.0, draw.uniform(0, draw.seldom(0.1, 45, 25))),
        "DispersionModel": draw.choice("Watson", "Cone", "Coherent"),
        "CorrelationLength": draw.seldom(0.6, 0.0, draw.log(0.5, 50)),
        "NumberOfBundles": draw.seldom(0.3, 2, 1),
        "CrossingAngle": draw.uniform(0, 90),
        "CrossingStyle": draw.choice("Interwoven", "Sheets"),
        "SheetThickness": draw.seldom(0.6, 0.0, draw.log(0.3, side)),
        "SpacingFactor": draw.log(0.4, 4),
        "MinimumSpacing": spacing,
        "MaximumSpacing": Draw.rounded(spacing * draw.log(1, 6)),
        "Seed": draw.whole(0, 2**31 - 1),
    }
    place = Draw(f"{seed}/{index}/place")
    bundle["Border"] = place.choice("Cut", "Walls")
    bundle["Length"] = place.seldom(0.7, 0.0, place.log(0.5 * side, 1.5 * side))
    if bundle["Border"] == "Cut":
        bundle["Direction"] = place.seldom(0.5, [0, 0, 1], [place.uniform(-1, 1) for _ in range(3)])
        bundle["Mixing"] = place.choice("Interpenetrating", "Layers")
        bundle["CorrelationLength"] = bundle["CorrelationLength"] or 8
        if place.seldom(0.2, True, False):
            bundle.update(DispersionModel=place.choice("Harmonics", "Peaks"), NumberOfBundles=1, OrientationHarmonics=f"1 0 0 {place.uniform(-0.5, 2)} 0 0",
                          OrientationPeaks=f"0 0 0.5 {place.uniform(-1, 1)} 0.3 0")
    bundle["GRatio"] = place.seldom(0.7, 0.0, place.uniform(0.3, 0.9))
    bundle["SectionAxisRatio"] = place.seldom(0.4, 1.0, place.uniform(0.7, 1))
    adagrad = draw.seldom(0.15, True, False)
    optimiser = {
        "MaximumIterations": draw.seldom(0.25, draw.whole(0, 300), 1500),
        "OverlapTolerance": draw.log(1e-4, 0.1),
        "Method": "Adagrad" if adagrad else "Momentum",
        "OverlapWeight": draw.log(0.2, 5),
        "CurvatureWeight": draw.seldom(0.1, 0.0, draw.log(1, 100)),
        "LengthWeight": draw.seldom(0.1, 0.0, draw.log(1, 100)),
        "RadiusWeight": draw.log(0.1, 10),
        "CompactnessWeight": draw.seldom(0.1, 0.0, draw.log(0.2, 20)),
        "StepSize": draw.log(0.005, 0.05) if adagrad else draw.seldom(0.1, draw.log(0.01, 10), draw.uniform(1, 1.9)),
        "Relaxation": draw.uniform(0.9, 1) if draw.whole(0, 3) else draw.uniform(0.5, 1),
        "PackingLimit": draw.uniform(0.3, 1),
        "RadiusTolerance": draw.seldom(0.6, 0.0, draw.uniform(0, 0.5)),
        "TrimToDomain": draw.seldom(0.2, 0, 1),
        "KeepHistory": draw.seldom(0.2, 1, 0),
        "HistoryInterval": draw.whole(1, 50),
        "NumberOfThreads": draw.whole(0, 3),
    }
    voxel = Draw.rounded(side / draw.log(12, 55))
    tolerance = draw.seldom(0.1, 0.0, draw.log(1e-3, 0.05))
    gap = draw.seldom(0.15, 0.0, draw.log(1e-3, draw.seldom(0.2, 0.3, 0.05)))
    growth = {
        "VoxelSize": voxel,
        "TargetFibreVolumeFraction": draw.seldom(0.3, -1.0, draw.seldom(0.4, 0.0, draw.uniform(0.3, draw.seldom(0.3, 0.95, 0.85)))),
        "GrowthIterations": draw.whole(0, 8),
        "MinimumGap": gap,
        "SurfaceTolerance": tolerance,
        "SurfaceRoughness": draw.seldom(0.2, 0.0, draw.uniform(0, 0.5)),
        "SeedDensity": draw.seldom(0.85, 0.0, draw.log(0.5, 50)),
        "Margin": draw.seldom(0.7, 0.0, draw.log(0.02, 1)),
        "Seed": draw.whole(0, 2**31 - 1),
        "NumberOfThreads": draw.whole(0, 3),
    }
    target = growth["TargetFibreVolumeFraction"]
    fraction = (bundle["GrownFibreVolumeFraction"] if target < 0 else target) or 0.5
    myelin = {
        "GRatioModel": draw.choice("Constant", "LogLinear", "Distributed", "TargetAxonVolumeFraction"),
        "GRatio": draw.seldom(0.15, draw.uniform(0.05, 0.99), draw.uniform(0.4, 0.9)),
        "GRatioDeviation": draw.uniform(0, 0.3),
        "TargetAxonVolumeFraction": Draw.rounded(fraction * draw.uniform(0.1, 0.7)),
        "SmoothingIterations": draw.seldom(0.1, draw.whole(0, 21), draw.whole(0, 5)),
        "DecimationError": draw.seldom(0.15, 0.0, Draw.rounded(tolerance * draw.log(0.1, draw.seldom(0.05, 2, 1)))),
        "ClipToDomain": draw.seldom(0.2, 0, 1),
        "Seed": draw.whole(0, 2**31 - 1),
        "ReleaseInput": draw.seldom(0.2, 1, 0),
        "NumberOfThreads": draw.whole(0, 3),
    }
    cuts = draw.log(0.05, 5)
    return {
        "BundleInitializer": bundle,
        "CapsuleOptimizer": optimiser,
        "FibreRadialGrowth": growth,
        "MyelinSurface": myelin,
        "SubstrateStatistics": {"CutSpacing": cuts, "NumberOfBins": draw.whole(1, 60)},
        "SubstrateCertificate": {"MinimumGap": gap, "CutSpacing": cuts},
        "SubstrateWriter": {"MinimumGap": gap, "AllowOpenSurfaces": 1},
    }


def script(drawn):
    """A script that repeats the chain."""
    inputs = {
        "CapsuleOptimizer": "Input=bundle",
        "FibreRadialGrowth": "Input=OutputPort(fibres, 0)",
        "MyelinSurface": "Input=grown",
        "SubstrateStatistics": "Fibres=OutputPort(fibres, 0), Outer=OutputPort(surfaces, 0), Inner=OutputPort(surfaces, 1)",
        "SubstrateCertificate": "Fibres=OutputPort(fibres, 0), Outer=OutputPort(surfaces, 0), Inner=OutputPort(surfaces, 1)",
        "SubstrateWriter": 'Fibres=OutputPort(fibres, 0), Outer=OutputPort(surfaces, 0), Inner=OutputPort(surfaces, 1), FolderName="substrate"',
    }
    names = ("bundle", "fibres", "grown", "surfaces", "statistics", "certificate", "written")
    lines = ["from paraview.simple import *"]
    for name, (stage, properties) in zip(names, drawn.items()):
        words = ([inputs[stage]] if stage in inputs else []) + [f"{one}={value!r}" for one, value in properties.items()]
        lines.append(f"{name} = {stage}({', '.join(words)})")
    return "\n".join(lines + [f"{name}.UpdatePipeline()" for name in names])


# Judging -------------------------------------------------------------------------------------------------------------------------


def table(data):
    names = [data.GetColumnName(column) for column in range(data.GetNumberOfColumns())]
    return [{name: data.GetValueByName(row, name).ToDouble() for name in names} for row in range(data.GetNumberOfRows())]


def fibre_of(path):
    return int(os.path.basename(path).split("_")[1].split(".")[0])


def judged_fibres(judged, gap):
    """{fibre: faults} that the oracle finds."""
    faults = {}

    def add(path, what):
        faults.setdefault(fibre_of(path), []).append(f"{path} {what}")

    for mesh in judged["meshes"]:
        for quality in ("closed", "manifold", "outward"):
            if not mesh[quality]:
                add(mesh["file"], f"is not {quality}")
        if mesh["self_intersecting"]:
            add(mesh["file"], "meets itself")
    held = set()
    for pair in judged["pairs"]:
        kinds = (pair["a"].split("/")[0], pair["b"].split("/")[0])
        if kinds == ("inner", "outer") and fibre_of(pair["a"]) == fibre_of(pair["b"]):
            if pair["relation"] == "a_in_b":
                held.add(fibre_of(pair["a"]))
        elif kinds == ("outer", "outer") and (pair["relation"] != "near" or pair["distance"] < gap * (1 - 1e-9)):
            for one in (pair["a"], pair["b"]):
                add(one, f"{pair['relation']} {pair['a']} {pair['b']} {pair['distance']}")
    for mesh in judged["meshes"]:
        if mesh["file"].startswith("inner/") and fibre_of(mesh["file"]) not in held:
            add(mesh["file"], "does not lie inside its outer surface")
    return faults


class Chains:
    """Runs chains by name, chain/SEED/INDEX."""

    def __init__(self):
        from torture.answers import Reports

        self.reports = Reports()
        self.folder = tempfile.mkdtemp(prefix="cactus-chains-")
        self.note = ""

    def close(self):
        shutil.rmtree(self.folder, ignore_errors=True)

    def forget(self):
        pass

    def run(self, name):
        from paraview import simple

        _, seed, index = name.split("/")
        self.note = ""
        drawn = parameters(seed, index)
        made = []
        folder = os.path.join(tempfile.mkdtemp(dir=self.folder), "substrate")
        try:
            faults = self._run(drawn, made, folder)
        finally:
            for proxy in reversed(made):
                simple.Delete(proxy)
            shutil.rmtree(os.path.dirname(folder), ignore_errors=True)
        return faults + ["to repeat it:\n" + script(drawn)] if faults else []

    def _run(self, drawn, made, folder):
        from paraview import simple

        warnings = {}

        def stage(name, **inputs):
            """The updated proxy, and what it warned; None after an error."""
            made.append(getattr(simple, name)(**inputs, **drawn[name]))
            made[-1].UpdatePipeline()
            errors, warnings[name] = self.reports.take()
            if errors:
                raise (Unclipped if name == "SubstrateStatistics" and "ClipToDomain" in errors[0] else Refused)(name, errors)
            return made[-1]

        try:
            bundle = stage("BundleInitializer")
            fibres = simple.OutputPort(stage("CapsuleOptimizer", Input=bundle), 0)
            grown = stage("FibreRadialGrowth", Input=fibres)
            outside = self._outside(grown)
            surfaces = stage("MyelinSurface", Input=grown)
            outer, inner = simple.OutputPort(surfaces, 0), simple.OutputPort(surfaces, 1)
            with contextlib.suppress(Unclipped):
                stage("SubstrateStatistics", Fibres=fibres, Outer=outer, Inner=inner)
            certificate = stage("SubstrateCertificate", Fibres=fibres, Outer=outer, Inner=inner)
            stage("SubstrateWriter", Fibres=fibres, Outer=outer, Inner=inner, FolderName=folder)
        except Refused as refused:
            return self._refused(refused)
        return self._compare(drawn, surfaces, outside, certificate, warnings, folder)

    def _refused(self, refused):
        from torture.answers import CPLUSPLUS, PIPELINE

        self.note = f"refused by {refused.stage}: {refused.errors[0]}"
        faults = []
        if len(refused.errors) != 1:
            faults.append(f"{refused.stage} gives {len(refused.errors)} errors for one fault: " + " | ".join(refused.errors))
        if any(CPLUSPLUS.search(text) or PIPELINE.search(text) for text in refused.errors):
            faults.append(f"{refused.stage} does not say it in a user's words: " + " | ".join(refused.errors))
        if "report this" in refused.errors[0]:
            faults.append(f"{refused.stage} calls it a fault of its own: {refused.errors[0]}")
        return faults

    def _compare(self, drawn, surfaces, outside, certificate, warnings, folder):
        from cactus_testing import fetch, mesh_oracle

        gap = drawn["FibreRadialGrowth"]["MinimumGap"]
        made = table(fetch(surfaces, 2))
        whole, fibres = table(fetch(certificate, 0))[0], table(fetch(certificate, 1))
        with open(os.path.join(folder, "certificate.csv"), newline="") as file:
            written = dict(list(csv.reader(file))[1:])
        certified = bool(whole["Certified"])
        found = judged_fibres(mesh_oracle(folder, *(("--gap", repr(gap)) if gap > 0 else ())), gap)
        flawed = {int(row["FibreId"]) for row in made if row["Flawed"]}
        self.note = f"{len(fibres)} fibres, {'certified' if certified else 'not certified'}, FVF {whole['FVF']:.3f}, {len(flawed)} flawed, {len(found)} with faults"

        faults = []
        if bool(float(written["Certified"])) != certified:
            faults.append(f"the filter certifies {certified}, the folder {written['Certified']}")
        if certified and found:
            faults.append(f"certified, but the oracle finds {found}")
        if not certified and not found and not whole["WithoutOuter"]:  # what is not there the oracle does not miss
            faults.append(f"not certified, but the oracle finds nothing: {warnings['SubstrateCertificate']}")
        for name in ("SubstrateCertificate", "SubstrateWriter"):
            # That fractions cannot be given, or that walkers leave so small a substrate, is a remark, and no part of the verdict.
            verdict = [warning for warning in warnings[name] if not warning.startswith("surfaces reach") and not re.search(LEAVING, warning)]
            if bool(verdict) == certified:
                faults.append(f"{name} is certified: {certified}, and warns {warnings[name]}")
        blamed = {int(row["FibreId"]) for row in fibres if self._is_faulty(row, gap)}
        if blamed != set(found):
            faults.append(f"the certificate blames fibres {sorted(blamed)}, the oracle {found}")
        if flawed != blamed:
            faults.append(f"Flawed are {sorted(flawed)}, the certificate blames {sorted(blamed)}")
        return faults + self._told(made, fibres, gap, flawed, outside, warnings["MyelinSurface"])

    @staticmethod
    def _outside(grown):
        """Fibres that do not run through the domain, of which no surface is wanted."""
        data = grown.GetClientSideObject().GetOutputDataObject(0).GetFieldData()
        ids, lengths = data.GetArray("FibreTable.FibreId"), data.GetArray("FibreTable.LengthInDomain")
        return {ids.GetTuple1(i) for i in range(ids.GetNumberOfTuples()) if lengths.GetTuple1(i) <= 0}

    @staticmethod
    def _is_faulty(row, gap):
        """Whether a row of the certificate's fibres names a fault of surfaces that are there."""
        return (
            (row["HasOuter"] and not row["OuterSound"])
            or (row["InnerTriangles"] > 0 and not row["InnerSound"])
            or row["OuterSelfIntersections"] > 0
            or row["InnerSelfIntersections"] > 0
            or row["SelfNested"] > 0
            or row["MeetingFibres"] > 0
            or row["InnerLeaves"] > 0
            or row["SmallestGap_um"] < gap
        )

    @staticmethod
    def _told(made, fibres, gap, flawed, outside, warnings):
        """Faults of what MyelinSurface says of its surfaces."""
        faults = []
        if len(warnings) > 1:
            faults.append("MyelinSurface warns more than once: " + " | ".join(warnings))
        certified = {int(row["FibreId"]) for row in fibres if row["HasOuter"]}
        listed = {int(row["FibreId"]) for row in made if row["Myelin"] != 4}
        if certified != listed:
            faults.append(f"surfaces of {sorted(certified)}, but the table lists {sorted(listed)}")
        lacking = [int(row["FibreId"]) for row in made if row["Myelin"] >= 3 and int(row["FibreId"]) not in outside]
        if (flawed or lacking) and not warnings:
            faults.append(f"flawed {sorted(flawed)}, without axon or fibre {lacking}, and not a word")
        thin = [row["FibreId"] for row in fibres if row["SmallestMyelin_um"] < gap * (1 - 1e-6)]
        if thin and not warnings:
            faults.append(f"myelin thinner than MinimumGap {gap} in fibres {thin}, and not a word")
        return faults


class Refused(Exception):
    def __init__(self, stage, errors):
        super().__init__(errors[0])
        self.stage, self.errors = stage, errors


class Unclipped(Refused):
    """What reaches out of the domain has no fractions: the statistics say so, and the chain goes on."""


def parse(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seed", default=os.environ.get("CACTUS_CHAINS_SEED") or str(int(time.time())))
    parser.add_argument("--cases", type=int, default=14)
    parser.add_argument("--only", action="append", default=[], metavar="INDEX")
    parser.add_argument("--workers", type=int, default=min(4, len(os.sched_getaffinity(0))))
    parser.add_argument("--seconds", type=float, default=150.0, help="that a chain may take")
    parser.add_argument("--report", help="file to which every chain is written as it ends")
    parser.add_argument("--worker", type=int, help=argparse.SUPPRESS)
    return parser.parse_args(arguments)


def main():
    options = parse(sys.argv[1:])
    if options.worker is not None:
        pool.work(options.worker, Chains)
        return 0
    print(f"seed {options.seed} (CACTUS_CHAINS_SEED={options.seed} repeats it)", flush=True)
    indices = options.only or [str(index) for index in range(options.cases)]
    file = open(options.report, "w") if options.report else None
    notes = []

    def report(name, faults, seconds, note):
        notes.append(note)
        line = f"{'FAILED' if faults else 'ok    '} {name} {seconds:5.1f} s  {note}"
        print(line, flush=True)
        for fault in faults:
            print("       " + fault.replace("\n", "\n       "), flush=True)
        if file:
            print(line, *faults, sep="\n", file=file, flush=True)

    names = [f"chain/{options.seed}/{index}" for index in indices]
    begin = time.monotonic()
    results = pool.run(os.path.abspath(__file__), names, options.seconds, options.workers, report)
    judged = sum(" certified" in note for note in notes)
    failed = [name for name, (faults, _) in results.items() if faults]
    print(f"{len(results)} chains in {time.monotonic() - begin:.0f} s, {judged} of them judged by the oracle, {len(failed)} failed: {' '.join(failed)}")
    return 1 if failed or not results else 0


if __name__ == "__main__":
    sys.exit(main())
