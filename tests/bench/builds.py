"""builds.py OLD NEW [--scenes A,AR,B,C] [--size 1920x1080] [--threads N] [--rounds N]: frames of one build against another's.

OLD and NEW are build folders, such as build/release of two checkouts. In turns; the ratio is NEW's time over OLD's of the same round,
and the median over all rounds is printed with its range. Use an otherwise idle machine.
"""
import argparse
import statistics

from harness import HERE, figures, folders, ratio

FRAMES = 40


def frame_ms(build, scene, size, threads):
    return figures(build / "bin/candela", HERE / f"scenes/{scene}.toml", *size.split("x"), FRAMES, "--threads", threads)["frame_ms"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scenes", default="A,AR,B,C")
    parser.add_argument("--size", default="1920x1080")
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--rounds", type=int, default=7)
    options = folders(parser, "old", "new")
    print("| scene | old | new | ratio |\n|---|---|---|---|")
    for scene in options.scenes.split(","):
        rounds = [(frame_ms(options.old, scene, options.size, options.threads), frame_ms(options.new, scene, options.size, options.threads))
                  for _ in range(options.rounds)]
        old, new = (statistics.median(times) for times in zip(*rounds))
        print(f"| {scene} | {old:.2f} ms | {new:.2f} ms | {ratio((n / o for o, n in rounds), 2)} |")


if __name__ == "__main__":
    main()
