# SPDX-License-Identifier: BSD-3-Clause
"""The plugin as its XML describes it: its proxies, their inputs and properties, and which values these may have."""

import math

from cactus_testing import proxies, switches_of


class Target:
    """A proxy of the plugin: its ports, its properties, and which values they may have."""

    def __init__(self, group, element):
        self.group, self.element, self.name = group, element, element.get("name")
        self.ports = {port.get("name"): self._kind(element, port) for port in element.findall("InputProperty")}
        self.optional = {port.get("name") for port in element.findall("InputProperty") if port.find("Hints/Optional") is not None}
        settable = [one for one in element if one.tag.endswith("VectorProperty") and one.get("information_only") != "1"]
        # Presets, which set other properties, have tests of their own.
        self.numbers = [one for one in settable if one.tag in ("DoubleVectorProperty", "IntVectorProperty") and one.find("PresetDomain") is None]
        self.texts = [one for one in settable if one.tag == "StringVectorProperty"]
        self.reads = self._extension("ReaderFactory")
        self.writes = [one.get("name") for one in self.texts if "Folder" in one.get("name") or group == "writers" and "File" in one.get("name")]

        writer = self._extension("WriterFactory")
        self.good_name = "good" + (f".{writer}" if writer else "")

    def _extension(self, factory):
        """The first one of a reader's or a writer's files, without its dot; None for others."""
        hint = self.element.find("Hints/" + factory)
        return hint.get("extensions").split()[0] if hint is not None else None

    @staticmethod
    def _kind(element, port):
        """Which good data object belongs to an input."""
        types = [kind.get("value") for kind in port.findall("DataTypeDomain/DataType")]
        if element.get("name") == "SubstrateFolder":
            return "outer"
        if element.get("name") == "HistologyRadii":
            return "mask"
        return "image" if "vtkImageData" in types else {"Outer": "outer", "Inner": "inner"}.get(port.get("name"), "fibres")

    def number(self, name):
        return next(one for one in self.numbers if one.get("name") == name)

    def switches(self, one):
        """{property: value} of the choices that make a property count."""
        found, pending = {}, [one]
        while pending:
            for name, is_inverse, value in switches_of(pending.pop()):
                if name not in found:
                    needed = self.element.find(f"*[@name='{name}']")
                    given = GIVEN.get(name, GIVEN[needed.tag])
                    found[name] = given if is_inverse else float(value)
                    pending.append(needed)
        return found


RADII = "radii.txt"  # files that are there
DIRECTIONS = "directions.nii"
# A value of each kind where any but 0, or some text, makes another property count.
GIVEN = {
    "RadiusTableFile": RADII, "OrientationFile": DIRECTIONS, "UnmyelinatedFraction": 0.3, "IntVectorProperty": 1.0, "DoubleVectorProperty": 0.5, "StringVectorProperty": "given",
}


def targets():
    return {element.get("name"): Target(group, element) for group, element in proxies()}


def limits(one):
    """(smallest, largest) that the XML allows; None where it has no limit."""
    domain = next((each for each in one if each.tag in ("DoubleRangeDomain", "IntRangeDomain")), None)
    if domain is not None:
        return tuple(None if domain.get(end) is None else float(domain.get(end)) for end in ("min", "max"))
    values = [int(entry.get("value")) for entry in one.findall("EnumerationDomain/Entry")]
    return (min(values), max(values)) if values else (None, None)


def values(one):
    """{name: number} of what a numeric property is set to."""
    low, high = limits(one)
    if one.tag == "IntVectorProperty":
        result = {"0": 0, "-1": -1, "2^31-1": 2**31 - 1, "-2^31": -(2**31), "1": 1, "7": 7}
        near = 1
    else:
        result = {
            "0": 0.0, "-1": -1.0, "1e-300": 1e-300, "1e-6": 1e-6, "1e40": 1e40, "1e300": 1e300, "-1e300": -1e300, "nan": math.nan,
            "inf": math.inf, "-inf": -math.inf,
        }
        near = 1e-9
    kind = int if near == 1 else float
    for end, limit, sign in (("min", low, -1), ("max", high, 1)):
        if limit is not None:
            result[end] = kind(limit)
            result["beyond-" + end] = kind(limit) + sign * (1 if near == 1 else max(near * abs(limit), 1e-12))
    return result


def is_legal(one, value):
    low, high = limits(one)
    return math.isfinite(value) and (low is None or value >= low) and (high is None or value <= high)
