# SPDX-License-Identifier: BSD-3-Clause
"""Where an example writes: it replaces nothing."""

import itertools
import os
import sys


def taken(folder, names):
    """The first of the things of these names that is in the folder already; None where none is."""
    return next((path for path in (os.path.join(folder, name) for name in names) if os.path.lexists(path)), None)


def first_free(folder, names):
    """The folder, or the first of folder-2, folder-3, … in which nothing of these names is."""
    numbered = itertools.chain([folder], (f"{folder}-{number}" for number in itertools.count(2)))
    return next(each for each in numbered if not taken(each, names))


def make_folder(program, folder, names):
    """Makes it if need be, and gives the paths of these names in it. Ends the program where that cannot be, or one is there already."""
    there = taken(folder, names)
    if there:
        sys.exit(f"{program}: {there} is there already: move it, or name another folder")
    try:
        os.makedirs(folder, exist_ok=True)
    except OSError as error:
        sys.exit(f"{program}: cannot write to {folder}: {error.strerror}")
    if not os.access(folder, os.W_OK):
        sys.exit(f"{program}: cannot write to {folder}: permission denied")
    return [os.path.join(folder, name) for name in names]
