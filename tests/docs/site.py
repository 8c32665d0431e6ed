# SPDX-License-Identifier: BSD-3-Clause
"""site.py SCRIPT FOLDER: SCRIPT makes the site of the documentation in FOLDER, every page of docs/ is in its menu, and every link of every page
leads to a file of it and, behind a #, to a place in that file."""

import glob
import html.parser
import os
import shutil
import subprocess
import sys
import urllib.parse

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


class Page(html.parser.HTMLParser):
    """Where a page's links lead, and the places in it that links can lead to."""

    def __init__(self, path):
        super().__init__()
        self.links, self.places = [], set()
        with open(path, encoding="utf-8") as file:
            self.feed(file.read())

    def handle_starttag(self, tag, attributes):
        found = dict(attributes)
        self.places.update(found[name] for name in ("id", "name") if found.get(name))
        self.links.extend(found[name] for name in ("href", "src") if found.get(name))


def faults(folder):
    pages = {path: Page(path) for path in glob.glob(os.path.join(folder, "**", "*.html"), recursive=True)}
    targets = []  # of each page, the files that its links lead to
    for path, page in pages.items():
        if os.path.basename(path) in ("404.html", "search.html"):  # whose links are those of a server
            continue
        targets.append(set())
        for link in page.links:
            parts = urllib.parse.urlsplit(link)
            if parts.scheme or parts.netloc:
                continue
            target = os.path.normpath(os.path.join(os.path.dirname(path), urllib.parse.unquote(parts.path))) if parts.path else path
            targets[-1].add(target)
            place = urllib.parse.unquote(parts.fragment)
            if not os.path.exists(target):
                yield f"{os.path.relpath(path, folder)}: {link} leads nowhere"
            elif place and target in pages and place not in pages[target].places:
                yield f"{os.path.relpath(path, folder)}: there is no {link}"
    menu = set.intersection(*targets)  # the rest of a page has links of its own
    for path in glob.glob(os.path.join(ROOT, "docs", "**", "*.md"), recursive=True):
        page = os.path.relpath(path, ROOT)[:-3] + ".html"
        if os.path.join(folder, page) not in menu:
            yield f"{page} is not in the menu: docs/mkdocs.yml"


def main(script, folder):
    shutil.rmtree(folder, ignore_errors=True)
    subprocess.run([sys.executable, script, "--output", folder], check=True)
    found = sorted(set(faults(folder)))
    print("\n".join(found) or "every link leads somewhere")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
