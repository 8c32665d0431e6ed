# SPDX-License-Identifier: BSD-3-Clause
"""Makes the figures and tables of the CACTUS paper again, each by its script in examples/figures.

Run it with ./cactus figures. Without a name it makes all.
"""

import argparse
import ast
import os
import re
import subprocess
import sys
import time

FOLDER = os.path.join(os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__)))), "examples", "figures")
sys.path.append(FOLDER)
from paper_figure import add_options  # noqa: E402  (which is in another folder)


def titles():
    """{name: first line of its script's description} of all figures, in the paper's order."""
    found = {}
    for script in os.listdir(FOLDER):
        name, ending = os.path.splitext(script)
        if ending == ".py" and name != "paper_figure":
            with open(os.path.join(FOLDER, script), encoding="utf-8") as file:
                found[name] = ast.get_docstring(ast.parse(file.read())).split("\n", maxsplit=1)[0]
    return dict(sorted(found.items(), key=lambda item: (int(re.search(r"Figure (\d+)", item[1]).group(1)), item[0])))


def arguments(known):
    """What is wanted, and the words that tell it to a figure's script."""
    parser = argparse.ArgumentParser(prog="./cactus figures", description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("names", nargs="*", metavar="NAME", help="figures to make (default: all)")
    parser.add_argument("--list", action="store_true", help="list the figures")
    add_options(parser)
    wanted = parser.parse_args()
    for name in wanted.names:
        if name not in known:
            parser.error(f"there is no figure {name}: {', '.join(known)}")
    given = {name: value for name, value in vars(wanted).items() if name not in ("names", "list") and value is not None}
    return wanted, [word for name, value in given.items() for word in (f"--{name.replace('_', '-')}", str(value))]


def main():
    known = titles()
    wanted, passed = arguments(known)
    if wanted.list:
        print("\n".join(f"{name:<15}{title}" for name, title in known.items()))
        return 0
    failed = []
    for name in wanted.names or known:
        start = time.perf_counter()
        print(f"{name}: {known[name]}", flush=True)
        # A process of its own, so that no figure holds memory that the next one needs.
        if subprocess.run(["pvpython", os.path.join(FOLDER, f"{name}.py"), *passed], check=False).returncode != 0:
            failed.append(name)
        print(f"    {time.perf_counter() - start:.0f} s", flush=True)
    if failed:
        print(f"figures: failed: {', '.join(failed)}", file=sys.stderr)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
