"""Equal samples: the time of a frame in each renderer, in turn."""

from curves import digits, markdown, median, paired_ratio


def one_round(peers, index):
    """Seconds of a frame of each renderer; loading, BVHs, pipelines and voxels are not in them."""
    choice, seconds = peers.choice, {}
    options = [*peers.lightloom_options(), "--set", f"paths={choice.paths}"]
    run = peers.lightloom.render("lightloom.json", 4, peers.out("lightloom_speed"), options)
    seconds["lightloom"] = median(run["later"])
    if peers.cycles:
        out = peers.out("cycles_speed.exr")
        seconds["cycles"] = peers.cycles.render(choice.paths, peers.bounces, seed=index, out=out)
    if peers.embree:
        seconds["embree"] = peers.embree.render(choice.paths, choice.vertices)["seconds"]
    return seconds


def make(peers, say):
    """Median seconds of each, and the ratios to Lightloom, paired by round."""
    if peers.cycles:
        load = peers.cycles.render(1, peers.bounces)
        say(f"Cycles: scene read in {peers.cycles.loaded_seconds:.1f} s; first image of one path with BVH {load:.1f} s")
    rounds = []
    for index in range(peers.choice.rounds):
        rounds.append(one_round(peers, index))
        say(f"round {index + 1}: " + ", ".join(f"{name} {value:.2f} s" for name, value in rounds[-1].items()))
    names = {"lightloom": "Lightloom (`lightloom.json`)", "cycles": "Cycles", "embree": "Embree's path tracer"}
    rows, figures = [], {}
    ours = [seconds["lightloom"] for seconds in rounds]
    for name in rounds[0]:
        theirs = [seconds[name] for seconds in rounds]
        ratio = paired_ratio(theirs, ours)
        figures[name] = {"seconds": theirs, "ratio": ratio}
        spread = "" if name == "lightloom" else f" ({digits(ratio['least'])} to {digits(ratio['most'])})"
        rows.append([names[name], digits(median(theirs)), digits(ratio["median"]) + spread])
    header = [f"{peers.choice.paths} paths a pixel", "s a frame", "times Lightloom's (of the rounds)"]
    return markdown(header, rows), figures


def first_frame(peers, say):
    """Wall time of the whole program for the first frame of lightloom.json, of the scene file as it stands."""
    walls = []
    for _ in range(1 + peers.choice.rounds):
        out = peers.out("lightloom_first")
        run = peers.lightloom.render("lightloom.json", 1, out, peers.lightloom_options(), scene=peers.scene_file)
        walls.append(run["wall"])
    say(f"first frames, the first of them to warm the caches: {', '.join(f'{wall:.2f} s' for wall in walls)}")
    warm = walls[1:]
    row = [digits(median(warm)), f"{digits(min(warm))} to {digits(max(warm))}"]
    header = ["process start to first frame, warm caches [s]", "least to most"]
    return markdown(header, [row]), {"seconds": warm}
