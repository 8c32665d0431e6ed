# SPDX-License-Identifier: BSD-3-Clause
"""help.py CACTUS.qch XML_FOLDER: the help that is packed into the plugin says of each page that it is UTF-8, where a browser that takes
pages for Latin-1 looks for it, and has a page with all properties for each proxy that users can find, with what its outputs hold and a picture."""

import glob
import os
import re
import sqlite3
import sys
import xml.etree.ElementTree as ElementTree
import zlib


def files(path):
    """Name and bytes of each page and picture; Qt packs them with zlib behind four bytes."""
    database = sqlite3.connect(f"file:{path}?mode=ro", uri=True)
    rows = database.execute("select FileNameTable.Name, FileDataTable.Data from FileNameTable join FileDataTable on FileNameTable.FileId = FileDataTable.Id")
    return {name: zlib.decompress(data[4:]) for name, data in rows if data}


def described(folder):
    """Name of each proxy's page, the names of its numbers, and the arrays of its outputs."""
    for path in sorted(glob.glob(os.path.join(folder, "*.xml"))):
        for group in ElementTree.parse(path).getroot().findall("ProxyGroup"):
            for proxy in group:
                numbers = [one.get("name") for one in proxy if one.tag == "DoubleVectorProperty" and one.get("information_only") != "1"]
                yield f"{group.get('name')}.{proxy.get('name')}.html", numbers, [one.get("name") for one in proxy.findall("Hints/Output/Array")]


def main(qch, folder):
    packed, faults = files(qch), []
    found = {name: content for name, content in packed.items() if name.endswith(".html")}
    for name, content in found.items():
        if not re.search(rb'<meta [^>]*charset=utf-8"', content[:1024]):
            faults.append(f"{name} does not say that it is UTF-8")
        if "Âµ" in content.decode("utf-8"):
            faults.append(f"{name} has been encoded twice")
        pictures = re.findall(r'<img src="([^"]*)"', content.decode("utf-8"))
        faults += [f"{name} has a picture that is not packed: {picture}" for picture in pictures if not packed.get(picture, b"").startswith(b"\x89PNG")]
    if not any(name.endswith(".png") for name in packed):
        faults.append("there is no picture")
    faults += [f"the first page has no link to {name}" for name, _, _ in described(folder) if f'href="{name}"' not in found.get("index.html", b"").decode("utf-8")]
    for name, properties, arrays in described(folder):
        page = found.get(name, b"").decode("utf-8")
        words = re.sub(r"[^0-9A-Za-z]", "", page)
        missing = [one for one in properties if one not in words]
        if not page or missing:
            faults.append(f"{name}: {'properties ' + ', '.join(missing) + ' are missing' if page else 'is missing'}")
        faults += [f"{name}: output array {one} is missing" for one in arrays if f"<th>{one}</th>" not in page]
    if not any("µm" in content.decode("utf-8") for content in found.values()):
        faults.append("no page has a µm to judge by")
    print("\n".join(faults) or f"{len(found)} pages")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
