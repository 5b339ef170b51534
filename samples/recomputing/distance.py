"""The pass type distance_transform."""
import numpy as np


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
