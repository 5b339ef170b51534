"""A scene file made comparable: what Lightloom, Cycles and Embree's path tracer all render, in files for each of them.

Normal maps, alpha masks, one-sidedness, animation, instances and punctual lights are not in that subset. With
materials "lambert", neither are gloss and metal: then all three compute the same light.
"""

import json
import math
import os
import shutil
import struct

COMPONENTS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}
FORMATS = {5121: "B", 5123: "H", 5125: "I", 5126: "f"}
LAMBERT, AS_IN_FILE = "lambert", "file"


class UnsupportedScene(Exception):
    """What the peers cannot be given, in one sentence."""


def read_json(file):
    with open(file, encoding="utf-8") as stream:
        return json.load(stream)


def write_json(file, data):
    with open(file, "w", encoding="utf-8") as stream:
        json.dump(data, stream, indent=1)


def check_scene(description, name):
    if not str(description.get("gltf", "")).endswith(".gltf"):
        raise UnsupportedScene(f"{name}: the peers need a scene file whose \"gltf\" names a .gltf file")
    if description.get("instances"):
        raise UnsupportedScene(f"{name}: \"instances\" are not handed to the peers; compare a scene without")
    if "radiance" not in description.get("environment", {"radiance": 0}):
        raise UnsupportedScene(f"{name}: the peers are given constant environments only; \"environment\" has an image")
    if not description.get("cameras"):
        raise UnsupportedScene(f"{name}: the peers need a camera in the scene file (\"cameras\")")


def simplify_material(material, materials):
    """The material without what a peer lacks; Lambertian if that is asked for."""
    material.pop("normalTexture", None)
    material.pop("occlusionTexture", None)
    material.pop("alphaCutoff", None)
    material["alphaMode"] = "OPAQUE"
    material["doubleSided"] = True
    extensions = material.get("extensions", {})
    extensions.pop("KHR_materials_anisotropy", None)
    if materials == LAMBERT:
        metallic_roughness = material.setdefault("pbrMetallicRoughness", {})
        metallic_roughness.pop("metallicRoughnessTexture", None)
        metallic_roughness.update(metallicFactor=0.0, roughnessFactor=1.0)
        extensions["KHR_materials_specular"] = {"specularFactor": 0}
    material["extensions"] = extensions


def simplify(gltf, materials):
    if gltf.get("skins"):
        raise UnsupportedScene("scenes with skins are not handed to the peers; compare a scene without")
    gltf.pop("animations", None)
    for material in gltf.get("materials", []):
        simplify_material(material, materials)
    used = {name for material in gltf.get("materials", []) for name in material["extensions"]}
    gltf["extensionsUsed"] = sorted(used)
    gltf.pop("extensionsRequired", None)
    for node in gltf["nodes"]:
        node.pop("extensions", None)
    gltf.pop("extensions", None)
    return gltf


def derive(scene_file, materials, folder):
    """Writes scene.scene.json and scene.gltf with its files into the folder and returns the scene's description."""
    description = read_json(scene_file)
    check_scene(description, scene_file)
    source = os.path.join(os.path.dirname(scene_file), description["gltf"])
    gltf = simplify(read_json(source), materials)
    os.makedirs(folder, exist_ok=True)
    for part in gltf.get("buffers", []) + gltf.get("images", []):
        if "uri" not in part or part["uri"].startswith("data:"):
            raise UnsupportedScene(f"{source}: the peers need buffers and images in files of their own")
        copy = os.path.join(folder, part["uri"])
        os.makedirs(os.path.dirname(copy), exist_ok=True)
        shutil.copyfile(os.path.join(os.path.dirname(source), part["uri"]), copy)
        os.chmod(copy, 0o644)
    write_json(os.path.join(folder, "scene.gltf"), gltf)
    description["gltf"] = "scene.gltf"
    description.pop("$schema", None)
    write_json(os.path.join(folder, "scene.scene.json"), description)
    return description


# Matrices are lists of four rows.


def product(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(4)) for j in range(4)] for i in range(4)]


def rotation(quaternion):
    x, y, z, w = quaternion
    return [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w), 0],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w), 0],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y), 0],
        [0, 0, 0, 1],
    ]


def local_matrix(node):
    if "matrix" in node:
        m = node["matrix"]
        return [[m[column * 4 + row] for column in range(4)] for row in range(4)]
    scale = node.get("scale", [1, 1, 1])
    translation = node.get("translation", [0, 0, 0])
    matrix = rotation(node.get("rotation", [0, 0, 0, 1]))
    return [[matrix[i][j] * scale[j] for j in range(3)] + [translation[i]] for i in range(3)] + [[0, 0, 0, 1]]


