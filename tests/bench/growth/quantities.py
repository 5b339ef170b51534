"""What grows, over which range, and how each point is measured."""

import dataclasses
import json
import pathlib
import typing

import scenes

ROOT = pathlib.Path(__file__).resolve().parents[3]
GRAPH = ROOT / "graphs" / "lightloom.json"
DENOISERS = ("temporal", "denoise")
VOXELS = ("voxelize", "merge", "distance", "emissive_faces")

COPY_SHADER = """#version 460
#extension GL_EXT_samplerless_texture_functions : require
layout(local_size_x = 8, local_size_y = 8) in;
uniform texture2D source;
uniform writeonly image2D out_result;
void main() {
  ivec2 at = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(at, imageSize(out_result)))) return;
  imageStore(out_result, at, texelFetch(source, at, 0) + vec4(1.0));
}
"""


@dataclasses.dataclass
class Quantity:
    name: str
    points: list
    long_points: list
    measure: typing.Callable  # of a Bench and a point; returns the size reached and {what: value}


def size_options(width, height, resolution=64):
    return ("--size", f"{width}x{height}", "--trace-size", f"{width}x{height}", "--set", f"resolution={resolution}")


def pixels(bench, width):
    height = width * 3 // 4
    figures = bench.run(GRAPH, scenes.plain_scene(bench.folder), *size_options(width, height))
    return width * height, {"frame [ms]": figures.frame(), "trace [ms]": figures.passes_together("trace"),
                            "accumulation and denoiser [ms]": figures.passes_together(*DENOISERS),
                            "images and voxels [MiB]": figures.values()}


def of_param(param):
    def measure(bench, value):
        figures = bench.run(GRAPH, scenes.plain_scene(bench.folder), *size_options(160, 120),
                            "--set", f"{param}={value}")
        return value, {"frame [ms]": figures.frame(), "trace [ms]": figures.passes["trace"],
                       "images and voxels [MiB]": figures.values()}
    return measure


def of_triangles(make):
    def measure(bench, count):
        scene = make(bench.folder, count)
        figures = bench.run(GRAPH, scene, *size_options(64, 48))
        values = {"load [ms]": figures.load(), "upload [ms]": figures.setup(), "frame [ms]": figures.frame(),
                  "gather [ms]": figures.passes["gather"], "trace [ms]": figures.passes["trace"],
                  "voxelize, once [ms]": figures.once("voxelize_static"), "process [MiB]": figures.peak()}
        remove(scene)
        return figures.data["scene"]["triangles"], values
    return measure


def loaded_triangles(bench, count):
    """Reading alone, for more triangles than a buffer of some devices may hold."""
    scene = scenes.triangles_scene(bench.folder, count)
    milliseconds, mebibytes = bench.time_of(["scene", str(scene)])
    remove(scene)
    return count, {"`lightloom scene` [ms]": milliseconds, "process [MiB]": mebibytes}


def remove(scene):
    for suffix in (".scene.json", ".gltf", ".bin"):
        (scene.parent / scene.name.replace(".scene.json", suffix)).unlink()


def voxels(bench, resolution):
    """One small box moves. The room is half as high as wide: the number is that of a cube."""
    figures = bench.run(GRAPH, scenes.moving_scene(bench.folder, 1), *size_options(64, 48, resolution))
    return resolution ** 3, {
        "voxel passes, every frame [ms]": figures.passes_together(*VOXELS),
        "voxelize_dynamic": figures.passes["voxelize_dynamic"], "merge": figures.passes["merge"],
        "distance": figures.passes["distance"], "emissive_faces": figures.passes["emissive_faces"],
        "trace [ms]": figures.passes["trace"], "voxelize_static, once [ms]": figures.once("voxelize_static"),
        "images and voxels [MiB]": figures.values()}


def whole_voxels(bench, resolution):
    """All voxels are made anew in every frame."""
    figures = bench.run(GRAPH, scenes.moving_scene(bench.folder, 1), *size_options(64, 48, resolution), "--set",
                        "voxelize_dynamic.update=all", "--set", "merge.update=all", "--set", "distance.update=all",
                        "--set", "emissive_faces.update=all")
    return resolution ** 3, {"voxel passes with `update` all [ms]": figures.passes_together(*VOXELS),
                                  "emissive_faces": figures.passes["emissive_faces"]}


def lights(bench, count):
    figures = bench.run(GRAPH, scenes.lights_scene(bench.folder, count), *size_options(64, 48))
    return count, {"load [ms]": figures.load(), "frame [ms]": figures.frame(), "gather [ms]": figures.passes["gather"],
                   "trace [ms]": figures.passes["trace"],
                   "emissive_faces, once [ms]": figures.once("emissive_faces"), "process [MiB]": figures.peak()}


def moving(make):
    def measure(bench, count):
        figures = bench.run(GRAPH, make(bench.folder, count), *size_options(64, 48))
        return count, {"load [ms]": figures.load(), "frame [ms]": figures.frame(),
                       "voxel passes [ms]": figures.passes_together(*VOXELS),
                       "process [MiB]": figures.peak()}
    return measure


def passes(bench, count):
    """A chain of compute nodes on 8 x 8 texels."""
    (bench.folder / "copy.comp").write_text(COPY_SHADER)
    graph = {"lightloom": 1, "name": "chain", "view": {"width": 8, "height": 8}, "trace": {"width": 8, "height": 8},
             "passes": {"p0": {"type": "gather"}}, "outputs": {}}
    source = "p0.surface.normal"
    for k in range(1, count):
        graph["passes"][f"p{k}"] = {"type": "compute", "shader": "copy.comp", "in": {"source": source}}
        source = f"p{k}.result"
    graph["outputs"]["radiance"] = source
    path = bench.folder / "chain.json"
    path.write_text(json.dumps(graph))
    # With no-hoist each of them runs in every frame.
    figures = bench.run(path, scenes.plain_scene(bench.folder), "--no-hoist")
    return count, {"plan [ms]": figures.plan(), "set up [ms]": figures.setup(), "frame [ms]": figures.frame(),
                   "process [MiB]": figures.peak()}


ALL = {
    "pixels": Quantity("pixels", [80, 160, 320, 640], [1280, 1920], pixels),
    "paths": Quantity("paths a pixel", [1, 4, 16], [64, 256], of_param("paths")),
    "bounces": Quantity("bounces", [1, 2, 4, 8], [16, 64], of_param("bounces")),
    "triangles": Quantity("triangles, each its own", [1000, 10_000, 100_000, 1_000_000], [3_000_000, 10_000_000],
                          of_triangles(scenes.triangles_scene)),
    "instances": Quantity("triangles, in instances", [1000, 10_000, 100_000, 1_000_000], [3_000_000, 10_000_000],
                          of_triangles(scenes.instances_scene)),
    "loading": Quantity("triangles that are read", [100_000, 1_000_000], [3_000_000, 10_000_000], loaded_triangles),
    "voxels": Quantity("voxels, a small box moves", [64, 128, 256], [512], voxels),
    "whole_voxels": Quantity("voxels, all anew", [64, 128], [256], whole_voxels),
    "lights": Quantity("emissive triangles", [10, 100, 1000, 10_000, 100_000], [], lights),
    "moving": Quantity("moving objects, one animation", [1, 10, 100, 1000], [], moving(scenes.moving_scene)),
    "moving_instances": Quantity("moving objects, each an instance", [1, 10, 100], [1000],
                                 moving(scenes.moving_instances_scene)),
    "passes": Quantity("passes of a graph", [10, 100, 1000], [10_000], passes),
}
