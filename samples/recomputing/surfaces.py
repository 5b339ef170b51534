"""What surfaces reflect, and how rough the filters take them to be."""
import numpy as np

LEAST_COSINE = 0.02  # to which a shading normal that faces away is turned


def dot(a, b):
    return np.sum(a * b, axis=-1)


def length(a):
    return np.sqrt(dot(a, a))


def luminance(rgb):
    return dot(rgb, np.array([0.2126, 0.7152, 0.0722]))


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


def facing_cosine(normal, to_viewer):
    """Cosine between the direction to the viewer and the shading normal, which is turned to the viewer's side."""
    normal = normal / length(normal)[..., None]
    turned = normal + to_viewer * np.maximum(LEAST_COSINE - dot(normal, to_viewer), 0)[..., None]
    return dot(turned / length(turned)[..., None], to_viewer)


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
