"""bench.py BUILD OUT [--scenes A,AR,B,C] [--sizes 512x512,1920x1080,3840x2160] [--rounds 7] [--threads N]: Candela against
OpenGL.

The rivals take turns within one run; each figure is the median of its rounds, each ratio is Candela's time over OpenGL's of the
same round. Writes OUT/results.json and OUT/results.md."""

import argparse
import ctypes
import json
import os
import pathlib
import platform
import re
import statistics
import subprocess
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).resolve().parent
PR_SET_CHILD_SUBREAPER = 36  # linux/prctl.h
MOST_DIFFERENCE = 0.2  # levels; moving the observer by 0.01 makes 0.4 on A, 1 on C


def run(words, **more):
    return subprocess.run([str(w) for w in words], check=True, capture_output=True, text=True, **more).stdout


def processor():
    for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            return line.split(":", 1)[1].strip()
    return platform.machine()


class Bench:
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
        return json.loads(run([self.candela, "bench", HERE / f"scenes/{scene}.toml", "--width", width, "--height", height,
                               "--frames", frames, "--json", *self.threads], env=self.env))

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


def spread(values):
    return {"median": statistics.median(values), "least": min(values), "most": max(values)}


def measure(bench, build, scene, width, height, rounds):
    dump = bench.dump(build, scene)
    result = {"scene": scene, "width": width, "height": height, "mean_difference": bench.same_picture(scene, dump, width, height)}
    to_png = bench.render_to(scene, width, height, bench.pictures / "candela.png")
    their_to_png = [bench.rival, dump, width, height, "--png", bench.pictures / "opengl.png"]
    frames = 30
    rows = []
    for _ in range(rounds):
        ours, relit = bench.ours(scene, width, height, frames)
        theirs = bench.theirs(dump, width, height, frames)
        png = bench.whole(to_png)
        their_png = bench.whole(their_to_png)
        ppm = bench.whole(bench.render_to(scene, width, height, bench.pictures / "candela.ppm"))
        rows.append((ours, relit, theirs, png, their_png, ppm, bench.whole(["true"]), bench.whole([bench.empty])))
    ours, relit, theirs, png, their_png, ppm, true, empty = zip(*rows)
    result["frame"] = {"candela_ms": spread(ours), "opengl_ms": spread(theirs), "ratio": spread([a / b for a, b in zip(ours, theirs)])}
    result["relit"] = {"candela_ms": spread(relit), "ratio_to_frame": spread([a / b for a, b in zip(relit, ours)])}
    result["whole_process_png"] = {"candela_ms": spread(png), "opengl_ms": spread(their_png),
                                   "ratio": spread([a / b for a, b in zip(png, their_png)])}
    result["whole_process_ppm"] = {"candela_ms": spread(ppm), "ratio_to_true": spread([a / b for a, b in zip(ppm, true)]),
                                   "ratio_to_empty_program": spread([a / b for a, b in zip(ppm, empty)])}
    result["peak_memory"] = {"candela_mib": bench.memory(to_png), "opengl_mib": bench.memory(their_to_png)}
    result["png_size_ratio"] = (bench.pictures / "candela.png").stat().st_size / (bench.pictures / "opengl.png").stat().st_size
    return result


def ratio(r, digits=3):
    return f"{r['median']:.{digits}f} ({r['least']:.{digits}f} to {r['most']:.{digits}f})"


def table(results, machine):
    lines = [f"Machine: {machine['processor']}, {machine['threads']} threads; Candela: {machine['instruction_set']}; OpenGL: "
             f"{machine['opengl']}.", "",
             "| scene | size | Candela frame | OpenGL frame | ratio | relit / frame |", "|---|---|---|---|---|---|"]
    for r in results:
        frame = r["frame"]
        lines.append(f"| {r['scene']} | {r['width']} x {r['height']} | {frame['candela_ms']['median']:.2f} ms | "
                     f"{frame['opengl_ms']['median']:.2f} ms | {ratio(frame['ratio'])} | {ratio(r['relit']['ratio_to_frame'])} |")
    lines += ["", "| scene | size | whole process to PNG: Candela | OpenGL | ratio | size of the file, ratio | peak memory: Candela | "
              "OpenGL | without PNG, over `true` | over an empty C++ program |", "|---|---|---|---|---|---|---|---|---|---|"]
    for r in results:
        whole, memory = r["whole_process_png"], r["peak_memory"]
        lines.append(f"| {r['scene']} | {r['width']} x {r['height']} | {whole['candela_ms']['median']:.1f} ms | "
                     f"{whole['opengl_ms']['median']:.1f} ms | {ratio(whole['ratio'])} | {r['png_size_ratio']:.2f} | "
                     f"{memory['candela_mib']:.0f} MiB | {memory['opengl_mib']:.0f} MiB | "
                     f"{r['whole_process_ppm']['ratio_to_true']['median']:.1f} | "
                     f"{r['whole_process_ppm']['ratio_to_empty_program']['median']:.1f} |")
    return "\n".join(lines) + "\n"


def asked_for(sizes):
    parser = argparse.ArgumentParser()
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--scenes", default="A,AR,B,C")
    parser.add_argument("--sizes", default=sizes)
    parser.add_argument("--rounds", type=int, default=7)
    parser.add_argument("--threads", type=int)
    arguments = parser.parse_args()
    for scene in arguments.scenes.split(","):
        if not (HERE / f"scenes/{scene}.toml").exists():
            parser.error(f"no scene '{scene}' (A, AR, B, C)")
    if not re.fullmatch(r"[1-9]\d*x[1-9]\d*(,[1-9]\d*x[1-9]\d*)*", arguments.sizes):
        parser.error(f"sizes are like 512x512,1920x1080, not '{arguments.sizes}'")
    if arguments.rounds < 1:
        parser.error("at least one round")
    if arguments.threads is not None and arguments.threads < 1:
        parser.error("at least one thread")
    arguments.build, arguments.out = arguments.build.resolve(), arguments.out.resolve()
    arguments.out.mkdir(parents=True, exist_ok=True)
    return arguments


def cells(arguments):
    """The scene, width and height of each row, reported when done."""
    for scene in arguments.scenes.split(","):
        for size in arguments.sizes.split(","):
            yield scene, *(int(x) for x in size.split("x"))
            print(f"bench: {scene} {size} done", file=sys.stderr)


def write(out, name, machine, results, text):
    (out / f"{name}.json").write_text(json.dumps({"machine": machine, "results": results}, indent=2) + "\n")
    (out / f"{name}.md").write_text(text)
    print(text, end="")


def main():
    arguments = asked_for("512x512,1920x1080,3840x2160")
    build, out = arguments.build, arguments.out
    bench = Bench(build, out, arguments.threads)
    machine = {"processor": processor(), "threads": arguments.threads or os.cpu_count(),
               "instruction_set": bench.figures("A", 16, 16, 1)["instruction_set"],
               "opengl": run([bench.rival, "--version"], env=bench.env).strip()}
    results = [measure(bench, build, *cell, arguments.rounds) for cell in cells(arguments)]
    write(out, "results", machine, results, table(results, machine))


if __name__ == "__main__":
    main()
