"""Scenes with shadows that together have solid, open and enclosing objects, which touch, overlap and are seen from below; every kind of
light, with samples that vary from pixel to pixel and that are fixed; light evaluated per pixel, at vertices and for faces, by every
shading and reflection model; all flags of lights and objects; ambient occlusion; textures; two triangles and twenty thousand; sizes
from a millimetre to a kilometre. Each scene has an exact variant, without what a target only approximates."""

import math
import random
import re
import typing

import texture_scenes

FRAME = """version = 1
[image]
width = 320
height = 240
samples = {samples}
background = [40, 60, 80]
color_management = "{encoding}"
[room]
width = 1e5
height = 1e5
depth = 1e5
[constraints]
overlap = "allow"
[shadows]
enabled = true
pattern = "{pattern}"
"""

SEEN = "[observer]\nposition = [1.2, 2.6, 5.2]\nlook_at = [0, 0.5, 0]\nfov = 42\n"
SEEN_FLAT = '[observer]\nposition = [1.2, 3.2, 5.2]\nlook_at = [0, 0.5, 0]\nprojection = "orthographic"\nheight = 4.6\n'
SEEN_LOW = "[observer]\nposition = [-2.4, 0.5, 4.2]\nlook_at = [0, 0.5, 0]\nfov = 46\n"

POINT = '[[light]]\nname = "lamp"\ntype = "point"\nposition = [1.6, 3.1, 1.9]\nintensity = 11\n'
SUN = '[[light]]\ntype = "directional"\ndirection = [0.8, -1, -0.55]\nintensity = 0.5\n'
LOW_SUN = '[[light]]\ntype = "directional"\ndirection = [0.9, -0.16, -0.4]\nintensity = 0.7\n'
SPOT = ('[[light]]\ntype = "spot"\nposition = [-2.2, 3.6, 1.4]\ndirection = [0.6, -1, -0.4]\nintensity = 16\ninner_angle = 14\n'
        'outer_angle = 33\n')
PANEL = ('[[light]]\ntype = "distributed"\nposition = [-0.6, 3.3, 1.2]\nintensity = 12\nedge_u = [1.4, 0, 0.4]\nedge_v = [0, 0, 0.9]\n'
         'samples_u = 4\nsamples_v = 3\n')
TUBE = '[[light]]\ntype = "distributed"\nposition = [2, 1.9, 1.5]\nintensity = 4\nedge_u = [0, 0.9, 0]\nsamples_u = 5\n'

# In the plane of a box's side, and two millimetres above another box.
NEAR_LAMPS = ('[[light]]\ntype = "point"\nposition = [-1.35, 0.8, 1.6]\nintensity = 1.5\n'
              '[[light]]\ntype = "point"\nposition = [0.5, 0.952, -0.3]\nintensity = 0.4\n')

# A light that is not data, and says how far away it is: an object beyond it does not block it.
LANTERN = """/// # Lantern
/// A lamp that is brighter towards the side.
struct LanternLight {
    vec3 position;    /// point in m: where it is
    float intensity;  /// = 8 [0, inf): at one metre
};

KERNEL Incident lantern_illuminate(LanternLight light, Receiver r) {
    vec3 to_source = light.position - r.position;
    float square = max(dot(to_source, to_source), 1.0e-8f);
    vec3 to_light = to_source * inversesqrt(square);
    vec3 sent = vec3(light.intensity * (1.5f - to_light.y * to_light.y) / square);
    return Incident(to_light, sent, sent);
}

KERNEL float lantern_distance(LanternLight light, Receiver r) {
    return length(light.position - r.position);
}
"""


def grid(columns, size):
    """A square floor of that many squares a side, facing up, with texture coordinates."""
    numbers = [(i / columns, k / columns) for k in range(columns + 1) for i in range(columns + 1)]
    lines = [f"v {size * (u - 0.5):.5f} 0 {size * (0.5 - v):.5f}\nvt {u:.5f} {v:.5f}" for u, v in numbers]
    for k in range(columns):
        for i in range(columns):
            corners = [k * (columns + 1) + i + 1 + step for step in (0, 1, columns + 2, columns + 1)]
            lines.append("f " + " ".join(f"{corner}/{corner}" for corner in corners))
    return "\n".join(lines) + "\n"


