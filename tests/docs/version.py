# SPDX-License-Identifier: BSD-3-Clause
"""version.py VERSION: every file that names the version of CACTUS names this one, and the changelog has a section for it."""

import os
import re
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
# Where it stands, and in which words.
PLACES = {
    "CITATION.cff": r"^version: (\S+)$",
    "tools/packaging/conda/meta.yaml": r'set version = "([^"]+)"',
    "tools/packaging/spack/cactus-grow/package.py": r'version\("([^"]+)"\)',
    ".github/ISSUE_TEMPLATE/fault.yml": r"placeholder: CACTUS (\d+\.\d+\.\d+)",
    "CHANGELOG.md": r"^## \[(\d+\.\d+\.\d+)\] - \d{4}-\d{2}-\d{2}$",
}


def text_of(path):
    with open(os.path.join(ROOT, path), encoding="utf-8") as file:
        return file.read()


def main(version):
    faults = []
    for path, pattern in PLACES.items():
        found = re.search(pattern, text_of(path), re.MULTILINE)
        if found is None or found.group(1) != version:
            faults.append(f"{path} has {found.group(1) if found else 'no version'} instead of {version}")
    released = re.search(r"^date-released: (\S+)$", text_of("CITATION.cff"), re.MULTILINE).group(1)
    if f"## [{version}] - {released}" not in text_of("CHANGELOG.md"):
        faults.append(f"CITATION.cff says {released}, CHANGELOG.md another day")
    print("\n".join(faults) or f"{version}, of {released}")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
