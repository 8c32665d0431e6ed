# SPDX-License-Identifier: BSD-3-Clause
"""Makes a page of documentation for every reader, source, filter and writer, out of xml/*.xml and docs/properties.md.

    python3 tools/scripts/filter_pages.py            writes docs/filters/NAME.md
    python3 tools/scripts/filter_pages.py --check    says which pages are not as they would be written, and writes nothing
    python3 tools/scripts/filter_pages.py --window FOLDER    adds pictures and outputs to ParaView's own help pages in FOLDER, as the build does

The part of a page between two marks is written by hand, and stays as it is.
"""

import argparse
import collections
import glob
import html
import os
import re
import shutil
import sys
import xml.etree.ElementTree as ElementTree

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
PAGES = os.path.join(ROOT, "docs", "filters")
PICTURES = os.path.join(ROOT, "docs", "images", "filters")
BEGIN, END = "<!-- by hand -->\n", "<!-- made from xml/ by tools/scripts/filter_pages.py -->\n"

LARGEST_PICTURE = 150_000  # bytes

KINDS = {
    "fibres": "fibres: polylines with point data `Radius`",
    "lines": "polylines",
    "streamlines": "fibres, or streamlines of a tractogram",
    "labels": "the label image of FibreRadialGrowth",
    "surfaces": "surfaces: triangles with cell data `FibreId`",
}
TYPES = {"vtkPolyData": "polygons or lines", "vtkPointSet": "points with cells", "vtkImageData": "an image", "vtkTable": "a table"}
PLACES = {"points": "point data", "cells": "cell data", "field": "field data", "rows": "column"}

Array = collections.namedtuple("Array", "of name unit meaning")
Output = collections.namedtuple("Output", "name data described arrays")
Property = collections.namedtuple("Property", "name default allowed meaning group advanced")
Input = collections.namedtuple("Input", "name takes optional meaning")


def words(element):
    """The text of an element on one line."""
    return " ".join((element.text or "").split()) if element is not None else ""


def spaced(name):
    """A name as the panel has it."""
    return re.sub(r"(?<=[a-z])(?=[A-Z])", " ", name)


def described_properties():
    """{stage: {property: (default, allowed, meaning in Markdown)}} of docs/properties.md."""
    found, stage = {}, None
    with open(os.path.join(ROOT, "docs", "properties.md"), encoding="utf-8") as file:
        for line in file:
            cells = [cell.strip() for cell in re.split(r"(?<!\\)\|", line.strip())[1:-1]]
            if line.startswith("## "):
                stage = found.setdefault(line[3:].strip(), {})
            elif len(cells) == 4 and cells[0] not in ("property", "preset"):
                stage[cells[0]] = tuple(cells[1:])
    return found


