# SPDX-License-Identifier: BSD-3-Clause
"""help.py CACTUS.qch XML_FOLDER: the help that is packed into the plugin says of each page that it is UTF-8, where a browser that takes
pages for Latin-1 looks for it, and has a page with all properties for each proxy that users can find."""

import glob
import os
import re
import sqlite3
import sys
import xml.etree.ElementTree as ElementTree
import zlib


def pages(path):
    """Name and bytes of each page; Qt packs them with zlib behind four bytes."""
    database = sqlite3.connect(f"file:{path}?mode=ro", uri=True)
    rows = database.execute("select FileNameTable.Name, FileDataTable.Data from FileNameTable join FileDataTable on FileNameTable.FileId = FileDataTable.Id")
    return {name: zlib.decompress(data[4:]) for name, data in rows if name.endswith(".html")}


def described(folder):
    """Name of each proxy's page, and its numbers' names in words."""
    for path in sorted(glob.glob(os.path.join(folder, "*.xml"))):
        for group in ElementTree.parse(path).getroot().findall("ProxyGroup"):
            for proxy in group:
                yield f"{group.get('name')}.{proxy.get('name')}.html", [one.get("name") for one in proxy if one.tag == "DoubleVectorProperty" and one.get("information_only") != "1"]


def main(qch, folder):
    found, faults = pages(qch), []
    for name, content in found.items():
        if not re.search(rb'<meta [^>]*charset=utf-8"', content[:1024]):
            faults.append(f"{name} does not say that it is UTF-8")
        if "Âµ" in content.decode("utf-8"):
            faults.append(f"{name} has been encoded twice")
    for name, properties in described(folder):
        page = found.get(name, b"").decode("utf-8")
        words = re.sub(r"[^0-9A-Za-z]", "", page)
        missing = [one for one in properties if one not in words]
        if not page or missing:
            faults.append(f"{name}: {'properties ' + ', '.join(missing) + ' are missing' if page else 'is missing'}")
    if not any("µm" in content.decode("utf-8") for content in found.values()):
        faults.append("no page has a µm to judge by")
    print("\n".join(faults) or f"{len(found)} pages")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
