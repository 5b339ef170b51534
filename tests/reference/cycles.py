"""Renders the Lambertian parts of a glTF file with Blender's Cycles, for a second opinion on reference_path_trace.

    blender -b -noaudio -P tests/reference/cycles.py -- SCENE.gltf OUT.exr WIDTH HEIGHT PATHS BOUNCES SEED

Every material becomes a diffuse surface that emits on both sides. The image is linear, in W m^-2 sr^-1, with a box
filter of one pixel, and comparable with

    lightloom render graphs/reference.json --scene SCENE.gltf --size WIDTHxHEIGHT --set paths=PATHS \
        --set bounces=BOUNCES --set trace.pixel_filter=box

Made with Blender 3.4.1.
"""

import json
import sys

import numpy

# Blender 3.4's glTF importer names types that NumPy has dropped since.
numpy.bool, numpy.int, numpy.float = bool, int, float

import bpy  # noqa: E402


def replace_material(material, description):
    nodes, links = material.node_tree.nodes, material.node_tree.links
    nodes.clear()
    output = nodes.new("ShaderNodeOutputMaterial")
    diffuse = nodes.new("ShaderNodeBsdfDiffuse")
    diffuse.inputs["Color"].default_value = description["pbrMetallicRoughness"].get("baseColorFactor", [1] * 4)
    diffuse.inputs["Roughness"].default_value = 0
    strength = description.get("extensions", {}).get("KHR_materials_emissive_strength", {}).get("emissiveStrength", 1)
    emission = nodes.new("ShaderNodeEmission")
    factor = description.get("emissiveFactor", [0] * 3)
    emission.inputs["Color"].default_value = [channel * strength for channel in factor] + [1]
    emission.inputs["Strength"].default_value = 1
    both = nodes.new("ShaderNodeAddShader")
    links.new(diffuse.outputs[0], both.inputs[0])
    links.new(emission.outputs[0], both.inputs[1])
    links.new(both.outputs[0], output.inputs[0])


def make_unbiased(cycles, paths, bounces, seed):
    cycles.device = "CPU"
    cycles.samples = paths
    cycles.seed = seed
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    cycles.max_bounces = cycles.diffuse_bounces = cycles.min_light_bounces = bounces
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = cycles.light_sampling_threshold = 0
    cycles.blur_glossy = 0
    cycles.pixel_filter_type = "BOX"
    cycles.filter_width = 1


def main(source, out, width, height, paths, bounces, seed):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=source)
    with open(source, encoding="utf-8") as file:
        descriptions = {material["name"]: material for material in json.load(file)["materials"]}
    for material in bpy.data.materials:
        replace_material(material, descriptions[material.name])
    scene = bpy.context.scene
    scene.camera = next(thing for thing in bpy.data.objects if thing.type == "CAMERA")
    scene.world = bpy.data.worlds.new("black")
    scene.world.use_nodes = True
    scene.world.node_tree.nodes["Background"].inputs["Strength"].default_value = 0
    scene.render.engine = "CYCLES"
    make_unbiased(scene.cycles, int(paths), int(bounces), int(seed))
    scene.render.resolution_x, scene.render.resolution_y = int(width), int(height)
    scene.render.resolution_percentage = 100
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    scene.render.filepath = out
    bpy.ops.render.render(write_still=True)


main(*sys.argv[sys.argv.index("--") + 1 :])
