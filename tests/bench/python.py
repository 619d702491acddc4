"""python.py BUILD [--rounds 31]: Python against C++, in turns: GGX at a million points, and the still life to an array. Each ratio is
Python's time on the processor over C++'s of the same round; prints the median, with the quartiles. Run it with Debian's Python, for which
the module is built."""

import argparse
import pathlib
import statistics
import subprocess
import sys
import time

HERE = pathlib.Path(__file__).resolve().parent


class Rival:
    """The same in C++, on request."""

    def __init__(self, build, *words):
        self.process = subprocess.Popen([build / "tests/bench/candela_python_rival", *map(str, words)], stdin=subprocess.PIPE,
                                        stdout=subprocess.PIPE, text=True, bufsize=1)

    def seconds(self):
        self.process.stdin.write("\n")
        return float(self.process.stdout.readline())

    def end(self):
        self.process.stdin.close()
        self.process.wait()


def compare(what, rival, work, rounds):
    ratios = []
    for i in range(rounds + 2):
        theirs = rival.seconds()
        begin = time.process_time()
        work()
        ours = time.process_time() - begin
        if i >= 2:
            ratios.append(ours / theirs)
    low, median, high = statistics.quantiles(ratios, n=4)
    print(f"{what:58} {median:.3f}  ({low:.3f} to {high:.3f})")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--rounds", type=int, default=31)
    arguments = parser.parse_args()
    sys.path.insert(0, str(arguments.build / "lib/python3/dist-packages"))
    import candela
    import numpy as np

    count = 1_000_000
    t = np.linspace(0, 1, count, endpoint=False, dtype=np.float32)
    model = candela.reflection("ggx", roughness=0.2)

    def directions(x, y, z):
        v = np.stack([x, np.full_like(x, y), np.full_like(x, z)], axis=-1)
        return v / np.linalg.norm(v, axis=-1, keepdims=True)

    normals, to_observer, to_light = directions(0 * t, 1, 0), directions(t, 1, 0.3), directions(-t, 1, 0.1)
    apart = [np.asfortranarray(array) for array in (normals, to_observer, to_light)]
    print(f"{'Python over C++':58} median  (quartiles)")
    rival = Rival(arguments.build, "evaluate", count)
    compare("GGX at 10^6 points, arrays (N, 3), one thread", rival,
            lambda: model.evaluate(normals, to_observer, to_light, threads=1), arguments.rounds)
    compare("GGX at 10^6 points, channels apart, one thread", rival, lambda: model.evaluate(*apart, threads=1), arguments.rounds)
    rival.end()
    file = HERE.parents[1] / "docs/examples/still-life.toml"
    scene = candela.Scene.load(file)
    rival = Rival(arguments.build, "render", file)
    compare("docs/examples/still-life.toml to an array", rival, scene.render, arguments.rounds)
    rival.end()


if __name__ == "__main__":
    main()
