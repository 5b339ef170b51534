"""The pass type temporal_accumulate."""
import itertools

import numpy as np

from recomputing.rounding import ROUNDING, Decision, Mean
from recomputing.surfaces import direction_to_viewer, dot, filter_roughness, length


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
