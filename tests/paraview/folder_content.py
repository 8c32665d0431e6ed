# SPDX-License-Identifier: BSD-3-Clause
"""What is in a folder, for tests with ParaView and without."""

import os


def files(folder):
    """The bytes of every file, by its path in the folder."""
    found = {}
    for path, _, names in os.walk(folder):
        for name in names:
            with open(os.path.join(path, name), "rb") as file:
                found[os.path.relpath(os.path.join(path, name), folder)] = file.read()
    return found
