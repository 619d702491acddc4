"""sweep.py BUILD OUT [--quick]: how Candela's frame times depend on threads, instruction sets, models, lights and triangles.

Writes OUT/sweep.json and OUT/sweep.md. --quick: small pictures and few frames, to try it."""

import argparse
import itertools
import json
import os
import sys

from harness import HERE, figures, folders, lights, run, sphere, written


class Sweep:
    def __init__(self, build, out, quick):
        self.candela = build / "bin/candela"
        self.out = out
        self.frames = 3 if quick else 20
        self.size = (160, 90) if quick else (1920, 1080)
        self.small = (160, 90) if quick else (512, 512)

    def figures(self, scene, *more, size=None, frames=None, **environment):
        return figures(self.candela, scene, *(size or self.size), frames or self.frames, "--warm-up", 2, "--defaults", *more,
                       env={**os.environ, **environment})

    def names(self, kind):
        return [plugin["name"] for plugin in json.loads(run([self.candela, "list", kind, "--json"]))]

    def processors(self):
        """Threads and instruction sets."""
        sets = ["baseline", "avx2", "avx512"]
        sets = sets[:1 + sets.index(self.figures(HERE / "scenes/A.toml")["instruction_set"])]
        threads = sorted({1, os.cpu_count()})
        return [{"scene": name, "instruction_set": used, "threads": count,
                 "frame_ms": self.figures(HERE / f"scenes/{name}.toml", "--threads", count,
                                          CANDELA_INSTRUCTION_SET=used)["frame_ms"]}
                for name in ("A", "AR", "B", "C") for used in sets for count in threads]

    def models(self):
        """Every shading model with every reflection model, under 1, 8 and 64 lights."""
        rows = []
        for count in (1, 8, 64):
            scene = written(self.out, f"lights-{count}", lights(count), sphere(4096))
            for shading, reflection in itertools.product(self.names("shading"), self.names("reflection")):
                found = self.figures(scene, "--shading", shading, "--reflection", reflection, size=self.small, frames=11)
                rows.append({"lights": count, "shading": shading, "reflection": reflection, "frame_ms": found["frame_ms"]})
            print(f"sweep: {count} light(s) done", file=sys.stderr)
        return rows

    def triangles(self):
        """A sphere of a thousand to ten million triangles."""
        rows = []
        for power in range(3, 8):
            found = self.figures(written(self.out, f"triangles-{power}", lights(1), sphere(10**power)))
            rows.append({key: found[key] for key in ("triangles", "meshes_ms", "projection_ms", "tiles_ms", "frame_ms")})
        return rows


def table(head, rows):
    return "\n".join(["| " + " | ".join(head) + " |", "|" + "---|" * len(head),
                      *("| " + " | ".join(row) + " |" for row in rows)]) + "\n"


def markdown(found):
    sets = list(dict.fromkeys(r["instruction_set"] for r in found["processors"]))
    threads = sorted({r["threads"] for r in found["processors"]})
    cell = {(r["scene"], r["instruction_set"], r["threads"]): r["frame_ms"] for r in found["processors"]}
    parts = ["Frames of 1920 x 1080 in milliseconds, by instruction set and threads:\n",
             table(["scene", *(f"{s}, {t}" for s in sets for t in threads)],
                   [[scene, *(f"{cell[scene, s, t]:.2f}" for s in sets for t in threads)] for scene in ("A", "AR", "B", "C")])]
    shadings = list(dict.fromkeys(r["shading"] for r in found["models"]))
    reflections = list(dict.fromkeys(r["reflection"] for r in found["models"]))
    for lights in sorted({r["lights"] for r in found["models"]}):
        cell = {(r["reflection"], r["shading"]): r["frame_ms"] for r in found["models"] if r["lights"] == lights}
        parts += [f"\nA sphere of 8,000 triangles under {lights} light(s), 512 x 512, frames in milliseconds, by shading model:\n",
                  table(["reflection model", *shadings],
                        [[name, *(f"{cell[name, s]:.2f}" for s in shadings)] for name in reflections])]
    parts += ["\nA sphere of more and more triangles, 1920 x 1080, milliseconds:\n",
              table(["triangles", "meshes, once", "projection", "tiles", "frame"],
                    [[f"{r['triangles']:,}", *(f"{r[key]:.2f}" for key in ("meshes_ms", "projection_ms", "tiles_ms", "frame_ms"))]
                     for r in found["triangles"]])]
    return "\n".join(parts)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--quick", action="store_true")
    arguments = folders(parser, "build", "out")
    out = arguments.out
    sweep = Sweep(arguments.build, out, arguments.quick)
    found = {"processors": sweep.processors(), "triangles": sweep.triangles(), "models": sweep.models()}
    (out / "sweep.json").write_text(json.dumps(found, indent=2) + "\n")
    text = markdown(found)
    (out / "sweep.md").write_text(text)
    print(text, end="")


if __name__ == "__main__":
    main()
