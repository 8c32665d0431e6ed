# SPDX-License-Identifier: BSD-3-Clause
"""plain_words.py FOLDER|FILE...: fails where a documentation comment (///, ///<) of C++ begins with a fragment instead of a verb or a noun
phrase, or where a comment, or a help text (.xml, .md), holds a phrase that readers of today stumble over."""

import pathlib
import re
import sys

COMMENT = re.compile(r"^(?P<code>.*?)(?<![^\s])(?P<mark>///<|///|//)(?P<text>.*)$")
FRAGMENT = re.compile(r"(Of|So|By|Whose|Sees)\b")
PHRASES = re.compile(
    r"\b(wants? nothing but|to live as long|what (comes|came) of it|nobody (says|has said)|sees to it|(is|are|was) to be had"
    r"|somebody else's|likes? it best|takes in)\b",
    re.IGNORECASE,
)

HELP = re.compile(
    PHRASES.pattern
    + r"|\b((is|are) to [a-z]+|(comes?|came) (in|out)|wants?|nobody|without effect|as may be|hands? back|get along|straight from|without being"
    r"|looked (at|for)|a mere|no result depends)\b",
    re.IGNORECASE,
)


def paragraphs(text):
    """Each paragraph of the comments of a text: its first line's number, its mark and its words."""
    found, mark = [], None
    for number, line in enumerate(text.splitlines(), 1):
        comment = COMMENT.match(line)
        words = comment["text"].strip() if comment else ""
        if not words:
            mark = None
        elif comment["mark"] == mark and not comment["code"].strip():
            found[-1][2].append(words)
        else:
            mark = comment["mark"]
            found.append((number, mark, [words]))
    return [(number, mark, " ".join(words)) for number, mark, words in found]


def help_faults(path):
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        for phrase in HELP.finditer(line):
            yield f"{path}:{number}: say in plain words: {phrase[0]}"


def faults(path):
    if path.suffix in (".xml", ".md"):
        yield from help_faults(path)
        return
    for number, mark, words in paragraphs(path.read_text(encoding="utf-8")):
        if mark != "//" and FRAGMENT.match(words):
            yield f"{path}:{number}: begin with a verb in the third person or a noun phrase: {words[:60]}"
        for phrase in PHRASES.finditer(words):
            yield f"{path}:{number}: say in plain words: {phrase[0]}"


def main():
    assert [words for _, _, words in paragraphs("int a; ///< Of a\n  ///< and b.\n/// So\n/// it is.\n///\n/// By\n")] == [
        "Of a and b.",
        "So it is.",
        "By",
    ]
    everything = [path for place in map(pathlib.Path, sys.argv[1:]) for path in ([place] if place.is_file() else sorted(place.rglob("*")))]
    files = [path for path in everything if path.suffix in (".h", ".cpp", ".cxx", ".xml", ".md")]
    found = [fault for path in files for fault in faults(path)]
    if not files:
        found.append("there are no sources in " + " ".join(sys.argv[1:]))
    print("\n".join(found) or f"{len(files)} files")
    sys.exit(bool(found))


main()
