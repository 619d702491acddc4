"""Frames in one `candela animate` against as many runs of `candela render`, in turns: the ratios of their times, by the clock and by
processor time.

animation.py <build folder> <work folder> [--frames N] [--rounds N]
"""
import argparse
import pathlib
import shutil
import statistics
import subprocess

from stopwatch import seconds

parser = argparse.ArgumentParser()
parser.add_argument("build", type=pathlib.Path)
parser.add_argument("work", type=pathlib.Path)
parser.add_argument("--frames", type=int, default=200)
parser.add_argument("--rounds", type=int, default=3)
arguments = parser.parse_args()
command = arguments.build.resolve() / "bin" / "candela"
size = ["--width", "160", "--height", "100", "--samples", "1", "--quiet"]


def candela(*words):
    subprocess.run([command, *words], cwd=arguments.work, check=True)


def one_process():
    candela("animate", "scene.toml", "--force", *size, "-o", "together/%04d.png")


def many_processes():
    for frame in range(arguments.frames):
        candela("render", "scene.toml", "--frame", str(frame), *size, "-o", f"alone/{frame:04}.png")


shutil.rmtree(arguments.work, ignore_errors=True)
(arguments.work / "alone").mkdir(parents=True)
candela("new", "scene.toml", "--animation", "--quiet")
candela("edit", "scene.toml", "--change", f"animation.frames={arguments.frames}", "--quiet")
ratios = []
for _ in range(arguments.rounds):
    together, alone = seconds(one_process), seconds(many_processes)
    ratios.append([b / a for a, b in zip(together, alone)])
    print(f"{arguments.frames} frames: animate {together[0]:.2f} s ({together[1]:.2f} of processors), render {alone[0]:.2f} s "
          f"({alone[1]:.2f}), ratio {ratios[-1][0]:.2f} ({ratios[-1][1]:.2f})", flush=True)
for frame in range(arguments.frames):
    name = f"{frame:04}.png"
    if (arguments.work / "together" / name).read_bytes() != (arguments.work / "alone" / name).read_bytes():
        raise SystemExit(f"frame {frame} differs")
clock, processors = (statistics.median(ratio) for ratio in zip(*ratios))
print(f"the same bytes; median ratio {clock:.2f} by the clock, {processors:.2f} by processor time")
