"""A run folder and its dumps."""
import json
import os

import numpy as np


class Missing(Exception):
    """Something that the run folder does not hold."""


class Run:
    """A run folder: its record, and dumped values by name and frame."""

    def __init__(self, folder):
        self.folder = folder
        self.record = self.read_json("run.json")
        self.index = self.read_json("dumps/index.json")
        self.frames = {entry["frame"]: entry for entry in self.index["frames"]}

    def path(self, relative):
        path = os.path.join(self.folder, relative)
        if not os.path.isfile(path):
            raise Missing(f"'{path}' is missing; render with --dump '*' --dump-format npy")
        return path

    def read_json(self, relative):
        with open(self.path(relative), encoding="utf-8") as file:
            return json.load(file)

    def read_array(self, relative):
        if not relative.endswith(".npy"):
            raise Missing(f"'{relative}' is no NumPy array; render with --dump-format npy")
        return np.load(self.path(relative))

    def frame(self, number):
        if number not in self.frames:
            raise Missing(f"frame {number} has no dumps")
        return self.frames[number]

    def conditions(self, number):
        return self.read_json(self.frame(number)["conditions"])

    def value(self, name, frame):
        files = self.frame(frame)["files"]
        if name not in files:
            raise Missing(f"the value '{name}' was not dumped; render with --dump '*'")
        array = self.read_array(files[name])
        return array.astype(np.float64) if array.dtype.kind == "f" else array

    def passes(self, kind):
        """Passes of that type, those that ran once included."""
        both = self.record["passes"] + self.record["hoisted"]
        return [entry for entry in both if entry["type"] == kind]


class Pass:
    """One pass in one frame: its params and the values that it read."""

    def __init__(self, run, entry, frame):
        self.run, self.frame = run, frame
        self.name, self.params, self.inputs = entry["pass"], entry["params"], entry["inputs"]

    def has(self, port):
        return port in self.inputs

    def read(self, port, age=0):
        """An input as it was `age` frames ago; for a history input, of that age."""
        return self.run.value(self.inputs[port].split("@")[0], self.frame - age)

    def ages(self, port):
        first, _, last = self.inputs[port].split("@")[1].partition("..")
        return range(int(first), int(last or first) + 1)

    def written(self, port):
        return self.run.value(f"{self.name}.{port}", self.frame)
