"""bench.py BUILD OUT [--scenes A,AR,B,C] [--sizes 512x512,1920x1080] [--rounds 7]: Candela against OpenGL.

The rivals take turns within one run; each figure is the median of its rounds, each ratio is Candela's time over OpenGL's of the
same round. Writes OUT/results.json and OUT/results.md."""

import argparse
import json
import os
import pathlib
import platform
import statistics
import subprocess
import sys
import time

HERE = pathlib.Path(__file__).resolve().parent


def run(words, **more):
    return subprocess.run([str(w) for w in words], check=True, capture_output=True, text=True, **more).stdout


def processor():
    for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            return line.split(":", 1)[1].strip()
    return platform.machine()


class Bench:
    def __init__(self, build, out):
        self.candela = build / "bin/candela"
        self.rival = build / "tests/bench/candela_opengl_rival"
        self.out = out
        threads = str(os.cpu_count())
        self.env = {**os.environ, "LP_NUM_THREADS": threads, "CANDELA_PLUGIN_PATH": str(build / "lib/candela/plugins")}

    def dump(self, build, scene):
        file = self.out / f"{scene}.dump"
        run([build / "tests/bench/candela_dump_scene", HERE / f"scenes/{scene}.toml", file], env=self.env)
        return file

    def ours(self, scene, width, height, frames):
        figures = json.loads(run([self.candela, "bench", HERE / f"scenes/{scene}.toml", "--width", width, "--height", height,
                                  "--frames", frames, "--json"], env=self.env))
        return figures["frame_ms"], figures["relit_frame_ms"]

    def theirs(self, dump, width, height, frames):
        lines = run([self.rival, dump, width, height, "--frames", frames + 5], env=self.env).split()
        return statistics.median(float(x) for x in lines[5:])

    def whole(self, words):
        begin = time.perf_counter()
        run(words, env=self.env)
        return 1e3 * (time.perf_counter() - begin)

    def same_picture(self, scene, dump, width, height):
        """How the pictures differ; far more than rounding is an error."""
        ours, theirs = self.out / f"{scene}-candela.png", self.out / f"{scene}-opengl.png"
        run([self.candela, "render", HERE / f"scenes/{scene}.toml", "--width", width, "--height", height, "-o", ours], env=self.env)
        run([self.rival, dump, width, height, "--png", theirs], env=self.env)
        figures = json.loads(run([self.candela, "diff", ours, theirs, "--json"], env=self.env))["interior"]
        if figures["mean"] > 0.5:
            sys.exit(f"scene {scene}: the rivals do not render the same picture (mean difference {figures['mean']:.3f} levels)")
        return figures["mean"]


def spread(values):
    return {"median": statistics.median(values), "least": min(values), "most": max(values)}


def measure(bench, build, scene, width, height, rounds):
    dump = bench.dump(build, scene)
    result = {"scene": scene, "width": width, "height": height, "mean_difference": bench.same_picture(scene, dump, width, height)}
    frames = 30
    rows = []
    for _ in range(rounds):
        ours, relit = bench.ours(scene, width, height, frames)
        theirs = bench.theirs(dump, width, height, frames)
        png = bench.whole([bench.candela, "render", HERE / f"scenes/{scene}.toml", "--width", width, "--height", height,
                           "-o", bench.out / "whole.png"])
        their_png = bench.whole([bench.rival, dump, width, height, "--png", bench.out / "whole.png"])
        rows.append((ours, relit, theirs, png, their_png))
    ours, relit, theirs, png, their_png = zip(*rows)
    result["frame"] = {"candela_ms": spread(ours), "opengl_ms": spread(theirs), "ratio": spread([a / b for a, b in zip(ours, theirs)])}
    result["relit"] = {"candela_ms": spread(relit), "ratio_to_frame": spread([a / b for a, b in zip(relit, ours)])}
    result["whole_process_png"] = {"candela_ms": spread(png), "opengl_ms": spread(their_png),
                                   "ratio": spread([a / b for a, b in zip(png, their_png)])}
    return result


def table(results, machine):
    def ratio(r):
        return f"{r['median']:.3f} ({r['least']:.3f} to {r['most']:.3f})"

    lines = [f"Machine: {machine['processor']}, {machine['threads']} threads; OpenGL: {machine['opengl']}.", "",
             "| scene | size | Candela frame | OpenGL frame | ratio | relit / frame | whole process to PNG: Candela | OpenGL | ratio |",
             "|---|---|---|---|---|---|---|---|---|"]
    for r in results:
        frame, whole = r["frame"], r["whole_process_png"]
        lines.append(f"| {r['scene']} | {r['width']} x {r['height']} | {frame['candela_ms']['median']:.2f} ms | "
                     f"{frame['opengl_ms']['median']:.2f} ms | {ratio(frame['ratio'])} | {ratio(r['relit']['ratio_to_frame'])} | "
                     f"{whole['candela_ms']['median']:.1f} ms | {whole['opengl_ms']['median']:.1f} ms | {ratio(whole['ratio'])} |")
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--scenes", default="A,AR,B,C")
    parser.add_argument("--sizes", default="512x512,1920x1080")
    parser.add_argument("--rounds", type=int, default=7)
    arguments = parser.parse_args()
    build, out = arguments.build.resolve(), arguments.out.resolve()
    out.mkdir(parents=True, exist_ok=True)
    bench = Bench(build, out)
    machine = {"processor": processor(), "threads": os.cpu_count(),
               "opengl": run([bench.rival, "--version"], env=bench.env).strip()}
    results = []
    for scene in arguments.scenes.split(","):
        for size in arguments.sizes.split(","):
            width, height = (int(x) for x in size.split("x"))
            results.append(measure(bench, build, scene, width, height, arguments.rounds))
            print(f"bench: {scene} {size} done", file=sys.stderr)
    (out / "results.json").write_text(json.dumps({"machine": machine, "results": results}, indent=2) + "\n")
    text = table(results, machine)
    (out / "results.md").write_text(text)
    print(text, end="")


if __name__ == "__main__":
    main()