def hills(columns, size):
    """A landscape, open at its border."""
    lines = []
    for k in range(columns + 1):
        for i in range(columns + 1):
            x, z = i / columns - 0.5, 0.5 - k / columns
            y = 0.25 * math.sin(9 * x + 1) * math.cos(11 * z) + 0.06 * math.sin(31 * x * z + 20 * x)
            lines.append(f"v {size * x:.5f} {y:.5f} {size * z:.5f}")
    for k in range(columns):
        for i in range(columns):
            a = k * (columns + 1) + i + 1
            lines.append(f"f {a} {a + 1} {a + columns + 2} {a + columns + 1}")
    return "\n".join(lines) + "\n"


# A screen of separate strips, open, with a normal towards +z.
SCREEN = "".join(f"v {x} 0 0\nv {x + 0.12:.2f} 0 0\nv {x + 0.12:.2f} 1 0\nv {x} 1 0\n" for x in (-0.5, -0.25, 0, 0.25)) + "".join(
    f"f {i} {i + 1} {i + 2} {i + 3}\n" for i in (1, 5, 9, 13))
# A wall, seen and lit from both sides, with a bend in the middle.
WALL = "v -0.6 0 0.2\nv 0 0 0\nv 0.6 0 0.2\nv -0.6 1 0.2\nv 0 1 0\nv 0.6 1 0.2\nf 1 2 5 4\nf 2 3 6 5\n"
# A tray: a bottom and four leaning sides, open at the top.
TRAY = ("v -0.3 0 -0.3\nv 0.3 0 -0.3\nv 0.3 0 0.3\nv -0.3 0 0.3\nv -0.5 0.4 -0.5\nv 0.5 0.4 -0.5\nv 0.5 0.4 0.5\nv -0.5 0.4 0.5\n"
        "f 1 2 3 4\nf 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\n")


def square_ring():
    """A solid that is not convex, with sharp edges only: outer and inner corners below, and the same above."""
    sides = [(x * size, y, z * size) for y in (-0.17, 0.17) for size in (0.6, 0.33) for x, z in ((1, 1), (1, -1), (-1, -1), (-1, 1))]
    text = "".join(f"v {x:.3f} {y} {z:.3f}\n" for x, y, z in sides)
    for i in range(4):
        k = (i + 1) % 4
        for corners in ((i, k, 8 + k, 8 + i), (4 + k, 4 + i, 12 + i, 12 + k), (8 + i, 8 + k, 12 + k, 12 + i), (k, i, 4 + i, 4 + k)):
            text += "f " + " ".join(str(corner + 1) for corner in corners) + "\n"
    return text


def plant():
    """Thin triangles in all directions, seen and lit from both sides."""
    text = ""
    for leaf in range(24):
        turn, rise, up = 2.4 * leaf, 0.06 * leaf, 0.1 + 0.016 * (7 * leaf % 24)
        x, z = math.cos(turn), math.sin(turn)
        text += (f"v {-0.08 * z:.4f} {rise:.4f} {0.08 * x:.4f}\nv {0.08 * z:.4f} {rise:.4f} {-0.08 * x:.4f}\n"
                 f"v {0.8 * x:.4f} {rise + up:.4f} {0.8 * z:.4f}\nf {3 * leaf + 1} {3 * leaf + 2} {3 * leaf + 3}\n")
    return text


def files():
    """The files that the scenes use, by name. The floor of two triangles also reaches behind the observer."""
    texts = {"floor.obj": grid(1, 30), "fine.obj": grid(90, 9), "hills.obj": hills(60, 12), "screen.obj": SCREEN, "wall.obj": WALL,
             "tray.obj": TRAY, "plant.obj": plant(), "ring.obj": square_ring(), "lantern.kernel": LANTERN}
    return {**{name: text.encode() for name, text in texts.items()}, "waves.ppm": texture_scenes.ppm(128, 128, 255, 1)}


