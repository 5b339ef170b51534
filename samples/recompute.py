#!/usr/bin/python3
"""Recomputes stages of a run from its dumps, with NumPy alone, and compares.

    lightloom render GRAPH --scene SCENE --frames 0..9 --dump '*' --dump-format npy --out DIR
    samples/recompute.py DIR [--frame N]

Each distance_transform, temporal_accumulate, box_blur (without `variance` and `guide`), modulate and tonemap of the run
is computed again, for one frame (the last unless told otherwise), from what it read, by the formulas of docs/buffers.md
and docs/denoiser.md; nothing of Lightloom is used. What a frame's environment is no dump says, so the background of
modulate is taken as it is. Exit status: 0 if all agree to 1e-5 (distances and pictures exactly), 1 if not, 2 if the run
folder lacks something.

Shaders compute in 32 bits, in an order that a compiler may choose. So a test like "is the cosine at least 0.9" may go
either way where rounding decides. Such pixels are found by a bound on the rounding error, and of the few results that
they may have one must agree. How many there are is printed; above one in twenty, the comparison counts as failed.
"""
import argparse
import itertools
import json
import os
import sys

import numpy as np

TOLERANCE = 1e-5
ROUNDING = 2.0 ** -21  # relative error of a sum of four products in 32 bits, with room to spare
ENCODING_ERROR = 2.0 ** -17  # of sRGB's power in 32 bits, which devices may take by a logarithm
MOST_DOUBTFUL = 0.05
LEAST_COSINE = 0.02  # to which a shading normal that faces away is turned
MODULATION_FLOOR = 0.001


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


def dot(a, b):
    return np.sum(a * b, axis=-1)


def length(a):
    return np.sqrt(dot(a, a))


def luminance(rgb):
    return dot(rgb, np.array([0.2126, 0.7152, 0.0722]))


# --- What surfaces reflect, and how rough the filters take them to be ------------------------------------------------


def reflected_shares(run, albedo, material, cosine):
    """What part of even light a surface reflects to the viewer: diffuse and specular, each as a colour."""
    base, metallic = albedo[..., :3], albedo[..., 3:]
    f0, f90 = material[..., 2:3], material[..., 3:4]
    grazing = np.clip(1 - cosine, 0, 1)[..., None] ** 5
    dielectric = f0 + (f90 - f0) * grazing
    diffuse = base * (1 - metallic) * (1 - dielectric)
    if not run.record["scene"]["features"]["specular"]:
        return diffuse, np.zeros(diffuse.shape)
    metal = base + (1 - base) * grazing
    return diffuse, dielectric * (1 - metallic) + metal * metallic


def specular_share(run, albedo, material, cosine):
    """Specular part of the luminance of what a surface reflects to the viewer."""
    diffuse, specular = reflected_shares(run, albedo, material, cosine)
    part, total = luminance(specular), luminance(diffuse + specular)
    return np.divide(part, total, out=np.zeros(total.shape), where=total > 0)


def direction_to_viewer(position, eye):
    offset = np.array(eye[:3]) - position * eye[3]
    return offset / length(offset)[..., None]


def filter_roughness(stage, eye):
    """Roughness along tangent and bitangent, by the param `lobe`."""
    position, normal = stage.read("surface.position")[..., :3], stage.read("surface.normal")[..., :3]
    albedo, material = stage.read("surface.albedo"), stage.read("surface.material")
    if stage.params["lobe"] == "diffuse":
        return np.ones(position.shape[:2] + (2,))
    share = np.ones(position.shape[:2])
    if stage.params["lobe"] == "both":
        with np.errstate(invalid="ignore", divide="ignore"):
            cosine = dot(normal, direction_to_viewer(position, eye))
        share = specular_share(stage.run, albedo, material, cosine)
    weight = (share ** 4)[..., None]
    return 1 - weight + np.clip(material[..., :2], 0, 1) * weight


# --- Tests that rounding may decide ----------------------------------------------------------------------------------


