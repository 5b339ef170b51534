#!/usr/bin/env python3
"""units.py OUTPUT SOURCE...: which sources are compiled together, as lines of CMake, into OUTPUT.

Most of a source's compilation goes into headers and templates of other people's, so that sources of one folder are compiled
some at a time, as one translation unit that includes them. A name that one source declares for itself and another one or
its headers mention may mean two things there, so that such sources stand in different units. OUTPUT is left alone if it says
so already, so that what depends on it stays up to date."""

import functools
import os
import re
import sys

SOURCES_A_UNIT = 8
BYTES_A_UNIT = 64 * 1024

# What a source has for itself alone, as clang-format ends it.
OWN = re.compile(r"^namespace \{\n(.*?)^\}  // namespace$", re.MULTILINE | re.DOTALL)
# What a line that begins at the margin declares: the last name before its parameters, value, bases or body ...
DECLARED = re.compile(
    r"^(?=\w)(?!namespace|using|if|for|while|return|TEST|TYPED_TEST|INSTANTIATE)"
    r"[\w:<>,&*\[\] ]*?(?<![\w:])(\w+)(?:\(| = |\{| \{| : |;)", re.MULTILINE)
# ... and further constants of the same line.
MARGIN_LINE = re.compile(r"^\w.*", re.MULTILINE)
CONSTANT = re.compile(r"\b(k[A-Z]\w*)(?: = |\{)")
# Two sources may import the same.
IMPORTED = re.compile(r"^using (?:[\w:]+::)?(\w+)(;| = .*;)", re.MULTILINE)
INCLUDED = re.compile(r'^#include "(.+)"', re.MULTILINE)
NOT_CODE = re.compile(r'//[^\n]*|R"(\w*)\(.*?\)\1"|"(?:[^"\\\n]|\\.)*"', re.DOTALL)
# A name behind one of these is looked up in what stands before it.
WORD = re.compile(r"(?<![\w.:>])(?<!-)([A-Za-z_]\w*)\b|(?<!-)>([A-Za-z_]\w*)")

ROOT = os.path.join(os.path.dirname(os.path.realpath(__file__)), "../..")


def words_of(text):
    return {name for names in WORD.findall(NOT_CODE.sub("", text)) for name in names if name}


@functools.lru_cache(maxsize=None)
def header(name):
    """The words of a header's code, and the headers behind it, itself first; none where the project has no such header."""
    path = os.path.join(ROOT, name)
    if not os.path.exists(path):
        return set(), set()
    with open(path, encoding="utf-8") as file:
        text = file.read()
    return words_of(text), {name}.union(*(header(inner)[1] for inner in INCLUDED.findall(text)))


class Source:
    """A source: the names that it declares for itself or imports, the words in its code, its headers, its bytes."""

    def __init__(self, path):
        with open(path, encoding="utf-8") as file:
            text = file.read()
        self.path = path
        own = "".join(OWN.findall(text))
        self.declared = set(DECLARED.findall(own)) - {"void"}  # of a function's type
        for line in MARGIN_LINE.findall(text):
            self.declared.update(CONSTANT.findall(line))
        self.imported = set(IMPORTED.findall(text))
        self.words = words_of(text)
        self.headers = set().union(*(header(name)[1] for name in INCLUDED.findall(text)))
        self.size = len(text)

    def leaves_alone(self, other):
        """Whether none of this source's names means another thing in the other one, which stands behind it."""
        if self.declared & other.words or {name for name, _ in self.imported - other.imported} & other.words:
            return False
        return not any(self.declared & header(name)[0] for name in other.headers - self.headers)

    def agrees_with(self, other):
        return self.leaves_alone(other) and other.leaves_alone(self)


def units_of(paths, most=SOURCES_A_UNIT, most_bytes=BYTES_A_UNIT):
    """The paths in lists of at most `most` that have `most_bytes` together and agree with each other."""
    units = []
    for source in map(Source, paths):
        for unit in units:
            if (len(unit) < most and sum(other.size for other in unit) + source.size <= most_bytes
                    and all(source.agrees_with(other) for other in unit)):
                unit.append(source)
                break
        else:
            units.append([source])
    return [[source.path for source in unit] for unit in units]


def cmake_lines(paths):
    """A line for each unit of several sources; each folder has its own."""
    folders = {}
    for path in paths:
        folders.setdefault(os.path.dirname(path), []).append(path)
    lines = []
    for folder, inside in folders.items():
        name = "_".join(folder.split(os.sep)[-2:])
        for number, unit in enumerate(units_of(inside)):
            if len(unit) > 1:
                listed = " ".join(f'"{path}"' for path in unit)
                lines.append(f"set_source_files_properties({listed} PROPERTIES UNITY_GROUP {name}_{number})\n")
    return "".join(lines)


def write(output, paths):
    lines = cmake_lines(paths)
    if os.path.exists(output):
        with open(output, encoding="utf-8") as old:
            if old.read() == lines:
                return
    with open(output, "w", encoding="utf-8") as new:
        new.write(lines)


if __name__ == "__main__":
    write(sys.argv[1], sys.argv[2:])
