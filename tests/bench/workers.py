"""Frames of 4K by two workers of `candela submit` against one, in turns: the efficiency, by the clock and by processor time.

workers.py <build folder> <work folder> [--frames N] [--rounds N]

By the clock it is (time of one) / (2 x time of two), and meaningful only on an idle machine; by processor time it is the time of one
over the total time of two, and less than 1 if they slow each other down.
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
parser.add_argument("--frames", type=int, default=24)
parser.add_argument("--rounds", type=int, default=3)
arguments = parser.parse_args()
command = arguments.build.resolve() / "bin" / "candela"


def candela(*words):
    subprocess.run([command, *map(str, words)], cwd=arguments.work, check=True)


def seconds_by(workers):
    shutil.rmtree(arguments.work / "frames", ignore_errors=True)
    return seconds(lambda: candela(
        "submit", "scene.toml", "-o", "frames/%04d.png", "--jobs", workers, "--threads", 1, "--chunk", 3, "--quiet",
        "--width", 3840, "--height", 2160, "--samples", 8))


shutil.rmtree(arguments.work, ignore_errors=True)
arguments.work.mkdir(parents=True)
candela("new", "scene.toml", "--animation", "--quiet")
candela("edit", "scene.toml", "--change", f"animation.frames={arguments.frames}", "--quiet")
efficiencies = []
for _ in range(arguments.rounds):
    one, two = seconds_by(1), seconds_by(2)
    efficiencies.append((one[0] / (2 * two[0]), one[1] / two[1]))
    print(f"{arguments.frames} frames: one worker {one[0]:.2f} s ({one[1]:.2f} of processors), two {two[0]:.2f} s ({two[1]:.2f}), "
          f"efficiency {efficiencies[-1][0]:.2f} ({efficiencies[-1][1]:.2f})", flush=True)
print("median: efficiency", " ".join(f"{statistics.median(column):.2f}" for column in zip(*efficiencies)), "by the clock and by processor time")