class Decision:
    """For each pixel whether a test passes, and whether that is beyond doubt."""

    def __init__(self, passes, sure):
        self.passes, self.sure = passes, sure

    @staticmethod
    def certain(passes):
        return Decision(passes, np.ones(passes.shape, bool))

    @staticmethod
    def at_least(value, bound, error):
        return Decision(value >= bound, np.abs(value - bound) > error)

    @staticmethod
    def at_most(value, bound, error):
        return Decision(value <= bound, np.abs(value - bound) > error)

    def __and__(self, other):
        passes = self.passes & other.passes
        fails_for_sure = (self.sure & ~self.passes) | (other.sure & ~other.passes)
        return Decision(passes, fails_for_sure | (self.sure & other.sure))


class Mean:
    """A weighted mean of candidates, some of which may or may not belong to it."""

    def __init__(self, shape):
        self.sum = np.zeros(shape + (3,))
        self.weight = np.zeros(shape)
        self.doubts = {}  # pixel -> list of lists of (weight, rgb or None)

    def add(self, rgb, weight, decision):
        # float32 keeps no NaN and no infinity in a sum; the shaders leave such values out.
        finite = np.all(np.isfinite(rgb), axis=-1)
        taken = decision.passes & decision.sure & finite
        self.sum += np.where(taken[..., None], np.where(finite[..., None], rgb, 0) * weight[..., None], 0)
        self.weight += np.where(taken, weight, 0)
        for pixel in zip(*np.nonzero(~decision.sure & finite)):
            self.add_choice(pixel, [(weight[pixel], rgb[pixel]), (0.0, np.zeros(3))])

    def add_choice(self, pixel, choices):
        self.doubts.setdefault(pixel, []).append(choices)

    def result(self, expected, weighs):
        """The mean; where there is doubt, the possible one that is nearest to `expected`. `weighs`: alpha is the sum of
        the weights."""
        result = np.array(expected)
        with np.errstate(invalid="ignore", divide="ignore"):
            result[..., :3] = self.sum / np.maximum(self.weight, 1e-30)[..., None]
        if weighs:
            result[..., 3] = self.weight
        for pixel, doubts in self.doubts.items():
            result[pixel] = self.nearest(pixel, doubts, expected[pixel], weighs)
        return result

    def nearest(self, pixel, doubts, expected, weighs):
        best = None
        for combination in itertools.islice(itertools.product(*doubts), 100000):
            weight = self.weight[pixel] + sum(choice[0] for choice in combination)
            rgb = self.sum[pixel] + sum(choice[0] * choice[1] for choice in combination)
            made = np.append(rgb / max(weight, 1e-30), weight if weighs else expected[3])
            error = np.max(np.abs(made - expected))
            if best is None or error < best[0]:
                best = (error, made)
        return best[1]


# --- The stages ------------------------------------------------------------------------------------------------------


def recompute_distance(stage):
    """Chessboard distance to the nearest occupied voxel, up to the radius, by growing what is occupied."""
    radius = stage.params["radius"]
    occupied = stage.read("voxels.albedo")[..., 3] > 127
    distance = np.full(occupied.shape, radius + 1, np.uint8)
    distance[occupied] = 0
    reached = occupied
    for k in range(1, radius + 1):
        grown = reached
        for axis in range(3):
            pad = [(1, 1) if other == axis else (0, 0) for other in range(3)]
            wide = np.moveaxis(np.pad(grown, pad), axis, 0)
            grown = np.moveaxis(wide[:-2] | wide[1:-1] | wide[2:], 0, axis)
        distance[grown & ~reached] = k
        reached = grown
    return distance[..., None], stage.written("distance"), {}


