"""growth.py BUILD OUT [--quick] [--rounds 3]: how time and memory grow with triangles, objects, lights and pixels.

Each row grows one of them a hundredfold, in two steps, and names the exponent of the time between its ends: 1 where ten times as much
takes ten times as long. Each time is the least of its rounds, in which the sizes take turns. Writes OUT/growth.json and OUT/growth.md.
--quick: a hundredth of each size, to try it."""

import argparse
import json
import math

from harness import Bench, folders, lights, run, sphere, written


def cubes(count):
    """In a block, spaced apart."""
    side = math.ceil(count ** (1 / 3))
    step = 2 / side

    def at(i):
        return ", ".join(f"{(n - side / 2) * step:.6f}" for n in (i % side, i // side % side, i // side**2))
    return "".join(f'[[object]]\ntype = "cube"\nsize = {0.6 * step:.6f}\nposition = [{at(i)}]\n' for i in range(count))


class Growth:
    def __init__(self, build, out, rounds):
        self.bench = Bench(build, out)
        self.out = out
        self.rounds = rounds

    def frames(self, scene, width, height):
        """Reads the scene, makes its meshes and draws some frames."""
        return [self.bench.candela, "bench", scene, "--defaults", "--json", "--width", width, "--height", height, "--frames", 5]

    def picture(self, scene, width, height):
        return [self.bench.candela, "render", scene, "--defaults", "--quiet", "--width", width, "--height", height, "-o",
                self.bench.pictures / "picture.png"]

    def milliseconds(self, words):
        if "render" in words:
            return {"whole": self.bench.whole(words)}
        figures = json.loads(run(words, env=self.bench.env))
        return {"make": figures["read_ms"] + figures["meshes_ms"], "frame": figures["frame_ms"]}

    def measured(self, what, sizes, words_for):
        """A row for each quantity timed when `words_for(size)` is run."""
        found = {size: [] for size in sizes}
        memory = {}
        for _ in range(self.rounds):
            for size in sizes:
                words = words_for(size)
                found[size].append(self.milliseconds(words))
                if size not in memory:
                    memory[size] = self.bench.memory([str(word) for word in words])
        least = {size: {key: min(one[key] for one in of_size) for key in of_size[0]} for size, of_size in found.items()}
        growth = math.log(sizes[-1] / sizes[0])
        return [{"what": what, "timed": key, "sizes": sizes, "ms": [least[size][key] for size in sizes],
                 "exponent": math.log(least[sizes[-1]][key] / least[sizes[0]][key]) / growth, "memory_mib": list(memory.values())}
                for key in least[sizes[0]]]


NAMES = {"make": "to read the scene and make its meshes", "frame": "a frame", "whole": "the whole process, to a PNG file"}


def markdown(rows):
    lines = ["| what grows | what is timed | milliseconds | tenfold takes | exponent | peak memory, MiB |", "|---|---|---|---|---|---|"]
    for row in rows:
        sizes = " → ".join(f"{size:,}" for size in row["sizes"])
        steps = (later / earlier for earlier, later in zip(row["ms"], row["ms"][1:]))
        lines.append(f"| {row['what']}: {sizes} | {NAMES[row['timed']]} | {' → '.join(f'{ms:,.1f}' for ms in row['ms'])} | "
                     f"{', '.join(f'{step:.1f}' for step in steps)} | {row['exponent']:.2f} | "
                     f"{' → '.join(f'{mib:,.0f}' for mib in row['memory_mib'])} |")
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--rounds", type=int, default=3)
    arguments = folders(parser, "build", "out")
    out = arguments.out
    growth = Growth(arguments.build, out, arguments.rounds)
    part = 100 if arguments.quick else 1

    def triangles(count):
        return growth.frames(written(out, "triangles", lights(1), sphere(count)), 1920, 1080)

    def objects(count):
        return growth.frames(written(out, "objects", lights(1), cubes(count)), 1920, 1080)

    def many_lights(count):
        return growth.frames(written(out, "lights", lights(count), sphere(8000)), 512, 512)

    def pixels(count):
        side = round(math.sqrt(count))
        return growth.picture(written(out, "pixels", lights(1), sphere(8000)), side, side)

    rows = [*growth.measured("triangles", [10**p // part for p in (5, 6, 7)], triangles),
            *growth.measured("objects", [10**p // part for p in (3, 4, 5)], objects),
            *[row for row in growth.measured("lights", [10**p for p in (1, 2, 3)], many_lights) if row["timed"] == "frame"],
            *growth.measured("pixels", [side**2 // part for side in (1638, 5180, 16384)], pixels)]
    (out / "growth.json").write_text(json.dumps(rows, indent=2) + "\n")
    text = markdown(rows)
    (out / "growth.md").write_text(text)
    print(text, end="")


if __name__ == "__main__":
    main()
