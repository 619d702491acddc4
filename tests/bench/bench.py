"""bench.py BUILD OUT [--scenes A,AR,B,C] [--sizes 512x512,1920x1080,3840x2160] [--rounds 7]: Candela against OpenGL.

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
        """Milliseconds from start to end, and the most memory held, in MiB."""
        begin = time.perf_counter()
        process = subprocess.Popen([str(w) for w in words], env=self.env, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        _, status, usage = os.wait4(process.pid, 0)
        milliseconds = 1e3 * (time.perf_counter() - begin)
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode != 0:
            sys.exit(f"{words[0]} ended with {process.returncode}")
        return milliseconds, usage.ru_maxrss / 1024

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
        ours_to = [bench.candela, "render", HERE / f"scenes/{scene}.toml", "--width", width, "--height", height, "-o"]
        png, memory = bench.whole([*ours_to, bench.out / "candela.png"])
        their_png, their_memory = bench.whole([bench.rival, dump, width, height, "--png", bench.out / "opengl.png"])
        ppm, _ = bench.whole([*ours_to, bench.out / "candela.ppm"])
        nothing, _ = bench.whole(["true"])
        rows.append((ours, relit, theirs, png, their_png, memory, their_memory, ppm, nothing))
    ours, relit, theirs, png, their_png, memory, their_memory, ppm, nothing = zip(*rows)
    result["frame"] = {"candela_ms": spread(ours), "opengl_ms": spread(theirs), "ratio": spread([a / b for a, b in zip(ours, theirs)])}
    result["relit"] = {"candela_ms": spread(relit), "ratio_to_frame": spread([a / b for a, b in zip(relit, ours)])}
    result["whole_process_png"] = {"candela_ms": spread(png), "opengl_ms": spread(their_png),
                                   "ratio": spread([a / b for a, b in zip(png, their_png)])}
    result["whole_process_ppm"] = {"candela_ms": spread(ppm), "ratio_to_true": spread([a / b for a, b in zip(ppm, nothing)])}
    result["peak_memory"] = {"candela_mib": spread(memory), "opengl_mib": spread(their_memory),
                             "ratio": spread([a / b for a, b in zip(memory, their_memory)])}
    result["png_size_ratio"] = (bench.out / "candela.png").stat().st_size / (bench.out / "opengl.png").stat().st_size
    return result


def table(results, machine):
    def ratio(r):
        return f"{r['median']:.3f} ({r['least']:.3f} to {r['most']:.3f})"

    lines = [f"Machine: {machine['processor']}, {machine['threads']} threads; OpenGL: {machine['opengl']}.", "",
             "| scene | size | Candela frame | OpenGL frame | ratio | relit / frame |", "|---|---|---|---|---|---|"]
    for r in results:
        frame = r["frame"]
        lines.append(f"| {r['scene']} | {r['width']} x {r['height']} | {frame['candela_ms']['median']:.2f} ms | "
                     f"{frame['opengl_ms']['median']:.2f} ms | {ratio(frame['ratio'])} | {ratio(r['relit']['ratio_to_frame'])} |")
    lines += ["", "| scene | size | whole process to PNG: Candela | OpenGL | ratio | size of the file, ratio | peak memory: Candela | "
              "OpenGL | without PNG, over an empty process |", "|---|---|---|---|---|---|---|---|---|"]
    for r in results:
        whole, memory = r["whole_process_png"], r["peak_memory"]
        lines.append(f"| {r['scene']} | {r['width']} x {r['height']} | {whole['candela_ms']['median']:.1f} ms | "
                     f"{whole['opengl_ms']['median']:.1f} ms | {ratio(whole['ratio'])} | {r['png_size_ratio']:.2f} | "
                     f"{memory['candela_mib']['median']:.0f} MiB | {memory['opengl_mib']['median']:.0f} MiB | "
                     f"{r['whole_process_ppm']['ratio_to_true']['median']:.1f} |")
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--scenes", default="A,AR,B,C")
    parser.add_argument("--sizes", default="512x512,1920x1080,3840x2160")
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