class MovingGeometry:
    """Where points of moving triangles were in earlier frames."""

    def __init__(self, run):
        self.run, self.about = run, run.index["moving"]
        self.triangles = run.read_array(self.about["triangles"])[..., 0] if self.about else None

    def corners(self, triangle, frame):
        """Positions [..., corner, xyz] of triangles counted from the first that moves."""
        positions = self.run.read_array(self.run.frame(frame)["moving_positions"])[..., 0].astype(np.float64)
        return positions[self.triangles[triangle][..., :3].astype(np.int64) - self.about["first_vertex"]]

    @staticmethod
    def axes(corners):
        """Rows: along the edge ab, across it, normal; 0 for a triangle without area."""
        a, b, c = np.moveaxis(corners, -2, 0)
        unit = lambda v: np.divide(v, length(v)[..., None], out=np.zeros(v.shape), where=length(v)[..., None] > 1e-30)
        x, z = unit(b - a), unit(np.cross(b - a, c - a))
        return np.stack([x, np.cross(z, x), z], axis=-2)

    def past(self, ids, position, normal, frame, age):
        """Position and normal of surface points `age` frames before `frame`."""
        position, normal = position.copy(), normal.copy()
        if self.triangles is None:
            return position, normal
        moves = (ids[..., 0] != 0) & (ids[..., 2] >= self.about["first_triangle"])
        triangle = ids[moves][:, 2].astype(np.int64) - self.about["first_triangle"]
        now, then = self.corners(triangle, frame), self.corners(triangle, frame - age)
        packed = ids[moves][:, 3]
        b, c = (packed & 0xFFFF) / 65535.0, (packed >> 16) / 65535.0
        weights = np.stack([1 - b - c, b, c], axis=-1)[..., None]
        position[moves] += np.sum(weights * (then - now), axis=-2)
        turned = np.einsum("nij,nj->ni", self.axes(now), normal[moves])
        normal[moves] = np.einsum("nij,ni->nj", self.axes(then), turned)
        return position, normal


class EarlierFrame:
    """What one earlier frame saw, and which of its pixels show given surface points."""

    def __init__(self, stage, age):
        self.params = stage.params
        self.view = stage.run.conditions(stage.frame - age)
        self.position = stage.read("trail_position", age)
        self.normal = stage.read("trail_normal", age)[..., :3]
        self.ids = stage.read("trail_id", age) if stage.has("trail_id") else None
        self.radiance = stage.read("trail", age)
        self.size = np.array(self.position.shape[1::-1])

    def project(self, position):
        """Place in pixels (x, y), clip w, and a bound on the rounding error of the place."""
        matrix = np.array(self.view["view_projection"])
        point = np.append(position, np.ones(position.shape[:-1] + (1,)), axis=-1)
        clip = point @ matrix.T
        terms = np.abs(point) @ np.abs(matrix).T
        w = clip[..., 3:]
        with np.errstate(invalid="ignore", divide="ignore"):
            ndc = clip[..., :2] / w
            error = ROUNDING * (terms[..., :2] + np.abs(ndc) * terms[..., 3:]) / np.abs(w)
        return (ndc * 0.5 + 0.5) * self.size, w[..., 0], (error + ROUNDING) * 0.5 * self.size

    def footprint(self, w):
        """Width of a pixel seen head on [m]."""
        rows = np.array(self.view["view_projection"])[:2, :3]
        return 2 * w * np.max(1 / (length(rows) * self.size))

    def shows(self, cell, position, normal, ids, w):
        """Does the pixel `cell` show the surface of the points?"""
        y, x = cell[..., 1], cell[..., 0]
        seen = self.position[y, x]
        decision = Decision.certain(seen[..., 3] > 0)
        if self.ids is not None:
            decision &= Decision.certain(np.all(self.ids[y, x][..., :2] == ids[..., :2], axis=-1))
        decision &= Decision.at_least(dot(self.normal[y, x], normal), self.params["normal_threshold"], 8 * ROUNDING)
        eye = np.array(self.view["eye"])
        slant = np.maximum(np.abs(dot(normal, direction_to_viewer(position, eye))), 0.05)
        offset = seen[..., :3] - position
        reach = self.params["position_tolerance"] * self.footprint(w)
        rounding = 8 * ROUNDING * (length(offset) + reach) + ROUNDING * np.max(np.abs(position), axis=-1)
        decision &= Decision.at_most(np.abs(dot(offset, normal)), reach, rounding)
        return decision & Decision.at_most(length(offset), reach / slant, rounding + 20 * ROUNDING * reach / slant**2)


def history_weight(age, frames, roughness):
    x = np.clip(1 - age / frames * (1 - roughness) / np.maximum(roughness, 1e-6), 0, 1)
    return x * x * (3 - 2 * x)


