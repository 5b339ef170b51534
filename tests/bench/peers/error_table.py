"""Time to equal error: Lightloom's frames, and the time in which Cycles makes a picture as good.

Each has its own reference of many paths and other random numbers: Lightloom its reference_path_trace (both look through
the centres of pixels and filter textures alike), Cycles Cycles (both with the box filter). How far the references
are apart is printed, too, and what Lightloom's pictures have against that of Cycles.
"""

import os

from curves import cost_at_error, digits, markdown, median

REFERENCE_SEED = 1000
STEADY_FRAMES = 6  # of a run at the least whose later frames are timed


def reference_of_lightloom(peers, say):
    """EXR file; made once and kept."""
    choice = peers.choice
    name = f"reference_lightloom_{choice.size[0]}x{choice.size[1]}_{choice.vertices}_{choice.reference_samples}"
    folder = peers.out(f"{name}_{peers.camera}")
    file = os.path.join(folder, "radiance.0000.exr")
    if not os.path.exists(file):
        options = ["--set", f"paths={choice.reference_samples}", "--set", f"bounces={peers.bounces}"]
        options += ["--seed", str(REFERENCE_SEED)]
        seconds = peers.lightloom.render("reference.json", 1, folder, options)["wall"]
        say(f"reference_path_trace: {choice.reference_samples} paths a pixel in {seconds:.0f} s")
    return file


def reference_of_cycles(peers, say):
    """EXR file; made once and kept."""
    choice = peers.choice
    name = f"reference_cycles_{choice.size[0]}x{choice.size[1]}_{choice.vertices}_{choice.reference_samples}"
    file = peers.out(f"{name}_{peers.camera}.exr")
    if not os.path.exists(file):
        partial = peers.out("unfinished.exr")
        seconds = peers.cycles.render(choice.reference_samples, peers.bounces, seed=REFERENCE_SEED, out=partial)
        os.replace(partial, file)
        say(f"Cycles' reference: {choice.reference_samples} paths a pixel in {seconds:.0f} s")
    return file


def references(peers, say):
    """Both references, and how far they are apart."""
    files = {"lightloom": reference_of_lightloom(peers, say)}
    if peers.cycles:
        files["cycles"] = reference_of_cycles(peers, say)
        apart = peers.lightloom.compare(files["cycles"], files["lightloom"])
        text = f"The references differ by FLIP {digits(apart['flip'])}, relMSE {digits(apart['relmse'])}."
        return text, {"files": files, "apart": apart}
    return "Cycles is not here: there is one reference only.", {"files": files}


def configurations(peers):
    """What of Lightloom is judged: name, frames, options."""
    options = peers.lightloom_options()
    found = [(f"`lightloom.json`, {n} frame{'s' * (n > 1)} of 1 path", n, options) for n in peers.choice.frames]
    many = [*options, "--set", f"paths={peers.choice.paths}"]
    found.append((f"`lightloom.json`, 1 frame of {peers.choice.paths} paths", 1, many))
    found.append((f"variant `raw`, 1 frame of {peers.choice.paths} paths", 1, [*many, "--variant", "raw"]))
    return found


def cycles_point(peers, samples, reference):
    file = peers.out(f"cycles_{samples}.exr")
    seconds = peers.cycles.render(samples, peers.bounces, out=file)
    return {"samples": samples, "seconds": seconds, **peers.lightloom.compare(reference, file)}


def lightloom_times(peers, index, frames, options):
    """Steady seconds of a frame, and wall seconds of the program that makes so many and writes the last."""
    out = peers.out(f"lightloom_{index}")
    steady = peers.lightloom.render("lightloom.json", max(frames, STEADY_FRAMES), out, options)
    run = steady if frames >= STEADY_FRAMES else peers.lightloom.render("lightloom.json", frames, out, options)
    return median(steady["later"]), run["wall"]


