#!/usr/bin/env python3
"""make_corpus.py: makes the seeds of tests/fuzz/corpus, which are small files that are right in many ways.

Findings of the fuzzers lie beside them, named finding_*; this program leaves those alone.
"""
import base64
import json
import pathlib
import shutil
import struct
import zlib

HERE = pathlib.Path(__file__).resolve().parent
CORPUS = HERE / "corpus"
REPOSITORY = HERE.parent.parent


def png(width, height, depth=8, kind=2, interlace=0):
    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))

    channels = {0: 1, 2: 3, 3: 1, 4: 2, 6: 4}[kind]
    row = b"\0" + bytes((width * channels * depth + 7) // 8)
    palette = chunk(b"PLTE", bytes(range(12))) if kind == 3 else b""
    header = struct.pack(">IIBBBBB", width, height, depth, kind, 0, 0, interlace)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + palette + chunk(b"IDAT", zlib.compress(row * height * (1 + interlace)))
            + chunk(b"IEND", b""))


def hdr(width, height):
    return b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n" % (height, width) + b"\x80\x80\x80\x81" * (width * height)


def exr(width, height, tiled=False):
    def attribute(name, kind, value):
        return name + b"\0" + kind + b"\0" + struct.pack("<I", len(value)) + value

    channels = b"".join(name + b"\0" + struct.pack("<IIII", 2, 0, 1, 1) for name in (b"B", b"G", b"R")) + b"\0"
    box = struct.pack("<iiii", 0, 0, width - 1, height - 1)
    header = (attribute(b"channels", b"chlist", channels) + attribute(b"compression", b"compression", b"\0")
              + attribute(b"dataWindow", b"box2i", box) + attribute(b"displayWindow", b"box2i", box)
              + attribute(b"lineOrder", b"lineOrder", b"\0") + attribute(b"pixelAspectRatio", b"float", struct.pack("<f", 1))
              + attribute(b"screenWindowCenter", b"v2f", struct.pack("<ff", 0, 0))
              + attribute(b"screenWindowWidth", b"float", struct.pack("<f", 1)))
    if tiled:
        header += attribute(b"tiles", b"tiledesc", struct.pack("<IIB", width, height, 0))
    magic = b"\x76\x2f\x31\x01" + struct.pack("<I", 0x202 if tiled else 2)
    begin = len(magic) + len(header) + 1
    row = bytes(width * 12)
    if tiled:
        chunks = [struct.pack("<iiiii", 0, 0, 0, 0, len(row) * height) + row * height]
    else:
        chunks = [struct.pack("<ii", y, len(row)) + row for y in range(height)]
    offsets, at = b"", begin + 8 * len(chunks)
    for chunk in chunks:
        offsets += struct.pack("<Q", at)
        at += len(chunk)
    return magic + header + b"\0" + offsets + b"".join(chunks)


def npy(kind, shape, size):
    text = "{'descr': '%s', 'fortran_order': False, 'shape': %s, }" % (kind, shape)
    text += " " * (63 - (10 + len(text)) % 64) + "\n"
    return b"\x93NUMPY\x01\0" + struct.pack("<H", len(text)) + text.encode() + bytes(size)


# 8 x 8 grey, baseline, by libjpeg; small enough to stand here.
JPEG = base64.b64decode(
    "/9j/4AAQSkZJRgABAQAAAQABAAD/2wBDAAgGBgcGBQgHBwcJCQgKDBQNDAsLDBkSEw8UHRofHh0aHBwgJC4nICIsIxwcKDcpLDAxNDQ0Hyc5PTgyPC4z"
    "NDL/wAALCAAIAAgBAREA/8QAHwAAAQUBAQEBAQEAAAAAAAAAAAECAwQFBgcICQoL/8QAtRAAAgEDAwIEAwUFBAQAAAF9AQIDAAQRBRIhMUEGE1FhByJx"
    "FDKBkaEII0KxwRVS0fAkM2JyggkKFhcYGRolJicoKSo0NTY3ODk6Q0RFRkdISUpTVFVWV1hZWmNkZWZnaGlqc3R1dnd4eXqDhIWGh4iJipKTlJWWl5iZmqKj"
    "pKWmp6ipqrKztLW2t7i5usLDxMXGx8jJytLT1NXW19jZ2uHi4+Tl5ufo6erx8vP09fb3+Pn6/9oACAEBAAA/AP/Z")


def gltf_parts():
    views, data = [], b""

    def accessor(values, kind, component, count):
        nonlocal data
        data += bytes(-len(data) % 4)
        packed = struct.pack("<%d%s" % (len(values), {5126: "f", 5123: "H"}[component]), *values)
        views.append({"buffer": 0, "byteOffset": len(data), "byteLength": len(packed)})
        data += packed
        return {"bufferView": len(views) - 1, "componentType": component, "type": kind, "count": count}

    accessors = [
        accessor([0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0], "VEC3", 5126, 4),
        accessor([0, 0, 1] * 4, "VEC3", 5126, 4),
        accessor([0, 1, 1, 1, 1, 0, 0, 0], "VEC2", 5126, 4),
        accessor([0, 1, 2, 0, 2, 3], "SCALAR", 5123, 6),
        accessor([0, 1, 0, 0] * 4, "VEC4", 5123, 4),
        accessor([1, 0, 0, 0] * 4, "VEC4", 5126, 4),
        accessor([0, 1], "SCALAR", 5126, 2),
        accessor([0, 5, 0, 0, 5, 4], "VEC3", 5126, 2),
        accessor([0, 0, 1] * 4, "VEC3", 5126, 4),
    ]
    return {"asset": {"version": "2.0"}, "bufferViews": views, "accessors": accessors,
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2}, "indices": 3}]}],
            "nodes": [{"mesh": 0}], "scenes": [{"nodes": [0]}], "scene": 0}, data