class Proxy:
    """What the XML says of one proxy."""

    def __init__(self, group, element):
        self.group, self.name = group, element.get("name")
        self.label = element.get("label")
        documentation = element.find("Documentation")
        self.short, self.long, self.more = documentation.get("short_help"), documentation.get("long_help"), words(documentation)
        hints = element.find("Hints")
        menu = hints.find("ShowInMenu")
        self.menu = f"{'Sources' if group == 'sources' else 'Filters'} > {menu.get('category')} > {self.label}" if menu is not None else None
        files = next((hints.find(kind) for kind in ("ReaderFactory", "WriterFactory") if hints.find(kind) is not None), None)
        self.extensions = files.get("extensions").split() if files is not None else []
        self.file_description = files.get("file_description") if files is not None else None
        self.inputs = [self._input(one) for one in element.findall("InputProperty")]
        ports = {port.get("index"): port.get("name") for port in element.findall("OutputPort")}
        self.outputs = [
            Output(ports.get(one.get("port"), ""), one.get("data"), one.get("described"), [Array(*(array.get(key, "") for key in ("of", "name", "unit")), array.get("meaning")) for array in one])
            for one in hints.findall("Output")
        ]
        self.element = element

    @staticmethod
    def _input(element):
        domain = element.find("SubstrateDataDomain")
        if domain is not None:
            takes = [KINDS[kind] for kind in domain.get("kinds").split()]
        else:
            takes = [TYPES[one.get("value")] for one in element.iter("DataType")]
        takes += ["several of them"] if element.get("multiple_input") == "1" else []
        return Input(element.get("name"), "; ".join(takes), element.find("Hints/Optional") is not None, words(element.find("Documentation")))

    def properties(self, described):
        """Those that users set, in the panel's order, with what docs/properties.md says of them."""
        element, described = self.element, described.get(self.element.get("class").removeprefix("vtk"), {})
        groups = {one.get("name"): group.get("label") for group in element.findall("PropertyGroup") for one in group}
        given = ["FileName"] if element.find("Hints/WriterFactory") is not None else []  # by the dialog, or SaveData's first argument
        found = []
        for one in (one for part in element for one in (part if part.tag == "PropertyGroup" else [part])):
            name, meaning = one.get("name"), plain(words(one.find("Documentation")))
            if name in given:
                continue
            if one.tag == "StageProperty":
                if name not in described:
                    sys.exit(f"filter_pages: docs/properties.md lacks {self.name}.{name}: build/release/bin/cactus_property_table > docs/properties.md")
                default, allowed, meaning = described[name]
            elif one.tag == "Property" and one.get("command"):
                default, allowed = "", "a button"
            elif one.find("PresetDomain") is not None:
                default, allowed = "None", "None or a [preset](../presets.md)"
            else:
                continue
            found.append(Property(name, default, allowed, meaning, groups.get(name, ""), one.get("panel_visibility") == "advanced"))
        order = list(dict.fromkeys(["", *(one.group for one in found)]))  # as the panel has them: by their first property
        return sorted(found, key=lambda one: order.index(one.group))

    def call(self):
        """How a script has it."""
        if self.group == "writers":
            return f'SaveData("NAME.{self.extensions[0]}", proxy=...)'
        wanted = [f"{one.name}=..." for one in self.inputs if not one.optional]
        wanted += ['FileName="..."'] if self.extensions else []
        return f"{self.name}({', '.join(wanted)})"

    def reached(self):
        """Where the window has it."""
        endings = ", ".join(f"`.{one}`" for one in self.extensions)
        if self.group == "writers":
            return f"*File > Save Data*, as *{self.file_description}* ({endings})"
        if self.extensions:
            return f"*File > Open* ({endings})"
        return f"*{self.menu}*"


def plain(text):
    """Text that Markdown leaves as it is."""
    return html.escape(text, quote=False).replace("|", "\\|").replace("*", "\\*")


def proxies():
    """All proxies of xml/*.xml, by the name of their file, with the meaning of each array."""
    found = {}
    for path in sorted(glob.glob(os.path.join(ROOT, "xml", "*.xml"))):
        file = os.path.splitext(os.path.basename(path))[0]
        for group in ElementTree.parse(path).getroot().findall("ProxyGroup"):
            for element in group:
                found.setdefault(file, []).append(Proxy(group.get("name"), element))
    # An array that several filters make is described at one of them.
    known = collections.defaultdict(dict)
    every = [output for all_of_file in found.values() for proxy in all_of_file for output in proxy.outputs]
    for array in (array for output in every for array in output.arrays if array.meaning is not None):
        known[array.of, array.name][array.meaning] = array
    for output in every:
        for i, array in enumerate(output.arrays):
            if array.meaning is None:
                if len(known[array.of, array.name]) != 1:
                    sys.exit(f"filter_pages: {PLACES[array.of]} {array.name} is described {len(known[array.of, array.name])} times: say at each what it means")
                output.arrays[i] = next(iter(known[array.of, array.name].values()))
    return found


def table(head, rows):
    return "".join(f"| {' | '.join(row)} |\n" for row in (head, ["---"] * len(head), *rows))


def input_part(proxy):
    if not proxy.inputs:
        return ""
    rows = [[f"`{one.name}`", one.takes + ("; optional" if one.optional else ""), plain(one.meaning)] for one in proxy.inputs]
    return "\n## In\n\n" + table(["input", "takes", "what"], rows)


