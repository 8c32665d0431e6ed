# SPDX-License-Identifier: BSD-3-Clause
"""Files and folders that names may lead to, and files that are spoilt."""

import contextlib
import os
import stat

import numpy as np

def playground(folder, good):
    """A folder with what a name may lead to, and {case: text that a file or folder property is set to}."""
    os.makedirs(os.path.join(folder, "has", "something"))
    for name in ("file.txt", "has/note.txt", "has/something/more.txt"):
        with open(os.path.join(folder, name), "w") as file:
            file.write("dear to somebody\n")
    os.makedirs(os.path.join(folder, "empty"))
    os.symlink("file.txt", os.path.join(folder, "link"))
    os.symlink("has", os.path.join(folder, "link-to-folder"))
    os.symlink("nowhere", os.path.join(folder, "broken-link"))
    os.symlink("circle", os.path.join(folder, "circle"))
    os.mkfifo(os.path.join(folder, "fifo"))
    names = {
        "empty": "", "blank": " ", "question": "?", "newline": "a\nb", "letters": "äöü-ø-漢字", "long": "x" * 300, "very-long": "x" * 100000,
        "percent": "%s%n%p%d", "control": "a\x01\x7f", "quote": "a\"'`$(x)", "dot": ".", "dots": "..", "dot-slash": "./",
        "slashes": "a//b", "through-dots": "has/..", "nowhere": "no/such/folder/x", "under-a-file": "file.txt/x", "existing": "file.txt",
        "existing-folder": "has", "empty-folder": "empty", "link": "link", "link-to-folder": "link-to-folder", "broken-link": "broken-link",
        "circle": "circle", "fifo": "fifo", "proc": "/proc/no-such-thing", "minus": "-1", "nan": "nan", "overflow": "1e999",
        "numbers": "0.5, 1e300", "list": "0.5;0.6", "many": "0.5 " * 20000, "comma": ",,,,", "hexadecimal": "0x1p4", "negative": "-0.5 0.5",
    }
    if os.geteuid() == 0:  # devices of our own: were one replaced, nobody would miss it
        for name, minor in (("null", 3), ("full", 7)):
            try:
                os.mknod(os.path.join(folder, name), stat.S_IFCHR | 0o666, os.makedev(1, minor))
                names[name] = name
            except PermissionError:
                pass
    return names


def kept(folder):
    """What nobody may have touched."""
    result = {}
    for name in ("has/note.txt", "has/something/more.txt"):
        with contextlib.suppress(OSError), open(os.path.join(folder, name)) as file:
            result[name] = file.read()
    return result


def spoilt_files(good):
    """{name: bytes} of files in the place of a good one."""
    result = {
        "empty": b"", "blank": b" \n\t\n", "one-byte": b"\x00", "zeros": bytes(5000), "noise": np.random.default_rng(1).bytes(5000),
        "text": b"Dear reader,\nthis is no such file.\n", "half": good[: len(good) // 2], "cut-in-a-number": good[: len(good) // 3],
        "twice": good + good, "and-more": good + b"1 2 3\n", "windows": good.replace(b"\n", b"\r\n"), "commas": good.replace(b".", b","),
        "marked": b"\xef\xbb\xbf" + good, "long-line": b"1" * 10**7, "comment": b"# comment\n" + good,
    }
    try:
        return {**result, **spoilt_text(good, good.decode())}
    except UnicodeDecodeError:
        return {**result, **spoilt_bytes(good)}


def spoilt_text(good, text):
    lines = good.split(b"\n")
    words = good.split()

    def line(number, text):
        return b"\n".join(lines[:number] + [text] + lines[number + 1 :])

    result = {
        "last-line-missing": b"\n".join(lines[:-2]), "one-line": b" ".join(words), "word-per-line": b"\n".join(words),
        "utf-16": text.encode("utf-16"), "swapped": b"\n".join([lines[1], lines[0]] + lines[2:]), "extra-column": good.replace(b"\n", b" 1\n"),
    }
    for value in (b"nan", b"inf", b"-1", b"0", b"1e40", b"1e300", b"1e999", b"99999999999999999999", b"2147483648", b"-0", b"1.5", b"x", b""):
        for number in (0, 1, 2):
            result[f"line{number + 1}={value.decode()}"] = line(number, value)
        columns = lines[4].split()
        for column in range(len(columns)):
            result[f"line5.{column + 1}={value.decode()}"] = line(4, b" ".join(columns[:column] + [value] + columns[column + 1 :]))
    return result


def spoilt_bytes(good):
    """Words of four bytes exchanged, near the beginning (a header) and everywhere."""
    result = {"one-byte-less": good[:-1], "one-byte-more": good + b"\x00"}
    places = [*range(0, min(len(good), 128), 8), *range(128, len(good) - 4, max(1, len(good) // 16))]
    for name, word in (("zeros", bytes(4)), ("ones", b"\xff" * 4), ("nan", b"\x00\x00\xc0\x7f"), ("huge", b"\xff\xff\x7f\x7f")):
        for place in places:
            result[f"{name}-at-{place}"] = good[:place] + word + good[place + 4 :]
    return result
