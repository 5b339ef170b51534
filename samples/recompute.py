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
import sys

sys.dont_write_bytecode = True  # a sample leaves nothing beside its sources

import numpy as np

from recomputing.box_blur import guide_of, recompute_box_blur
from recomputing.distance import recompute_distance
from recomputing.picture import recompute_modulate, recompute_tonemap
from recomputing.run_folder import Missing, Pass, Run
from recomputing.temporal import recompute_temporal

TOLERANCE = 1e-5
MOST_DOUBTFUL = 0.05

STAGES = {
    "distance_transform": (recompute_distance, 0.0),
    "temporal_accumulate": (recompute_temporal, TOLERANCE),
    "box_blur": (recompute_box_blur, TOLERANCE),
    "modulate": (recompute_modulate, TOLERANCE),
    "tonemap": (recompute_tonemap, 0.0),
}


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
