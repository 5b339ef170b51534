"""Scenes that grow in one thing alone: triangles, lights, moving objects."""

import array
import json
import math
import pathlib

from gltf_writer import GltfWriter

SIDE = 10.0  # of the room [m]
HEIGHT = 5.0  # of the room [m]
PERIOD = 4.0  # in which what moves is back where it was [s]


class Mesh:
    """Quads and triangles with their own corners."""

    def __init__(self):
        self.positions = array.array("f")
        self.normals = array.array("f")
        self.indices = array.array("I")

    def quad(self, corner, u, v):
        normal = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
        length = math.sqrt(sum(x * x for x in normal))
        first = len(self.positions) // 3
        for s, t in ((0, 0), (1, 0), (1, 1), (0, 1)):
            self.positions.extend(corner[k] + s * u[k] + t * v[k] for k in range(3))
            self.normals.extend(x / length for x in normal)
        self.indices.extend((first, first + 1, first + 2, first, first + 2, first + 3))

    def box(self, half):
        h, e = half, 2 * half
        self.quad((-h, -h, h), (e, 0, 0), (0, e, 0))
        self.quad((h, -h, -h), (-e, 0, 0), (0, e, 0))
        self.quad((h, -h, h), (0, 0, -e), (0, e, 0))
        self.quad((-h, -h, -h), (0, 0, e), (0, e, 0))
        self.quad((-h, h, h), (e, 0, 0), (0, 0, -e))
        self.quad((-h, -h, -h), (e, 0, 0), (0, 0, e))

    def add_to(self, writer, material):
        return writer.mesh(self.positions, self.normals, self.indices, material)


def room(writer):
    """Floor, walls and a ceiling with a lamp below it; open towards the camera."""
    shell = Mesh()
    s, h = SIDE, HEIGHT
    shell.quad((-s / 2, 0, s / 2), (s, 0, 0), (0, 0, -s))
    shell.quad((-s / 2, h, -s / 2), (s, 0, 0), (0, 0, s))
    shell.quad((-s / 2, 0, -s / 2), (s, 0, 0), (0, h, 0))
    shell.quad((-s / 2, 0, s / 2), (0, 0, -s), (0, h, 0))
    shell.quad((s / 2, 0, -s / 2), (0, 0, s), (0, h, 0))
    writer.node(shell.add_to(writer, writer.material((0.7, 0.65, 0.6))))
    return writer


def lamp(writer):
    panel = Mesh()
    panel.quad((-1, HEIGHT - 0.2, -1), (2, 0, 0), (0, 0, 2))
    writer.node(panel.add_to(writer, writer.material((0.8, 0.8, 0.8), [1, 1, 1], 20.0)))
    return writer


def finish(writer, folder, name, height=2.2):
    """The glTF file and a scene file beside it with a camera at the open side. Returns the latter."""
    writer.write(pathlib.Path(folder) / (name + ".gltf"))
    scene = {"lightloom_scene": 1, "gltf": name + ".gltf",
             "cameras": {"front": {"eye": [0, height, SIDE * 0.9], "target": [0, height - 0.4, 0], "up": [0, 1, 0],
                                   "vertical_fov_degrees": 45}},
             "environment": {"radiance": [0.3, 0.35, 0.4]}}
    path = pathlib.Path(folder) / (name + ".scene.json")
    path.write_text(json.dumps(scene))
    return path


def plain_scene(folder):
    """The room with its lamp and three boxes; nothing moves."""
    writer = lamp(room(GltfWriter()))
    box = Mesh()
    box.box(0.8)
    mesh = box.add_to(writer, writer.material((0.3, 0.5, 0.7)))
    for place in ((-2.5, 0.8, -1), (0.2, 0.8, 0.5), (2.6, 0.8, -2)):
        writer.node(mesh, place)
    return finish(writer, folder, "plain")


