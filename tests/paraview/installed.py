# SPDX-License-Identifier: BSD-3-Clause
"""installed.py PREFIX: the plugin was loaded by itself, all of it from below PREFIX, and makes fibres."""

import os
import sys

from paraview import servermanager, simple

prefix = os.path.realpath(sys.argv[1]) + os.sep

with open("/proc/self/maps") as maps:
    loaded = {line.split()[-1] for line in maps if os.path.basename(line.split()[-1]) in ("CACTUS.so", "libCactusFilters.so", "libCactusViews.so")}
assert len(loaded) == 3, f"the plugin is not loaded as a whole: {loaded}"
assert all(path.startswith(prefix) for path in loaded), f"not the installed copy: {loaded}"

bundle = simple.BundleInitializer(Side=10, FibreVolumeFraction=0.3)
bundle.UpdatePipeline()
assert servermanager.Fetch(bundle).GetNumberOfLines() > 10, "no fibres"
