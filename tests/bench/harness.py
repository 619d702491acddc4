"""Runs and times programs, makes scenes, and sums up figures, for all benchmarks."""
import ctypes
import json
import math
import os
import pathlib
import platform
import resource
import statistics
import subprocess
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).resolve().parent
PR_SET_CHILD_SUBREAPER = 36  # linux/prctl.h
MOST_DIFFERENCE = 0.2  # levels; moving the observer by 0.01 makes 0.4 on A, 1 on C

SCENE = """version = 1
observer = { position = [0.0, 0.6, 3.4], look_at = [0.0, 0.0, 0.0] }
"""


def lights(count):
    """Around the observer, together as bright as one."""
    angles = (2 * math.pi * i / count for i in range(count))
    return "".join(f'[[light]]\ntype = "point"\nposition = [{3 * math.sin(a):.4f}, 2.5, {3 * math.cos(a):.4f}]\n'
                   f"intensity = {14 / count:.6f}\n" for a in angles)


def sphere(triangles):
    return f'[[object]]\ntype = "sphere"\nradius = 1.0\nsegments = {2 * round(math.sqrt(triangles) / 2)}\n'


def written(folder, name, *parts):
    """The file of a scene of these parts."""
    file = folder / f"{name}.toml"
    file.write_text(SCENE + "".join(parts))
    return file


def run(words, **more):
    return subprocess.run([str(w) for w in words], check=True, capture_output=True, text=True, **more).stdout


def figures(candela, scene, width, height, frames, *more, **where):
    """Returns what `candela bench` measures."""
    return json.loads(run([candela, "bench", scene, "--width", width, "--height", height, "--frames", frames, "--json", *more], **where))


def processor():
    for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            return line.split(":", 1)[1].strip()
    return platform.machine()


def processor_seconds():
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def seconds(work):
    """The clock time of `work`, and the processor time of the programs that it waits for."""
    begin, begin_processor = time.perf_counter(), processor_seconds()
    work()
    return time.perf_counter() - begin, processor_seconds() - begin_processor


def spread(values):
    return {"median": statistics.median(values), "least": min(values), "most": max(values)}


def ratio(values, digits=3):
    """The median of ratios, or of their spread, with its range."""
    r = values if isinstance(values, dict) else spread(list(values))
    return f"{r['median']:.{digits}f} ({r['least']:.{digits}f} to {r['most']:.{digits}f})"


def write(out, name, machine, results, text):
    (out / f"{name}.json").write_text(json.dumps({"machine": machine, "results": results}, indent=2) + "\n")
    (out / f"{name}.md").write_text(text)
    print(text, end="")


def folders(parser, *names):
    """The arguments, of which these are folders. The last is created."""
    for name in names:
        parser.add_argument(name, type=lambda path: pathlib.Path(path).resolve())
    arguments = parser.parse_args()
    getattr(arguments, names[-1]).mkdir(parents=True, exist_ok=True)
    return arguments


class Bench:
    """Candela and its OpenGL rival on the scenes of tests/bench/scenes."""

    def __init__(self, build, out, threads=None):
        self.candela = build / "bin/candela"
        self.rival = build / "tests/bench/candela_opengl_rival"
        self.empty = build / "tests/bench/candela_empty_program"
        self.out = out
        # In memory if the system has such a folder, to measure the programs, not the disk.
        self.scratch = tempfile.TemporaryDirectory(dir="/dev/shm" if os.access("/dev/shm", os.W_OK) else None)
        self.pictures = pathlib.Path(self.scratch.name)
        self.threads = ["--threads", threads] if threads else []
        self.env = {**os.environ, "LP_NUM_THREADS": str(threads or os.cpu_count()), "CANDELA_PLUGIN_PATH": str(build / "lib/candela/plugins")}

    def dump(self, build, scene):
        file = self.out / f"{scene}.dump"
        run([build / "tests/bench/candela_dump_scene", HERE / f"scenes/{scene}.toml", file], env=self.env)
        return file

    def figures(self, scene, width, height, frames):
        return figures(self.candela, HERE / f"scenes/{scene}.toml", width, height, frames, *self.threads, env=self.env)

    def ours(self, scene, width, height, frames):
        figures = self.figures(scene, width, height, frames)
        return figures["frame_ms"], figures["relit_frame_ms"]

    def theirs(self, dump, width, height, frames):
        lines = run([self.rival, dump, width, height, "--frames", frames + 5], env=self.env).split()
        return statistics.median(float(x) for x in lines[5:])

    def whole(self, words):
        """Milliseconds from start to end."""
        begin = time.perf_counter()
        process = subprocess.run([str(w) for w in words], env=self.env, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        milliseconds = 1e3 * (time.perf_counter() - begin)
        if process.returncode != 0:
            sys.exit(f"{words[0]} ended with {process.returncode}")
        return milliseconds

    def memory(self, words):
        """Peak memory in MiB. A process inherits the peak of its parent, so a small shell starts it."""
        ctypes.CDLL(None).prctl(PR_SET_CHILD_SUBREAPER, 1)
        pid = run(["sh", "-c", '"$@" >/dev/null 2>&1 & echo $!', "sh", *words], env=self.env)
        _, _, usage = os.wait4(int(pid), 0)
        return usage.ru_maxrss / 1024

    def render_to(self, scene, width, height, file):
        return [self.candela, "render", HERE / f"scenes/{scene}.toml", "--width", width, "--height", height, "-o", file,
                *self.threads]

    def difference(self, scene, width, height, theirs):
        """Mean difference of Candela's picture from theirs, in levels; far more than rounding is an error."""
        ours = self.out / f"{scene}-candela.png"
        run(self.render_to(scene, width, height, ours), env=self.env)
        mean = json.loads(run([self.candela, "diff", ours, theirs, "--json"], env=self.env))["interior"]["mean"]
        if mean > MOST_DIFFERENCE:
            sys.exit(f"{theirs.name}: not the picture of {ours.name} (mean difference {mean:.3f} levels)")
        return mean

    def same_picture(self, scene, dump, width, height):
        theirs = self.out / f"{scene}-opengl.png"
        run([self.rival, dump, width, height, "--png", theirs], env=self.env)
        return self.difference(scene, width, height, theirs)
