# SPDX-License-Identifier: BSD-3-Clause
"""installed.py PREFIX: the plugin was loaded by itself, all of it from below PREFIX but for what the window alone needs, and makes fibres."""

import os
import sys

from paraview import servermanager, simple

prefix = os.path.realpath(sys.argv[1]) + os.sep

with open("/proc/self/maps") as maps:
    libraries = {line.split()[-1] for line in maps if ".so" in line}
loaded = {path for path in libraries if "cactus" in os.path.basename(path).lower()}
expected = {"CACTUS.so", "libCactusFilters.so", "libCactusViews.so"}
assert {os.path.basename(path) for path in loaded} == expected, f"not {expected}: {loaded}"
assert all(path.startswith(prefix) for path in loaded), f"not the installed copy: {loaded}"
window = {path for path in libraries if os.path.basename(path).startswith(("libQt", "libpqCore"))}
assert not window, f"there is no window, but its libraries are loaded: {window}"

bundle = simple.BundleInitializer(Border="Walls", Side=10, FibreVolumeFraction=0.3)
bundle.UpdatePipeline()
assert servermanager.Fetch(bundle).GetNumberOfLines() > 10, "no fibres"