def add_age(mean, frame, weight, points, accumulates):
    """Adds to the mean what one earlier frame saw of the points."""
    position, normal, ids = points
    place, w, error = frame.project(position)
    cell = np.floor(place)
    seen = accumulates & (w > 0)
    near_border = np.any(np.minimum(place - cell, cell + 1 - place) <= error, axis=-1) & seen
    inside = seen & np.all((place >= 0) & (place < frame.size), axis=-1)
    cell = np.where(inside[..., None], cell, 0).astype(np.int64)
    decision = frame.shows(cell, position, normal, ids, w)
    past = frame.radiance[cell[..., 1], cell[..., 0]]
    decision &= Decision.certain(inside & (past[..., 3] > 0))
    decision.passes &= ~near_border
    decision.sure |= near_border
    mean.add(past[..., :3], weight, decision)
    for pixel in zip(*np.nonzero(near_border)):
        mean.add_choice(pixel, border_choices(frame, pixel, place, error, weight, points, w))


def border_choices(frame, pixel, place, error, weight, points, w):
    """What a point that falls onto the border of pixels may have been given."""
    choices = []
    ranges = [sorted({int(np.floor(place[pixel][k] + side * error[pixel][k])) for side in (-1, 1)}) for k in (0, 1)]
    for x, y in itertools.product(*ranges):
        if not (0 <= x < frame.size[0] and 0 <= y < frame.size[1]):
            choices.append((0.0, np.zeros(3)))
            continue
        decision = frame.shows(np.array([x, y]), *(part[pixel] for part in points), w[pixel])
        past = frame.radiance[y, x]
        usable = past[3] > 0 and bool(np.all(np.isfinite(past[:3])))
        if usable and (decision.passes or not decision.sure):
            choices.append((weight[pixel], past[:3]))
        if not usable or not decision.passes or not decision.sure:
            choices.append((0.0, np.zeros(3)))
    return choices


def recompute_temporal(stage):
    """Mean over the frames that saw the same point, weighted by age and roughness."""
    conditions = stage.run.conditions(stage.frame)
    current, position = stage.read("radiance"), stage.read("surface.position")
    normal, ids = stage.read("surface.normal")[..., :3], stage.read("surface.id")
    frames = stage.params["frames"]
    roughness = np.max(filter_roughness(stage, np.array(conditions["eye"])), axis=-1)
    accumulates = (position[..., 3] > 0) & (current[..., 3] > 0)
    moving = MovingGeometry(stage.run)
    mean = Mean(current.shape[:2])
    mean.add(current[..., :3], np.ones(current.shape[:2]), Decision.certain(accumulates))
    for age in stage.ages("trail"):
        if age >= frames or age > conditions["history_length"]:
            break
        weight = history_weight(age, frames, roughness)
        past = moving.past(ids, position[..., :3], normal, stage.frame, age)
        add_age(mean, EarlierFrame(stage, age), weight, past + (ids,), accumulates & (weight > 0))
    written = stage.written("radiance")
    made = mean.result(written, weighs=True)
    made[~accumulates] = np.append(current[..., :3], np.zeros(current.shape[:2] + (1,)), axis=-1)[~accumulates]
    return made, written, mean.doubts


def shifted(array, pixels, axis):
    """array[p + pixels] along the axis, and where that lies inside."""
    source = np.arange(array.shape[axis]) + pixels
    inside = (source >= 0) & (source < array.shape[axis])
    rows = np.take(array, np.clip(source, 0, array.shape[axis] - 1), axis=axis)
    return rows, inside.reshape([-1 if k == axis else 1 for k in range(2)])


