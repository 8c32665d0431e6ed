# SPDX-License-Identifier: BSD-3-Clause
"""properties.py TABLE XML DOCS: fails where DOCS is not what the program TABLE prints, and where a panel of the folder XML does not tell
the unit of a property in the title of its group."""

import glob
import os
import re
import subprocess
import sys
import xml.etree.ElementTree as ElementTree

UNITS = {"µm": "µm", "mm": "mm", "°": "degrees", "s": "seconds"}


def unit_faults(folder, made):
    """Each property with a unit in the table whose group in the panel has another in its title, or that has no group."""
    units = {}
    for line in made.splitlines():
        if line.startswith("## "):
            stage = line[3:]
        found = re.match(r"\| (\w+) \| [^|]* \| [^|]*[ \d](µm|mm|°|s) \|", line)
        if found:
            units[stage, found.group(1)] = UNITS[found.group(2)]
    assert len(units) > 30, units
    for path in sorted(glob.glob(os.path.join(folder, "*.xml"))):
        for proxy in ElementTree.parse(path).getroot().findall("ProxyGroup/SourceProxy"):
            titles = {one: group.get("label", "") for group in proxy.findall("PropertyGroup") for one in group}
            for one in proxy.iter("StageProperty"):
                unit = units.get((proxy.get("name"), one.get("name")))
                if unit is not None and one.get("panel_visibility") != "never" and unit not in titles.get(one, ""):
                    yield f"{proxy.get('name')}.{one.get('name')} is in {unit}, which the title of its group in the panel does not say"


def main():
    table, folder, docs = sys.argv[1:]
    made = subprocess.run([table], check=True, capture_output=True, text=True).stdout
    faults = list(unit_faults(folder, made))
    with open(docs, encoding="utf-8") as file:
        if file.read() != made:
            faults.append(f"{docs} is not what is described: {table} > {docs}")
    print("\n".join(faults) or "every unit is told")
    sys.exit(bool(faults))


main()
