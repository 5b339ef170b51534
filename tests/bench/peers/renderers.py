"""The three renderers as programs that are started, told what to render, and timed."""

import json
import os
import re
import shutil
import subprocess
import time

HERE = os.path.dirname(os.path.abspath(__file__))


class PeerFailed(Exception):
    """A program that did not do what it was told, in one sentence and its own last words."""


class PeerMissing(Exception):
    """A program that is not installed."""


def last_words(text, lines=6):
    return "\n".join(text.strip().splitlines()[-lines:])


def run_program(command, folder=None):
    """Standard output and wall seconds of a program that must succeed."""
    begin = time.perf_counter()
    done = subprocess.run(command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False)
    seconds = time.perf_counter() - begin
    if done.returncode != 0:
        raise PeerFailed(f"{command[0]} ended with {done.returncode}:\n{last_words(done.stdout + done.stderr)}")
    return done.stdout, seconds


def embree_frame_seconds(text):
    """Seconds of a frame, the mean over the measured ones, from what Embree's old benchmark prints."""
    found = re.search(r"^BENCHMARK_RENDER_AVG\s+([0-9.eE+-]+)\s*$", text, re.MULTILINE)
    if not found or float(found.group(1)) <= 0:
        raise PeerFailed(f"Embree's path tracer printed no BENCHMARK_RENDER_AVG:\n{last_words(text)}")
    return 1 / float(found.group(1))


class Lightloom:
    """`lightloom` on a derived scene; folder is the derived scene's."""

    def __init__(self, program, root, folder, camera, size):
        self.program, self.root, self.folder = program, root, folder
        self.scene, self.camera, self.size = os.path.join(folder, "scene.scene.json"), camera, size

    def render(self, graph, frames, out, options=(), scene=None):
        """Seconds of the first frame and of the later ones, and of the whole program. The last frame is written, after
        its time: like Blender's operator and Embree's benchmark, frames are not timed beside the writing of files."""
        size = f"{self.size[0]}x{self.size[1]}"
        command = [self.program, "render", os.path.join(self.root, "graphs", graph), "--scene", scene or self.scene]
        command += ["--camera", self.camera, "--size", size, "--trace-size", size, "--frames", f"0..{frames - 1}"]
        command += ["--output-frames", str(frames - 1), "--no-times", "--out", out, *options]
        _, wall = run_program(command)
        with open(os.path.join(out, "run.json"), encoding="utf-8") as file:
            times = json.load(file)["frame_wall_ms"]["frames"]
        return {"first": times[0] / 1000, "later": [ms / 1000 for ms in times[1:]], "wall": wall}

    def compare(self, reference, test):
        """FLIP (of radiance) and relMSE of an EXR file against another."""
        text, _ = run_program(
            [self.program, "compare", reference, test, "--json", "--flip", "hdr", "--only", "flip,relmse"]
        )
        return error_figures(text)


def error_figures(text):
    """flip and relmse out of the JSON of `lightloom compare`, wherever it keeps them."""

    def find(data, name):
        if isinstance(data, dict):
            if isinstance(data.get(name), (int, float)):
                return data[name]
            data = list(data.values())
        if isinstance(data, list):
            for part in data:
                value = find(part, name)
                if value is not None:
                    return value
        return None

    data = json.loads(text)
    figures = {name: find(data, name) for name in ("flip", "relmse")}
    missing = [name for name, value in figures.items() if value is None]
    if missing:
        raise PeerFailed(f"`lightloom compare` gave no {' and no '.join(missing)}: {text[:200]}")
    return figures


class Cycles:
    """One Blender process that keeps the scene, its textures and its BVH, and renders on demand."""

    def __init__(self, folder, camera, size):
        program = shutil.which("blender")
        if not program:
            raise PeerMissing("blender is not installed (Debian: apt-get install blender)")
        command = [program, "-b", "-noaudio", "--python-exit-code", "1", "-P", os.path.join(HERE, "cycles_server.py")]
        command += ["--", folder, camera, str(size[0]), str(size[1])]
        self.log = []
        # Blender takes the folder of the first python3 in PATH for that of its own modules; another one's has no numpy.
        path = os.path.dirname(program) + os.pathsep + os.environ.get("PATH", "")
        pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "stderr": subprocess.STDOUT}
        self.process = subprocess.Popen(command, env={**os.environ, "PATH": path}, text=True, **pipes)
        loaded = self._answer()
        self.loaded_seconds, self.denoiser = loaded["loaded_seconds"], loaded["denoiser"]

    def _answer(self):
        for line in self.process.stdout:
            if line.startswith("PEERS "):
                return json.loads(line[len("PEERS ") :])
            self.log.append(line)
        self.process.wait()
        raise PeerFailed(f"blender ended with {self.process.returncode}:\n{last_words(''.join(self.log))}")

    def _order(self, **order):
        self.process.stdin.write(json.dumps(order) + "\n")
        self.process.stdin.flush()
        return self._answer()

    def render(self, samples, bounces, seed=0, out=None, filter_width=1.0, denoise=False):
        """Seconds of the render operator; the first call also loads textures and builds the BVH."""
        order = {"samples": samples, "bounces": bounces, "seed": seed, "out": out, "filter": filter_width}
        return self._order(do="render", denoise=denoise, **order)["seconds"]

    def picture(self, files, exposure, out):
        """Linear EXR files side by side as a PNG file, at half their size."""
        self._order(do="picture", files=files, exposure=exposure, out=os.path.abspath(out))

    def textures(self):
        return {int(index): name for index, name in self._order(do="textures")["names"].items()}

    def close(self):
        self.process.stdin.close()
        self.process.stdout.read()
        self.process.wait()


class Embree:
    """The path tracer of embree-tools on the scene.obj of a folder."""

    def __init__(self, folder, description, camera, size, solid_angle):
        self.program = shutil.which("pathtracer") or shutil.which("embree_pathtracer")
        if not self.program:
            raise PeerMissing("Embree's path tracer is not installed (Debian: apt-get install embree-tools)")
        self.folder = folder
        view = description["cameras"][camera]
        words = ["-i", "scene.obj", "--size", *map(str, size)]
        for option, key in (("--vp", "eye"), ("--vi", "target"), ("--vu", "up")):
            words += [option, *map(str, view.get(key, [0, 1, 0]))]
        words += ["--fov", str(view["vertical_fov_degrees"]), "--righthanded"]
        words += ["--ambientlight", *map(str, description.get("environment", {}).get("radiance", [0] * 3))]
        if "sun" in description:
            sun = description["sun"]
            radiance = [value / solid_angle for value in sun["irradiance"]]
            words += ["--distantlight", *map(str, sun["direction"] + radiance), str(sun["angular_radius_degrees"])]
        self.words = words

    def render(self, samples, vertices, frames=1, warm_up=1):
        """Mean seconds of the frames after those of warm-up, and wall seconds of the program with its loading."""
        command = [self.program, *self.words, "--spp", str(samples), "--max-path-length", str(vertices)]
        command += ["--legacy", "--benchmark", str(warm_up), str(frames)]
        text, wall = run_program(command, self.folder)
        return {"seconds": embree_frame_seconds(text), "wall": wall}

    def picture(self, samples, vertices, out):
        command = [self.program, *self.words, "--spp", str(samples), "--max-path-length", str(vertices), "-o", out]
        run_program(command, self.folder)
