"""mesh_file.py BUILD OUT [--format ply] [--size 1000x600] [--rounds 7] [--rows N]: Candela against f3d on a file of ten million
triangles: ply, stl, obj or glb.

Whole processes from file to PNG, in turns; the ratio is Candela's time over f3d's of the same round, and the median over all rounds is
printed, with processor time. f3d needs a display: xvfb-run provides one if there is none."""
import argparse
import os
import shutil
import statistics
import subprocess
import sys
from pathlib import Path

import large_mesh
from harness import folders, ratio, seconds


def seconds_of(words, directory: Path):
    return seconds(lambda: subprocess.run(words, cwd=directory, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL))


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("--format", choices=[suffix[1:] for suffix in large_mesh.WRITERS], default="ply")
    parser.add_argument("--size", default="1000x600")
    parser.add_argument("--rounds", type=int, default=7)
    parser.add_argument("--rows", type=int, default=2237)
    options = folders(parser, "build", "out")
    if not shutil.which("f3d"):
        sys.exit("mesh_file: f3d is missing; scripts/setup.sh --programs installs it")
    if "DISPLAY" not in os.environ:  # once for all rounds, so that its start is not measured
        os.execvp("xvfb-run", ["xvfb-run", "-a", sys.executable, "-B", *sys.argv])
    width, height = options.size.split("x")
    out = options.out
    model = f"large.{options.format}"
    large_mesh.write(out / model, options.rows)
    candela = [str(options.build / "bin/candela"), "render", model, "--no-shadows", "-o", "candela.png", "--width", width, "--height", height]
    f3d = ["f3d", model, "--output", "f3d.png", f"--resolution={width},{height}"]
    for words in (candela, f3d):  # the file comes from memory from now on
        seconds_of(words, out)
    rounds = [(seconds_of(candela, out), seconds_of(f3d, out)) for _ in range(options.rounds)]
    for name, part in (("elapsed", 0), ("processor", 1)):
        print(f"{name:9}  Candela {statistics.median(ours[part] for ours, _ in rounds):6.2f} s   "
              f"f3d {statistics.median(theirs[part] for _, theirs in rounds):6.2f} s   "
              f"ratio {ratio((ours[part] / theirs[part] for ours, theirs in rounds), 2)}")


if __name__ == "__main__":
    main()
