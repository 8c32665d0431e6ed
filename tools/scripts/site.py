# SPDX-License-Identifier: BSD-3-Clause
"""Makes a site of the documentation, with MkDocs: README.md is its first page, and links lead where they lead in the tree.

Run it with ./cactus docs. Without a network, too, the pages can be read: open index.html.
"""

import argparse
import os
import shutil
import subprocess
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
# What pages are made of, and what they link to.
PARTS = ("README.md", "CHANGELOG.md", "CONTRIBUTING.md", "CITATION.cff", "LICENSE", "cactus", "docs", "examples", "tools")


def arguments():
    parser = argparse.ArgumentParser(prog="./cactus docs", description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--output", default="cactus-docs", metavar="DIR", help="folder for the site (default: %(default)s)")
    return parser.parse_args()


def stage(folder):
    """Copies the parts to a folder of their own: MkDocs takes all that lies in one."""
    for part in PARTS:
        source = os.path.join(ROOT, part)
        if os.path.isdir(source):
            shutil.copytree(source, os.path.join(folder, part), ignore=shutil.ignore_patterns("__pycache__", "mkdocs.yml"))
        else:
            shutil.copy(source, folder)


def main():
    output = os.path.abspath(arguments().output)
    if os.path.lexists(output) and not (os.path.isdir(output) and not os.listdir(output)):
        sys.exit(f"docs: {output} is there already: delete it, or name another folder with --output")
    with tempfile.TemporaryDirectory(prefix="cactus-docs-") as scratch:
        pages = os.path.join(scratch, "pages")
        os.mkdir(pages)
        stage(pages)
        settings = os.path.join(scratch, "mkdocs.yml")
        with open(os.path.join(ROOT, "docs", "mkdocs.yml"), encoding="utf-8") as file:
            content = file.read()
        with open(settings, "w", encoding="utf-8") as file:
            # Files are opened without a server: a link to a folder would list it.
            file.write(f"{content}docs_dir: {pages}\nuse_directory_urls: false\n")
        if subprocess.run(["mkdocs", "build", "--quiet", "--strict", "--config-file", settings, "--site-dir", output], check=False).returncode != 0:
            sys.exit("docs: the site could not be made, as said above")
    print(f"Wrote {os.path.join(output, 'index.html')}")


if __name__ == "__main__":
    main()
