"""Tests that rounding may decide."""
import itertools

import numpy as np

ROUNDING = 2.0 ** -21  # relative error of a sum of four products in 32 bits, with room to spare


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
