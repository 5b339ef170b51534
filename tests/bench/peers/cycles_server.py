"""Runs inside Blender: loads a derived scene once and renders it with Cycles as often as it is told to.

    blender -b -noaudio -P cycles_server.py -- FOLDER CAMERA WIDTH HEIGHT

Reads one JSON object a line from standard input and answers each with a line "PEERS {...}" on standard output:
{"do": "render", "samples": N, "bounces": B, "seed": S, "filter": width in pixels, "out": FILE or null, "denoise": bool}
gives the seconds of the render operator; {"do": "textures"} writes PPM files of linear light for Embree;
{"do": "picture", "files": [EXR, ...], "exposure": E, "out": PNG} puts images side by side at half their size.
"""

import json
import os
import sys
import time

import numpy

# Blender 3.4's glTF importer names types that NumPy has dropped since.
numpy.bool, numpy.int, numpy.float = bool, int, float

import bpy  # noqa: E402
import mathutils  # noqa: E402


def to_blender(vector):
    """glTF is y-up, Blender z-up."""
    return mathutils.Vector((vector[0], -vector[2], vector[1]))


def set_camera(scene, camera):
    data = bpy.data.cameras.new("peers")
    thing = bpy.data.objects.new("peers", data)
    eye, target = to_blender(camera["eye"]), to_blender(camera["target"])
    back = (eye - target).normalized()
    right = to_blender(camera.get("up", [0, 1, 0])).cross(back).normalized()
    matrix = mathutils.Matrix((right, back.cross(right), back)).transposed().to_4x4()
    matrix.translation = eye
    thing.matrix_world = matrix
    data.sensor_fit = "VERTICAL"
    data.angle = camera["vertical_fov_degrees"] * 3.141592653589793 / 180
    data.clip_start, data.clip_end = 1e-3, 1e5
    scene.collection.objects.link(thing)
    scene.camera = thing


def set_lights(scene, description):
    for thing in [thing for thing in bpy.data.objects if thing.type == "LIGHT"]:
        bpy.data.objects.remove(thing)
    if "sun" in description:
        sun = description["sun"]
        data = bpy.data.lights.new("sun", "SUN")
        data.energy, data.color = 1, sun["irradiance"]
        data.angle = 2 * sun["angular_radius_degrees"] * 3.141592653589793 / 180
        data.cycles.use_multiple_importance_sampling = True
        thing = bpy.data.objects.new("sun", data)
        thing.rotation_mode = "QUATERNION"
        thing.rotation_quaternion = to_blender(sun["direction"]).to_track_quat("-Z", "Y")
        scene.collection.objects.link(thing)
    scene.world = bpy.data.worlds.new("peers")
    scene.world.use_nodes = True
    background = scene.world.node_tree.nodes["Background"]
    background.inputs["Color"].default_value = description.get("environment", {}).get("radiance", [0] * 3) + [1]
    background.inputs["Strength"].default_value = 1


def make_lambertian(material, description):
    """A diffuse surface that has the importer's base colour, and emits as the file says."""
    nodes, links = material.node_tree.nodes, material.node_tree.links
    principled = next(node for node in nodes if node.type == "BSDF_PRINCIPLED")
    output = next(node for node in nodes if node.type == "OUTPUT_MATERIAL")
    diffuse = nodes.new("ShaderNodeBsdfDiffuse")
    colour = principled.inputs["Base Color"]
    diffuse.inputs["Color"].default_value = colour.default_value
    if colour.is_linked:
        links.new(colour.links[0].from_socket, diffuse.inputs["Color"])
    surface = diffuse.outputs[0]
    factor = description.get("emissiveFactor", [0] * 3)
    if any(factor):
        strength = description["extensions"].get("KHR_materials_emissive_strength", {}).get("emissiveStrength", 1)
        emission, both = nodes.new("ShaderNodeEmission"), nodes.new("ShaderNodeAddShader")
        emission.inputs["Color"].default_value = factor + [1]
        emission.inputs["Strength"].default_value = strength
        links.new(surface, both.inputs[0])
        links.new(emission.outputs[0], both.inputs[1])
        surface = both.outputs[0]
    links.new(surface, output.inputs["Surface"])
    nodes.remove(principled)


def set_cycles(scene, width, height):
    scene.render.engine = "CYCLES"
    scene.render.use_persistent_data = True
    scene.render.threads_mode = "AUTO"
    scene.render.resolution_x, scene.render.resolution_y = width, height
    scene.render.resolution_percentage = 100
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    cycles = scene.cycles
    cycles.device = "CPU"
    cycles.use_adaptive_sampling = cycles.use_denoising = cycles.use_auto_tile = False
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = cycles.light_sampling_threshold = 0
    cycles.blur_glossy = 0
    cycles.caustics_reflective = cycles.caustics_refractive = True
    cycles.pixel_filter_type = "BOX"


