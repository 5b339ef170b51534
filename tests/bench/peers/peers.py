#!/usr/bin/env python3
"""Renders a scene file with Lightloom, Cycles and Embree's path tracer, in turn, and prints how their times compare.

    tests/bench/peers/peers.py [--lightloom FILE] [--scene FILE] [--camera NAME] [--tables LIST] [--rounds N] ...

Needs Debian's packages blender and embree-tools; a peer that is not installed is left out, loudly. docs/performance.md
("Beside Cycles and Embree") says what is compared and how. --help lists the options.
"""

import argparse
import json
import os
import sys

import error_table
import peer_scene
import renderers
import speed_table

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(os.path.dirname(HERE)))
SPONZA = os.path.join(ROOT, "..", "shared", "scenes", "sponza.scene.json")
ATRIUM = os.path.join(ROOT, "samples", "scenes", "atrium.scene.json")
TABLES = {
    "speed": speed_table.make,
    "first_frame": speed_table.first_frame,
    "references": error_table.references,
    "error": error_table.make,
}


def say(text):
    print(text, file=sys.stderr, flush=True)


def size_of(text):
    width, _, height = text.partition("x")
    if not (width.isdigit() and height.isdigit() and int(width) > 0 and int(height) > 0):
        raise argparse.ArgumentTypeError(f"'{text}' is no size; WIDTHxHEIGHT is expected, such as 640x480")
    return int(width), int(height)


def tables_of(text):
    names = text.split(",")
    unknown = [name for name in names if name not in TABLES]
    if unknown:
        raise argparse.ArgumentTypeError(f"there is no table '{unknown[0]}', only {', '.join(TABLES)}")
    return names


def counts_of(text):
    numbers = [int(part) if part.isdigit() else 0 for part in text.split(",")]
    if 0 in numbers or numbers != sorted(set(numbers)):
        raise argparse.ArgumentTypeError(f"'{text}' is no list of ascending counts such as 1,2,4,8")
    return numbers


def positive(text):
    if not text.isdigit() or int(text) < 1:
        raise argparse.ArgumentTypeError(f"'{text}' is no positive integer")
    return int(text)


def options():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    add = parser.add_argument
    add("--lightloom", default=os.path.join(ROOT, "build", "lightloom"), help="the program (default: build/lightloom)")
    add("--scene", help="scene file (default: Sponza of ../shared/scenes, or the committed atrium)")
    add("--camera", help="camera of the scene file (default: its first)")
    add("--materials", choices=[peer_scene.LAMBERT, peer_scene.AS_IN_FILE], default=peer_scene.LAMBERT,
        help="lambert: base colours alone, the same light for all; file: gloss as each renderer understands it")
    add("--tables", type=tables_of, default=list(TABLES), help=f"of {','.join(TABLES)} (default: all)")
    add("--size", type=size_of, default=(640, 480), help="pixels (default: 640x480)")
    add("--paths", type=positive, default=15, help="paths a pixel of the speed table (default: 15)")
    add("--vertices", type=positive, default=5, help="vertices of a path on surfaces (default: 5)")
    add("--rounds", type=positive, default=3, help="rounds of the speed table (default: 3)")
    add("--samples", type=counts_of, default=[1, 2, 4, 8, 16, 32], help="of Cycles' curve (default: 1,2,4,8,16,32)")
    add("--frames", type=counts_of, default=[1, 4, 10], help="of Lightloom's curve (default: 1,4,10)")
    add("--reference-samples", type=positive, default=128, help="paths of both references (default: 128)")
    add("--set", action="append", default=[], metavar="NAME=VALUE", help="parameter of graphs/lightloom.json")
    add("--work", default=os.path.join(ROOT, "out", "peers"), help="folder for files; references stay there")
    add("--picture", help="PNG file of the error table's pictures side by side")
    add("--exposure", type=float, default=2.0, help="of that picture (default: 2)")
    add("--json", help="write all figures into this file")
    return parser.parse_args()


class Peers:
    """The renderers, ready on one derived scene; a peer that is not there is None."""

    def __init__(self, choice, scene_file):
        self.choice, self.scene_file = choice, scene_file
        name = os.path.basename(scene_file).split(".")[0]
        self.folder = os.path.join(os.path.abspath(choice.work), f"{name}_{choice.materials}")
        self.description = peer_scene.derive(scene_file, choice.materials, self.folder)
        self.camera = choice.camera or next(iter(self.description["cameras"]))
        if self.camera not in self.description["cameras"]:
            names = ", ".join(self.description["cameras"])
            raise peer_scene.UnsupportedScene(f"{scene_file} has no camera '{self.camera}', only {names}")
        self.bounces = choice.vertices - 1
        self.lightloom = renderers.Lightloom(choice.lightloom, ROOT, self.folder, self.camera, choice.size)
        self.cycles = self._try(lambda: renderers.Cycles(self.folder, self.camera, choice.size))
        self.embree = self._try(self._make_embree) if self.cycles else None

    def _try(self, make):
        try:
            return make()
        except renderers.PeerMissing as missing:
            say(f"LEFT OUT: {missing}")
            return None

    def _make_embree(self):
        angle = self.description.get("sun", {}).get("angular_radius_degrees", 0.25)
        solid_angle = peer_scene.cone_solid_angle(angle)
        embree = renderers.Embree(self.folder, self.description, self.camera, self.choice.size, solid_angle)
        peer_scene.write_obj(self.folder, self.cycles.textures())
        return embree

    def out(self, *names):
        path = os.path.join(self.folder, *names)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        return path

    def lightloom_options(self):
        words = ["--set", f"bounces={self.bounces}"]
        for setting in self.choice.set:
            words += ["--set", setting]
        return words

    def close(self):
        if self.cycles:
            self.cycles.close()


def scene_file_of(choice):
    if choice.scene:
        return choice.scene
    if os.path.exists(SPONZA):
        return SPONZA
    say(f"SPONZA IS NOT HERE ({os.path.relpath(SPONZA)}): the figures are those of the committed atrium")
    return ATRIUM


def main():
    choice = options()
    scene_file = scene_file_of(choice)
    if not os.access(choice.lightloom, os.X_OK):
        say(f"'{choice.lightloom}' is no program; build it, or name it with --lightloom")
        return 2
    peers, figures = None, {}
    try:
        peers = Peers(choice, scene_file)
        width, height = choice.size
        print(f"{os.path.basename(scene_file)}, camera {peers.camera}, {width}x{height}, "
              f"materials: {choice.materials}, {choice.vertices} vertices a path, {os.cpu_count()} cores\n", flush=True)
        for table in choice.tables:
            text, figures[table] = TABLES[table](peers, say)
            print(text + "\n", flush=True)
    except (peer_scene.UnsupportedScene, renderers.PeerFailed, OSError) as problem:
        say(str(problem))
        return 1
    finally:
        if peers:
            peers.close()
    if choice.json:
        peer_scene.write_json(choice.json, figures)
    return 0


if __name__ == "__main__":
    sys.exit(main())
