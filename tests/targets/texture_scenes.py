"""Scenes that together show a texture with every reflection model, evaluated per pixel, at vertices and for faces; repeated, clamped and mirrored;
magnified, and on a floor that recedes until a pixel covers tens of texels; alone and on vertex colours; with normals from pictures of
normals and of heights."""

import random
import struct

SCENES = 7  # of at most three rows, a model each
SHADINGS = ["phong", "gouraud", "flat"]  # one for each rate at which light is evaluated

# A quarter of a cylinder: its texture coordinates exceed the picture, and its vertices have colours.
COLUMNS, ROWS = 8, 4


def cylinder():
    lines = []
    for row in range(ROWS + 1):
        for column in range(COLUMNS + 1):
            turn = column / COLUMNS
            x, z = turn * 1.6 - 0.8, 0.5 - 2 * (turn - 0.5) ** 2
            color = [0.55 + 0.45 * turn, 1 - 0.4 * row / ROWS, 0.6 + 0.3 * abs(1 - 2 * turn)]
            lines.append(f"v {x:.4f} {row / ROWS - 0.5:.4f} {z:.4f} " + " ".join(f"{c:.3f}" for c in color))
            lines.append(f"vt {2.3 * turn - 0.6:.4f} {1.9 * row / ROWS - 0.4:.4f}")
    for row in range(ROWS):
        for column in range(COLUMNS):
            a = row * (COLUMNS + 1) + column + 1
            b, c, d = a + 1, a + COLUMNS + 2, a + COLUMNS + 1
            lines.append(f"f {a}/{a} {b}/{b} {c}/{c} {d}/{d}")
    return "\n".join(lines) + "\n"


# Two triangles from in front of the observer to forty metres away, with the picture repeated a dozen times along them.
FLOOR = """v -14 0 3
v 14 0 3
v 14 0 -40
v -14 0 -40
vt -3 0\nvt 4 0\nvt 4 12\nvt -3 12
f 1/1 2/2 3/3
f 1/1 3/3 4/4
"""


def ppm(width, height, largest, seed):
    """Soft waves with grain: between any two texels and at any two levels, the colour differs by a few steps."""
    chance = random.Random(seed)
    values = bytearray()
    for y in range(height):
        for x in range(width):
            wave = 0.5 + 0.16 * wave_of(x / width) * wave_of(y / height)
            for channel in range(3):
                value = wave + 0.05 * channel * wave_of(x / width + 0.2 * channel) + chance.uniform(-0.015, 0.015)
                number = round(largest * min(1, max(0, value)))
                values += struct.pack(">H" if largest > 255 else ">B", number)
    return f"P6\n{width} {height}\n{largest}\n".encode() + bytes(values)


def normals(width, height):
    """Waves as a normal map."""
    values = bytearray()
    for y in range(height):
        for x in range(width):
            tilt = 0.35 * wave_of(3 * x / width), 0.35 * wave_of(2 * y / height)
            values += bytes(round(127.5 + 127.5 * c) for c in (*tilt, (1 - tilt[0] ** 2 - tilt[1] ** 2) ** 0.5))
    return f"P6\n{width} {height}\n255\n".encode() + bytes(values)


def wave_of(x):
    """A periodic smooth wave from 0 to 1: a parabola up and one down."""
    x %= 1
    half, sign = (x, 1) if x < 0.5 else (x - 0.5, -1)
    return sign * 16 * half * (0.5 - half)


def files():
    """The files that the scenes use, by name; the pictures include one of odd size and one of 16 bits."""
    return {"floor.obj": FLOOR.encode(), "cylinder.obj": cylinder().encode(), "fine.ppm": ppm(256, 256, 255, 1),
            "odd.ppm": ppm(61, 43, 255, 2), "deep.ppm": ppm(48, 64, 65535, 3),
            "normals.ppm": normals(64, 48)}


NORMALS = [
    "", 'normal_map = { texture = "normals.ppm", scale = 0.8, transform = { scale = [2, 1.5], rotation = 20 } }\n',
    'bump_map = { texture = "deep.ppm", height = 0.1, wrap = "clamp" }\n',
]

WRAPS = ['wrap = "repeat"', 'wrap = "clamp"', 'wrap = "mirror"', 'wrap = "clamp", wrap_v = "mirror"', 'wrap = "mirror", wrap_v = "repeat"']

PLACED = ['encoding = "auto"', "transform = { rotation = 25 }", "transform = { scale = [1.5, 0.8], offset = [0.1, 0.3] }"]

SHAPES = [
    'type = "mesh"\nfile = "cylinder.obj"\nscale = [0.75, 0.75, 0.75]\n',
    'type = "sphere"\nradius = 0.45\nsegments = 24\nrotation = [20, 40, 0]\n',
    'type = "torus"\nmajor_radius = 0.36\nminor_radius = 0.15\nsegments = 24\nrotation = [60, 20, 0]\n',
    'type = "cube"\nsize = 0.7\nrotation = [25, 40, 0]\n',
]


def scene_text(reflections, number):
    """The TOML of a scene with a share of the reflection models."""
    share = reflections[number::SCENES]
    is_perspective = number != 2
    size = "fov = 44" if is_perspective else "height = 4.2"
    text = (f'version = 1\n[observer]\nposition = [0.2, 1.3, 4.6]\nlook_at = [0, 0.2, 0]\nprojection = "{"perspective" if is_perspective else "orthographic"}"\n'
            f'{size}\n[image]\nwidth = 360\nheight = 270\nsamples = {4 if number == 1 else 1}\nbackground = [40, 60, 80]\n'
            f'color_management = "{"none" if number == 3 else "srgb"}"\n[room]\nwidth = 100\nheight = 100\ndepth = 100\n[constraints]\noverlap = "allow"\n'
            '[[light]]\ntype = "ambient"\ncolor = [120, 120, 130]\n[[light]]\ntype = "directional"\ndirection = [-0.4, -1, -0.9]\nintensity = 0.6\n'
            '[[light]]\ntype = "point"\nposition = [-1.5, 3, 3]\nintensity = 9\nattenuation = "offset-linear"\nattenuation_offset = 1.5\n'
            '[[object]]\nname = "floor"\ntype = "mesh"\nfile = "floor.obj"\nposition = [0, -1.2, 0]\nshading = "phong"\nreflection = "lambert"\n'
            f'color = {{ texture = "{"deep" if number == 3 else "fine"}.ppm", scale = [1, 0.96, 0.87] }}\n')
    for row, reflection in enumerate(share):
        for column, shading in enumerate(SHADINGS):
            place = number + row + column
            picture = ["fine", "odd", "deep"][(row + column) % 3]
            text += (f'[[object]]\nposition = [{1.3 * (column - 1):.2f}, {1.35 - 1.05 * row:.2f}, {-0.4 * (row == 0):.2f}]\nshading = "{shading}"\n'
                     f'reflection = "{reflection}"\ncolor = {{ texture = "{picture}.ppm", scale = [{0.8 - 0.14 * row:.2f}, 0.87, {0.58 + 0.1 * column:.2f}], '
                     f'{WRAPS[(place // 2) % len(WRAPS)]}, {PLACED[place % len(PLACED)]} }}\n' + NORMALS[(number + row) % len(NORMALS)] + SHAPES[place % len(SHAPES)])
    return text
