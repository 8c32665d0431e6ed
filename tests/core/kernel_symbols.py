# SPDX-License-Identifier: BSD-3-Clause
"""kernel_symbols.py NM OBJECT...: fails where an object file that is compiled for one vector unit defines an inline function that others
share: of several definitions the linker takes any one, and so perhaps the one for a machine that is not there."""

import subprocess
import sys


def main():
    nm, objects = sys.argv[1], sys.argv[2:]
    faults = [] if objects else ["no object files are named"]
    for path in objects:
        listing = subprocess.run([nm, "--defined-only", path], check=True, capture_output=True, text=True).stdout
        symbols = [line.split()[-2:] for line in listing.splitlines() if line.strip()]
        shared = [name for kind, name in symbols if kind in "WVwvu"]
        if not any(kind in "BDRST" for kind, name in symbols):
            faults.append(f"{path} defines no table of kernels")
        faults += [f"{path} shares {name}: force it inline" for name in shared]
    print("\n".join(faults) or f"{len(objects)} files share nothing")
    sys.exit(bool(faults))


main()
