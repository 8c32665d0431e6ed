# SPDX-License-Identifier: BSD-3-Clause
"""Makes a substrate again from its manifest.json, into a new folder, and compares the two bit for bit.

Run it with ./cactus rerun. It ends with 0 where all is the same, with 1 where files differ, and with 2 where the substrate cannot
be made again.
"""

import argparse
import json
import os
import sys

from paraview import simple

from substrate_folder import Refusal, ended, manifest_path, read_manifest, sha256

# What a manifest may name: a manifest may come from anybody, and must not run or write anything else.
WRITERS = ("SubstrateWriter", "SubstrateProduction")
STAGES = ("BundleInitializer", "CurvedBundles", "StrandReader", "TractogramReader", "TractFibres", "CapsuleOptimizer", "FibreRadialGrowth", "MyelinSurface", "SubstrateReader", "Placement", *WRITERS)
# Files with a line that says which version has written them.
NAME_THE_VERSION = (".ply", ".node", ".poly", "setup_substrate.m")
KEPT_NOWHERE = ("CheckpointFile", "Resume", "FolderName")


def arguments():
    parser = argparse.ArgumentParser(prog="./cactus rerun", description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("manifest", help="manifest.json of a substrate folder, or the folder")
    parser.add_argument("--output", metavar="FOLDER", help="folder to write, which must not exist (default: beside the old one, -rerun added)")
    return parser.parse_args()


def named_by(value, path):
    """What a property of this value has named, of which a file was read: that file, or a folder that holds it."""
    name, named = os.path.basename(value.rstrip("/")), path
    while os.path.basename(named) not in ("", name):
        named = os.path.dirname(named)
    return named if os.path.basename(named) else path


class Chain:
    """The stages of a manifest as ParaView has them, the last of which writes the folder `output`."""

    def __init__(self, stages, output):
        self.stages = {stage.get("id"): stage for stage in stages}
        self.last = stages[-1]
        self.output = output
        self.made = {}
        if self.last.get("filter") not in WRITERS:
            raise Refusal(f"the last stage of the provenance is neither {' nor '.join(WRITERS)}")

    def check(self):
        """All that can be known before anything runs."""
        for stage in self.needed():
            name = stage["filter"]
            if name not in STAGES:
                raise Refusal(f"there is no stage {name} that could be run again")
            if not hasattr(simple, name):
                raise Refusal("the plugin is not loaded: run this by ./cactus rerun")
            if stage.get("reached", {}).get("IsResult") is False:
                raise Refusal(f"the substrate was made of a state on {name}'s way (KeepHistory), which is not kept")
            for read in stage.get("files", []):
                self.check_file(name, read)

    @staticmethod
    def check_file(name, read):
        path = read["path"]
        if not os.path.isfile(path):
            raise Refusal(f"{path}, which {name} has read, is missing: put it back there")
        if sha256(path) != read["sha256"]:
            raise Refusal(f"{path}, which {name} has read, is another file than it was (its SHA-256 was {read['sha256']}): put the old one there")

    def needed(self):
        """The stages that the last one comes from, each once, and itself."""
        found = {}

        def visit(stage):
            if stage["id"] not in found:
                found[stage["id"]] = stage
                for name, references in stage.get("inputs", {}).items():
                    for reference in references:
                        look(reference, f"{name} of {stage['filter']}")

        def look(reference, where):
            for part in reference.get("blocks", []):
                look(part, where)
            if "filter" in reference:
                raise Refusal(f"a {reference['filter']} was at work before input {where}, whose values nobody has kept")
            if "blocks" not in reference:
                if reference.get("stage") not in self.stages:
                    raise Refusal(f"where input {where} came from is not known")
                if reference.get("changed"):
                    raise Refusal(f"the data at input {where} were changed after {self.stages[reference['stage']]['filter']} by something that nobody has kept")
                visit(self.stages[reference["stage"]])

        visit(self.last)
        return [stage for stage in self.stages.values() if stage["id"] in found]

    def source(self, reference):
        """What gives the data of a reference."""
        if "blocks" in reference:
            return simple.GroupDatasets(Input=[self.source(part) for part in reference["blocks"]])
        proxy = self.proxy(self.stages[reference["stage"]])
        return simple.OutputPort(proxy, reference.get("port", 0))

    def proxy(self, stage):
        if stage["id"] not in self.made:
            inputs = {}
            for name, references in stage.get("inputs", {}).items():
                sources = [self.source(reference) for reference in references]
                inputs[name] = sources if len(sources) > 1 else sources[0]
            made = getattr(simple, stage["filter"])(**inputs)
            self.set_properties(made, stage)
            self.made[stage["id"]] = made
        return self.made[stage["id"]]

    def set_properties(self, proxy, stage):
        values = dict(stage["properties"])
        if stage["filter"] == "BundleInitializer":
            values.setdefault("Border", "Walls")  # all there was before 0.3.0
        if stage["filter"] in ("BundleInitializer", "TractFibres"):
            values.setdefault("CalibreVariation", 0)
        if stage["filter"] in ("BundleInitializer", "TractFibres", "CurvedBundles"):
            values.setdefault("SectionAxisRatio", 1)
        reached = stage.get("reached", {})
        if reached.get("Ended") in ("TimeBudget", "Stopped"):
            # The clock and the user stop elsewhere the next time.
            values["MaximumIterations"], values["TimeBudget"] = reached["Iterations"], 0
        for read in stage.get("files", []):
            values[read["property"]] = named_by(values.get(read["property"], ""), read["path"])
        names = set(proxy.ListProperties()) - set(KEPT_NOWHERE)
        for name, value in values.items():
            if name not in names:
                raise Refusal(f"{stage['filter']} has no property {name} in this CACTUS")
            if isinstance(value, list) and isinstance(getattr(proxy, name), str):
                value = " ".join(repr(number) for number in value)
            setattr(proxy, name, int(value) if isinstance(value, bool) else value)
        if stage is self.last:
            proxy.FolderName = self.output

    def run(self):
        """Writes the folder. Says which stage is at work."""
        failed = []
        for stage in self.needed():
            proxy = self.proxy(stage)
            print(f"    {stage['filter']}", flush=True)
            algorithm = proxy.GetClientSideObject()
            algorithm.AddObserver("ErrorEvent", lambda *_: failed.append(stage["filter"]))
            proxy.UpdatePipeline()
            if failed:
                raise Refusal(f"{failed[0]} failed, as the error above says")


def first_difference(old, new):
    """What the data that are not as they were came from first, by the checksums of the links between stages."""

    def links(stages):
        found = []
        for stage in stages:
            for name, references in stage.get("inputs", {}).items():
                found += [(stage["filter"], name, reference.get("checksum")) for reference in references]
        return found

    for before, after in zip(links(old), links(new)):
        if before != after:
            return f"input {before[1]} of {before[0]}"
    return None


def compared(manifest, version):
    """The files that have to be the same, by their checksums. What another version says of a substrate may differ."""
    words = ("README.txt", "certificate.csv", "certificate_fibres.csv") if manifest["version"] != version else ()
    return {path: checksum for path, checksum in manifest["sha256"].items() if path not in words}


def compare(manifest, again, folder):
    """How many files there are to compare; those that are not the same to the bit, or in one of the two only; and from which data on."""
    header = None
    if again["version"] != manifest["version"]:
        header = f"CACTUS {again['version']}", f"CACTUS {manifest['version']}"
    wanted = compared(manifest, again["version"])
    different = []
    for path, checksum in sorted(wanted.items()):
        here = os.path.join(folder, path)
        if not os.path.isfile(here) or sha256(here, header if path.endswith(NAME_THE_VERSION) else None) != checksum:
            different.append(path)
    different += sorted(path for path in compared(again, manifest["version"]) if path not in wanted)
    return len(wanted), different, first_difference(manifest["provenance"], again["provenance"])


def rerun(wanted):
    path = manifest_path(wanted.manifest)
    manifest = read_manifest(path)
    output = os.path.abspath(wanted.output or os.path.dirname(os.path.abspath(path)) + "-rerun")
    if os.path.lexists(output):
        raise Refusal(f"{output} is there already: name another folder with --output")
    if not manifest["sha256"]:
        raise Refusal("the manifest lists no files to compare")
    chain = Chain(manifest["provenance"], output)
    chain.check()
    print(f"Making {output}", flush=True)
    chain.run()
    if not os.path.isfile(os.path.join(output, "manifest.json")):
        raise Refusal(f"{chain.last['filter']} has written nothing, as the error above says")
    with open(os.path.join(output, "manifest.json"), encoding="utf-8") as file:
        again = json.load(file)
    count, different, first = compare(manifest, again, output)
    if again["version"] != manifest["version"]:
        print(f"The substrate was made by CACTUS {manifest['version']}, this is {again['version']}: results may differ.")
    if not different:
        print(f"The same to the bit: {count} files.")
        return 0
    print(f"{len(different)} of {count} files differ:")
    for name in different[:20]:
        print(f"    {name}")
    if len(different) > 20:
        print(f"    and {len(different) - 20} more")
    if first:
        print(f"The first data that came out otherwise are those at {first}.")
    return 1


if __name__ == "__main__":
    sys.exit(ended("rerun", lambda: rerun(arguments())))