def world_meshes(gltf):
    """Pairs of a mesh's index and the matrix that takes it to the world."""
    identity = [[float(i == j) for j in range(4)] for i in range(4)]
    found = []

    def visit(index, parent):
        node = gltf["nodes"][index]
        matrix = product(parent, local_matrix(node))
        if "mesh" in node:
            found.append((node["mesh"], matrix))
        for child in node.get("children", []):
            visit(child, matrix)

    for root in gltf["scenes"][gltf.get("scene", 0)]["nodes"]:
        visit(root, identity)
    return found


def accessor_values(gltf, buffers, index):
    """The accessor's elements as tuples."""
    accessor = gltf["accessors"][index]
    view = gltf["bufferViews"][accessor["bufferView"]]
    layout = "<" + FORMATS[accessor["componentType"]] * COMPONENTS[accessor["type"]]
    stride = view.get("byteStride", struct.calcsize(layout))
    first = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
    data = buffers[view["buffer"]]
    return [struct.unpack_from(layout, data, first + i * stride) for i in range(accessor["count"])]


def phong_exponent(perceptual_roughness):
    """Exponent of a Phong lobe about as wide as a microfacet lobe of this perceptual roughness."""
    alpha = max(perceptual_roughness, 0.03) ** 2
    return max(2 / (alpha * alpha) - 2, 1)


def mtl_text(gltf, textures):
    """Materials for Embree's OBJ reader; textures are file names by the index of their image."""
    lines = []
    for index, material in enumerate(gltf.get("materials", [])):
        surface = material.get("pbrMetallicRoughness", {})
        colour = surface.get("baseColorFactor", [1, 1, 1, 1])[:3]
        metal = surface.get("metallicFactor", 1.0)
        lambert = material["extensions"].get("KHR_materials_specular", {}).get("specularFactor", 1) == 0
        gloss = [0.0] * 3 if lambert else [0.04 * (1 - metal) + metal * value for value in colour]
        lines.append(f"newmtl material{index}")
        lines.append("Kd " + " ".join(f"{(1 - metal) * value:.6g}" for value in colour))
        lines.append("Ks " + " ".join(f"{value:.6g}" for value in gloss))
        lines.append(f"Ns {phong_exponent(surface.get('roughnessFactor', 1.0)):.6g}")
        if "baseColorTexture" in surface:
            image = gltf["textures"][surface["baseColorTexture"]["index"]]["source"]
            lines.append(f"map_Kd {textures[image]}")
    return "\n".join(lines) + "\n"


def write_primitive(stream, gltf, buffers, primitive, matrix, base):
    """One primitive's vertices and faces; returns how many vertices it has."""
    if primitive.get("mode", 4) != 4:
        raise UnsupportedScene("Embree's OBJ is written from triangle lists only; the scene has strips, fans or lines")
    attributes = primitive["attributes"]
    positions = accessor_values(gltf, buffers, attributes["POSITION"])
    for x, y, z in positions:
        stream.write("v %.7g %.7g %.7g\n" % tuple(r[0] * x + r[1] * y + r[2] * z + r[3] for r in matrix[:3]))
    coordinates = accessor_values(gltf, buffers, attributes["TEXCOORD_0"]) if "TEXCOORD_0" in attributes else []
    for u, v in coordinates or [(0, 0)] * len(positions):
        stream.write("vt %.7g %.7g\n" % (u, 1 - v))
    if "indices" in primitive:
        indices = [base + index for (index,) in accessor_values(gltf, buffers, primitive["indices"])]
    else:
        indices = list(range(base, base + len(positions)))
    stream.write(f"usemtl material{primitive.get('material', 0)}\n")
    for i in range(0, len(indices) - 2, 3):
        a, b, c = indices[i : i + 3]
        stream.write(f"f {a}/{a} {b}/{b} {c}/{c}\n")
    return len(positions)


def write_obj(folder, textures):
    """scene.obj and scene.mtl beside the scene.gltf of the folder."""
    gltf = read_json(os.path.join(folder, "scene.gltf"))
    buffers = []
    for buffer in gltf["buffers"]:
        with open(os.path.join(folder, buffer["uri"]), "rb") as stream:
            buffers.append(stream.read())
    with open(os.path.join(folder, "scene.mtl"), "w", encoding="utf-8") as stream:
        stream.write(mtl_text(gltf, textures))
    base = 1
    with open(os.path.join(folder, "scene.obj"), "w", encoding="utf-8") as stream:
        stream.write("mtllib scene.mtl\n")
        for mesh, matrix in world_meshes(gltf):
            for primitive in gltf["meshes"][mesh]["primitives"]:
                base += write_primitive(stream, gltf, buffers, primitive, matrix, base)


def cone_solid_angle(half_angle_degrees):
    """Solid angle of a cone [sr]; exact for small angles, too."""
    return 4 * math.pi * math.sin(math.radians(half_angle_degrees) / 2) ** 2