def add_tap(mean, stage, surface, radiance, reach, pixels, axis):
    """Adds the neighbours that many pixels away that show the same object, face alike and lie within the cut-off."""
    position, normal, ids, tangents = surface
    other, inside = shifted(position, pixels, axis)
    decision = Decision.certain(inside & (shifted(ids[..., 0], pixels, axis)[0] == ids[..., 0]))
    offset = other[..., :3] - position[..., :3]
    cutoff = np.max(reach, axis=-1)
    decision &= Decision.at_most(length(offset), cutoff, 8 * ROUNDING * (cutoff + length(offset)))
    cosine = dot(shifted(normal, pixels, axis)[0], normal)
    decision &= Decision.at_least(cosine, stage.params["normal_threshold"], 8 * ROUNDING)
    if stage.params["cutoff"] == "elliptic":
        tangent, bitangent = tangents
        place = np.stack([dot(offset, tangent) * reach[..., 1], dot(offset, bitangent) * reach[..., 0]], axis=-1)
        limit = reach[..., 0] * reach[..., 1]
        decision &= Decision.at_most(length(place), limit, 8 * ROUNDING * (limit + length(offset) * cutoff))
    value = shifted(radiance, pixels, axis)[0]
    decision &= Decision.certain((value[..., 3] > 0) & (radiance[..., 3] > 0) & (position[..., 3] > 0))
    mean.add(value[..., :3], np.ones(position.shape[:2]), decision)


def recompute_box_blur(stage):
    """Mean over a row or column of pixels that show the same surface."""
    conditions = stage.run.conditions(stage.frame)
    radiance, position = stage.read("radiance"), stage.read("surface.position")
    normal, tangent = stage.read("surface.normal")[..., :3], stage.read("surface.tangent")[..., :3]
    surface = (position, normal, stage.read("surface.id"), (tangent, np.cross(normal, tangent)))
    bounds = conditions["scene_bounds"]
    diagonal = float(np.linalg.norm(np.array(bounds["max"]) - np.array(bounds["min"])))
    floor = stage.params["floor_fraction"] * diagonal
    roughness = filter_roughness(stage, np.array(conditions["eye"]))
    if stage.params["roughness"] == "perceptual":
        roughness = np.sqrt(roughness)
    if stage.params["kernel"] == "isotropic":
        roughness[...] = np.sqrt(roughness[..., :1] * roughness[..., 1:])
    reach = np.maximum(floor, stage.params["distance_fraction"] * position[..., 3:]) * roughness
    filtered = (position[..., 3] > 0) & (radiance[..., 3] > 0)
    mean = Mean(radiance.shape[:2])
    mean.sum += np.where(filtered[..., None], radiance[..., :3], 0)
    mean.weight += filtered
    axis = {"x": 1, "y": 0}[stage.params["axis"]]
    for k in range(1, stage.params["radius"] + 1):
        for pixels in (k, -k):
            add_tap(mean, stage, surface, radiance, reach, pixels, axis)
    written = stage.written("radiance")
    made = mean.result(written, weighs=False)
    made[..., 3] = radiance[..., 3]
    made[~filtered] = radiance[~filtered]
    return made, written, mean.doubts


def facing_cosine(normal, to_viewer):
    """Cosine between the direction to the viewer and the shading normal, which is turned to the viewer's side."""
    normal = normal / length(normal)[..., None]
    turned = normal + to_viewer * np.maximum(LEAST_COSINE - dot(normal, to_viewer), 0)[..., None]
    return dot(turned / length(turned)[..., None], to_viewer)


def recompute_modulate(stage):
    """Radiance times the modulation colour, and the emission of the surface."""
    position, albedo = stage.read("surface.position"), stage.read("surface.albedo")
    emission, normal = stage.read("surface.emission"), stage.read("surface.normal")[..., :3]
    eye = stage.run.conditions(stage.frame)["eye"]
    with np.errstate(invalid="ignore", divide="ignore"):
        cosine = facing_cosine(normal, direction_to_viewer(position[..., :3], eye))
    diffuse, specular = reflected_shares(stage.run, albedo, stage.read("surface.material"), cosine)
    first = stage.read("radiance")[..., :3]
    if stage.has("specular"):
        reflected = first * np.maximum(diffuse, MODULATION_FLOOR)
        if stage.run.record["scene"]["features"]["specular"]:
            reflected += stage.read("specular")[..., :3] * np.maximum(specular, MODULATION_FLOOR)
    else:
        reflected = first * np.maximum(diffuse + specular, MODULATION_FLOOR)
    reflected = np.where(emission[..., 3:] > 0.5, albedo[..., :3], reflected)
    written = stage.written("radiance")
    made = np.append(reflected + emission[..., :3], np.ones(position.shape[:2] + (1,)), axis=-1)
    background = position[..., 3] <= 0
    made[background] = np.append(written[background][:, :3], np.zeros((np.sum(background), 1)), axis=-1)
    return made, written, {}


