"""Writes glTF files with one binary buffer."""

import array
import json
import pathlib

FLOAT = 5126
UNSIGNED_INT = 5125
COMPONENTS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}


class GltfWriter:
    def __init__(self):
        self.json = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": []}], "nodes": [], "meshes": [],
                     "materials": [], "accessors": [], "bufferViews": [], "buffers": [{}]}
        self.chunks = []
        self.size = 0
        self.extensions = set()

    def accessor(self, values, kind, component=FLOAT, with_bounds=False):
        """Adds an array.array of floats or unsigned ints; returns the index of the accessor."""
        data = values.tobytes()
        width = COMPONENTS[kind]
        self.json["bufferViews"].append({"buffer": 0, "byteOffset": self.size, "byteLength": len(data)})
        accessor = {"bufferView": len(self.json["bufferViews"]) - 1, "componentType": component, "type": kind,
                    "count": len(values) // width}
        if with_bounds:
            accessor["min"] = [min(values[axis::width]) for axis in range(width)]
            accessor["max"] = [max(values[axis::width]) for axis in range(width)]
        self.chunks.append(data)
        self.size += len(data)
        self.json["accessors"].append(accessor)
        return len(self.json["accessors"]) - 1

    def material(self, color, emission=None, strength=1.0):
        material = {"pbrMetallicRoughness": {"baseColorFactor": [*color, 1.0], "metallicFactor": 0.0,
                                             "roughnessFactor": 1.0},
                    "extensions": {"KHR_materials_specular": {"specularFactor": 0.0}}}
        self.extensions.add("KHR_materials_specular")
        if emission:
            material["emissiveFactor"] = emission
            material["extensions"]["KHR_materials_emissive_strength"] = {"emissiveStrength": strength}
            self.extensions.add("KHR_materials_emissive_strength")
        self.json["materials"].append(material)
        return len(self.json["materials"]) - 1

    def mesh(self, positions, normals, indices, material):
        """Corners as flat arrays of floats ('f') and indices ('I')."""
        attributes = {"POSITION": self.accessor(positions, "VEC3", with_bounds=True),
                      "NORMAL": self.accessor(normals, "VEC3")}
        primitive = {"attributes": attributes, "material": material,
                     "indices": self.accessor(indices, "SCALAR", UNSIGNED_INT)}
        self.json["meshes"].append({"primitives": [primitive]})
        return len(self.json["meshes"]) - 1

    def node(self, mesh, translation=(0.0, 0.0, 0.0)):
        self.json["nodes"].append({"mesh": mesh, "translation": list(translation)})
        self.json["scenes"][0]["nodes"].append(len(self.json["nodes"]) - 1)
        return len(self.json["nodes"]) - 1

    def swing(self, tracks, seconds):
        """One animation that moves each (node, positions) through its positions, evenly spaced in time."""
        animation = {"samplers": [], "channels": []}
        times = {}
        for node, positions in tracks:
            count = len(positions)
            if count not in times:
                steps = array.array("f", [seconds * k / (count - 1) for k in range(count)])
                times[count] = self.accessor(steps, "SCALAR", with_bounds=True)
            flat = array.array("f", [x for position in positions for x in position])
            animation["samplers"].append({"input": times[count], "output": self.accessor(flat, "VEC3")})
            animation["channels"].append({"sampler": len(animation["samplers"]) - 1,
                                          "target": {"node": node, "path": "translation"}})
        self.json.setdefault("animations", []).append(animation)

    def write(self, path):
        path = pathlib.Path(path)
        binary = path.with_suffix(".bin")
        with binary.open("wb") as out:
            for chunk in self.chunks:
                out.write(chunk)
        self.json["buffers"] = [{"uri": binary.name, "byteLength": self.size}]
        if self.extensions:
            self.json["extensionsUsed"] = sorted(self.extensions)
        path.write_text(json.dumps(self.json))
        return path