def rich(document):
    primitive = document["meshes"][0]["primitives"][0]
    primitive["attributes"].update({"JOINTS_0": 4, "WEIGHTS_0": 5})
    primitive["targets"] = [{"POSITION": 8}]
    primitive["material"] = 0
    document["accessors"][8]["sparse"] = {"count": 1, "indices": {"bufferView": 3, "componentType": 5123},
                                          "values": {"bufferView": 7}}
    document.update({
        "nodes": [{"mesh": 0, "skin": 0}, {"children": [2], "camera": 0, "extensions": {"KHR_lights_punctual": {"light": 0}}},
                  {"translation": [0, 5, 0], "rotation": [0, 0, 0, 1], "scale": [1, 1, 1]}],
        "scenes": [{"nodes": [0, 1]}],
        "skins": [{"joints": [1, 2]}],
        "cameras": [{"type": "perspective", "perspective": {"yfov": 1.0, "znear": 0.1}}],
        "extensionsUsed": ["KHR_lights_punctual"],
        "extensions": {"KHR_lights_punctual": {"lights": [{"type": "spot", "intensity": 3, "spot": {"outerConeAngle": 0.5}}]}},
        "images": [{"uri": "data:image/png;base64," + base64.b64encode(png(2, 2)).decode()}],
        "samplers": [{"wrapS": 33071}], "textures": [{"source": 0, "sampler": 0}],
        "materials": [{"name": "m", "alphaMode": "MASK", "normalTexture": {"index": 0},
                       "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}, "roughnessFactor": 0.5},
                       "emissiveFactor": [1, 1, 1], "extensions": {"KHR_materials_ior": {"ior": 1.4}}}],
        "animations": [{"samplers": [{"input": 6, "output": 7, "interpolation": "LINEAR"}],
                        "channels": [{"sampler": 0, "target": {"node": 2, "path": "translation"}}]}]})
    return document


def glb(document, data):
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    data += bytes(-len(data) % 4)
    return (b"glTF" + struct.pack("<II", 2, 28 + len(text) + len(data)) + struct.pack("<I", len(text)) + b"JSON" + text
            + struct.pack("<I", len(data)) + b"BIN\0" + data)


def embedded(document, data):
    uri = "data:application/octet-stream;base64," + base64.b64encode(data).decode()
    return json.dumps(document | {"buffers": [{"byteLength": len(data), "uri": uri}]}).encode()


def scene_files():
    document, data = gltf_parts()
    length = {"buffers": [{"byteLength": len(data)}]}
    scene = {"lightloom_scene": 1, "gltf": "quad.gltf", "instances": [{"gltf": "quad.gltf", "translation": [1, 0, 0]}],
             "cameras": {"a": {"eye": [0, 0, 3], "target": [0, 0, 0]}},
             "sun": {"direction": [0, -1, 0], "irradiance": [1, 1, 1]}, "environment": {"radiance": [1, 1, 1]}}
    path = {"lightloom_camera_path": 1, "keyframes": [{"time": t, "position": [t, 0, 0], "target": [t, 0, -1]} for t in range(3)]}
    return {"quad.gltf": embedded(document, data), "quad.glb": glb(document | length, data),
            "rich.gltf": embedded(rich(gltf_parts()[0]), data), "rich.glb": glb(rich(gltf_parts()[0]) | length, data),
            "a.scene.json": json.dumps(scene).encode(), "path.json": json.dumps(path).encode(),
            "outside.gltf": json.dumps(document | {"buffers": [{"byteLength": 9, "uri": "../../etc/passwd"}]}).encode()}


def pictures():
    return {"rgb.png": png(4, 3), "grey16.png": png(3, 3, 16, 0), "palette.png": png(4, 4, 2, 3), "interlaced.png": png(9, 9, 8, 6, 1),
            "huge.png": png(1, 1).replace(struct.pack(">II", 1, 1), struct.pack(">II", 100000, 100000)), "grey.jpg": JPEG,
            "a.hdr": hdr(4, 2), "a.exr": exr(3, 2), "tiled.exr": exr(4, 4, True), "f4.npy": npy("<f4", (2, 3, 4), 96),
            "u1.npy": npy("|u1", (2, 2, 2, 1), 8)}


def main():
    for folder, files in (("scene_file", scene_files()), ("image_header", pictures())):
        for name, content in files.items():
            (CORPUS / folder / name).write_bytes(content)
    for graph in ("paper", "lightloom", "reference"):
        shutil.copy(REPOSITORY / "graphs" / (graph + ".json"), CORPUS / "graph_file" / (graph + ".json"))
    for graph in ("bundles", "variants", "ranges", "conditions", "kinds", "no_bypass"):
        shutil.copy(REPOSITORY / "tests" / "graphs_bad" / (graph + ".json"), CORPUS / "graph_file" / (graph + ".json"))


if __name__ == "__main__":
    main()