def measure(peers, reference, say):
    """Cycles' curve and Lightloom's times, in turn."""
    choice, curve = peers.choice, []
    rows = configurations(peers)
    times = [[] for _ in rows]
    if peers.cycles:
        peers.cycles.render(1, peers.bounces)
    for turn in range(max(len(choice.samples), choice.rounds)):
        if peers.cycles and turn < len(choice.samples):
            curve.append(cycles_point(peers, choice.samples[turn], reference))
            say("Cycles, {samples} paths: {seconds:.2f} s, FLIP {flip:.4f}, relMSE {relmse:.5f}".format(**curve[-1]))
        if turn < choice.rounds:
            for index, (_, frames, options) in enumerate(rows):
                times[index].append(lightloom_times(peers, index, frames, options))
    return curve, times


def equal(curve, name, error, seconds):
    """Cycles' seconds at this error, and how many times Lightloom's that is."""
    if not curve:
        return "-", "-"
    theirs, end = cost_at_error([(point["seconds"], point[name]) for point in curve], error)
    return f"{end or ''} {digits(theirs)}".strip(), f"{end or ''} {digits(theirs / seconds)}".strip()


def judge(peers, index, configuration, times, curve, files):
    name, frames, _ = configuration
    picture = peers.out(f"lightloom_{index}", f"radiance.{frames - 1:04d}.exr")
    own = peers.lightloom.compare(files["lightloom"], picture)
    seconds = frames * median([steady for steady, _ in times])
    wall = median([wall for _, wall in times])
    row = {"name": name, "seconds": seconds, "wall": wall, **own}
    cells = [name, digits(seconds), digits(wall), digits(own["flip"]), digits(own["relmse"])]
    for figure in ("flip", "relmse"):
        cells += equal(curve, figure, own[figure], seconds)
    if "cycles" in files:
        row["against_cycles"] = peers.lightloom.compare(files["cycles"], picture)
        cells.append(digits(row["against_cycles"]["flip"]))
    return row, cells


def draw(peers, judged, curve, files):
    """Lightloom's last frames of one path, Cycles' picture of about that time, and its reference, side by side."""
    index = len(peers.choice.frames) - 1
    seconds = judged[index]["seconds"]
    nearest = min(curve, key=lambda point: abs(point["seconds"] - seconds))
    ours = peers.out(f"lightloom_{index}", f"radiance.{peers.choice.frames[index] - 1:04d}.exr")
    theirs = peers.out(f"cycles_{nearest['samples']}.exr")
    peers.cycles.picture([ours, theirs, files["cycles"]], peers.choice.exposure, peers.choice.picture)
    return (f"{peers.choice.picture}: {judged[index]['name']} ({digits(seconds)} s), Cycles with {nearest['samples']} "
            f"paths ({digits(nearest['seconds'])} s), Cycles with {peers.choice.reference_samples} paths")


def make(peers, say):
    text, made = references(peers, say)
    files = made["files"]
    curve, times = measure(peers, files.get("cycles"), say)
    judged = [judge(peers, index, configuration, times[index], curve, files)
              for index, configuration in enumerate(configurations(peers))]
    header = ["", "s steady", "s from process start", "FLIP", "relMSE", "Cycles, same FLIP [s]", "times steady",
              "Cycles, same relMSE [s]", "times steady"] + ["FLIP by Cycles' reference"] * ("cycles" in files)
    parts = [text, markdown(header, [cells for _, cells in judged])]
    if curve:
        rows = [[str(p["samples"]), *(digits(p[name]) for name in ("seconds", "flip", "relmse"))] for p in curve]
        parts.append(markdown(["Cycles, paths a pixel", "s", "FLIP", "relMSE"], rows))
    rows = [row for row, _ in judged]
    if curve and peers.choice.picture:
        parts.append(draw(peers, rows, curve, files))
    return "\n\n".join(parts), {"references": made, "cycles": curve, "lightloom": rows}