def link(described):
    """Where a page of docs/ describes more, as seen from docs/filters/."""
    page, _, _ = described.partition("#")
    with open(os.path.join(ROOT, "docs", page), encoding="utf-8") as file:
        title = file.readline().lstrip("# ").strip()
    return f"[{title}](../{described})"


def output_part(proxy):
    text = "\n## Out\n" if proxy.outputs else ""
    text += "\nField data of the input are passed on.\n" if proxy.outputs and proxy.inputs else ""
    for number, output in enumerate(proxy.outputs):
        name = f"Output {number}, *{output.name}*" if output.name else "Output"
        text += f"\n{name}: {output.data}.{f' What is in it: {link(output.described)}.' if output.described else ''}\n"
        rows = [[PLACES[array.of], f"`{array.name}`", array.unit, plain(array.meaning)] for array in output.arrays]
        text += "\n" + table(["", "array", "unit", "what"], rows) if rows else ""
    return text


def property_part(proxy, title, described):
    text, group = f"\n## {title}\n", None
    for one in proxy.properties(described):
        if one.group != group or group is None:
            group = one.group
            text += f"\n{f'**{group}**' + chr(10) * 2 if group else ''}" + table(["property", "default", "allowed", "what"], [])
        text += f"| `{one.name}`{' ⚙' if one.advanced else ''} | {one.default} | {one.allowed} | {one.meaning} |\n"
    return text


def picture_of(name):
    return f"![{{}}](../images/filters/{name}.png)\n\n" if os.path.exists(os.path.join(PICTURES, name + ".png")) else ""


def page(name, of_file, by_hand, described):
    """The page of xml/NAME.xml, which has one proxy, or two that do the same in two ways."""
    main = of_file[0]
    text = f"# {main.label}\n\n{plain(main.short)}\n\n{picture_of(name).format(plain(main.short))}{BEGIN}{by_hand}{END}\n"
    text += f"{plain(main.long)} {plain(main.more)}\n\n"
    for one in of_file:
        text += f"- {'In the window' if one is main else 'Or'}: {one.reached()}; in a script: `{one.call()}`\n"
    text += input_part(main) + output_part(main)
    for one in of_file:
        text += property_part(one, "Properties" if one is main else f"Properties of {one.file_description}", described)
    return text + "\nThe panel shows names in words (*Minimum Gap* is `MinimumGap`) and hides properties without effect. ⚙: advanced property.\n"


def by_hand(path):
    """The part of a page that is written by hand, with the lines at its ends; empty where there is no page yet."""
    if not os.path.exists(path):
        return "\n"
    with open(path, encoding="utf-8") as file:
        text = file.read()
    begin, end = text.find(BEGIN), text.find(END)
    if begin < 0 or end < begin:
        sys.exit(f"filter_pages: {path} has lost its marks: {BEGIN.strip()} and {END.strip()}")
    return text[begin + len(BEGIN) : end]


def pages():
    """{path: (text as it is, or None; text as it is to be)}."""
    found, described = {}, described_properties()
    for name, of_file in proxies().items():
        path = os.path.join(PAGES, name + ".md")
        wanted = page(name, of_file, by_hand(path), described)
        now = None
        if os.path.exists(path):
            with open(path, encoding="utf-8") as file:
                now = file.read()
        found[path] = (now, wanted)
    return found


def faults():
    """What is wrong with the pages as they are."""
    found = pages()
    for path, (now, wanted) in found.items():
        name = os.path.relpath(path, ROOT)
        if now != wanted:
            yield f"{name} is not what xml/ says: python3 tools/scripts/filter_pages.py"
        elif "**Paper**" not in by_hand(path):
            yield f"{name} has nothing that was written by hand: the section of the paper, what its picture shows"
    for name, of_file in proxies().items():
        picture = os.path.join(PICTURES, name + ".png")
        is_drawn = any(not output.data.startswith("table, a row per file") for output in of_file[0].outputs)
        if is_drawn and not os.path.exists(picture):
            yield f"{os.path.relpath(picture, ROOT)} is missing: ./cactus pvpython tools/scripts/filter_pictures.py {name}"
        elif os.path.exists(picture) and os.path.getsize(picture) > LARGEST_PICTURE:
            yield f"{os.path.relpath(picture, ROOT)} is larger than {LARGEST_PICTURE} bytes"
    for path in sorted(set(glob.glob(os.path.join(PAGES, "*.md"))) - set(found)):
        yield f"{os.path.relpath(path, ROOT)} is of nothing in xml/"


