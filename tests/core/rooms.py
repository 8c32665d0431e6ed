# SPDX-License-Identifier: BSD-3-Clause
"""rooms.py CORE ROOM...: fails where a file in one of core's rooms, which stand in their order, includes one of a later room, where
a file is in no room, or where includes of headers and sources run in a circle."""

import pathlib
import re
import sys

INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*"([^"]+)"', re.MULTILINE)


def units(core):
    """What each unit (a header and its sources, by room and name) includes of core."""
    found = {}
    for path in sorted(core.rglob("*")):
        if path.suffix in (".h", ".cpp"):
            unit = path.relative_to(core).with_suffix("").as_posix()
            includes = {include[: -len(".h")] for include in INCLUDE.findall(path.read_text(encoding="utf-8"))}
            found.setdefault(unit, set()).update(includes - {unit})
    return found


def circle(includes):
    """One circle of units, or nothing."""
    done = set()

    def visit(unit, way):
        if unit in way:
            return way[way.index(unit) :] + [unit]
        if unit not in done:
            for next_unit in sorted(includes.get(unit, ())):
                found = visit(next_unit, way + [unit])
                if found:
                    return found
            done.add(unit)
        return None

    for unit in sorted(includes):
        found = visit(unit, [])
        if found:
            return found
    return None


def main():
    core, rooms = pathlib.Path(sys.argv[1]), sys.argv[2:]
    includes = units(core)
    faults = []
    if not includes or not rooms:
        faults.append(f"there are no sources in {core}, or no rooms are named")
    for unit, included in includes.items():
        room = unit.split("/")[0]
        if "/" not in unit or room not in rooms:
            faults.append(f"{unit} is in none of the rooms {' '.join(rooms)}")
            continue
        for other in sorted(included):
            if other not in includes:
                faults.append(f"{unit} includes {other}.h, which is not in core: name it with its room")
            elif rooms.index(other.split("/")[0]) > rooms.index(room):
                faults.append(f"{unit} includes {other}.h of a later room")
    found = circle(includes)
    if found:
        faults.append("a circle: " + " -> ".join(found))
    print("\n".join(faults) or f"{len(includes)} units in {len(rooms)} rooms")
    sys.exit(bool(faults))


main()