class Stage:
    """Makes parts of scenes from the models that a target has, `factors`. `is_exact`: without what POV-Ray approximates."""

    def __init__(self, factors, is_exact):
        self.reflections, self.shadings = factors["reflection"], factors["shading"]
        self.is_exact = is_exact

    def occlusion(self, rays, distance):
        return "" if self.is_exact else f"ambient_occlusion_rays = {rays}\nambient_occlusion_distance = {distance}\n"

    def ambient(self, rays=0, distance=1):
        return '[[light]]\ntype = "ambient"\nintensity = 0.25\n' + (self.occlusion(rays, distance) if rays else "")

    def hemisphere(self, rays, distance):
        if self.is_exact:
            return '[[light]]\ntype = "ambient"\ncolor = [60, 70, 90]\n'
        return '[[light]]\ntype = "hemisphere"\nsky_color = [90, 110, 160]\nground_color = [60, 50, 40]\n' + self.occlusion(rays, distance)

    def lantern(self, position, intensity):
        kind = "point" if self.is_exact else "lantern.kernel"
        return f'[[light]]\ntype = "{kind}"\nposition = {list(position)}\nintensity = {intensity}\n'

    def waved(self, thing):
        """The thing with a texture that its colour multiplies, in sRGB."""
        def textured(match):
            scale = [round((int(number) / 255) ** 2.2, 3) for number in match[1].split(",")]
            return f'color = {{ texture = "waves.ppm", scale = {scale} }}\n'
        return thing if self.is_exact else re.sub(r"(?m)^color = \[(.*)\]\n", textured, thing)

    def thing(self, shape, color, shading="phong", reflection="phong", receives=True, more=""):
        shading = shading if shading in self.shadings else "phong"
        reflection = reflection if reflection in self.reflections else "phong"
        more += "" if receives else "receives_shadows = false\n"
        return f'[[object]]\n{shape}color = {list(color)}\nshading = "{shading}"\nreflection = "{reflection}"\n{more}'

    def concave(self, shape, color, receives=True, **choice):
        """In POV-Ray, the parts of an object that is not convex always block each other's light."""
        return self.thing(shape, color, receives=receives or self.is_exact, **choice)

    def open_mesh(self, file, position, turn, color, is_smooth=False, **choice):
        """POV-Ray does not smooth the shadow of an open surface on itself."""
        angle = 180 if is_smooth and not self.is_exact else 0
        return self.concave(f'type = "mesh"\nfile = "{file}"\ncrease_angle = {angle}\nposition = {list(position)}\nrotation = [0, {turn}, 0]\n',
                            color, **choice)

    def floor(self, file="floor.obj", **choice):
        return self.thing(f'name = "floor"\ntype = "mesh"\nfile = "{file}"\n', (235, 235, 235), **choice)

    def ball(self, x, z, radius=0.45, segments=20, y=None, **choice):
        y = radius + 0.05 if y is None else y
        return self.thing(f'type = "sphere"\nradius = {radius}\nsegments = {segments}\nposition = [{x}, {y:.3f}, {z}]\n', (230, 120, 90), **choice)

    def box(self, x, z, y=0.36, size=0.7, turn=33, **choice):
        return self.thing(f'type = "cube"\nsize = {size}\nrotation = [0, {turn}, 0]\nposition = [{x}, {y}, {z}]\n', (120, 190, 230), **choice)

    def ring(self, x, z, segments=24, **choice):
        """A torus; where its inner side would be approximated, a square ring. It is turned so that no pixel shows what is nearer to its
        inner corners than a millimetre, where nothing casts shadows in POV-Ray."""
        shape = f'type = "torus"\nmajor_radius = 0.5\nminor_radius = 0.17\nsegments = {segments}\nrotation = [65, 0, 25]\n'
        if self.is_exact:
            shape = 'type = "mesh"\nfile = "ring.obj"\ncrease_angle = 0\nrotation = [60, 0, 20]\n'
        return self.concave(f"{shape}position = [{x}, 0.75, {z}]\n", (150, 220, 140), **choice)

    def pot(self, x, z, **choice):
        """A teapot; where its smooth open surfaces would be approximated, a tray with sharp edges."""
        color = (225, 215, 120)
        if self.is_exact:
            return self.open_mesh("tray.obj", (x, 0.02, z), 20, color, **choice)
        return self.thing(f'type = "teapot"\nsize = 0.6\nsegments = 8\nposition = [{x}, 0.32, {z}]\n', color, **choice)

    def screen(self, x, z, turn=0, **choice):
        return self.open_mesh("screen.obj", (x, 0.02, z), turn, (200, 150, 220), **choice)

    def wall(self, x, z, turn=0, **choice):
        return self.open_mesh("wall.obj", (x, 0.001, z), turn, (220, 200, 190), is_smooth=True, **choice)

    def still_life(self, **choice):
        return self.box(-1.3, 0.1, **choice) + self.ball(0, 0.4, **choice) + self.ring(1.2, -0.5, **choice) + self.pot(-0.1, -1.1, **choice)

    def enclosing(self, size, position, **choice):
        return self.concave(f'type = "cube"\nsize = {size}\nposition = {list(position)}\nencloses = true\n', (230, 225, 210), **choice)


