# SPDX-License-Identifier: BSD-3-Clause
"""The picture of docs/architecture.md: which folder includes files of which other, as the sources say.

    python3 tools/scripts/architecture_picture.py            writes docs/images/architecture.svg
    python3 tools/scripts/architecture_picture.py --check    says whether the picture is as it would be written, and writes nothing
"""

import os
import pathlib
import re
import sys

ROOT = pathlib.Path(os.path.abspath(__file__)).parents[2]
PICTURE = ROOT / "docs" / "images" / "architecture.svg"
INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*"([^"]+)"', re.MULTILINE)
# From top to bottom; each uses what is below it.
FOLDERS = {
    "Plugin": "the plugin, its views, its part of the window",
    "Filters": "a thin VTK class for each stage",
    "core/program": "the command cactus-grow",
    "core/recipe": "recipes and manifests, run without ParaView",
    "core/stages": "what users are asked for at each stage",
    "core/io": "strands, tractograms, folders for simulators",
    "core/judge": "certificate, statistics, sampling",
    "core/surface": "each fibre's outer and inner surface",
    "core/mesh": "triangles: contour, checks, coarsening",
    "core/growth": "growth in the space between the fibres",
    "core/optimiser": "fibres bend until none overlaps",
    "core/bundle": "where fibres start",
    "core/fibres": "fibres, and what is measured on them",
    "core/base": "threads, files, numbers, properties",
}
LEFT, TOP, WIDTH, HEIGHT, STEP = 20, 16, 470, 32, 44


def folder_of(path):
    """The folder of FOLDERS that a file is in."""
    return next((folder for folder in FOLDERS if path.startswith(folder + "/")), None)


def uses():
    """Each folder with the folders whose headers it includes."""
    headers = {}  # where a header is that another folder names without a folder
    sources = [path for path in sorted(ROOT.rglob("*")) if path.suffix in (".h", ".cpp", ".cxx")]
    sources = [(path, folder_of(path.relative_to(ROOT).as_posix())) for path in sources]
    for path, folder in sources:
        if folder in ("Filters", "Plugin"):
            headers[path.name] = folder
    found = {folder: set() for folder in FOLDERS}
    for path, folder in sources:
        for include in INCLUDE.findall(path.read_text(encoding="utf-8")) if folder else ():
            found[folder].add(folder_of("core/" + include) or headers.get(include) or folder)
    return {folder: used - {folder} for folder, used in found.items()}


def reached(used, folder):
    """All that a folder uses, also by way of others."""
    return used[folder].union(*(reached(used, other) for other in used[folder]))


def picture():
    names = list(FOLDERS)
    used_by = uses()
    # An arrow that follows from others is left out.
    direct = {name: {other for other in used if not any(other in reached(used_by, way) for way in used - {other})} for name, used in used_by.items()}
    middle = {name: TOP + STEP * i + HEIGHT / 2 for i, name in enumerate(names)}
    lines = []
    for place, (name, used) in enumerate(direct.items()):
        below = [other for other in used if names.index(other) > place + 1]
        if name != names[-1] and names[place + 1] in used:
            lines.append(f'<path d="M{LEFT + 40} {middle[name] + HEIGHT / 2} V{middle[names[place + 1]] - HEIGHT / 2 - 5}" marker-end="url(#tip)"/>')
        for other in sorted(below, key=names.index):
            bend = LEFT + WIDTH + 22 * (names.index(other) - place)
            lines.append(f'<path d="M{LEFT + WIDTH} {middle[name] + 4} C{bend} {middle[name] + 4} {bend} {middle[other] - 6} {LEFT + WIDTH + 6} {middle[other] - 6}" marker-end="url(#tip)"/>')
    boxes = [f'<rect x="{LEFT}" y="{middle[name] - HEIGHT / 2}" width="{WIDTH}" height="{HEIGHT}" rx="4" fill="{"#e8eef7" if name.startswith("core/") else "#f7eee0"}"/>'
             f'<text x="{LEFT + 12}" y="{middle[name] + 5}"><tspan font-weight="bold">{name}</tspan>: {meaning}</text>' for name, meaning in FOLDERS.items()]
    width, height = LEFT + WIDTH + 250, TOP + STEP * len(names)
    return "\n".join([
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" viewBox="0 0 {width} {height}" font-family="sans-serif" font-size="14">',
        '<defs><marker id="tip" viewBox="0 0 8 8" refX="7" refY="4" markerWidth="7" markerHeight="7" orient="auto"><path d="M0 0 L8 4 L0 8 z" fill="#778"/></marker></defs>',
        f'<rect width="{width}" height="{height}" fill="white"/>', '<g stroke="#778" fill="none" stroke-opacity="0.6">', *lines, "</g>", *boxes, "</svg>", ""])


def main():
    wanted = picture()
    if "--check" in sys.argv[1:]:
        if not PICTURE.exists() or PICTURE.read_text(encoding="utf-8") != wanted:
            sys.exit("docs/images/architecture.svg is not what the sources say: python3 tools/scripts/architecture_picture.py")
        return
    PICTURE.write_text(wanted, encoding="utf-8")


if __name__ == "__main__":
    main()
