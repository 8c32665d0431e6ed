# SPDX-License-Identifier: BSD-3-Clause
"""What a substrate folder says of itself: its manifest, and whether its files are still as they were written."""

import csv
import hashlib
import json
import math
import os
import re
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


class Refusal(Exception):
    """Why a script cannot do what it was asked for, and what to do."""


def ended(name, run):
    """The exit status of the script `name`, whose work is `run`: 2, and one line of why, where it refuses or cannot make out the folder."""
    try:
        return run()
    except Refusal as refusal:
        print(f"{name}: {refusal}", file=sys.stderr)
    except (KeyError, TypeError, AttributeError, ValueError, ArithmeticError) as error:
        print(f"{name}: the manifest or a table is damaged ({error!r})", file=sys.stderr)
    return 2


def sha256(path, header=None):
    """Of a file, with `header` = (here, there): what its first line of comment calls the version."""
    with open(path, "rb") as file:
        content = file.read()
    if header:
        content = content.replace(header[0].encode(), header[1].encode(), 1)
    return hashlib.sha256(content).hexdigest()


def manifest_path(name):
    """Of a folder, or of a manifest itself."""
    return os.path.join(name, "manifest.json") if os.path.isdir(name) else name


def read_manifest(path):
    try:
        with open(path, encoding="utf-8") as file:
            manifest = json.load(file)
    except OSError as error:
        raise Refusal(f"cannot read {path}: {error.strerror}") from error
    except ValueError as error:
        raise Refusal(f"{path} is no JSON: {error}") from error
    if not isinstance(manifest, dict) or manifest.get("format") != "CACTUS substrate folder":
        raise Refusal(f"{path} is no manifest of a substrate")
    stages = manifest.get("provenance")
    if not isinstance(stages, list) or not stages or not isinstance(manifest.get("sha256"), dict):
        raise Refusal(f"{path} does not say how the substrate was made, or what its files were")
    if not all(isinstance(stage, dict) for stage in stages):
        raise Refusal(f"{path} says how the substrate was made in words only, as those of CACTUS before 0.2.0 do: run the stages by hand with these values")
    outside = [name for name in manifest["sha256"] if os.path.isabs(name) or ".." in name.split("/")]
    if outside:
        raise Refusal(f"{path} names a file that is not in its folder: {outside[0]}")
    return manifest


def changed_files(folder, manifest):
    """Those that are not as they were written, or are gone, by their paths in the folder."""
    changed = []
    for path, checksum in sorted(manifest["sha256"].items()):
        here = os.path.join(folder, path)
        if not os.path.isfile(here) or sha256(here) != checksum:
            changed.append(path)
    return changed


def is_as_written(manifest_file):
    """Whether a manifest is as it was written, by its own checksum, which is taken with zeros in its place."""
    with open(manifest_file, "rb") as file:
        content = file.read()
    found = re.search(rb'"manifest_sha256": *"([0-9a-f]{64})"', content)
    return found is not None and hashlib.sha256(content[: found.start(1)] + 64 * b"0" + content[found.end(1) :]).hexdigest().encode() == found.group(1)


def citation():
    """What CITATION.cff prefers: in words, as a link, and its DOI alone."""
    with open(os.path.join(ROOT, "CITATION.cff"), encoding="utf-8") as file:
        preferred = file.read().split("preferred-citation:", 1)[1]

    def one(name):
        return re.search(rf'\b{name}: "?([^"\n]+)', preferred).group(1)

    authors = ", ".join(re.findall(r'family-names: "([^"]+)"', preferred))
    return {"words": f"{authors} ({one('year')}): {one('title')}. {one('journal')} {one('volume')}:{one('start')}.", "link": f"https://doi.org/{one('doi')}", "doi": one("doi")}


def number(text):
    try:
        return float(text)
    except ValueError:
        return math.nan


def read_table(path):
    """A table as a list of dictionaries of texts."""
    try:
        with open(path, encoding="utf-8", newline="") as file:
            return list(csv.DictReader(file))
    except (OSError, csv.Error) as error:
        raise Refusal(f"cannot read {path}: {error}") from error


def read_rows(path):
    """A table of numbers, with a dictionary for each row."""
    return [{name: number(value) for name, value in row.items()} for row in read_table(path)]


def read_quantities(path):
    """A table of the columns quantity and value, as one dictionary of numbers."""
    return {row["quantity"]: number(row["value"]) for row in read_table(path)}
