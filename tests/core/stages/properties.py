# SPDX-License-Identifier: BSD-3-Clause
"""properties.py TABLE XML DOCS: fails where a panel does not tell the unit of a property in the title of its group; where the server-manager XML says other than the stages' descriptions, as the program TABLE
prints them, of a property's name, type, default, range, choices or of what it depends on, or where DOCS is not what TABLE makes."""

import glob
import json
import os
import re
import subprocess
import sys
import xml.etree.ElementTree as ElementTree

KINDS = {"DoubleVectorProperty": float, "IntVectorProperty": int, "StringVectorProperty": str}


def xml_stages(folder):
    """{stage: {property's name: XML element}} of what users set. A class may stand there twice, as a filter and for Save Data."""
    stages = {}
    for path in glob.glob(os.path.join(folder, "*.xml")):
        for proxy in ElementTree.parse(path).getroot().findall("ProxyGroup/*"):
            if proxy.get("class") != "vtk" + proxy.get("name"):
                continue
            stages[proxy.get("name")] = {
                one.get("name"): one for one in proxy if one.tag in KINDS and one.get("information_only") != "1" and not is_preset(proxy, one)
            }
    return stages


def is_preset(proxy, one):
    """Whether a property, which no stage has, gives others their values."""
    domain = one.find("PresetDomain")
    if domain is not None:
        assert domain.get("stage") == proxy.get("name"), "a preset of another stage"
        assert one.get("name") == "Preset" and one.get("command") is None
    return domain is not None


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
            titles = {one.get("name"): group.get("label") for group in proxy.findall("PropertyGroup") for one in group}
            for one in proxy:
                unit = units.get((proxy.get("name"), one.get("name")))
                if unit is not None and one.get("panel_visibility") != "never" and unit not in titles.get(one.get("name"), ""):
                    yield f"{proxy.get('name')}.{one.get('name')} is in {unit}, which the title of its group in the panel does not say"


def default(one):
    kind = KINDS[one.tag]
    return kind(one.get("default_values", "" if kind is str else "none"))


def limits(one):
    """Those of the domain `limits`, else of the only one."""
    domains = [domain for domain in one if domain.tag in ("DoubleRangeDomain", "IntRangeDomain")]
    widest = [domain for domain in domains if domain.get("name") == "limits"] or domains
    for domain in domains:
        assert domain.get("min") == widest[0].get("min"), "its domains have different minima"
    return [float(widest[0].get(end, "nan")) for end in ("min", "max")] if widest else None


def switches(one):
    """{property: values} of those on whose values the panel shows it; no values where it needs any but 0 or none."""
    found = {}
    for decorator in one.findall(".//PropertyWidgetDecorator[@property]"):
        values = found.setdefault(decorator.get("property"), set())
        if decorator.get("inverse") == "1":
            assert decorator.get("value") in ("0", ""), "is shown by an inverse that is not described"
        else:
            values.update(float(value) for value in decorator.get("values", decorator.get("value")).split())
    return found


def differences(facts, one):
    """What the XML element says otherwise."""
    kind = KINDS[one.tag]
    if isinstance(facts["default"], str) != (kind is str) or isinstance(facts["default"], float) != (kind is float):
        yield f"is a {one.tag}"
    elif default(one) != facts["default"]:
        yield f"has the default {default(one)} instead of {facts['default']}"
    entries = [entry.get("text") for entry in one.findall("EnumerationDomain/Entry")]
    numbers = [int(entry.get("value")) for entry in one.findall("EnumerationDomain/Entry")]
    if entries != facts["choices"] or numbers != list(range(len(entries))):
        yield f"has the choices {entries}"
    if (one.find("BooleanDomain") is not None) != isinstance(facts["default"], bool):
        yield "is a switch in one place only"
    wanted = [facts["lowest"], facts["highest"]] if "lowest" in facts else None
    if limits(one) != wanted:
        yield f"has the range {limits(one)} instead of {wanted}"
    needed = {name: set(values) for name, values in facts["conditions"].items()}
    if switches(one) != needed:
        yield f"is shown where {switches(one)}, and has an effect where {needed}"


def main():
    table, folder, docs = sys.argv[1:]
    described = json.loads(subprocess.run([table, "--json"], check=True, capture_output=True, text=True).stdout)
    shown = xml_stages(folder)
    faults = []
    if set(described) != set(shown):
        faults.append(f"the XML has the stages {sorted(shown)}, described are {sorted(described)}")
    for stage in sorted(set(described) & set(shown)):
        facts = {one["name"]: one for one in described[stage]}
        for name in sorted(set(facts) ^ set(shown[stage])):
            faults.append(f"{stage}.{name} is {'not in the XML' if name in facts else 'not described'}")
        for name in sorted(set(facts) & set(shown[stage])):
            faults += [f"{stage}.{name} {fault}" for fault in differences(facts[name], shown[stage][name])]
    made = subprocess.run([table], check=True, capture_output=True, text=True).stdout
    faults += unit_faults(folder, made)
    with open(docs, encoding="utf-8") as file:
        if file.read() != made:
            faults.append(f"{docs} is not what is described: {table} > {docs}")
    print("\n".join(faults) or f"{sum(map(len, described.values()))} properties of {len(described)} stages")
    sys.exit(bool(faults) or not described)


main()
