"""builds.py OLD NEW [--scenes A,AR,B,C] [--size 1920x1080] [--threads N] [--rounds N]: frames of one build against another's.

OLD and NEW are build folders, such as build/release of two checkouts. In turns; the ratio is NEW's time over OLD's of the same round,
and the median over all rounds is printed with its range. Use an otherwise idle machine.
"""
import argparse
import json
import pathlib
import statistics
import subprocess

SCENES = pathlib.Path(__file__).resolve().parent / "scenes"
FRAMES = 40


def frame_ms(build, scene, size, threads):
    width, height = size.split("x")
    words = [build / "bin" / "candela", "bench", SCENES / f"{scene}.toml", "--frames", str(FRAMES), "--threads", str(threads),
             "--width", width, "--height", height, "--json"]
    return json.loads(subprocess.run(words, check=True, capture_output=True, text=True).stdout)["frame_ms"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("old", type=lambda path: pathlib.Path(path).resolve())
    parser.add_argument("new", type=lambda path: pathlib.Path(path).resolve())
    parser.add_argument("--scenes", default="A,AR,B,C")
    parser.add_argument("--size", default="1920x1080")
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--rounds", type=int, default=7)
    options = parser.parse_args()
    print("| scene | old | new | ratio |\n|---|---|---|---|")
    for scene in options.scenes.split(","):
        rounds = [(frame_ms(options.old, scene, options.size, options.threads), frame_ms(options.new, scene, options.size, options.threads))
                  for _ in range(options.rounds)]
        old, new = (statistics.median(times) for times in zip(*rounds))
        ratios = sorted(n / o for o, n in rounds)
        print(f"| {scene} | {old:.2f} ms | {new:.2f} ms | {statistics.median(ratios):.2f} ({ratios[0]:.2f}–{ratios[-1]:.2f}) |")


if __name__ == "__main__":
    main()
