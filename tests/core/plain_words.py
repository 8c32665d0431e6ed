# SPDX-License-Identifier: BSD-3-Clause
"""plain_words.py FOLDER...: fails where a documentation comment (///, ///<) in these folders begins with a fragment instead of a verb
or a noun phrase, or where a comment holds a phrase that readers of today stumble over."""

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


def faults(path):
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
    everything = [path for folder in sys.argv[1:] for path in sorted(pathlib.Path(folder).rglob("*"))]
    files = [path for path in everything if path.suffix in (".h", ".cpp", ".cxx")]
    found = [fault for path in files for fault in faults(path)]
    if not files:
        found.append("there are no sources in " + " ".join(sys.argv[1:]))
    print("\n".join(found) or f"{len(files)} files")
    sys.exit(bool(found))


main()