def of_size(s, by):
    """A scene whose lengths are multiples of that."""
    lengths = [f"{by * x:.9g}" for x in (1.2, 2.6, 5.2, 1.6, 3.1, 1.9, 0.45, 0.5, 0.7, -1.1, 0.4)]
    if s.is_exact:
        pot = s.open_mesh("tray.obj", (-1.1 * by, 0.02 * by, 0), 20, (225, 215, 120), more=f"scale = {by}\n")
    else:
        pot = s.thing('type = "teapot"\nsize = {8}\nsegments = 8\nposition = [{9}, {10}, 0]\n'.format(*lengths), (225, 215, 120))
    return ("[observer]\nposition = [{0}, {1}, {2}]\nlook_at = [0, 0, 0]\nfov = 42\n".format(*lengths) + s.ambient() +
            '[[light]]\ntype = "point"\nposition = [{3}, {4}, {5}]\nattenuation = "none"\nintensity = 0.8\n'.format(*lengths) +
            s.floor(more=f"scale = {by}\n") +
            s.thing('type = "sphere"\nradius = {6}\nsegments = 20\nposition = [0, {7}, 0]\n'.format(*lengths), (230, 120, 90)) + pot)


def flags(s):
    """All flags, at all rates; POV-Ray's objects that are not convex always block light between their parts."""
    concave = "" if s.is_exact else s.ring(1.2, -0.5, shading="flat") + s.pot(-0.1, -1.1, receives=False)
    return (SEEN + s.ambient(4) + POINT + SUN + "casts_shadows = false\n" + TUBE + s.floor() + s.ball(0, 0.4, more="casts_shadows = false\n") +
            s.box(-1.3, 0.1, receives=False) + s.ball(1.1, 1, 0.3, shading="gouraud", receives=False, more="casts_shadows = false\n") +
            s.ball(-0.7, 1.1, 0.25, shading="gouraud") + concave)


def many_lights(s):
    """A ring of coloured lamps, each with its own hard shadows."""
    text = ""
    for i in range(14):
        turn = 2 * math.pi * i / 14
        text += (f'[[light]]\ntype = "point"\nposition = [{2.5 * math.cos(turn):.3f}, {1.6 + 0.1 * i:.2f}, {2.5 * math.sin(turn):.3f}]\n'
                 f"intensity = 0.9\ncolor = [{37 * i % 256}, {91 * i % 256}, {53 * i % 256}]\n")
    return SEEN_FLAT + s.ambient() + text + s.floor() + s.still_life() + s.screen(1.1, 1.2, 20)


