# SPDX-License-Identifier: BSD-3-Clause
"""Makes the reference substrates, all or those named, and compares what they give with checksums.txt.

    python3 examples/reference/make.py [NAME...] [--output FOLDER] [--write]

Each takes about a minute of one core. It ends with 0 where all are as checksums.txt has them, and with 1 where one is not; with --write it writes
that file instead, for all that it has made.
"""

import argparse
import csv
import glob
import hashlib
import json
import os
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
LAUNCHER = os.path.join(HERE, "..", "..", "cactus")
TABLE = os.path.join(HERE, "checksums.txt")
COLUMNS = ("name", "fibres", "FVF", "AVF", "certified", "surfaces_sha256")
REMARK = """# What the recipes beside this file give, made by make.py. surfaces_sha256 is the SHA-256 of all surface files, one after the other in the order
# of manifest.json, each without its line of comment, which names the version of CACTUS.
"""


def names():
    return sorted(os.path.basename(path)[: -len(".json")] for path in glob.glob(os.path.join(HERE, "*.json")))


def surfaces_checksum(folder, manifest):
    checksum = hashlib.sha256()
    for entry in manifest["files"]:
        with open(os.path.join(folder, entry["path"]), "rb") as file:
            for line in file:
                if not line.startswith(b"comment "):
                    checksum.update(line)
    return checksum.hexdigest()


def made(folder):
    """What a substrate is, as a row of the table."""
    with open(os.path.join(folder, "manifest.json"), encoding="utf-8") as file:
        manifest = json.load(file)
    with open(os.path.join(folder, "certificate.csv"), newline="", encoding="utf-8") as file:
        certificate = {row["quantity"]: row["value"] for row in csv.DictReader(file)}
    return {"fibres": str(manifest["outer_surfaces"]), "FVF": f"{float(certificate['FVF']):.4f}", "AVF": f"{float(certificate['AVF']):.4f}",
            "certified": "yes" if manifest["certified"] else "no", "surfaces_sha256": surfaces_checksum(folder, manifest)}


def read_table():
    if not os.path.exists(TABLE):
        return {}
    with open(TABLE, encoding="utf-8") as file:
        rows = [line.split() for line in file if not line.startswith("#")]
    return {row[0]: dict(zip(rows[0][1:], row[1:])) for row in rows[1:]}


def write_table(rows):
    with open(TABLE, "w", encoding="utf-8") as file:
        file.write(REMARK)
        file.writelines(" ".join(row) + "\n" for row in [COLUMNS, *([name, *(rows[name][column] for column in COLUMNS[1:])] for name in sorted(rows))])


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("names", nargs="*", metavar="NAME", help="; ".join(names()))
    parser.add_argument("--output", default="cactus-reference", metavar="FOLDER", help="where the substrates' folders go (default: %(default)s)")
    parser.add_argument("--program", metavar="PATH", help="a cactus-grow that is built already (default: ./cactus grow)")
    parser.add_argument("--write", action="store_true", help="write checksums.txt")
    wanted = parser.parse_args()
    unknown = sorted(set(wanted.names) - set(names()))
    if unknown:
        parser.error(f"there is no {unknown[0]}: {', '.join(names())}")
    os.makedirs(wanted.output, exist_ok=True)
    known, different = read_table(), []
    for name in wanted.names or names():
        folder = os.path.join(wanted.output, name)
        command = [wanted.program] if wanted.program else [LAUNCHER, "grow"]
        status = subprocess.run([*command, os.path.join(HERE, name + ".json"), "--output", folder]).returncode
        if status not in (0, 3):  # 3: written, and not certified
            sys.exit(f"make: {name} was not made")
        row = made(folder)
        if not wanted.write and row != known.get(name):
            different.append(name)
            print(f"{name}: {row}, and checksums.txt has {known.get(name)}")
        known[name] = row
    if wanted.write:
        write_table(known)
    elif not different:
        print("All are as checksums.txt has them.")
    return 1 if different else 0


if __name__ == "__main__":
    sys.exit(main())
