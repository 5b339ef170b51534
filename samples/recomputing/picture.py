"""The pass types modulate and tonemap."""
import numpy as np

from recomputing.surfaces import direction_to_viewer, facing_cosine, reflected_shares

MODULATION_FLOOR = 0.001
ENCODING_ERROR = 2.0 ** -17  # of sRGB's power in 32 bits, which devices may take by a logarithm


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
