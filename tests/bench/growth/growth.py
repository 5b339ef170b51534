#!/usr/bin/env python3
"""Measures how time and memory grow with the size of the problem, one quantity at a time, and fits exponents.

    growth.py --lightloom build/lightloom                     every quantity, some minutes
    growth.py --lightloom build/lightloom --long              to the ends of the ranges
    growth.py --lightloom build/lightloom --only voxels       one quantity; may be repeated
    growth.py ... --keep points.json                          quantities that are in there are not measured again
    growth.py ... --write docs/performance.md                 puts the table in its place in the document
"""

import argparse
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time

import fit
import quantities

BEGIN = "<!-- growth table: begin -->"
END = "<!-- growth table: end -->"
MIB = 1024 * 1024
NOISE_MS = 2.0  # of this much more at the upper end, no exponent is asked for


class Bench:
    """Runs `lightloom bench` and picks the figures that grow."""

    def __init__(self, program, folder, frames):
        self.program = program
        self.folder = folder
        self.frames = frames

    def run(self, graph, scene, *options):
        command = [self.program, "bench", str(graph), "--scene", str(scene), "--json", "--warm-up", "2",
                   "--frames", f"0..{self.frames - 1}", *options]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise RuntimeError(f"{' '.join(command)}\n{done.stderr.strip()}")
        return Figures(json.loads(done.stdout))

    def time_of(self, arguments):
        """Wall time [ms] and peak memory [MiB] of a whole run of the program."""
        start = time.monotonic()
        process = subprocess.Popen([self.program, *arguments], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode != 0:
            raise RuntimeError(f"{self.program} {' '.join(arguments)} ended with {process.returncode}")
        return (time.monotonic() - start) * 1e3, usage.ru_maxrss / 1024


class Figures:
    def __init__(self, data):
        self.data = data
        self.passes = {name: times["median"] for name, times in data["passes"].items()}

    def frame(self):
        return self.data["frame_ms"]["median"]

    def passes_together(self, *names):
        """Medians of the passes whose names begin so."""
        return sum(time for name, time in self.passes.items() if name.startswith(names))

    def once(self, name):
        return self.data["once"]["hoisted"].get(name, self.passes.get(name, 0.0))

    def load(self):
        return self.data["scene_ms"]

    def setup(self):
        return self.data["once"]["setup_ms"]

    def plan(self):
        return self.data["once"]["plan_ms"]

    def values(self):
        return self.data["value_memory_bytes"] / MIB

    def peak(self):
        return self.data["host_peak_bytes"] / MIB


def text_of(value):
    if value >= 100:
        return f"{value:,.0f}"
    return f"{value:.3g}"


def exponent_text(slope):
    return "-" if slope is None else f"{slope:.2f}"


def rows_of(quantity, points):
    """Table rows of one quantity; `points` are (x, {what: value})."""
    rows = []
    for what in points[0][1]:
        series = [(x, values[what]) for x, values in points]
        if max(y for _, y in series) <= 0:
            continue
        top = fit.upper_exponent(series)
        rows.append((f"{quantity.name}, {text_of(series[0][0])} to {text_of(series[-1][0])}", what,
                     text_of(series[0][1]), text_of(series[-1][1]), exponent_text(fit.exponent(series)),
                     exponent_text(top), top, series))
    return rows


def table_of(rows):
    lines = ["| quantity | what | at the least | at the most | exponent | of the last decade |",
             "| --- | --- | --- | --- | --- | --- |"]
    previous = ""
    for name, what, low, high, slope, top, _, _ in rows:
        lines.append(f"| {name if name != previous else ''} | {what} | {low} | {high} | {slope} | {top} |")
        previous = name
    return "\n".join(lines)


def steep(rows, bound):
    """Rows that grow faster than `bound` at their upper end by more than noise."""
    return [(name, what, top) for name, what, _, _, _, _, top, series in rows
            if top is not None and top > bound and series[-1][1] - series[-2][1] > NOISE_MS]


def put_into(document, table):
    text = document.read_text()
    begin, end = text.find(BEGIN), text.find(END)
    if begin < 0 or end < begin:
        sys.exit(f"{document}: has no lines '{BEGIN}' and '{END}' between which the table goes")
    document.write_text(text[:begin] + BEGIN + "\n" + table + "\n" + text[end:])


def measured(bench, name, long):
    """All points of a quantity, each told as it is there."""
    quantity = quantities.ALL[name]
    points = []
    for x in quantity.points + (quantity.long_points if long else []):
        size, values = quantity.measure(bench, x)
        points.append((size, values))
        print(f"{name} {size}: " + ", ".join(f"{what} {text_of(y)}" for what, y in values.items()),
              file=sys.stderr, flush=True)
    return points


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--lightloom", default="build/lightloom", help="the program [default: %(default)s]")
    parser.add_argument("--only", action="append", choices=sorted(quantities.ALL), help="one quantity; may be repeated")
    parser.add_argument("--long", action="store_true", help="to the ends of the ranges")
    parser.add_argument("--frames", type=int, default=3, help="measured frames of each point [default: %(default)s]")
    parser.add_argument("--bound", type=float, default=1.1, help="largest exponent [default: %(default)s]")
    parser.add_argument("--keep", type=pathlib.Path, help="file of all points; quantities in it are not measured again")
    parser.add_argument("--write", type=pathlib.Path, help="document whose table is replaced")
    options = parser.parse_args()
    record = json.loads(options.keep.read_text()) if options.keep and options.keep.exists() else {}
    rows = []
    with tempfile.TemporaryDirectory(prefix="lightloom_growth_") as folder:
        bench = Bench(options.lightloom, pathlib.Path(folder), options.frames)
        for name in options.only or quantities.ALL:
            if name not in record:
                record[name] = measured(bench, name, options.long)
            if options.keep:
                options.keep.write_text(json.dumps(record, indent=1) + "\n")
            rows += rows_of(quantities.ALL[name], record[name])
    table = table_of(rows)
    print(table)
    if options.write:
        put_into(options.write, table)
    too_steep = steep(rows, options.bound)
    for name, what, top in too_steep:
        print(f"grows faster than linear: {what} with {name}, exponent {top:.2f}", file=sys.stderr)
    return 1 if too_steep else 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except RuntimeError as error:
        sys.exit(f"error: {error}")
