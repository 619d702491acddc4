"""Frames of an animation, in turns: the ratios of their times, by the clock and by processor time, and their medians.

animation.py <build folder> <work folder> [--workers] [--frames N] [--rounds N]

As many runs of `candela render` over one `candela animate`. With --workers, frames of 4K by one worker of `candela submit` over those
by two; half of the ratio by the clock is their efficiency, which is meaningful only on an idle machine, and the ratio of processor
times is less than 1 if they slow each other down.
"""
import argparse
import shutil
import statistics
import subprocess

from harness import folders, seconds

parser = argparse.ArgumentParser()
parser.add_argument("--workers", action="store_true")
parser.add_argument("--frames", type=int)
parser.add_argument("--rounds", type=int, default=3)
arguments = folders(parser, "build", "work")
frames = arguments.frames or (24 if arguments.workers else 200)
small = ["--width", 160, "--height", 100, "--samples", 1, "--quiet"]
large = ["--width", 3840, "--height", 2160, "--samples", 8, "--quiet"]


def candela(*words):
    subprocess.run([arguments.build / "bin/candela", *map(str, words)], cwd=arguments.work, check=True)


def animated():
    candela("animate", "scene.toml", "--force", *small, "-o", "animate/%04d.png")


def rendered():
    for frame in range(frames):
        candela("render", "scene.toml", "--frame", frame, *small, "-o", f"render/{frame:04}.png")


def submitted(workers):
    shutil.rmtree(arguments.work / str(workers), ignore_errors=True)
    candela("submit", "scene.toml", "-o", f"{workers}/%04d.png", "--jobs", workers, "--threads", 1, "--chunk", 3, *large)


shutil.rmtree(arguments.work, ignore_errors=True)
(arguments.work / "render").mkdir(parents=True)
candela("new", "scene.toml", "--animation", "--quiet")
candela("edit", "scene.toml", "--change", f"animation.frames={frames}", "--quiet")
slow, fast = (("1", lambda: submitted(1)), ("2", lambda: submitted(2))) if arguments.workers else (("render", rendered), ("animate", animated))
ratios = []
for _ in range(arguments.rounds):
    one, other = seconds(slow[1]), seconds(fast[1])
    ratios.append([a / b for a, b in zip(one, other)])
    print(f"{frames} frames: {slow[0]} {one[0]:.2f} s ({one[1]:.2f} of processors), {fast[0]} {other[0]:.2f} s ({other[1]:.2f}), "
          f"ratio {ratios[-1][0]:.2f} ({ratios[-1][1]:.2f})", flush=True)
for frame in range(frames):
    name = f"{frame:04}.png"
    if (arguments.work / slow[0] / name).read_bytes() != (arguments.work / fast[0] / name).read_bytes():
        raise SystemExit(f"frame {frame} differs")
clock, processors = (statistics.median(ratio) for ratio in zip(*ratios))
print(f"the same bytes; median ratio {clock:.2f} by the clock, {processors:.2f} by processor time")