def render(scene, order):
    cycles, bounces = scene.cycles, order["bounces"]
    cycles.samples, cycles.seed = order["samples"], order["seed"]
    cycles.max_bounces = cycles.diffuse_bounces = cycles.glossy_bounces = bounces
    cycles.min_light_bounces = bounces
    cycles.filter_width = order["filter"]
    cycles.use_denoising = order.get("denoise", False)
    begin = time.perf_counter()
    bpy.ops.render.render(write_still=False)
    seconds = time.perf_counter() - begin
    if order.get("out"):
        bpy.data.images["Render Result"].save_render(order["out"])
    return {"seconds": seconds}


def write_textures(folder, images):
    """The colour textures as PPM files of linear light, by the index of their image in the glTF file."""
    names = {}
    for index, image in images.items():
        source = bpy.data.images.load(os.path.join(folder, image["uri"]))
        width, height = source.size
        encoded = numpy.array(source.pixels[:], dtype=numpy.float32).reshape(height, width, 4)[::-1, :, :3]
        linear = numpy.where(encoded <= 0.04045, encoded / 12.92, ((encoded + 0.055) / 1.055) ** 2.4)
        names[index] = f"texture{index}.ppm"
        with open(os.path.join(folder, names[index]), "wb") as stream:
            stream.write(b"P6\n%d %d\n255\n" % (width, height))
            stream.write((linear * 255 + 0.5).astype(numpy.uint8).tobytes())
        bpy.data.images.remove(source)
    return {"names": names}


def half_size(file, exposure):
    """Display values of a linear image, four pixels averaged into one."""
    source = bpy.data.images.load(file)
    width, height = (length // 2 * 2 for length in source.size)
    pixels = numpy.array(source.pixels[:], dtype=numpy.float32).reshape(source.size[1], source.size[0], -1)
    bpy.data.images.remove(source)
    pixels = pixels[:height, :width, :3].reshape(height // 2, 2, width // 2, 2, 3).mean((1, 3)) * exposure
    pixels = numpy.clip(pixels, 0, 1)
    return numpy.where(pixels <= 0.0031308, pixels * 12.92, 1.055 * pixels ** (1 / 2.4) - 0.055)


def write_picture(files, exposure, out):
    colours = numpy.concatenate([half_size(file, exposure) for file in files], axis=1)
    height, width = colours.shape[:2]
    picture = bpy.data.images.new("picture", width, height)
    picture.pixels = numpy.concatenate([colours, numpy.ones((height, width, 1))], axis=2).ravel().tolist()
    picture.filepath_raw, picture.file_format = out, "PNG"
    picture.save()
    return {"width": width, "height": height}


def colour_images(gltf):
    textures = [material.get("pbrMetallicRoughness", {}).get("baseColorTexture") for material in gltf["materials"]]
    indices = {gltf["textures"][texture["index"]]["source"] for texture in textures if texture}
    return {index: gltf["images"][index] for index in sorted(indices)}


def answer(data):
    print("PEERS " + json.dumps(data), flush=True)


def main(folder, camera, width, height):
    begin = time.perf_counter()
    with open(os.path.join(folder, "scene.scene.json"), encoding="utf-8") as file:
        description = json.load(file)
    with open(os.path.join(folder, "scene.gltf"), encoding="utf-8") as file:
        gltf = json.load(file)
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=os.path.join(folder, "scene.gltf"))
    scene = bpy.context.scene
    lambertian = {
        material["name"]: material
        for material in gltf["materials"]
        if material["extensions"].get("KHR_materials_specular", {}).get("specularFactor", 1) == 0
    }
    for material in bpy.data.materials:
        if material.name in lambertian:
            make_lambertian(material, lambertian[material.name])
    set_camera(scene, description["cameras"][camera])
    set_lights(scene, description)
    set_cycles(scene, int(width), int(height))
    answer({"loaded_seconds": time.perf_counter() - begin, "denoiser": bpy.app.build_options.cycles and has_oidn()})
    for line in sys.stdin:
        order = json.loads(line)
        if order["do"] == "render":
            answer(render(scene, order))
        elif order["do"] == "picture":
            answer(write_picture(order["files"], order["exposure"], order["out"]))
        elif order["do"] == "textures":
            answer(write_textures(folder, colour_images(gltf)))


def has_oidn():
    import _cycles

    return bool(_cycles.with_openimagedenoise)


main(*sys.argv[sys.argv.index("--") + 1 :])
