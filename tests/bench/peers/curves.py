"""Medians, ratios and curves of error against time."""

import math
import statistics


def median(values):
    return statistics.median(values)


def paired_ratio(theirs, ours):
    """Median over rounds of theirs / ours, with the smallest and the largest."""
    if len(theirs) != len(ours) or not ours:
        raise ValueError(f"{len(theirs)} and {len(ours)} rounds make no pairs")
    ratios = [a / b for a, b in zip(theirs, ours)]
    return {"median": median(ratios), "least": min(ratios), "most": max(ratios)}


def cost_at_error(curve, error):
    """The cost at which a curve of (cost, error) has the error, straight between its points on logarithmic axes.

    Costs and errors are positive, the curve is sorted by cost and taken to fall: where noise makes it rise, its first
    crossing counts. Returns (cost, None), or (cost of the end of the curve, "<" or ">") where the error is already
    reached at the first point, or not even at the last: nothing is extrapolated.
    """
    if not curve:
        raise ValueError("a curve needs a point")
    if curve[0][1] <= error:
        return curve[0][0], "<" if curve[0][1] < error else None
    for (cost_a, error_a), (cost_b, error_b) in zip(curve, curve[1:]):
        if error_b <= error:
            share = (math.log(error_a) - math.log(error)) / (math.log(error_a) - math.log(error_b))
            return math.exp(math.log(cost_a) + share * (math.log(cost_b) - math.log(cost_a))), None
    return curve[-1][0], ">"


def fitted_line(points):
    """Offset and slope of the least squares line through (x, y)."""
    if len({x for x, _ in points}) < 2:
        raise ValueError("a line needs two different abscissas")
    mean_x = sum(x for x, _ in points) / len(points)
    mean_y = sum(y for _, y in points) / len(points)
    slope = sum((x - mean_x) * (y - mean_y) for x, y in points) / sum((x - mean_x) ** 2 for x, _ in points)
    return mean_y - slope * mean_x, slope


def markdown(header, rows):
    lines = ["| " + " | ".join(header) + " |", "| " + " | ".join("---" for _ in header) + " |"]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows])


def digits(value, count=3):
    """A positive number with so many significant digits, without an exponent."""
    if value == 0:
        return "0"
    places = max(0, count - 1 - math.floor(math.log10(abs(value))))
    return f"{value:.{places}f}"
