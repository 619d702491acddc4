"""shadows.py BUILD OUT [--rounds 5] [--quick]: what shadows cost.

In turns: frames of the scenes of tests/bench/scenes with shadows and without; Candela's rays against a bare loop over Embree's; a torus of
more and more triangles, under more and more lights, with the exponent of the time between the ends; and, if there is POV-Ray, whole
processes from scene to PNG against its own with shadows. Writes OUT/shadows.md. --quick: small pictures and few triangles, to try it."""

import argparse
import math
import re
import shutil

from harness import HERE, Bench, figures, folders, lights, processor, ratio, run, written

TORUS = '[[object]]\ntype = "torus"\nmajor_radius = 0.8\nminor_radius = 0.35\nrotation = [40.0, 0.0, 20.0]\nsegments = {}\n'
MODELS = 'shading = { model = "phong" }\nreflection = { model = "phong" }\n'


def torus(triangles):
    """As the harness' sphere: with that many triangles."""
    return TORUS.format(2 * round(math.sqrt(triangles) / 2))


def frames(bench, scene, size, count, with_shadows):
    return figures(bench.candela, scene, *size, count, "--shadows" if with_shadows else "--no-shadows", env=bench.env)["frame_ms"]


def cost(bench, rounds, size):
    lines = ["| scene | without | with shadows | ratio |", "|---|---|---|---|"]
    for name in ("A", "AR", "B", "C"):
        scene = HERE / f"scenes/{name}.toml"
        pairs = [(frames(bench, scene, size, 20, False), frames(bench, scene, size, 20, True)) for _ in range(rounds)]
        without, with_shadows = (min(times) for times in zip(*pairs))
        lines.append(f"| {name} | {without:.2f} ms | {with_shadows:.2f} ms | {ratio((b / a for a, b in pairs), 2)} |")
    return lines


def rays(build, rounds):
    lines = ["| scene | Candela, million rays per second | bare Embree | ratio |", "|---|---|---|---|"]
    for name in ("AR", "B"):
        text = run([build / "tests/bench/candela_occlusion_rays", HERE / f"scenes/{name}.toml", rounds])
        found = [tuple(map(float, pair)) for pair in re.findall(r"([\d.]+) M/s, Embree ([\d.]+) M/s", text)]
        ours, bare = (max(rates) for rates in zip(*found))
        lines.append(f"| {name} | {ours:.1f} | {bare:.1f} | {ratio((a / b for a, b in found), 2)} |")
    return lines


def growth(bench, rounds, size, quick):
    lines = ["| what grows | a frame without | with shadows | exponent, without | with |", "|---|---|---|---|---|"]
    part = 10 if quick else 1
    cases = {"triangles": ((10_000 // part, 100_000 // part, 1_000_000 // part), lambda n: (MODELS, lights(1), torus(n))),
             "lights": ((1, 10, 100), lambda n: (MODELS, lights(n), torus(8000)))}
    for what, (sizes, parts) in cases.items():
        times = {False: [], True: []}
        for number in sizes:
            scene = written(bench.out, f"shadows-{what}", *parts(number))
            for with_shadows, found in times.items():
                found.append(min(frames(bench, scene, size, 5, with_shadows) for _ in range(rounds)))
        exponents = [math.log(found[-1] / found[0]) / math.log(sizes[-1] / sizes[0]) for found in times.values()]
        shown = [" → ".join(f"{ms:.1f}" for ms in found) + " ms" for found in times.values()]
        lines.append(f"| {what}: {' → '.join(f'{n:,}' for n in sizes)} | {shown[0]} | {shown[1]} | {exponents[0]:.2f} | {exponents[1]:.2f} |")
    return lines


def against_pov_ray(bench, rounds, size):
    lines = ["| scene | Candela | POV-Ray | ratio |", "|---|---|---|---|"]
    for name in ("AR", "B"):
        folder = bench.out / f"povray-{name}"
        shutil.rmtree(folder, ignore_errors=True)
        scene = [HERE / f"scenes/{name}.toml", "--shadows", "--width", size[0], "--height", size[1]]
        run([bench.candela, "generate", *scene, "--target", "povray", "--approximate", "-o", folder], env=bench.env)
        theirs = ["povray", f"+I{folder}/scene.pov", f"+O{bench.out}/pov.png", f"+L{folder}", f"+W{size[0]}", f"+H{size[1]}", "-A", "-D"]
        ours = [bench.candela, "render", *scene, "-o", bench.out / "candela.png"]
        pairs = [(bench.whole(ours), bench.whole(theirs)) for _ in range(rounds)]
        a, b = (min(times) for times in zip(*pairs))
        lines.append(f"| {name} | {a:.0f} ms | {b:.0f} ms | {ratio((x / y for x, y in pairs), 4)} |")
    return lines


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--quick", action="store_true")
    options = folders(parser, "build", "out")
    bench = Bench(options.build, options.out)
    size = (320, 180) if options.quick else (1920, 1080)
    parts = [[f"{processor()}, {size[0]} x {size[1]}."], cost(bench, options.rounds, size), rays(options.build, options.rounds),
             growth(bench, options.rounds, size, options.quick)]
    if shutil.which("povray"):
        parts.append(against_pov_ray(bench, min(options.rounds, 3), size))
    text = "\n\n".join("\n".join(lines) for lines in parts) + "\n"
    (options.out / "shadows.md").write_text(text)
    print(text, end="")


if __name__ == "__main__":
    main()
