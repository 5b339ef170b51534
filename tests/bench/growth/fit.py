"""Power laws through measured points."""

import math


def exponent(points):
    """Slope of the least-squares line through (log x, log y); None for fewer than two points with x, y > 0."""
    logs = [(math.log(x), math.log(y)) for x, y in points if x > 0 and y > 0]
    if len(logs) < 2:
        return None
    mean_x = sum(x for x, _ in logs) / len(logs)
    mean_y = sum(y for _, y in logs) / len(logs)
    spread = sum((x - mean_x) ** 2 for x, _ in logs)
    if spread == 0:
        return None
    return sum((x - mean_x) * (y - mean_y) for x, y in logs) / spread


def upper_exponent(points, factor=10.0):
    """The same over the points within `factor` of the largest x, or over the last two where only one lies there."""
    points = sorted(points)
    top = [point for point in points if point[0] * factor * 1.001 >= points[-1][0]]
    return exponent(top if len(top) > 1 else points[-2:])