def lattice(count):
    """Places of moving boxes, spread over the room."""
    columns = max(1, math.ceil(count ** (1 / 3)))
    places = []
    for k in range(count):
        x, y, z = ((cell + 0.5) / columns for cell in (k % columns, k // columns % columns, k // columns ** 2))
        places.append(((x - 0.5) * SIDE * 0.8, 0.4 + y * HEIGHT * 0.75, (z - 0.5) * SIDE * 0.8))
    return places


def moving_scene(folder, count):
    """The room with `count` boxes that swing about places of a lattice. The boxes shrink as they become more, so that
    all together take the same share of the room."""
    writer = lamp(room(GltfWriter()))
    half = min(0.3, 1.2 / max(1, math.ceil(count ** (1 / 3))))
    box = Mesh()
    box.box(half)
    mesh = box.add_to(writer, writer.material((0.3, 0.5, 0.7)))
    tracks = []
    for place in lattice(count):
        swung = (place[0] + 2 * half, place[1], place[2] + half)
        tracks.append((writer.node(mesh, place), [place, swung, place]))
    writer.swing(tracks, PERIOD)
    return finish(writer, folder, f"moving_{count}")


def moving_instances_scene(folder, count):
    """The same with each box an instance of one animated file, by the scene file."""
    folder = pathlib.Path(folder)
    half = min(0.3, 1.2 / max(1, math.ceil(count ** (1 / 3))))
    single = GltfWriter()
    box = Mesh()
    box.box(half)
    node = single.node(box.add_to(single, single.material((0.3, 0.5, 0.7))))
    single.swing([(node, [(0, 0, 0), (2 * half, 0, half), (0, 0, 0)])], PERIOD)
    name = f"moving_instances_{count}"
    single.write(folder / (name + "_box.gltf"))
    path = finish(lamp(room(GltfWriter())), folder, name)
    scene = json.loads(path.read_text())
    scene["instances"] = [{"gltf": name + "_box.gltf", "translation": place, "time_offset_seconds": PERIOD * k / count}
                          for k, place in enumerate(lattice(count))]
    path.write_text(json.dumps(scene))
    return path


def lights_scene(folder, count):
    """The room with `count` emissive triangles in panels below the ceiling, which emit the same altogether."""
    writer = room(GltfWriter())
    panels = Mesh()
    columns = max(1, math.ceil(math.sqrt(count / 2)))
    pitch = SIDE * 0.9 / columns
    for k in range(math.ceil(count / 2)):
        x, z = (k % columns) * pitch - SIDE * 0.45, (k // columns) * pitch - SIDE * 0.45
        panels.quad((x, HEIGHT - 0.3, z), (pitch * 0.6, 0, 0), (0, 0, pitch * 0.6))
    writer.node(panels.add_to(writer, writer.material((0.8, 0.8, 0.8), [1, 1, 1], 2.0)))
    return finish(writer, folder, f"lights_{count}")


def terrain(columns, rows, width, depth):
    """A hilly sheet of 2 * columns * rows triangles whose corners are shared."""
    positions, normals, indices = array.array("f"), array.array("f"), array.array("I")
    xs = [width * (i / columns - 0.5) for i in range(columns + 1)]
    waves = [0.4 * math.sin(7.0 * i / columns) for i in range(columns + 1)]
    for j in range(rows + 1):
        z = depth * (0.5 - j / rows)
        lift = 0.6 + 0.3 * math.cos(5.0 * j / rows)
        positions.extend(value for x, wave in zip(xs, waves) for value in (x, lift + wave, z))
    normals.frombytes(array.array("f", (0, 1, 0)).tobytes() * ((columns + 1) * (rows + 1)))
    step = columns + 1
    for j in range(rows):
        first = j * step
        indices.extend(corner for a in range(first, first + columns)
                       for corner in (a, a + 1, a + step + 1, a, a + step + 1, a + step))
    return positions, normals, indices


def triangles_scene(folder, count):
    """The room with a sheet of about `count` triangles in it, each of them its own."""
    writer = lamp(room(GltfWriter()))
    side = max(1, round(math.sqrt(count / 2)))
    sheet = terrain(side, side, SIDE * 0.9, SIDE * 0.9)
    writer.node(writer.mesh(*sheet, writer.material((0.4, 0.6, 0.3))))
    return finish(writer, folder, f"triangles_{count}", HEIGHT * 0.7)


def instances_scene(folder, count):
    """The same number of triangles as instances of a sheet of 2,000."""
    writer = lamp(room(GltfWriter()))
    tiles = max(1, round(math.sqrt(count / 2000)))
    pitch = SIDE * 0.9 / tiles
    quads = 10 if tiles == 1 and count < 2000 else 32
    rows = max(1, round(count / (2 * quads * tiles * tiles)))
    sheet = terrain(quads, rows, pitch, pitch)
    mesh = writer.mesh(*sheet, writer.material((0.4, 0.6, 0.3)))
    for k in range(tiles * tiles):
        writer.node(mesh, ((k % tiles + 0.5) * pitch - SIDE * 0.45, 0, (k // tiles + 0.5) * pitch - SIDE * 0.45))
    return finish(writer, folder, f"instances_{count}", HEIGHT * 0.7)
