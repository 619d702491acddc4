"""shadow_comparison.py CANDELA SCENES [SEED]: renders random scenes with shadows by Candela and by POV-Ray, and compares them.

Prints the share of interior pixels, farther than 1.5 pixels from the outlines of objects and shadows, that differ by at most 1/255. Fails
if it is below 99.9 % over all scenes. Lights of all kinds, all shapes, closed and open meshes, small and large scenes."""

import math
import random
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

WIDTH, HEIGHT = 160, 120
BAR = 0.999
FLOOR = "v -5 0 -5\nv -5 0 5\nv 5 0 5\nv 5 0 -5\nf 1 2 3 4\n"
GOLDEN = (1 + math.sqrt(5)) / 2


def icosahedron():
    corners = [(0, a, b * GOLDEN) for a in (-1, 1) for b in (-1, 1)]
    corners += [(a, b * GOLDEN, 0) for a in (-1, 1) for b in (-1, 1)] + [(b * GOLDEN, 0, a) for a in (-1, 1) for b in (-1, 1)]
    points = np.array(corners)
    text = "".join("v {:.6f} {:.6f} {:.6f}\n".format(*p / np.linalg.norm(p)) for p in points)
    for i, a in enumerate(points):
        for j in range(i + 1, 12):
            for k in range(j + 1, 12):
                b, c = points[j], points[k]
                if all(abs(np.linalg.norm(x - y) - 2) < 1e-3 for x, y in ((a, b), (b, c), (c, a))):
                    is_outward = np.dot(np.cross(b - a, c - a), a) > 0
                    text += f"f {i + 1} {(j if is_outward else k) + 1} {(k if is_outward else j) + 1}\n"
    return text


def leaves(chance):
    """A plant of thin triangles, seen and lit from both sides."""
    text = ""
    for leaf in range(24):
        turn, rise = 2.4 * leaf, 0.06 * leaf - 0.7
        side, up = 0.1 * chance.uniform(0.5, 1), chance.uniform(0.1, 0.5)
        x, z = math.cos(turn), math.sin(turn)
        text += f"v {-side * z:.4f} {rise:.4f} {side * x:.4f}\nv {side * z:.4f} {rise:.4f} {-side * x:.4f}\nv {0.9 * x:.4f} {rise + up:.4f} {0.9 * z:.4f}\n"
        text += f"f {3 * leaf + 1} {3 * leaf + 2} {3 * leaf + 3}\n"
    return text


def vector(values):
    return "[" + ", ".join(f"{value:.5g}" for value in values) + "]"


class RandomScene:
    """A scene whose lengths are all multiplied by `scale`."""

    def __init__(self, seed):
        self.chance = random.Random(seed)
        self.scale = self.chance.choice([1, 1, 0.5, 10])

    def point(self, *values):
        return vector(self.scale * value for value in values)

    def between(self, low, high):
        return self.chance.uniform(low, high)

    def color(self):
        return vector(self.chance.randrange(60, 256) for _ in range(3))

    def shape(self, radius):
        """One that fits into a ball of that radius, and whether POV-Ray draws all of its shadows exactly with any flags."""
        s = self.scale * radius
        segments = self.chance.choice([8, 12, 20, 40])
        return self.chance.choice([
            (f'type = "sphere"\nradius = {s:.5g}\nsegments = {segments}\n', True),
            (f'type = "cube"\nsize = {1.15 * s:.5g}\n', True),
            (f'type = "torus"\nmajor_radius = {0.7 * s:.5g}\nminor_radius = {0.28 * s:.5g}\nsegments = {segments}\n', False),
            (f'type = "teapot"\nsize = {0.9 * s:.5g}\nsegments = {self.chance.choice([4, 8])}\n', False),
            (f'type = "mesh"\nfile = "icosahedron.obj"\nscale = {vector([s, 0.8 * s, s])}\n', True),
            (f'type = "mesh"\nfile = "leaves.obj"\nscale = {vector([s, s, s])}\n', False)])

    def objects(self):
        text = '[[object]]\nname = "floor"\ntype = "mesh"\nfile = "floor.obj"\nreflection = "lambert"\nshading = "phong"\n'
        text += f"scale = {self.point(1, 1, 1)}\ncolor = {self.color()}\n"
        balls = []
        while len(balls) < 6:
            radius = self.between(0.35, 0.8)
            at = (self.between(-2.2, 2.2), self.between(radius + 0.01, 2.2), self.between(-2.2, 1.6))
            if any(math.dist(at, other) < radius + size + 0.02 for other, size in balls):
                continue
            balls.append((at, radius))
            shape, is_convex = self.shape(radius)
            text += f'[[object]]\n{shape}position = {self.point(*at)}\nrotation = {vector(self.between(0, 360) for _ in range(3))}\n'
            text += f'color = {self.color()}\nreflection = "{self.chance.choice(["lambert", "phong", "blinn-phong"])}"\n'
            text += f'shading = "{self.chance.choice(["phong", "angle-weighted", "area-weighted", "max-weighted"])}"\n'
            if is_convex and self.chance.random() < 0.15:
                text += "receives_shadows = false\n"
            if self.chance.random() < 0.1:
                text += "casts_shadows = false\n"
        return text

    def light(self, kind):
        area = self.scale * self.scale
        position = f"position = {self.point(self.between(-2.5, 2.5), self.between(2.8, 4.5), self.between(-2, 3))}\n"
        if kind == "directional":
            return f'direction = {vector([self.between(-1, 1), -1, self.between(-1, 0.5)])}\nintensity = {self.between(0.2, 0.5):.4g}\n'
        if kind == "point":
            law = self.chance.choice(["inverse-square", "offset-linear", "none"])
            intensity = {"inverse-square": 4 * area, "offset-linear": 1.5 * self.scale, "none": 0.4}[law] * self.between(0.5, 1)
            return position + f'attenuation = "{law}"\nattenuation_offset = {0.3 * self.scale:.4g}\nintensity = {intensity:.5g}\n'
        if kind == "spot":
            return position + (f"direction = {vector([self.between(-0.5, 0.5), -1, self.between(-0.5, 0.5)])}\ninner_angle = 20\nouter_angle = 45\n"
                               f"intensity = {6 * area:.5g}\n")
        return position + (f"edge_u = {self.point(1.5, 0, self.between(-0.5, 0.5))}\nedge_v = {self.point(0, self.between(0, 0.5), 1)}\nsamples_u = 3\n"
                           f"samples_v = 2\nintensity = {4 * area:.5g}\n")

    def text(self):
        size = self.chance.choice(['projection = "perspective"\nfov = 48', f'projection = "orthographic"\nheight = {4.6 * self.scale:.5g}'])
        text = ('version = 1\n[shadows]\nenabled = true\npattern = "fixed"\n[observer]\n'
                f'position = {self.point(self.between(-1.5, 1.5), 3.2, 5.2)}\nlook_at = {self.point(0, 0.8, 0)}\n{size}\n'
                f'[image]\nwidth = {WIDTH}\nheight = {HEIGHT}\nbackground = {self.color()}\n'
                f'[room]\nwidth = {20 * self.scale}\nheight = {20 * self.scale}\ndepth = {20 * self.scale}\n[constraints]\noverlap = "allow"\n')
        kinds = [self.chance.choice(["directional", "point", "spot", "distributed"]) for _ in range(self.chance.choice([1, 2, 3]))]
        self.lights = [f"light-{number}" for number in range(len(kinds))]
        text += '[[light]]\ntype = "ambient"\nintensity = 0.2\n'
        for name, kind in zip(self.lights, kinds):
            text += f'[[light]]\nname = "{name}"\ntype = "{kind}"\n{self.light(kind)}'
        return text + self.objects()