def width_of(picture):
    """Pixels, as the header of a PNG file has them."""
    with open(picture, "rb") as file:
        return int.from_bytes(file.read(20)[16:], "big")


def window_part(proxy, picture):
    """What ParaView's own page lacks: a picture, no wider than its window, and the outputs, which it does not read from the XML."""
    text = f'<p><img src="{os.path.basename(picture)}" width="{min(600, width_of(picture))}"/></p>\n' if picture else ""
    for number, output in enumerate(proxy.outputs):
        name = f"Output {number}, {output.name}" if output.name else "Output"
        text += f"<h4>{html.escape(name)}: {html.escape(output.data)}</h4>\n"
        rows = "".join(
            f"<tr><td>{PLACES[array.of]}</td><th>{html.escape(array.name)}</th><td>{array.unit}</td><td>{html.escape(array.meaning)}</td></tr>\n" for array in output.arrays
        )
        text += f'<table width="97%" border="2px">\n{rows}</table>\n' if rows else ""
    return text + "<h4>Properties</h4>\n" if text else ""


def add_to_window(folder):
    """Adds it to the pages of all proxies, before their tables of properties, in place of what was added before."""
    begin, end = "<!-- outputs -->\n", "<!-- properties -->\n"
    for file, of_file in proxies().items():
        picture = os.path.join(PICTURES, file + ".png")
        shown = picture if os.path.exists(picture) else None
        if shown:
            shutil.copy(shown, folder)
        for proxy in of_file:
            path = os.path.join(folder, f"{proxy.group}.{proxy.name}.html")
            with open(path, encoding="utf-8") as page_file:
                text = re.sub(f"{begin}.*?{end}", "", page_file.read(), flags=re.DOTALL)
            head, found, tail = text.partition('<table width="97%" border="2px">')
            if found:
                with open(path, "w", encoding="utf-8") as page_file:
                    page_file.write(f"{head}{begin}{window_part(proxy, shown if proxy is of_file[0] else None)}{end}{found}{tail}")


def write_index(folder):
    """The page that help opens with, which else would be the first file by name."""
    rows = "".join(
        f'<tr><th><a href="{proxy.group}.{proxy.name}.html">{html.escape(proxy.label)}</a></th><td>{html.escape(proxy.short)}</td></tr>\n'
        for of_file in proxies().values() for proxy in of_file
    )  # fmt: skip
    with open(os.path.join(folder, "index.html"), "w", encoding="utf-8") as file:
        file.write(f'<html>\n    <head>\n<title>All filters</title>\n</head>\n<body>\n<h2>CACTUS</h2>\n<table width="97%" border="2px">\n{rows}</table>\n</body>\n</html>\n')


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--check", action="store_true", help="write nothing, and fail where a page is not as it would be written")
    parser.add_argument("--window", metavar="FOLDER", help="ParaView's own help pages, to add pictures and outputs to")
    wanted = parser.parse_args()
    if wanted.window:
        add_to_window(wanted.window)
        write_index(wanted.window)
        return 0
    if wanted.check:
        found = list(faults())
        print("\n".join(found) or f"{len(pages())} pages are as xml/ says")
        return 1 if found else 0
    os.makedirs(PAGES, exist_ok=True)
    for path, (now, wanted) in pages().items():
        if now != wanted:
            with open(path, "w", encoding="utf-8") as file:
                file.write(wanted)
            print(f"Wrote {os.path.relpath(path, ROOT)}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