def many_objects(s):
    """A field of boxes and balls, more of them than the boxes that are looked at before the triangles."""
    text = SEEN + s.ambient() + SUN + POINT + s.floor()
    for place in range(289):
        x, z = 0.27 * (place % 17 - 8), 0.27 * (place // 17 - 10)
        height = 0.05 + 0.05 * (place * 7 % 5)
        text += s.ball(x, z, 0.09, 8, height + 0.05) if place % 4 == 0 else s.box(x, z, height, 0.16, 13 * place % 90)
    return text


def mixed(s, number):
    """Reflection and shading models in turn, flags of objects, and all kinds of lights."""
    chance = random.Random(number)
    x = round(chance.uniform(-1, 1), 2)
    text = (SEEN if number != 1 else SEEN_FLAT) + s.ambient(12 if number % 2 == 0 else 0, 1.5)
    text += f'[[light]]\ntype = "directional"\ndirection = [{x}, -1, -0.4]\nintensity = 0.25\n'
    text += POINT.replace("11", "3") + SPOT.replace("16", "5")
    text += PANEL.replace("12", "3") + '[[light]]\nname = "inside"\ntype = "point"\nposition = [-1.6, 1.8, -0.5]\nintensity = 0.3\n'
    text += s.lantern((0.6, 0.4, 0.3), 0.3) + s.floor(reflection="lambert")
    fine, coarse, turn = chance.choice([14, 24]), chance.choice([9, 14]), chance.randrange(15, 60)

    def choice(place):
        turned = place + number
        return {"shading": s.shadings[turned % len(s.shadings)], "reflection": s.reflections[(turned + 2 * number) % len(s.reflections)],
                "receives": turned % 5 != 2, "more": "casts_shadows = false\n" if turned % 5 == 4 else ""}

    return (text + s.ball(-1.5, 0.4, 0.5, fine, **choice(0)) + s.ring(1.5, 0.6, coarse, **choice(1)) +
            s.box(-0.5, 1.4, 0.302, 0.6, turn, **choice(2)) + s.ball(0.1, -0.3, 0.35, coarse, 1.5, **choice(3)) + s.wall(0, -1.4, **choice(4)) +
            s.pot(0.5, 2.1, **choice(5)) + s.enclosing(0.5, (-1.6, 1.8, -0.5), **choice(6)))


class Scene(typing.NamedTuple):
    name: str
    content: typing.Callable[[Stage], str]
    samples: int = 1
    pattern: str = "varied"
    encoding: str = "srgb"


SCENES = [
    Scene("point and ambient",
          lambda s: SEEN + s.ambient() + POINT + s.floor() + s.still_life() + s.screen(1.1, 1.2, 20)),
    Scene("spot and sun, four samples",
          lambda s: SEEN + s.ambient() + SPOT + SUN + s.floor() + s.still_life() + s.screen(-1.4, 1.3, -30), samples=4),
    Scene("vertices and faces",
          lambda s: SEEN + s.ambient() + POINT + SUN + s.floor("fine.obj", shading="gouraud") + s.still_life(shading="gouraud") +
          s.ball(1.2, 1.3, shading="flat") + s.screen(-1.2, 1.2, 15, shading="flat")),
    Scene("faces in penumbras",
          lambda s: SEEN_FLAT + s.ambient() + PANEL + s.floor("fine.obj", shading="gouraud") + s.still_life(shading="flat")),
    Scene("penumbras that vary",
          lambda s: SEEN_FLAT + s.ambient() + PANEL + TUBE + s.floor() + s.still_life() + s.screen(1.1, 1.2, 20)),
    Scene("penumbras in steps, four samples",
          lambda s: SEEN + s.ambient() + PANEL + TUBE + s.floor() + s.still_life(), samples=4, pattern="fixed"),
    Scene("inside of a hall, and a shade around a lamp",
          lambda s: SEEN + s.ambient() + POINT + SPOT + s.enclosing(14, (0, 6.9, 0), reflection="lambert") +
          s.enclosing(0.5, (1.6, 3.1, 1.9), reflection="lambert") + s.still_life(reflection="half-lambert") +
          s.screen(1.1, 1.2, 20, reflection="gooch")),
    Scene("flags", flags),
    Scene("ambient occlusion",
          lambda s: SEEN + s.ambient(16, 1.5) + POINT + s.hemisphere(9, 0.6) + s.floor() + s.still_life() + s.screen(1.1, 1.2, 20)),
    Scene("models that light beyond the horizon",
          lambda s: SEEN_FLAT + s.ambient(8, 1) + SUN + SPOT + s.floor() + s.still_life(reflection="half-lambert") +
          s.ball(1.4, 1.2, segments=8, reflection="gooch"), pattern="fixed"),
    Scene("a light of another author",
          lambda s: SEEN + s.ambient() + s.lantern((1.6, 3.1, 1.9), 9) + s.floor() + s.still_life() + s.box(1.75, 2.05, 3.6, 0.6, 0)),
    # In POV-Ray, a pixel is at least a millimetre.
    Scene("a millimetre", lambda s: of_size(s, 0.1 if s.is_exact else 0.001)),
    Scene("a kilometre", lambda s: of_size(s, 1000)),
    Scene("a low sun and coarse meshes",
          lambda s: SEEN_LOW + s.ambient() + LOW_SUN + s.floor() + s.ball(-1.2, 0.2, 0.5, 6) + s.ball(0.2, 0.3, 0.5, 9) +
          s.ring(1.3, -0.2, 7) + s.wall(0.2, -1.4) + s.box(-0.4, 1.3, 0.21, 0.4)),
    Scene("fourteen lamps", many_lights),
    Scene("three hundred objects", many_objects),
    Scene("twenty thousand triangles",
          lambda s: SEEN + s.ambient() + POINT + SUN + s.ball(-0.9, 0.3, 0.7, 80) + s.ring(1.1, 0, 80) +
          s.open_mesh("hills.obj", (0, 0.1, 0), 0, (180, 200, 140), is_smooth=True)),
    Scene("things that touch, cut, and are stacked",
          lambda s: SEEN + s.ambient() + SUN + POINT + s.floor() + s.box(-1, 0, 0.35) + s.box(-1, 0, 0.95, 0.5, 10) +
          s.box(0.3, 0.6, 0.1, turn=0) + s.ball(0.5, -0.7, 0.5, 24, 0.2) + s.ball(0.8, -0.5, 0.4, 24, 0.6) + s.screen(0.3, 0.6, 30)),
    Scene("a lamp in the plane of a wall, and one that nearly touches",
          lambda s: SEEN + s.ambient() + NEAR_LAMPS + s.floor() + s.box(-1, 0, 0.35, turn=0) + s.box(0.5, -0.3, 0.6, turn=0) + s.ball(1.5, 0.8)),
    Scene("a plant, uneven scales, and values without encoding",
          lambda s: SEEN_FLAT + s.ambient() + SPOT.replace("16", "8") + POINT.replace("11", "7") + s.floor() +
          s.open_mesh("plant.obj", (0.3, 0.02, 0.2), 30, (120, 210, 110)) + s.ball(-1.4, 0.2, more="scale = [1, 0.5, 1.6]\n") +
          s.box(1.5, 0.9, 0.25, more="scale = [0.3, 0.6, 1.3]\n"), encoding="none"),
    Scene("textures",
          lambda s: SEEN + s.ambient() + PANEL + POINT.replace("11", "4") + s.waved(s.floor("fine.obj")) +
          s.waved(s.ball(0, 0.4)) + s.box(-1.3, 0.1) + s.ring(1.2, -0.5)),
    Scene("everything, seen in perspective", lambda s: mixed(s, 0)),
    Scene("everything, seen in parallel", lambda s: mixed(s, 1), pattern="fixed"),
    Scene("everything, without encoding", lambda s: mixed(s, 2), encoding="none"),
    Scene("everything, four samples", lambda s: mixed(s, 3), samples=4, pattern="fixed"),
]


def scene_text(factors, number, is_exact):
    """The TOML of a scene; it needs files()."""
    scene = SCENES[number]
    frame = FRAME.format(samples=1 if is_exact else scene.samples, pattern="fixed" if is_exact else scene.pattern, encoding=scene.encoding)
    return frame + scene.content(Stage(factors, is_exact))