def read_ppm(path):
    return np.frombuffer(path.read_bytes()[-3 * WIDTH * HEIGHT:], np.uint8).reshape(HEIGHT, WIDTH, 3).astype(int)


def interior(terms):
    """The pixels whose neighbours, up to 1.5 pixels away, show the same objects and shadows."""
    result = np.ones((HEIGHT, WIDTH), bool)
    for term in terms:
        around = np.pad(term, ((1, 1), (1, 1), (0, 0)), mode="edge")
        for y in range(3):
            for x in range(3):
                result &= (around[y:y + HEIGHT, x:x + WIDTH] == term).all(axis=-1)
    return result


def compared(candela, seed, folder):
    """The numbers of interior pixels of a scene, and of those of them that differ."""
    scene = RandomScene(seed)
    files = {"scene.toml": scene.text(), "floor.obj": FLOOR, "icosahedron.obj": icosahedron(), "leaves.obj": leaves(scene.chance)}
    for name, text in files.items():
        (folder / name).write_text(text)
    terms = ["object", *(f"visibility.{light}" for light in scene.lights)]

    def run(*command):
        subprocess.run(command, cwd=folder, check=True, capture_output=True, timeout=120)

    run(candela, "render", "scene.toml", "-o", "ours.ppm", "--terms", ",".join(terms))
    # Open surfaces and hollows with smooth normals are the only approximations.
    run(candela, "generate", "scene.toml", "--target", "povray", "-o", ".", "--approximate")
    run("povray", "scene.ini", "+FP8", "+Oother.ppm")
    ours, other = read_ppm(folder / "ours.ppm"), read_ppm(folder / "other.ppm")
    shown = [read_ppm(folder / f"ours.{term}.ppm") for term in terms]
    inside = interior(shown) & shown[0].any(axis=-1)  # the background is black
    differs = (np.abs(ours - other).max(axis=-1) > 1) & inside
    return inside.sum(), differs.sum()


def main():
    candela, count = str(Path(sys.argv[1]).resolve()), int(sys.argv[2])
    first = int(sys.argv[3]) if len(sys.argv) > 3 else 1
    pixels = different = 0
    worst = (0, None)
    for seed in range(first, first + count):
        with tempfile.TemporaryDirectory(dir="/tmp") as folder:  # where POV-Ray may read and write
            inside, differs = compared(candela, seed, Path(folder))
        pixels, different = pixels + inside, different + differs
        worst = max(worst, (differs / inside, seed), key=lambda each: each[0])
        print(f"seed {seed}: {inside / (WIDTH * HEIGHT):.1%} interior of objects, {1 - differs / inside:.3%} of that equal", flush=True)
    print(f"{count} scenes: {1 - different / pixels:.4%} of {pixels} interior pixels are equal to 1/255; the worst scene, {worst[1]}: {1 - worst[0]:.3%}")
    return 0 if different <= (1 - BAR) * pixels else 1


if __name__ == "__main__":
    sys.exit(main())
