#!/usr/bin/env python3
"""The pieces of the comparison that can be wrong without anyone noticing; needs neither peers nor Lightloom."""

import json
import math
import os
import tempfile
import unittest

import curves
import peer_scene
import renderers

QUAD = {
    "asset": {"version": "2.0"},
    "scene": 0,
    "scenes": [{"nodes": [0]}],
    "nodes": [{"translation": [1, 2, 3], "children": [1]}, {"mesh": 0, "scale": [2, 2, 2]}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}],
    "accessors": [
        {"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 3},
        {"bufferView": 1, "componentType": 5123, "type": "SCALAR", "count": 3},
    ],
    "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 6}],
    "buffers": [{"uri": "quad.bin", "byteLength": 42}],
    "materials": [
        {
            "normalTexture": {"index": 0},
            "alphaMode": "MASK",
            "alphaCutoff": 0.5,
            "pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.25, 0.125, 1], "metallicFactor": 1},
            "emissiveFactor": [1, 0, 0],
        }
    ],
}


class Curves(unittest.TestCase):
    def test_between_two_points_the_curve_is_a_power_law(self):
        cost, end = curves.cost_at_error([(1, 0.8), (4, 0.4), (16, 0.2)], 0.4 / math.sqrt(2))
        self.assertIsNone(end)
        self.assertAlmostEqual(cost, 8)

    def test_at_a_point_it_is_the_points_cost(self):
        self.assertEqual(curves.cost_at_error([(1, 0.8), (4, 0.4)], 0.8), (1, None))
        self.assertAlmostEqual(curves.cost_at_error([(1, 0.8), (4, 0.4)], 0.4)[0], 4)

    def test_nothing_is_extrapolated(self):
        self.assertEqual(curves.cost_at_error([(1, 0.8), (4, 0.4)], 0.9), (1, "<"))
        self.assertEqual(curves.cost_at_error([(1, 0.8), (4, 0.4)], 0.3), (4, ">"))

    def test_where_noise_makes_it_rise_the_first_crossing_counts(self):
        cost, end = curves.cost_at_error([(1, 0.8), (2, 0.4), (4, 0.5), (8, 0.2)], 0.45)
        self.assertIsNone(end)
        self.assertTrue(1 < cost < 2)

    def test_ratios_are_of_pairs(self):
        self.assertEqual(curves.paired_ratio([10, 30, 20], [5, 10, 20]), {"median": 2, "least": 1, "most": 3})
        with self.assertRaises(ValueError):
            curves.paired_ratio([1, 2], [1])

    def test_digits(self):
        self.assertEqual([curves.digits(v) for v in (0.012345, 1.2345, 123.45, 12345, 0)],
                         ["0.0123", "1.23", "123", "12345", "0"])


class Parsing(unittest.TestCase):
    def test_embree_prints_frames_a_second(self):
        text = "frame [0/1]: 9.9 fps (skipped)\nBENCHMARK_RENDER_MIN 1\nBENCHMARK_RENDER_AVG 0.25\n"
        self.assertEqual(renderers.embree_frame_seconds(text), 4)
        with self.assertRaises(renderers.PeerFailed):
            renderers.embree_frame_seconds("frame [0/1]: 9.9 fps\n")

    def test_figures_of_compare_may_be_zero_but_not_missing(self):
        text = json.dumps({"figures": {"flip": 0.0, "relmse": 2}})
        self.assertEqual(renderers.error_figures(text), {"flip": 0.0, "relmse": 2})
        with self.assertRaises(renderers.PeerFailed):
            renderers.error_figures('{"figures": {"flip": 0.5, "relmse": null}}')


class Scenes(unittest.TestCase):
    def derive(self, materials, **scene):
        source = self.enterContext(tempfile.TemporaryDirectory())
        peer_scene.write_json(os.path.join(source, "quad.gltf"), QUAD)
        with open(os.path.join(source, "quad.bin"), "wb") as file:
            file.write(peer_scene.struct.pack("<9f3H", 0, 0, 0, 1, 0, 0, 0, 1, 0, 2, 1, 0))
        cameras = {"only": {"eye": [0, 0, 1], "target": [0, 0, 0], "vertical_fov_degrees": 60}}
        description = {"lightloom_scene": 1, "gltf": "quad.gltf", "cameras": cameras, **scene}
        peer_scene.write_json(os.path.join(source, "quad.scene.json"), description)
        folder = os.path.join(source, "derived")
        peer_scene.derive(os.path.join(source, "quad.scene.json"), materials, folder)
        return folder

    def test_what_a_peer_lacks_is_left_out_for_all(self):
        material = peer_scene.read_json(os.path.join(self.derive("lambert"), "scene.gltf"))["materials"][0]
        self.assertNotIn("normalTexture", material)
        self.assertEqual(material["alphaMode"], "OPAQUE")
        self.assertEqual(material["pbrMetallicRoughness"]["metallicFactor"], 0)
        self.assertEqual(material["extensions"]["KHR_materials_specular"], {"specularFactor": 0})
        self.assertEqual(material["emissiveFactor"], [1, 0, 0])

    def test_materials_of_the_file_keep_their_gloss(self):
        material = peer_scene.read_json(os.path.join(self.derive("file"), "scene.gltf"))["materials"][0]
        self.assertEqual(material["pbrMetallicRoughness"]["metallicFactor"], 1)
        self.assertNotIn("KHR_materials_specular", material["extensions"])

    def test_obj_has_the_triangles_in_the_world(self):
        folder = self.derive("lambert")
        peer_scene.write_obj(folder, {})
        with open(os.path.join(folder, "scene.obj"), encoding="utf-8") as file:
            lines = file.read().splitlines()
        self.assertEqual([line for line in lines if line.startswith("v ")], ["v 1 2 3", "v 3 2 3", "v 1 4 3"])
        self.assertEqual(lines[-1], "f 3/3 2/2 1/1")
        with open(os.path.join(folder, "scene.mtl"), encoding="utf-8") as file:
            self.assertIn("Kd 0.5 0.25 0.125\nKs 0 0 0", file.read())

    def test_scenes_that_peers_are_not_given_are_refused(self):
        for extra in ({"instances": [{}]}, {"environment": {"image": "sky.hdr"}}, {"cameras": {}}, {"gltf": "a.glb"}):
            with self.assertRaises(peer_scene.UnsupportedScene):
                self.derive("lambert", **extra)

    def test_a_quarter_turn_about_z(self):
        half = math.sqrt(0.5)
        matrix = peer_scene.local_matrix({"rotation": [0, 0, half, half], "scale": [2, 1, 1]})
        self.assertAlmostEqual(matrix[1][0], 2)
        self.assertAlmostEqual(matrix[0][1], -1)

    def test_solid_angle_of_a_small_and_of_half_a_sphere(self):
        self.assertAlmostEqual(peer_scene.cone_solid_angle(90), 2 * math.pi)
        radians = math.radians(0.01)
        self.assertAlmostEqual(peer_scene.cone_solid_angle(0.01) / (math.pi * radians * radians), 1, places=6)


if __name__ == "__main__":
    unittest.main()
