"""The pass type box_blur."""
import numpy as np

from recomputing.rounding import ROUNDING, Decision, Mean
from recomputing.surfaces import dot, filter_roughness, length


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


def guide_of(kind, inputs):
    """An input by which a box blur weighs its taps in another way than `recompute_box_blur` does; None without one."""
    return next((port for port in ("variance", "guide") if kind == "box_blur" and port in inputs), None)