CURVES = {
    "filmic": lambda x: x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14),
    "reinhard": lambda x: x / (1 + x),
    "linear": lambda x: x,
}


def recompute_tonemap(stage):
    """Exposure, tone curve and the encoding of sRGB, in whole steps of the picture."""
    radiance = stage.read("radiance")[..., :3]
    finite = np.all(np.isfinite(radiance), axis=-1)[..., None]
    exposed = np.clip(np.where(finite, radiance, 0) * 2.0 ** stage.params["exposure"], 0, 1e9)
    linear = np.clip(CURVES[stage.params["curve"]](exposed), 0, 1)
    encoded = np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)
    written = stage.written("image")
    steps = np.iinfo(written.dtype).max
    exact = np.append(encoded, np.ones(finite.shape), axis=-1) * steps
    nearest = np.rint(exact)
    doubtful = (nearest != written) & (np.abs(exact - written) <= 0.5 + ENCODING_ERROR * steps)
    made = np.where(doubtful, written, nearest)
    return made, written, {pixel: None for pixel in zip(*np.nonzero(np.any(doubtful, axis=-1)))}


STAGES = {
    "distance_transform": (recompute_distance, 0.0),
    "temporal_accumulate": (recompute_temporal, TOLERANCE),
    "box_blur": (recompute_box_blur, TOLERANCE),
    "modulate": (recompute_modulate, TOLERANCE),
    "tonemap": (recompute_tonemap, 0.0),
}


def guide_of(kind, inputs):
    """An input by which a box blur weighs its taps in another way than `recompute_box_blur` does; None without one."""
    return next((port for port in ("variance", "guide") if kind == "box_blur" and port in inputs), None)


def compare(name, kind, made, written, doubts, tolerance):
    """Prints one line; true if they agree. The error is absolute below 1 and relative above."""
    made, written = made.astype(np.float64), written.astype(np.float64)
    difference = np.abs(made - written)
    difference[np.isnan(made) & np.isnan(written)] = 0
    absolute = float(np.max(difference))
    relative = float(np.max(difference / np.maximum(np.abs(written), 1e-30), where=difference > 0, initial=0.0))
    error = difference / np.maximum(np.abs(written), 1)
    worst = float(np.max(error))
    doubtful = len(doubts) / (made.shape[0] * made.shape[1]) if doubts else 0.0
    agrees = worst <= tolerance and doubtful <= MOST_DOUBTFUL
    print(f"{'agrees ' if agrees else 'DIFFERS'} {name} ({kind}): largest difference {absolute:.3g} absolute, "
          f"{relative:.3g} relative; {len(doubts)} of {made[..., 0].size} decided by rounding")
    if not agrees:
        place = np.unravel_index(int(np.argmax(error)), error.shape)
        print(f"        worst at {tuple(int(k) for k in place)}: {made[place]:.9g} instead of {written[place]:.9g}")
    return agrees


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("folder", help="run folder with --dump '*' --dump-format npy")
    parser.add_argument("--frame", type=int, help="which frame; the last one unless given")
    options = parser.parse_args()
    try:
        run = Run(options.folder)
        frame = max(run.frames) if options.frame is None else options.frame
        agrees = []
        for kind, (recompute, tolerance) in STAGES.items():
            for entry in run.passes(kind):
                guide = guide_of(kind, entry["inputs"])
                if guide:
                    print(f"left out {entry['pass']} ({kind}): its input `{guide}` decides, which this sample does not know")
                    continue
                made, written, doubts = recompute(Pass(run, entry, frame))
                agrees.append(compare(entry["pass"], kind, made, written, doubts, tolerance))
        if not agrees:
            raise Missing("the run has none of the passes " + ", ".join(STAGES))
    except Missing as problem:
        print(f"error: {problem}", file=sys.stderr)
        return 2
    return 0 if all(agrees) else 1


if __name__ == "__main__":
    sys.exit(main())
