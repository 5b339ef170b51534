#!/usr/bin/env python3
"""clang_tidy.py BUILD_FOLDER SOURCE...: clang-tidy over the sources, on all cores; prints what it finds and fails then.

Most of its time goes into system headers, so that sources compiled with the same flags are looked at some at a time, as
one translation unit that includes them, as the build does (framework/build/units.py); where they cannot stand in one unit,
it is halved."""

import concurrent.futures
import json
import os
import shlex
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.realpath(__file__))
sys.path.insert(0, os.path.join(HERE, "../../framework/build"))
from units import units_of  # pylint: disable=wrong-import-position


def flags_of(entry):
    """The command of a source without its own name and without what it writes, and the folder it runs in."""
    words = entry.get("arguments") or shlex.split(entry["command"])
    kept = []
    skip = False
    for word in words:
        if skip:
            skip = False
        elif word in ("-o", "-MF", "-MT", "-MQ"):
            skip = True
        elif word not in ("-c", "-MD", "-MMD") and os.path.join(entry["directory"], word) != entry["file"]:
            kept.append(word)
    return entry["directory"], tuple(kept)


def compiled_by(entry):
    """The sources that a command compiles: its own, or those that its unit includes."""
    if "/Unity/" not in entry["file"]:
        return [os.path.realpath(entry["file"])]
    with open(entry["file"], encoding="utf-8") as unit:
        return [os.path.realpath(line.split('"')[1]) for line in unit if line.startswith("#include")]


def tidy(folder, flags, sources, extra):
    """What clang-tidy, or the compiler with `extra`, says about one unit of sources: (status, text)."""
    name = os.path.join(folder, f"unit_{abs(hash(tuple(sources)))}_{len(extra)}.cpp")
    with open(name, "w", encoding="utf-8") as unit:
        unit.writelines(f'#include "{source}"\n' for source in sources)
    directory, words = flags
    # Commands begin with the compiler, behind its cache where there is one.
    words = [word for word in words if os.path.basename(word) != "ccache"]
    config = f"--config-file={os.path.join(HERE, '../../.clang-tidy')}"
    done = subprocess.run(["clang-tidy", "--quiet", config, *extra, name, "--", *words[1:]],
                          cwd=directory, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
    return done.returncode, done.stdout


def findings(folder, flags, sources):
    """The findings in the sources, as text; empty where there are none."""
    # An include of a source is what a unit is made of.
    status, text = tidy(folder, flags, sources, ["--checks=-bugprone-suspicious-include"])
    if status == 0:
        return ""
    if len(sources) == 1:
        return text
    half = len(sources) // 2
    return findings(folder, flags, sources[:half]) + findings(folder, flags, sources[half:])


def main():
    build, *sources = sys.argv[1:]
    with open(os.path.join(build, "compile_commands.json"), encoding="utf-8") as commands:
        entries = {source: entry for entry in json.load(commands) for source in compiled_by(entry)}
    missing = [source for source in sources if os.path.realpath(source) not in entries]
    if missing:
        sys.exit(f"{missing[0]} is compiled by nobody; {len(missing)} such in all")
    alike = {}
    for source in sources:
        alike.setdefault(flags_of(entries[os.path.realpath(source)]), []).append(source)
    units = [(flags, unit) for flags, members in alike.items() for unit in units_of(members, most=12)]
    # The longest first, so that no core waits for one at the end.
    units.sort(key=lambda unit: -len(unit[1]))
    with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        found = [text for text in pool.map(lambda unit: findings(folder, *unit), units) if text]
    print("".join(found) or f"{len(sources)} sources in {len(units)} units: nothing found")
    sys.exit(1 if found else 0)


main()
